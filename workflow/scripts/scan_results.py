"""What there is of one scan, for the report."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from outcomes import DONE, REFUSED, Outcome, read_outcome
from scan_list import ListedScan

STEPS = ["info", "delight", "verify", "relight"]


@dataclass
class ScanResults:
    """One scan: its outcomes by step, the report of delight, and what stood in the way."""

    name: str
    path: str
    folder: Path
    outcomes: dict[str, Outcome]
    report: dict[str, Any]  # empty where there is none
    problems: list[str] = field(default_factory=list)  # a sentence each

    @property
    def room(self) -> bool:
        """Whether the room is there."""
        return bool(self.report)

    @property
    def gain(self) -> float | None:
        """Cross-validated: dB by which places of one paint agree better than in the scan."""
        validation = self.report.get("crossValidation") or {}
        return validation.get("gainDb")

    @property
    def core_seconds(self) -> float:
        return sum(outcome.coreSeconds for outcome in self.outcomes.values())

    @property
    def megabytes(self) -> float:
        return max((outcome.megabytes for outcome in self.outcomes.values()), default=0)


def read_results(results: Path, scan: ListedScan) -> ScanResults:
    """Reads what is there; what is not there is a problem with a sentence, never an error."""
    folder = results / scan.name
    found = {step: read_outcome(folder / f"{step}.json") for step in STEPS}
    outcomes = {step: outcome for step, outcome in found.items() if outcome}
    delit = "delight" in outcomes and outcomes["delight"].outcome == DONE
    refused = [(step, of) for step, of in outcomes.items() if of.outcome == REFUSED]
    problems = [f"{step}: {outcome.sentence}" for step, outcome in refused]
    unfinished = next((step for step in STEPS if step not in outcomes), None)
    if unfinished:
        problems.append(f"{unfinished}: not finished{_why(folder / 'logs' / f'{unfinished}.log')}")
    report = _read_json(folder / "room" / "report.json") if delit else {}
    return ScanResults(scan.name, scan.path, folder, outcomes, report, problems)


def _why(log: Path) -> str:
    """The last line of the log of a step that left no outcome."""
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    except OSError:
        return ", for it was not begun"
    return f"; {lines[-1]}" if lines else ""


def _read_json(file: Path) -> dict[str, Any]:
    try:
        report: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return report


def in_order(scans: list[ScanResults]) -> list[ScanResults]:
    """Those without a room first, then those without the figure, then by it, the smallest gain
    first: what a person should look at stands at the top."""

    def key(scan: ScanResults) -> tuple[bool, bool, float, str]:
        return scan.room, scan.gain is not None, scan.gain or 0.0, scan.name

    return sorted(scans, key=key)
