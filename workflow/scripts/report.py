"""Writes one page about all scans of a folder or table, of what is there of them at the time."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from outcomes import write_whole
from report_page import page
from scan_list import ListError, read_scans
from scan_results import in_order, read_results
from thumbnails import thumbnails_of


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scans", type=Path, help="folder or table")
    parser.add_argument("results", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--thumbnails", type=int, default=300, help="how many scans have pictures")
    asked = parser.parse_args()
    try:
        listed = read_scans(asked.scans)
    except ListError as error:
        sys.exit(str(error))
    scans = in_order([read_results(asked.results, scan) for scan in listed])
    with_pictures = [scan for scan in scans if scan.room][: asked.thumbnails]
    pictures = {scan.name: thumbnails_of(scan.folder) for scan in with_pictures}
    write_whole(asked.output, page(scans, pictures))
    done = sum(1 for scan in scans if scan.room)
    print(f"{asked.output}: {done} of {len(scans)} scans are done", file=sys.stderr)


if __name__ == "__main__":
    main()
