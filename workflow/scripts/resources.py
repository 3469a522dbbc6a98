"""What a job asks for: memory and time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from outcomes import read_outcome


SNAKEMAKE_MEGABYTES = 200  # two of them and Python, beside relamp in a job of a cluster


class Estimate:
    """Of a scan, by what relamp info says of it; before that, of a scan without texels: Snakemake 7
    asks once when it plans, and again when the job's turn comes."""

    def __init__(self, settings: dict[str, float | str], info_outcome: str) -> None:
        # On the command line of Snakemake the numbers of a dictionary are texts.
        self._settings = {name: float(value) for name, value in settings.items()}
        info = read_outcome(Path(info_outcome))
        self._info: dict[str, Any] = (info.printed if info else None) or {}

    def megabytes(self, step: str, attempt: int) -> int:
        """More at each attempt; for the step of a refused scan, which runs nothing, the least."""
        estimated = self._estimated(step).get("bytes")
        if estimated is not None:
            first = SNAKEMAKE_MEGABYTES + estimated / 1e6 * self._settings["margin"]
        else:
            by_texels = self._texels() * self._settings["bytesPerTexel"] / 1e6
            first = self._settings["megabytes"] + by_texels
        most = self._settings["mostMegabytes"] or math.inf
        return int(min(attempt * math.ceil(first), most))

    def minutes(self, step: str, attempt: int, threads: int, runs: int = 1) -> int:
        """Of so many runs on so many threads; at least two."""
        estimated = self._estimated(step).get("coreSeconds")
        if estimated is not None:
            core_seconds = runs * estimated * self._settings["margin"]
        else:
            by_texels = self._texels() * self._settings["microsecondsPerTexel"] / 1e6
            core_seconds = self._settings["coreSeconds"] + by_texels
        return attempt * (1 + math.ceil(core_seconds / threads / 60))

    def _estimated(self, step: str) -> dict[str, float]:
        of_step: dict[str, float] = self._info.get("estimate", {}).get(step, {})
        return of_step

    def _texels(self) -> int:
        return int(self._info.get("texels", 0))
