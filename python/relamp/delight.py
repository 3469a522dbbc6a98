"""Takes the light out of a scan."""

from __future__ import annotations

import os
import warnings
from typing import Any, Dict, Iterable, Optional, Tuple, Union

from . import _relamp
from .places import Place, ends_of, places_of
from .progress import Progress, watcher_of
from .room import Room

_READING = ("up", "scale", "transfer", "skip_mesh", "allow_outside", "allow_overlap", "longest_side")
_THESIS = (
    "emitter_threshold", "expansion", "light_levels", "attenuation", "power", "ambient", "merge_distance", "rsm_size",
    "lpv_size", "lpv_steps", "flatten_reach", "flatten_range", "no_lpv", "no_ambient",
)  # fmt: skip
Path = Union[str, "os.PathLike[str]"]


def _refuse_what_has_no_effect(given: Dict[str, Any], solver: str, lights: Optional[Path]) -> None:
    """A person means something by every keyword."""
    meant = [keyword for keyword, value in given.items() if value]
    if not meant:
        return
    if solver == "thesis":
        raise ValueError(f"{meant[0]}: the thesis solver has no use for it; leave it out")
    if lights is not None:
        raise ValueError(f"{meant[0]}: nothing is estimated where the lights are given; leave it out")


def delight(
    scan: Union[_relamp.Scan, Path],
    *,
    solver: str = "gather",
    quality: str = "standard",
    lights: Optional[Path] = None,
    light: Iterable[Place] = (),
    not_a_light: Iterable[Place] = (),
    same: Iterable[Tuple[Place, Place]] = (),
    white: Iterable[Place] = (),
    no_sun: bool = False,
    no_gain: bool = False,
    response: Optional[Path] = None,
    rays: int = 0,
    shadow_rays: int = 0,
    seed: int = 1,
    samples: int = 64,
    darkest: float = 0.005,
    fill: bool = False,
    engine: str = "auto",
    gpu: str = "",
    threads: int = 0,
    progress: Progress = None,
    **more: Any,
) -> Room:
    """Takes the light out of a scan, as the program `relamp delight` does; keywords are its options.

    scan: a file, or a relamp.Scan. For a file, `more` can be keywords of relamp.read_scan: up,
    scale, transfer, skip_mesh, allow_outside, allow_overlap. For the thesis solver it can be its
    parameters: emitter_threshold, expansion, light_levels, attenuation, power, ambient,
    merge_distance, rsm_size, lpv_size, lpv_steps, flatten_reach, flatten_range, no_lpv, no_ambient;
    see docs/guide/thesis.md.
    solver: 'gather', 'pathtrace' or 'thesis'. quality: 'draft', 'standard' or 'high'.
    lights: a lights.json, instead of looking for lamps. light, not_a_light: places (m) that shine or
    do not; same: pairs of places of one paint; white: places that are white as paper.
    response: 'straight', or a lights.json or report.json of another scan by the same camera.
    rays 4..1024, shadow_rays 1..1024, 0: by quality. samples 1..65536, of the solver pathtrace.
    darkest: 1e-6..1, shading below is believed the less the darker it is. engine: 'auto', 'cpu',
    'gpu'. threads: 0 is one a core. progress: called with a stage's name and its share done, 0..1;
    True: a bar by tqdm.

    The same scan and keywords give the same result on any number of threads. Ctrl-C ends it.
    Raises relamp.Error with a sentence about the scan or a file, ValueError about a keyword.

    >>> relamp.delight("nowhere.glb")
    Traceback (most recent call last):
    relamp.Error: nowhere.glb: no such file
    >>> relamp.delight("nowhere.glb", quality="best")
    Traceback (most recent call last):
    ValueError: quality="best" is none of draft, standard, high
    """
    searched = {
        "light": places_of("light", light),
        "not_a_light": places_of("not_a_light", not_a_light),
        "same": ends_of("same", same),
        "white": places_of("white", white),
        "no_sun": bool(no_sun),
        "no_gain": bool(no_gain),
    }
    curve = "" if response is None else os.fspath(response)
    reading = {keyword: value for keyword, value in more.items() if keyword in _READING}
    thesis = {keyword: value for keyword, value in more.items() if keyword in _THESIS}
    for keyword in more:
        if keyword not in _READING and keyword not in _THESIS:
            raise TypeError(f"delight() got an unexpected keyword argument '{keyword}'")
        if keyword in _THESIS and solver != "thesis":
            raise ValueError(f"{keyword}: only the thesis solver has a use for it; leave it out")
    _refuse_what_has_no_effect({**searched, "response": curve}, solver, lights)
    if not 1e-6 <= darkest <= 1:
        raise ValueError(f"darkest={darkest} is not between 1e-06 and 1")
    if not 0 <= seed < 2**32:
        raise ValueError(f"seed={seed} is not between 0 and 4294967295")
    if not 0 <= threads <= 1024:
        raise ValueError(f"threads={threads} is not between 0 and 1024")
    options = _relamp.Options({
        **searched,
        "solver": str(solver),
        "quality": str(quality),
        "rays": int(rays),
        "shadow_rays": int(shadow_rays),
        "seed": int(seed),
        "samples": int(samples),
        "darkest": float(darkest),
        "fill": bool(fill),
        "thesis": thesis,
        "engine": str(engine),
        "gpu": str(gpu),
    })
    watcher = watcher_of(progress)
    if isinstance(scan, _relamp.Scan):
        if reading:
            raise ValueError(f"{next(iter(reading))}: the scan is read already; it goes to read_scan")
    else:
        scan = _relamp.read_scan(os.fspath(scan), progress=watcher, **reading)
    found, notes = _relamp.delight(
        scan, options, "" if lights is None else os.fspath(lights), curve, threads, watcher
    )
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return Room(found, threads)
