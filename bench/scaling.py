#!/usr/bin/python3
"""The scaling law: docs/images/scaling.svg and the table of docs/guide/performance.md.

    bench/scaling.py RELAMP SCAN OUT.svg

SCAN, a plain GLB of one texture (as bench/scan_file.py knows them), is made larger in one way at a time, by factors of four:

    texels       the texture enlarged, each pixel repeated
    triangles    each cut into four
    lamps        `relamp relight` of its result by that many bulbs under the ceiling, with shadows and bounces
    rooms        copies side by side (bench/house.py)

Default options, on the CPU by two threads, twice; the least time counts. A line through logarithms gives the exponent, of the points
whose cost is more than a fifth above the first's and the one before them: 1 is in proportion. Needs python3-numpy, -pil, -matplotlib.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scan_file import ScanFile

FACTORS = {"texels": (1, 4, 16, 64), "triangles": (1, 4, 16), "lamps": (1, 4, 16, 64), "rooms": (1, 4, 16)}
TIMES = 2
SEEN = 1.2  # of the least cost: less is not the thing that grows
HOUSE = Path(__file__).parent / "house.py"


def cost(command: list[str]) -> tuple[float, float]:
    """Seconds from command to end and GB at the peak; of the quickest run."""
    best = (np.inf, 0.0)
    for _ in range(TIMES):
        said = subprocess.run(["/usr/bin/time", "-f", "%e %M", *command], check=True, capture_output=True, text=True).stderr.split()
        best = min(best, (float(said[-2]), float(said[-1]) * 1024 / 1e9))
    return best


def enlarged(path: str, factor: int, out: Path) -> None:
    scan, by = ScanFile(path), round(factor**0.5)
    scan.put_texture(scan.texture().repeat(by, 0).repeat(by, 1), lossless=True)
    scan.write(out)


def cut_up(path: str, factor: int, out: Path) -> None:
    """Corners come anew for each triangle: seams stay where they were."""
    scan = ScanFile(path)
    for primitive in scan.primitives():
        index = scan.numbers(primitive["indices"]).reshape(-1, 3)
        corners = {name: scan.numbers(accessor)[index] for name, accessor in primitive["attributes"].items()}
        for _ in range(round(np.log(factor) / np.log(4))):
            for name, c in corners.items():
                m = (c + c[:, [1, 2, 0]]) / 2
                parts = ((c[:, 0], m[:, 0], m[:, 2]), (m[:, 0], c[:, 1], m[:, 1]), (m[:, 2], m[:, 1], c[:, 2]), (m[:, 0], m[:, 1], m[:, 2]))
                corners[name] = np.concatenate([np.stack(part, 1) for part in parts])
        count = 3 * len(next(iter(corners.values())))
        for name, accessor in list(primitive["attributes"].items()) + [("indices", primitive["indices"])]:
            values = np.arange(count, dtype=np.uint32) if name == "indices" else corners[name].reshape(count, -1).astype(np.float32)
            item = dict(scan.json["accessors"][accessor], bufferView=len(scan.views), byteOffset=0, count=count,
                        componentType=5125 if name == "indices" else 5126)
            scan.json["bufferViews"].append({"buffer": 0, "byteLength": values.nbytes})
            scan.views.append(values.tobytes())
            scan.json["accessors"].append(item)
            number = len(scan.json["accessors"]) - 1
            if name == "indices":
                primitive["indices"] = number
            else:
                primitive["attributes"][name] = number
    scan.write(out)


def bulbs(path: str, count: int, out: Path) -> None:
    """A lights file: balls of 2 cm, 30 cm under the ceiling, evenly over the floor plan."""
    corners, _ = ScanFile(path).triangles()
    low, high = np.percentile(corners.reshape(-1, 3), 10, axis=0), np.percentile(corners.reshape(-1, 3), 90, axis=0)
    side = int(np.ceil(count**0.5))
    places = [low + (high - low) * [(i % side + 0.5) / side, 1, (i // side + 0.5) / side] - [0, 0.3, 0] for i in range(count)]
    lamps = [{"type": "sphere", "position": place.tolist(), "radius": 0.02, "lumens": 2000 / count} for place in places]
    out.write_text(json.dumps({"lights": lamps}))


def measured(relamp: str, path: str, folder: Path) -> dict[str, list[tuple[float, float, float]]]:
    rows: dict[str, list[tuple[float, float, float]]] = {}
    fixed = ["-q", "--engine", "cpu", "--threads", "2"]
    room, scan, lights = str(folder / "room"), folder / "scan.glb", folder / "lights.json"
    subprocess.run([relamp, "delight", *fixed, path, "-o", room], check=True)
    delight = [relamp, "delight", *fixed, str(scan), "-o", str(folder / "out")]
    relight = [relamp, "relight", *fixed, room, "--lights", str(lights), "--no-transport", "-o", str(folder / "lit.png")]
    for kind, factors in FACTORS.items():
        for factor in factors:
            if kind == "texels":
                enlarged(path, factor, scan)
            elif kind == "triangles":
                cut_up(path, factor, scan)
            elif kind == "rooms":
                subprocess.run([sys.executable, HOUSE, scan, *[path] * factor], check=True)
            else:
                bulbs(path, factor, lights)
            seconds, gigabytes = cost(relight if kind == "lamps" else delight)
            rows.setdefault(kind, []).append((factor, seconds, gigabytes))
            print(f"{kind} x {factor}: {seconds:.2f} s, {gigabytes:.2f} GB", flush=True)
    return rows


def exponent(points: np.ndarray) -> float:
    """Of what grows with a factor, from the last point whose cost is still the first's."""
    grown = points[points[:, 1] > SEEN * points[0, 1]]
    if len(grown) == 0:
        return 0.0
    before = points[points[:, 0] < grown[0, 0]][-1:]
    x, y = np.log(np.concatenate([before, grown])).T
    return float(np.polyfit(x, y, 1)[0])


def draw(rows: dict[str, list[tuple[float, float, float]]], out: str) -> None:
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "relamp"
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axis, column, name in ((axes[0], 1, "seconds"), (axes[1], 2, "GB at the peak")):
        for kind, points in rows.items():
            values = np.array(points)[:, [0, column]]
            axis.plot(*values.T, "o-", label=f"{kind}: {exponent(values):.2f}")
        axis.set(xscale="log", yscale="log", xlabel="times as many", ylabel=name)
        axis.grid(alpha=0.3, which="both")
        axis.legend(title="exponent")
    figure.savefig(out, metadata={"Date": None})


def main() -> None:
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    relamp, path, out = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        rows = measured(os.path.abspath(relamp), path, Path(folder))
    draw(rows, out)
    for kind, points in rows.items():
        values = np.array(points)
        last = np.log(values[-1, 1:] / values[-2, 1:]) / np.log(values[-1, 0] / values[-2, 0])
        print(f"{kind}: time ^ {exponent(values[:, [0, 1]]):.2f}, in the last step {last[0]:.2f}; "
              f"memory ^ {exponent(values[:, [0, 2]]):.2f}, {last[1]:.2f}")


if __name__ == "__main__":
    main()
