"""Where relamp is, and how it is called."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field

from .errors import Refusal


@dataclass
class Settings:
    """What a person may say about a run."""

    program: str = ""  # "": look on PATH
    quality: str = "standard"
    threads: int = 0  # 0: one a core
    sun: bool = True
    allow_overlap: bool = False
    hints: list[str] = field(default_factory=list)  # options of delight, as they are passed


def find_program(named: str) -> str:
    """The path of relamp. Throws Refusal where there is none."""
    way_out = ("build or install relamp, then name its file in Edit > Preferences > Add-ons > "
               "relamp, or put its folder on PATH")
    if not named:
        found = shutil.which("relamp")
        if not found:
            raise Refusal(f"the program relamp is not on PATH; {way_out}")
        return found
    path = os.path.abspath(os.path.expanduser(named))
    if os.path.isdir(path):
        path = os.path.join(path, "relamp")
    if not os.path.isfile(path):
        raise Refusal(f"{path}, the program that the preferences name, is not there; {way_out}")
    if not os.access(path, os.X_OK):
        raise Refusal(f"{path}, the program that the preferences name, may not be executed; "
                      f"{way_out}")
    return path


def command(settings: Settings, scan: str, linear: bool, output: str) -> list[str]:
    words = [find_program(settings.program), "delight", scan, "-o", output, "--progress",
             "--quality", settings.quality, *settings.hints]
    if linear:
        words += ["--transfer", "linear"]
    if settings.threads:
        words += ["--threads", str(settings.threads)]
    if not settings.sun:
        words.append("--no-sun")
    if settings.allow_overlap:
        words.append("--allow-overlap")
    return words
