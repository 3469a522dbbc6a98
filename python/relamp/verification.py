"""How well a result gives its scan again."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple, Union

from . import _relamp
from .lights import Triple
from .progress import Progress, watcher_of


@dataclass(frozen=True)
class VerifiedBin:
    """Places of about the same shading."""

    shading: float  #: mean luminance of radiance / albedo
    ratio: float  #: luminance of what was rendered over that of the scan
    rms_error: float  #: radiance


@dataclass(frozen=True)
class Verification:
    """Albedo under the lights found, every bounce simulated, beside the scan. By area."""

    scan: Path
    fixtures: Tuple[str, ...]  #: names of those that shone
    places: int  #: that were compared: texels that are not burnt out
    rms_error: float  #: radiance, 1 = the texture's white
    standard_error: float  #: of rms_error
    rms_of_scan: float  #: of the texture there, to compare with
    as_white_as_paper: float  #: share of the area whose albedo is 0.87: there light may lack
    rms_error_elsewhere: float  #: rms_error without these places
    psnr: float  #: dB, peak 1
    ratio: Triple  #: of what was rendered over the scan, means of each channel
    bins: Tuple[VerifiedBin, ...]  #: five, of equal area, from dark to bright
    warnings: Tuple[str, ...]


def verify(
    folder: Union[str, "os.PathLike[str]"],
    *,
    samples: int = 64,
    places: int = 20000,
    seed: int = 1,
    scan: Optional[Union[str, "os.PathLike[str]"]] = None,
    allow_outside: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Verification:
    """Renders what a folder of Room.save() or `relamp delight` says and compares it with the scan.

    samples: paths from every place, 2..65536; places: texels looked at; scan: where the scan is, if
    it was moved. The same seed gives the same figures on any number of threads. Raises relamp.Error
    where the folder or the scan is missing or another. Source: docs/guide/verify.md.

    >>> relamp.verify("nowhere")
    Traceback (most recent call last):
    relamp.Error: nowhere: holds no report.json; name a folder that relamp delight has written
    """
    if not 2 <= samples <= 65536:
        raise ValueError(f"samples={samples} is not between 2 and 65536")
    if not 1 <= places <= 1_000_000_000:
        raise ValueError(f"places={places} is not between 1 and 1000000000")
    if not 0 <= seed < 2**32:
        raise ValueError(f"seed={seed} is not between 0 and 4294967295")
    found = _relamp.verify(
        os.fspath(folder),
        int(samples),
        int(places),
        int(seed),
        "" if scan is None else os.fspath(scan),
        bool(allow_outside),
        int(threads),
        watcher_of(progress),
    )
    return Verification(
        fixtures=tuple(found.pop("fixtures")),
        bins=tuple(VerifiedBin(**part) for part in found.pop("bins")),
        warnings=tuple(found.pop("warnings")),
        **found,
    )
