"""Which scans a folder or a table lists, and what is said of one that is wrong."""

from __future__ import annotations

import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["RELAMP_SOURCE"]) / "workflow" / "scripts"))

from resources import Estimate  # noqa: E402
from scan_list import ListError, read_scans  # noqa: E402


class ScanList(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def put(self, name: str, text: str = "") -> Path:
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def refusal(self, source: Path) -> str:
        with self.assertRaises(ListError) as raised:
            read_scans(source)
        return str(raised.exception)

    def test_folder_is_searched_at_any_depth(self) -> None:
        for name in ("kitchen.glb", "house 1/attic.PLY", "house 1/notes.txt", ".hidden/x.glb"):
            self.put(name)
        names = [scan.name for scan in read_scans(self.folder)]
        self.assertEqual(names, ["house-1-attic", "kitchen"])

    def test_table_names_scans_from_its_own_folder_and_gives_them_options(self) -> None:
        rows = ["path\tname\tread_options", "rooms/a.glb\t\t--up z", "", "b.glb\tIt's b\t"]
        table = self.put("scans.tsv", "\n".join(rows))
        first, second = read_scans(table)
        self.assertEqual((first.name, first.path), ("rooms-a", str(self.folder / "rooms/a.glb")))
        self.assertEqual(first.options["read_options"], "--up z")
        self.assertEqual((second.name, second.options["read_options"]), ("It-s-b", ""))

    def test_wrong_lists_are_refused_with_the_way_out(self) -> None:
        self.assertIn("--config scans=", self.refusal(self.folder / "nowhere"))
        self.assertIn("no scan in it", self.refusal(self.folder))
        self.assertIn("There must be path", self.refusal(self.put("a.csv", "file\nx.glb\n")))
        rows = self.put("b.csv", "path,name\nx.glb,x\n,y\n")
        self.assertIn("row 3: has no path", self.refusal(rows))
        self.assertIn("row 2: has more cells", self.refusal(self.put("c.csv", "path\nx.glb,y\n")))
        rows = self.put("d.csv", "path\nattic.glb\nAttic.ply\n")
        self.assertIn("would both be Attic", self.refusal(rows))
        self.assertIn("neither a folder nor a table", self.refusal(self.put("e.txt")))


class Resources(unittest.TestCase):
    settings = {
        "margin": 1.5,
        "megabytes": 300,
        "bytesPerTexel": 120,
        "coreSeconds": 60,
        "microsecondsPerTexel": 2,
        "mostMegabytes": 4000,
    }

    def estimate(self, printed: str) -> Estimate:
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(f'{{"outcome": "done", "printed": {printed}}}')
            file.flush()
            return Estimate(self.settings, file.name)

    def test_estimate_of_the_program_counts_with_the_margin(self) -> None:
        of_delight = '{"delight": {"bytes": 1000000000, "coreSeconds": 400}}'
        estimate = self.estimate(f'{{"texels": 9, "estimate": {of_delight}}}')
        self.assertEqual(estimate.megabytes("delight", 1), 1700)
        # 1.5 * 400 / 2 s are 5 minutes, and one to begin and end.
        self.assertEqual(estimate.minutes("delight", 1, 2), 6)

    def test_without_it_texels_count(self) -> None:
        estimate = self.estimate('{"texels": 10000000}')
        self.assertEqual(estimate.megabytes("verify", 1), 1500)
        self.assertEqual(estimate.minutes("verify", 1, 1), 3)

    def test_another_attempt_asks_for_more_up_to_what_any_machine_has(self) -> None:
        estimate = self.estimate('{"texels": 10000000}')
        self.assertEqual([estimate.megabytes("verify", n) for n in (1, 2, 3)], [1500, 3000, 4000])
        self.assertEqual(estimate.minutes("verify", 2, 1), 6)

    def test_scan_not_yet_looked_at_takes_the_least(self) -> None:
        self.assertEqual(Estimate(self.settings, "/nowhere.json").megabytes("relight", 1), 300)


if __name__ == "__main__":
    unittest.main()
