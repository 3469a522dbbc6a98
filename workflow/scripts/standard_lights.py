"""The options of relamp relight that make a standard light in one room."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

EACH_LAMP = re.compile(r"\{lamps=([^}]*)\}")


class RoomLights:
    """Which lamps and windows delight found."""

    def __init__(self, room: Path) -> None:
        report = json.loads((room / "report.json").read_text(encoding="utf-8"))
        fixtures = report["lights"]["fixtures"]
        self._room = room
        self._lamps = [str(of["id"]) for of in fixtures if not of["name"].startswith("window")]
        self._kinds = {"window"} if len(self._lamps) < len(fixtures) else set()
        self._kinds |= {"lamp"} if self._lamps else set()

    def has(self, kind: str) -> bool:
        """Whether the room has a "lamp" or a "window"."""
        return kind in self._kinds

    def options(self, light: str) -> list[str]:
        """Of a light in the configuration's words: {room} is the room's folder, {lamps=WHAT} the
        option --fixture N=WHAT for each lamp that is no window."""

        def for_each_lamp(what: re.Match[str]) -> str:
            return " ".join(f"--fixture {lamp}={what[1]}" for lamp in self._lamps)

        named = light.replace("{room}", shlex.quote(str(self._room)))
        return shlex.split(EACH_LAMP.sub(for_each_lamp, named))
