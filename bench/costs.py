#!/usr/bin/python3
"""What relamp takes of memory and of a core's time, beside what `relamp info` says of the scan: what src/scan/estimate.cpp is fitted to.

    bench/costs.py RELAMP SCAN ... >> costs.tsv     measure: a row a scan
    bench/costs.py --fit costs.tsv                  the rates of estimate.cpp, and how far each row is from them

A row is the scan's sizes, and for each command the seconds of user and system time, and the peak of resident memory in MB. Default options, two threads, on
the CPU; - where a command was not run. Core seconds, so that what else runs matters little (but not nothing: two threads of one core slow each other down).
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SIZES = ("pixels", "largestPage", "texels", "triangles", "squareMetres", "fixtures", "charts")
COMMANDS = ("info", "delight", "verify", "relight")
TERMS = ("fixed", "perPixel", "perPixelOfPage", "perTexel", "perTriangle", "perSquareMetre", "perLampSquareMetre", "perChart")
MOST_SURFACE, MOST_SURFACE_OF_CHARTS = 700, 1400  # m^2, as in estimate.cpp
ROUNDS = 20000  # of coordinate descent


def measured(command: list[str]) -> tuple[float, float, str]:
    """Core seconds, MB at the peak, standard output."""
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    said = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(command)}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6, said


def measure(relamp: str, scan: Path) -> str:
    with tempfile.TemporaryDirectory() as folder:
        room, threads = f"{folder}/room", ["--threads", "2"]
        looked = measured([relamp, "info", "--json", *threads, str(scan)])
        costs = [looked,
                 measured([relamp, "delight", "-q", "--engine", "cpu", *threads, str(scan), "-o", room]),
                 measured([relamp, "verify", "--json", *threads, "--scan", str(scan), room]),
                 measured([relamp, "relight", "-q", "--engine", "cpu", *threads, room, "--fixture", "all=on", "--no-transport",
                           "-o", f"{folder}/lit.png"])]
        fixtures = len(json.loads(Path(room, "report.json").read_text())["lights"]["fixtures"])
    found = json.loads(looked[2])
    pixels = [page["width"] * page["height"] for page in found["pages"]]
    sizes = (sum(pixels), max(pixels), found["texels"], found["triangles"], found["squareMetres"], fixtures,
             sum(page["charts"] for page in found["pages"]))
    return "\t".join([f"{scan.parent.name}/{scan.name}", *(f"{size:.6g}" for size in sizes),
                      *(f"{seconds:.2f}\t{megabytes:.0f}" for seconds, megabytes, _ in costs)])


def rates_of(terms: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """Rates >= 0 of least squares of the error as a share of the cost, by coordinate descent."""
    matrix = terms / cost[:, None]
    scale = np.maximum(matrix.max(axis=0), 1e-300)
    matrix = matrix / scale
    rates, rest = np.zeros(matrix.shape[1]), np.ones(len(cost))
    for _ in range(ROUNDS):
        for i, column in enumerate(matrix.T):
            new = max(0.0, rates[i] + column @ rest / max(column @ column, 1e-300))
            rest -= (new - rates[i]) * column
            rates[i] = new
    return rates / scale


def fit(file: Path) -> None:
    rows = [line.split("\t") for line in file.read_text().splitlines()]
    table = np.array([[float("nan") if cell == "-" else float(cell) for cell in row[1:]] for row in rows])
    pixels, page, texels, triangles, area, lamps, charts = table[:, :len(SIZES)].T
    charts = charts * np.minimum(1, MOST_SURFACE_OF_CHARTS / area)
    area = np.minimum(area, MOST_SURFACE)
    terms = np.stack([np.ones(len(table)), pixels, page, texels, triangles, area, lamps * area, charts], axis=1)
    print("#", *TERMS)
    for i, command in enumerate(COMMANDS):
        for j, (what, unit) in enumerate((("seconds", 1.0), ("bytes", 1e6))):
            cost = unit * table[:, len(SIZES) + 2 * i + j]
            known = ~np.isnan(cost)
            rates = rates_of(terms[known], cost[known])
            ratios = terms @ rates / cost
            print(f"{command} {what}: " + ", ".join(f"{rate:.2g}" for rate in rates))
            print(f"    estimate / measured {ratios[known].min():.2f} .. {ratios[known].max():.2f}: "
                  + " ".join(f"{row[0]} {ratio:.2f}" for row, ratio in zip(rows, ratios, strict=True)))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if sys.argv[1] == "--fit":
        fit(Path(sys.argv[2]))
    else:
        for name in sys.argv[2:]:
            print(measure(sys.argv[1], Path(name)), flush=True)
