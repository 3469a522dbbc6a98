"""Snakemake takes scans to one page, and makes again what is missing, and that alone."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["RELAMP_SOURCE"])
ROOM = SOURCE / "tests" / "rooms" / "lounge" / "scan.glb"  # has lamps and windows

# Killed at its first attempt to take the light out of the kitchen, as by a machine without memory;
# what it had begun stays there.
KILLED_ONCE = """#!/bin/bash
if [[ $1 == delight && $2 == *kitchen* && ! -e killed ]]; then
    touch killed
    mkdir -p results/kitchen/.room.relamp-00000000-1-abcdef
    kill -KILL $$
fi
exec "$RELAMP_PROGRAM" "$@"
"""
KILLED_ALWAYS = """#!/bin/bash
[[ $1 == info ]] || kill -KILL $$
exec "$RELAMP_PROGRAM" "$@"
"""


class Shelf(unittest.TestCase):
    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        scans = cls.folder / "my scans"
        scans.mkdir()
        for name in ("bedroom", "kitchen"):
            shutil.copy(ROOM, scans / f"{name}.glb")
        (scans / "broken <b>.glb").write_bytes(ROOM.read_bytes()[:100000])
        (cls.folder / "list.tsv").write_text(
            "path\tname\tdelight_options\n"
            "my scans/bedroom.glb\tbedroom\t\n"
            "my scans/kitchen.glb\tkitchen\t--solver thesis\n"
            "my scans/broken <b>.glb\tbroken\t\n"
            "my scans/gone.glb\tgone\t\n"
        )
        program = cls.folder / "killed_once"
        program.write_text(KILLED_ONCE)
        program.chmod(0o755)
        cls.first = cls.snakemake()

    @classmethod
    def snakemake(cls, *more: str) -> subprocess.CompletedProcess[str]:
        settings = ["relamp=./killed_once", "threads=2", "delight_options=--quality draft"]
        settings += ["verify_options=--samples 4 --places 1000", "relight_options=--size 160x100 --rays 4"]
        command = [os.environ["RELAMP_SNAKEMAKE"], "-s", str(SOURCE / "workflow" / "Snakefile")]
        command += ["--cores", "2", "--nocolor", *more, "--config", "scans=list.tsv", *settings]
        return subprocess.run(command, cwd=cls.folder, capture_output=True, text=True, timeout=250)

    def outcome(self, scan: str, step: str) -> dict:
        return json.loads((self.folder / "results" / scan / f"{step}.json").read_text())

    def ran(self, log: str) -> list[str]:
        """The rules that ran, with their scans."""
        return re.findall(r"^rule (\w+):(?:\n    .*)*?\n    wildcards: name=(\S+)", log, re.M)

    def test_1_good_scans_are_done_and_bad_ones_tell_why(self) -> None:
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        for scan in ("bedroom", "kitchen"):
            for step in ("info", "delight", "verify", "relight"):
                self.assertEqual(self.outcome(scan, step)["outcome"], "done", f"{scan} {step}")
            self.assertTrue((self.folder / "results" / scan / "room" / "report.json").exists())
            self.assertTrue((self.folder / "results" / scan / "relit" / "evening.png").exists())
        self.assertIn("is cut off", self.outcome("broken", "info")["sentence"])
        self.assertEqual(self.outcome("broken", "delight")["outcome"], "passed over")
        self.assertFalse((self.folder / "results" / "broken" / "room").exists())

    def test_2_what_was_killed_is_tried_again_with_more_memory_and_leaves_nothing(self) -> None:
        job = r"^rule delight:(?:\n    .*)*?name=kitchen(?:\n    .*)*?mem_mb=(\d+)"
        asked = re.findall(job, self.first.stderr, re.M)
        self.assertEqual(len(asked), 2, self.first.stderr)
        self.assertEqual(int(asked[1]), 2 * int(asked[0]))
        self.assertEqual(list((self.folder / "results").rglob(".*")), [])

    def test_3_report_shows_all_in_order_and_stands_alone(self) -> None:
        page = (self.folder / "results" / "report.html").read_text()
        # Without a result first; then by the gain, of which the thesis's room has none.
        names = re.findall(r"<h3>(?:<a [^>]*>)?([^<]+)", page)
        self.assertEqual(names, ["broken", "gone", "kitchen", "bedroom"])
        report = json.loads((self.folder / "results/bedroom/room/report.json").read_text())
        self.assertIn(f"gain {report['crossValidation']['gainDb']:.1f} dB", page)
        self.assertIn("broken &lt;b&gt;.glb: is cut off", page)
        self.assertIn("gone.glb", page)
        # Two rooms, three views and three lights of each.
        self.assertEqual(page.count('src="data:image/jpeg;base64,/9j/'), 12)
        self.assertEqual(page.count("<img"), page.count('alt="'))
        self.assertNotRegex(page, r'(src|href)="(http|/|file)|<script|<link')

    def test_4_second_run_has_nothing_to_do(self) -> None:
        again = self.snakemake()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("Nothing to be done", again.stderr)

    def test_5_room_that_was_removed_is_made_again_alone(self) -> None:
        other = self.folder / "results/kitchen/room/report.json"
        before = other.stat().st_mtime_ns
        shutil.rmtree(self.folder / "results/bedroom/room")
        again = self.snakemake()
        self.assertEqual(again.returncode, 0, again.stderr)
        steps = [("delight", "bedroom"), ("relight", "bedroom"), ("verify", "bedroom")]
        self.assertEqual(sorted(self.ran(again.stderr)), steps)
        self.assertTrue((self.folder / "results/bedroom/room/report.json").exists())
        self.assertEqual(other.stat().st_mtime_ns, before)

    def test_6_scan_that_was_mended_is_done(self) -> None:
        shutil.copy(ROOM, self.folder / "my scans" / "broken <b>.glb")
        planned = self.snakemake("--dry-run")
        will_run = self.ran(planned.stdout + planned.stderr)
        self.assertEqual({scan for _, scan in will_run}, {"broken"})

    def test_7_list_that_is_wrong_is_one_sentence(self) -> None:
        command = [os.environ["RELAMP_SNAKEMAKE"], "-s", str(SOURCE / "workflow" / "Snakefile")]
        command += ["--cores", "1", "--config", "scans=nowhere"]
        wrong = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        self.assertNotEqual(wrong.returncode, 0)
        self.assertIn("nowhere: not there. Say where the scans are", wrong.stderr)
        self.assertNotIn("Traceback", wrong.stderr)

    def test_8_what_fails_every_time_is_in_the_report(self) -> None:
        folder = self.folder / "dies"
        (folder / "scans").mkdir(parents=True)
        shutil.copy(ROOM, folder / "scans" / "hall.glb")
        program = folder / "dies"
        program.write_text(KILLED_ALWAYS)
        program.chmod(0o755)
        command = [os.environ["RELAMP_SNAKEMAKE"], "-s", str(SOURCE / "workflow" / "Snakefile")]
        command += ["--cores", "2", "--config", "relamp=./dies"]
        failed = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=250)
        self.assertEqual(failed.returncode, 1)
        self.assertEqual(len(re.findall("^rule delight:", failed.stderr, re.M)), 3)
        page = (folder / "results" / "report.html").read_text()
        self.assertIn("<li>delight: not finished; relamp was killed by signal 9", page)


if __name__ == "__main__":
    unittest.main()
