"""The scans of a folder or of a table."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

KINDS = {".glb", ".gltf", ".obj", ".ply"}
COLUMNS = {"path", "name", "read_options", "delight_options"}


class ListError(Exception):
    """A sentence: what is wrong with the list, and the way out."""


@dataclass
class ListedScan:
    """One scan: the name of its results' folder, its file, and options of its own by their kind."""

    name: str
    path: str
    options: dict[str, str] = field(default_factory=dict)


def folder_name(text: str) -> str:
    """A name that is one folder, is not hidden and needs no quotes."""
    return re.sub(r"[^\w.+-]+", "-", text).strip("-.") or "scan"


def read_scans(source: Path) -> list[ListedScan]:
    """Reads the list, in the order of the table or of the names; throws ListError."""
    if source.is_dir():
        scans = _of_folder(source)
    elif source.suffix in {".tsv", ".csv"}:
        scans = _of_table(source)
    elif source.exists():
        raise ListError(f"{source}: neither a folder nor a table, whose name ends in .tsv or .csv")
    else:
        way_out = "Say where the scans are: --config scans=FOLDER_OR_TABLE"
        raise ListError(f"{source}: not there. {way_out}")
    if not scans:
        raise ListError(f"{source}: no scan in it, nothing of {', '.join(sorted(KINDS))}")
    _refuse_same_names(source, scans)
    return scans


def _of_folder(folder: Path) -> list[ListedScan]:
    """kitchen.glb is kitchen, house/attic.glb is house-attic."""
    found = []
    for file in sorted(folder.rglob("*")):
        within = file.relative_to(folder)
        hidden = any(part.startswith(".") for part in within.parts)
        if file.suffix.lower() in KINDS and not hidden and file.is_file():
            found.append(ListedScan(folder_name(str(within.with_suffix(""))), str(file)))
    return found


def _of_table(table: Path) -> list[ListedScan]:
    """Paths are relative to the table. What is not there is a scan, too: the report says so."""
    with open(table, newline="", encoding="utf-8-sig") as lines:
        rows = csv.DictReader(lines, dialect="excel-tab" if table.suffix == ".tsv" else "excel")
        columns = set(rows.fieldnames or [])
        if "path" not in columns or columns - COLUMNS:
            raise ListError(
                f"{table}: its columns are {', '.join(map(str, rows.fieldnames or []))}. "
                "There must be path; there may be name, read_options and delight_options"
            )
        numbered = enumerate(rows, 2)
        return [_of_row(table, number, row) for number, row in numbered if any(row.values())]


def _of_row(table: Path, number: int, row: dict[str, str]) -> ListedScan:
    if not row["path"] or None in row:
        wrong = "has more cells than the first" if None in row else "has no path"
        raise ListError(f"{table}, row {number}: {wrong}")
    name = row.get("name") or str(Path(row["path"]).with_suffix(""))
    options = {key: row.get(key) or "" for key in ("read_options", "delight_options")}
    return ListedScan(folder_name(name), str(table.parent / row["path"]), options)


def _refuse_same_names(source: Path, scans: list[ListedScan]) -> None:
    first: dict[str, ListedScan] = {}
    for scan in scans:
        other = first.setdefault(scan.name.casefold(), scan)  # Attic is attic on some disks
        if other is not scan:
            raise ListError(
                f"{source}: {other.path} and {scan.path} would both be {scan.name}. "
                "Rename one, or give them names in a table"
            )
