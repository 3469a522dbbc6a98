"""What a scan is, before its light is taken out."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Tuple, Union

from . import _relamp
from .lights import Triple
from .progress import Progress, watcher_of


@dataclass(frozen=True)
class PageInspection:
    """One texture of a scan in numbers."""

    name: str
    width: int
    height: int
    of_vertices: bool  #: made of colours of vertices
    coverage: float  #: share of pixels that show a surface, 0..1
    clipped: float  #: share of these with a channel at the top of its range, 0..1
    charts: int  #: connected pieces of its UV layout


@dataclass(frozen=True)
class Cost:
    """What relamp.delight will take of a scan, on the CPU, at least: lamps are not counted yet."""

    bytes: float  #: of memory, at the peak
    core_seconds: float  #: summed over all threads


@dataclass(frozen=True)
class Inspection:
    """What a scan is, and what will be a problem in it."""

    triangles: int
    meshes: int
    texels: int
    square_metres: float
    millimetres_per_texel: float
    extent: Triple  #: m
    overlap: float  #: share of texels that stand for more than one place, 0..1
    pages: Tuple[PageInspection, ...]
    cost: Cost
    problems: Tuple[str, ...]  #: a sentence each, with what to do about it


def inspect(
    scan: Union[_relamp.Scan, str, "os.PathLike[str]"],
    *,
    threads: int = 0,
    progress: Progress = None,
    **reading: Any,
) -> Inspection:
    """Looks a scan over, as `relamp info` does.

    scan: a file, or a relamp.Scan; reading: keywords of relamp.read_scan, for a file. Raises
    relamp.Error with a sentence where the file is no textured surface.
    Source: docs/guide/scans.md.

    >>> relamp.inspect("nowhere.glb")
    Traceback (most recent call last):
    relamp.Error: nowhere.glb: no such file
    """
    watcher = watcher_of(progress)
    if not isinstance(scan, _relamp.Scan):
        scan = _relamp.read_scan(os.fspath(scan), progress=watcher, **reading)
    elif reading:
        raise ValueError(f"{next(iter(reading))}: the scan is read already; it goes to read_scan")
    found = _relamp.inspect(scan, threads, watcher)
    pages = tuple(PageInspection(**page) for page in found.pop("pages"))
    cost = Cost(**found.pop("cost"))
    return Inspection(pages=pages, cost=cost, problems=tuple(found.pop("problems")), **found)
