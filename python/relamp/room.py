"""A room without its light, as `relamp.delight` gives it."""

from __future__ import annotations

import json
import os
import threading
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _relamp
from .lights import Lights, lights_of
from .progress import Progress, watcher_of
from .relit import Light, Relit, text_and_file

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class CrossValidation:
    """Whether places of one paint, which no fit looked at, agree better in the albedo than in the scan.

    Source: docs/method/cross_validation.md.
    """

    pairs: int  #: pairs of places that were compared; 0: too few to tell
    scan: float  #: stops that they differ by in the scan
    albedo: float  #: stops that they differ by in the albedo
    gain: float  #: dB, 20 log10(scan / albedo)
    improves: bool  #: False: they agree clearly better in the scan


def _frozen(values: Array) -> Array:
    values.flags.writeable = False
    return values


class Page:
    """One texture of a room. Arrays have its size, row 0 on top, and are read-only.

    They are computed when the first is asked for, once, and every later look at them is at the same
    memory, which an array keeps for as long as it is used, whether the room is or not.
    """

    def __init__(self, decomposition: _relamp.Decomposition, index: int, threads: int) -> None:
        self._decomposition = decomposition
        self._index = index
        self._threads = threads
        self._lock = threading.RLock()
        self._made: Dict[str, Any] = {}

    def _once(self, name: str, make: Callable[[], Any]) -> Any:
        with self._lock:
            if name not in self._made:
                self._made[name] = make()
            return self._made[name]

    def _float(self, name: str) -> Array:
        """A layer of the library's half floats or bytes; only those that are asked for are made."""
        layers = self._once(
            "layers", lambda: self._decomposition.layers(self._index, self._threads, None)
        )
        return _frozen(layers[name].astype(np.float32))

    def _layer(self, name: str) -> Array:
        made: Array = self._once(name, lambda: self._float(name))
        return made

    def _geometry(self) -> Tuple[Array, Array]:
        made: Tuple[Array, Array] = self._once(
            "geometry", lambda: self._decomposition.geometry(self._index, self._threads)
        )
        return made

    @property
    def albedo(self) -> Array:
        """(H, W, 3) float32, linear, 0..0.9: the colour of the surfaces without any light."""
        return self._layer("albedo")

    @property
    def direct(self) -> Array:
        """(H, W, 3) float32: irradiance / pi straight from the lamps, windows and the sun."""
        return self._layer("direct")

    @property
    def indirect(self) -> Array:
        """(H, W, 3) float32: irradiance / pi by way of other surfaces, and through holes."""
        return self._layer("indirect")

    @property
    def shading(self) -> Array:
        """(H, W, 3) float32: direct + indirect. Times the albedo it is the scan, linear."""
        made: Array = self._once("shading", lambda: _frozen(self.direct + self.indirect))
        return made

    @property
    def confidence(self) -> Array:
        """(H, W) float32, 0 (albedo is a guess) to 1. Source: docs/method/confidence.md."""
        made: Array = self._once(
            "confidence", lambda: _frozen(self._float("confidence") / np.float32(255))
        )
        return made

    @property
    def fixtures(self) -> Array:
        """(H, W) int32: the id of the lamp or window; -1 none, -2 burnt out and no lamp."""
        made: Array = self._once(
            "fixtures", lambda: self._decomposition.fixtures(self._index, self._threads)
        )
        return made

    @property
    def positions(self) -> Array:
        """(H, W, 3) float32: where texels lie in the world, m; 0 where no surface is."""
        return self._geometry()[0]

    @property
    def normals(self) -> Array:
        """(H, W, 3) float32, unit; 0 where no surface is."""
        return self._geometry()[1]

    def __repr__(self) -> str:
        return f"<relamp.Page {self._index} of {self._decomposition.name!r}>"


