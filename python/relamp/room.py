"""A room without its light, as `relamp.delight` gives it."""

from __future__ import annotations

import json
import os
import threading
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _relamp
from .lights import Lights, Triple, lights_of
from .page import Array, Page
from .progress import Progress, Watcher, watcher_of
from .relit import Camera, Light, Relit, refuse_picture, text_and_file

Path = Union[str, "os.PathLike[str]"]
Settings = Optional[Mapping[Union[int, str], str]]


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


@dataclass(frozen=True)
class Opening:
    """A large hole of a scan, through which light comes: a window, a door, a missing ceiling.

    Source: docs/method/openings.md.
    """

    centre: Triple  #: m
    normal: Triple  #: unit, into the room
    area: float  #: m^2
    radiance: Triple  #: 1 = the texture's white: mean of what lies behind it


@dataclass(frozen=True)
class CameraModel:
    """What the camera made of the light of the room. Source: docs/method/camera.md."""

    contrast: float  #: stops of the texture that a stop of light made in the mid-tones
    response: Tuple[float, ...]  #: slopes of the curve at 6, 4, 2.5, 1.2 and 0 stops below white
    local_exponent: float  #: of brightness over half a metre; 1: no local tone mapping
    gain_stops: float  #: from the darkest place's exposure to the brightest's
    drifted: float  #: 0..1, how likely the exposure did


def _settings(fixtures: Settings) -> List[str]:
    return [f"{which}={what}" for which, what in (fixtures or {}).items()]


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
    def openings(self) -> Tuple[Opening, ...]:
        """Large holes of the scan that light comes through, by falling area."""
        return tuple(Opening(**opening) for opening in self._decomposition.openings)

    @property
    def camera(self) -> CameraModel:
        """What the camera did, which the albedo is free of."""
        return CameraModel(**self._decomposition.camera)

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
    doubt = property(lambda self: self.pages[0].doubt, doc=Page.doubt.__doc__)
    correction = property(lambda self: self.pages[0].correction, doc=Page.correction.__doc__)
    emission = property(lambda self: self.pages[0].emission, doc=Page.emission.__doc__)
    fixtures = property(lambda self: self.pages[0].fixtures, doc=Page.fixtures.__doc__)
    positions = property(lambda self: self.pages[0].positions, doc=Page.positions.__doc__)
    normals = property(lambda self: self.pages[0].normals, doc=Page.normals.__doc__)

    def relight(
        self,
        lights: Optional[Light] = None,
        *,
        fixtures: Settings = None,
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
        relit = self._lit(watcher).relight(text, file, _settings(fixtures), self._threads, watcher)
        return Relit(relit, len(self.pages), self._threads)

    def _lit(self, watcher: Optional[Watcher]) -> _relamp.Lighter:
        with self._lock:
            if self._lighter is None:
                self._lighter = _relamp.Lighter(self._decomposition, self._threads, watcher)
            return self._lighter

    def bake(
        self,
        lights: Optional[Light] = None,
        *,
        fixtures: Settings = None,
        progress: Progress = None,
    ) -> List[Array]:
        """Radiance of the relit room's textures, (H, W, 3) float32 a page; as relight() has it."""
        return self.relight(lights, fixtures=fixtures, progress=progress).radiance

    def film(
        self,
        target: Path,
        lights: Optional[Light] = None,
        *,
        fixtures: Settings = None,
        turntable: int = 0,
        timeline: Optional[Path] = None,
        fps: float = 24,
        camera: Optional[Camera] = None,
        size: Tuple[int, int] = (1280, 720),
        view: str = "agx",
        exposure: Optional[float] = None,
        antialias: int = 2,
        force: bool = False,
        progress: Progress = None,
    ) -> Tuple[str, ...]:
        """Writes a film, whole or not at all: target is a .mp4, by ffmpeg, or a folder of pictures.

        turntable: frames 1..9999 of one turn of the camera. timeline: a file of light that changes.
        One of them is needed. fps: frames a second, 1..240. Light as of relight(), pictures as of
        Relit.picture(). Returns warnings, a sentence each. Raises relamp.Error where the film
        cannot be written. Source: docs/guide/relighting.md.
        """
        if not 0 <= turntable <= 9999:
            raise ValueError(f"turntable={turntable} is not between 1 and 9999")
        if not turntable and timeline is None:
            raise ValueError("film() needs turntable, a number of frames, or timeline, a file")
        if not 1 <= fps <= 240:
            raise ValueError(f"fps={fps} is not between 1 and 240")
        refuse_picture(size, antialias, exposure)
        pose = None if camera is None else camera.arguments()
        width, height = size
        arguments = _relamp.FilmArguments(
            pose, (int(width), int(height)), view, exposure, int(antialias), int(turntable), float(fps), force
        )
        text, file = text_and_file(lights)
        changes = "" if timeline is None else os.fspath(timeline)
        watcher = watcher_of(progress)
        notes = _relamp.write_film(
            self._lit(watcher),
            os.fspath(target),
            text,
            file,
            _settings(fixtures),
            changes,
            arguments,
            self._threads,
            watcher,
        )
        return tuple(notes)

    def save(
        self,
        folder: Path,
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
