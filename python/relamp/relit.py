"""A room in another light."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, List, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _relamp
from .lights import Triple
from .places import is_finite

#: What a lights file says (docs/guide/lights.md): its path, or its content as a dict.
Light = Union[str, "os.PathLike[str]", Mapping[str, Any]]


@dataclass(frozen=True)
class Camera:
    """A pinhole that looks into the room; places in metres, Y up.

    >>> Camera(position=(1, 1.6, 1), target=(1, 1.6, 1))
    Traceback (most recent call last):
    ValueError: target: it is where the camera stands, so that it looks nowhere
    """

    position: Triple
    target: Triple  #: that it looks at
    up: Triple = (0.0, 1.0, 0.0)
    field_of_view: float = 1.3  #: rad across the width, 0..pi

    def __post_init__(self) -> None:
        if not is_finite([*self.position, *self.target, *self.up, self.field_of_view]):
            raise ValueError("Camera: all numbers must be finite")
        if not 0 < self.field_of_view < math.pi:
            raise ValueError(f"field_of_view={self.field_of_view} is not between 0 and pi")
        forward = np.subtract(self.target, self.position)
        if not np.linalg.norm(forward) > 0:
            raise ValueError("target: it is where the camera stands, so that it looks nowhere")
        if not np.linalg.norm(np.cross(forward, self.up)) > 1e-6 * np.linalg.norm(forward):
            raise ValueError("up: it lies along the view, so that nothing shows upwards")

    def arguments(self) -> Tuple[Triple, Triple, Triple, float]:
        """Position, unit forward, unit up, field of view."""

        def unit(vector: npt.NDArray[Any]) -> Triple:
            x, y, z = (vector / np.linalg.norm(vector)).tolist()
            return x, y, z

        forward = unit(np.subtract(self.target, self.position))
        position = (float(self.position[0]), float(self.position[1]), float(self.position[2]))
        return position, forward, unit(np.asarray(self.up, float)), float(self.field_of_view)


def refuse_picture(size: Tuple[int, int], antialias: int, exposure: Optional[float]) -> None:
    """A ValueError where the numbers of a picture are not what they can be."""
    width, height = (int(side) for side in size)
    if not (1 <= width <= 16384 and 1 <= height <= 16384):
        raise ValueError(f"size={size}: sides are between 1 and 16384 pixels")
    if not 1 <= antialias <= 16:
        raise ValueError(f"antialias={antialias} is not between 1 and 16")
    if exposure is not None and not -32 <= exposure <= 32:
        raise ValueError(f"exposure={exposure} is not between -32 and 32")


class Relit:
    """A room under one light; Room.relight() makes it."""

    def __init__(self, relit: _relamp.Relit, page_count: int, threads: int) -> None:
        self._relit = relit
        self._page_count = page_count
        self._threads = threads

    @property
    def warnings(self) -> Tuple[str, ...]:
        """What was passed over of the light, or is doubtful of it, a sentence each."""
        return tuple(self._relit.warnings)

    @property
    def radiance(self) -> List[npt.NDArray[Any]]:
        """(H, W, 3) float32 a page: the light on the walls, all bounces; 1 = the scan's white."""
        return [self._relit.radiance(page).astype(np.float32) for page in range(self._page_count)]

    def picture(
        self,
        camera: Optional[Camera] = None,
        *,
        size: Tuple[int, int] = (1280, 720),
        view: str = "agx",
        exposure: Optional[float] = None,
        antialias: int = 2,
        linear: bool = False,
    ) -> npt.NDArray[Any]:
        """What a camera sees: (H, W, 3) uint8, sRGB; with `linear` float32, the light itself.

        camera: None is a view from inside that shows much of the room. size: width and height,
        1..16384. view: 'agx', 'aces' or 'standard'. exposure: stops, -32..32; None: the log-average
        becomes middle grey. antialias: rays through a pixel, along each side, 1..16.
        """
        refuse_picture(size, antialias, exposure)
        width, height = size
        arguments = None if camera is None else camera.arguments()
        picture = self._relit.picture(
            arguments, (int(width), int(height)), view, exposure, int(antialias), bool(linear), self._threads, None
        )
        return picture.astype(np.float32) if linear else picture


def text_and_file(light: Optional[Light]) -> Tuple[str, str]:
    """The text of a lights file, and where it lies."""
    if light is None:
        return "", ""
    if isinstance(light, Mapping):
        return json.dumps(light), "lights"
    path = Path(os.fspath(light))
    try:
        return path.read_text(encoding="utf-8"), str(path)
    except (OSError, UnicodeDecodeError) as failure:
        reason = getattr(failure, "strerror", None) or "it is no text"
        raise _relamp.Error(f"{path}: cannot be read: {reason}") from None