class Room:
    """A scanned room taken apart. `albedo` and the other arrays are those of its first page.

    >>> room.albedo.shape == room.shading.shape
    True
    >>> room.albedo.dtype, room.albedo is room.pages[0].albedo
    (dtype('float32'), True)
    >>> [fixture.name for fixture in room.lights.fixtures][:1]
    ['window 0']
    """

    def __init__(self, decomposition: _relamp.Decomposition, threads: int = 0) -> None:
        self._decomposition = decomposition
        self._threads = threads
        self.pages: Tuple[Page, ...] = tuple(
            Page(decomposition, index, threads) for index in range(decomposition.page_count)
        )
        self._lock = threading.Lock()
        self._lighter: Optional[_relamp.Lighter] = None

    @property
    def lights(self) -> Lights:
        """The lamps, windows and the sun that were on."""
        return lights_of(self._decomposition.lights)

    @property
    def cross_validation(self) -> CrossValidation:
        """Whether the albedo is better than the scan, as far as that can be told without truth."""
        return CrossValidation(**self._decomposition.cross_validation)

    @property
    def warnings(self) -> Tuple[str, ...]:
        """What a person should know of this result, a sentence each."""
        return tuple(self._decomposition.warnings)

    albedo = property(lambda self: self.pages[0].albedo, doc=Page.albedo.__doc__)
    direct = property(lambda self: self.pages[0].direct, doc=Page.direct.__doc__)
    indirect = property(lambda self: self.pages[0].indirect, doc=Page.indirect.__doc__)
    shading = property(lambda self: self.pages[0].shading, doc=Page.shading.__doc__)
    confidence = property(lambda self: self.pages[0].confidence, doc=Page.confidence.__doc__)
    fixtures = property(lambda self: self.pages[0].fixtures, doc=Page.fixtures.__doc__)
    positions = property(lambda self: self.pages[0].positions, doc=Page.positions.__doc__)
    normals = property(lambda self: self.pages[0].normals, doc=Page.normals.__doc__)

    def relight(
        self,
        lights: Optional[Light] = None,
        *,
        fixtures: Optional[Mapping[Union[int, str], str]] = None,
        progress: Progress = None,
    ) -> Relit:
        """The room in another light, with shadows and all bounces. Fixtures are off unless told.

        lights: a lights file, or its content as a dict. fixtures: what becomes of the room's own
        lamps by number, name or 'all': 'on', 'off', '50%', '2700K,800lm', 'window'. Rays are cast
        for the first light only. Raises relamp.Error naming the key or setting.
        Source: docs/guide/relighting.md.

        >>> room.relight(fixtures={"all": "on"}).picture(size=(64, 36)).shape
        (36, 64, 3)
        """
        text, file = text_and_file(lights)
        watcher = watcher_of(progress)
        settings = [f"{which}={what}" for which, what in (fixtures or {}).items()]
        with self._lock:
            if self._lighter is None:
                self._lighter = _relamp.Lighter(self._decomposition, self._threads, watcher)
        relit = self._lighter.relight(text, file, settings, self._threads, watcher)
        return Relit(relit, len(self.pages), self._threads)

    def bake(
        self,
        lights: Optional[Light] = None,
        *,
        fixtures: Optional[Mapping[Union[int, str], str]] = None,
        progress: Progress = None,
    ) -> List[Array]:
        """Radiance of the relit room's textures, (H, W, 3) float32 a page; as relight() has it."""
        return self.relight(lights, fixtures=fixtures, progress=progress).radiance

    def save(
        self,
        folder: Union[str, "os.PathLike[str]"],
        *,
        force: bool = False,
        usd: bool = False,
        progress: Progress = None,
    ) -> Dict[str, Any]:
        """Writes what `relamp delight -o folder` writes, whole or not at all; returns report.json.

        force: also replace files that relamp did not write. usd: also write <scan>.usda, the room
        for programs that read USD. Raises relamp.Error where the folder cannot be written.
        Source: docs/guide/results.md.
        """
        watcher = watcher_of(progress)
        report = self._decomposition.save(os.fspath(folder), force, usd, self._threads, watcher)
        parsed: Dict[str, Any] = json.loads(report)
        return parsed

    def __repr__(self) -> str:
        lamps = len(self._decomposition.lights.fixtures)
        return f"<relamp.Room {self._decomposition.name!r}: {lamps} lamps and windows>"
