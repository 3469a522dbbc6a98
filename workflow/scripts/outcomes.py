"""What came of a step, kept as a small JSON file: done, refused with a sentence, or passed over."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

DONE, REFUSED, PASSED_OVER = "done", "refused", "passed over"


@dataclass
class Outcome:
    """Of one step of one scan."""

    outcome: str
    sentence: str = ""  # why it was refused, as relamp says it
    printed: Any = None  # the JSON that relamp printed
    makes: list[str] = field(default_factory=list)  # files; one gone: it is done again
    seconds: float = 0.0  # from start to end
    coreSeconds: float = 0.0  # of all cores together
    megabytes: float = 0.0  # at the peak


def read_outcome(file: Path) -> Outcome | None:
    """None where there is none; a file that is not whole counts as none."""
    try:
        return Outcome(**json.loads(file.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def write_outcome(file: Path, outcome: Outcome) -> None:
    """Whole or not at all."""
    write_whole(file, json.dumps(asdict(outcome), indent="\t") + "\n")


def write_whole(file: Path, text: str) -> None:
    """Writes beside, then renames."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(
        "w", dir=file.parent, prefix=f".{file.name}.", delete=False, encoding="utf-8"
    ) as beside:
        beside.write(text)
    os.chmod(beside.name, 0o644)
    os.replace(beside.name, file)


def forget(results: Path, names: Iterable[str], steps: list[str], refused: bool) -> None:
    """Removes outcomes that are true no more, so that the steps are done again: of what was made
    and is gone, and, if asked, of what was refused and of the steps behind it."""
    for name in names:
        for step in steps:
            file = results / name / f"{step}.json"
            outcome = read_outcome(file)
            if outcome is None:
                continue
            gone = not all(Path(made).exists() for made in outcome.makes)
            if gone or (refused and outcome.outcome != DONE):
                file.unlink()
