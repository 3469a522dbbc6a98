"""Runs one step of a scan and writes its outcome.

What relamp refuses (exit codes 1 and 2) is an outcome with its sentence, and the job is done.
Anything else, a signal above all, and what the machine lacks, leaves no outcome and fails the job,
so that it is tried again.
"""

from __future__ import annotations

import argparse
import json
import resource
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

from outcomes import DONE, PASSED_OVER, REFUSED, Outcome, read_outcome, write_outcome
from standard_lights import RoomLights

REFUSALS = {1, 2}  # the world is wrong; the command line is
# Said with exit code 1 of the machine, not of the scan.
OF_THE_MACHINE = ("not enough memory", "the system refuses", "cannot be written")


class Refused(Exception):
    """relamp's own sentence."""


class Relamp:
    """Runs relamp; what it says goes to the log."""

    def __init__(self, log: Path) -> None:
        self._log = log
        log.parent.mkdir(parents=True, exist_ok=True)
        log.write_text("", encoding="utf-8")

    def run(self, command: list[str]) -> str:
        """Returns what it printed. Throws Refused; ends this process where relamp was killed."""
        ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
        problems = ended.stderr.decode(errors="replace").strip()
        with open(self._log, "a", encoding="utf-8") as log:
            print(shlex.join(command), problems, sep="\n", file=log)
            if not ended.returncode:
                return ended.stdout.decode()
            said = sentence_of(problems) if ended.returncode in REFUSALS else ""
            if said and not any(words in said for words in OF_THE_MACHINE):
                raise Refused(said)
            said = said or f"relamp {how_it_ended(ended.returncode)}"
            print(said, file=log)
            sys.exit(said)


def how_it_ended(code: int) -> str:
    """In words."""
    if code in {-9, 137}:
        return "was killed by signal 9; where nobody did, it needed more memory than it may have"
    return f"was killed by signal {-code}" if code < 0 else f"ended with exit code {code}"


def sentence_of(problems: str) -> str:
    """relamp's sentence without its name, or nothing; progress and notes stand before it."""
    last = ("\n" + problems).partition("\nrelamp: ")[2]
    return " ".join(last.split())


def sweep(folder: Path) -> None:
    """Removes what a run that was killed left hidden, on whatever machine: Snakemake runs no step
    of a scan twice at a time, so nobody is at work on it."""
    for left in folder.glob(".*.relamp-*"):
        shutil.rmtree(left) if left.is_dir() else left.unlink()


def take_pictures(relamp: Relamp, asked: argparse.Namespace) -> list[str]:
    """One picture under each of the lights that make sense in this room."""
    asked.pictures.mkdir(parents=True, exist_ok=True)
    sweep(asked.pictures)
    room = RoomLights(asked.room)
    needs = dict(need.split("=") for need in asked.needs)
    made: list[str] = []
    for light in asked.lights:
        name, _, words = light.partition("=")
        if name not in needs or room.has(needs[name]):
            picture = str(asked.pictures / f"{name}.png")
            relamp.run([*asked.command, *room.options(words), "-o", picture])
            made.append(picture)
    for old in asked.pictures.glob("*.png"):  # of lights that a former run had
        if str(old) not in made:
            old.unlink()
    return made


def run(asked: argparse.Namespace) -> Outcome:
    """The step itself."""
    before = read_outcome(asked.after) if asked.after else None
    if before and before.outcome != DONE:
        return Outcome(PASSED_OVER)
    relamp = Relamp(asked.log)
    try:
        if asked.pictures:
            return Outcome(DONE, makes=take_pictures(relamp, asked))
        for file in asked.makes:
            sweep(file.parent.parent)
        printed = relamp.run(asked.command)
    except Refused as refused:
        return Outcome(REFUSED, sentence=str(refused))
    made = [str(file) for file in asked.makes]
    return Outcome(DONE, printed=json.loads(printed) if asked.json else None, makes=made)


def arguments() -> argparse.Namespace:
    """Of the command line; what stands behind -- is relamp's."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("outcome", type=Path, help="where to write what came of it")
    parser.add_argument("--log", type=Path, required=True)
    parser.add_argument("--after", type=Path, help="of the step before; if not done, nothing runs")
    parser.add_argument("--json", action="store_true", help="keep the JSON that relamp prints")
    parser.add_argument("--makes", type=Path, nargs="+", default=[], help="what will be there")
    parser.add_argument("--pictures", type=Path, help="folder for pictures under --lights")
    parser.add_argument("--room", type=Path, help="what --pictures are of")
    parser.add_argument("--lights", nargs="*", default=[], metavar="NAME=OPTIONS")
    parser.add_argument("--needs", nargs="*", default=[], metavar="NAME=lamp|window")
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    asked = parser.parse_args(sys.argv[1:split])
    asked.command = sys.argv[split + 1 :]
    return asked


def main() -> None:
    """Runs, measures, writes."""
    asked = arguments()
    began = time.monotonic()
    outcome = run(asked)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    outcome.seconds = round(time.monotonic() - began, 3)
    outcome.coreSeconds = round(used.ru_utime + used.ru_stime, 3)
    outcome.megabytes = round(used.ru_maxrss * 1024 / 1e6, 1)
    write_outcome(asked.outcome, outcome)


if __name__ == "__main__":
    main()
