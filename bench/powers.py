#!/usr/bin/python3
"""Holds the standard errors of lamps to rooms with ground truth: docs/guide/quality.md, lamps.

    bench/powers.py NAME=ROOM:RESULT ...

ROOM is a folder with gt_lights.json (or its recon/), RESULT what `relamp delight` wrote of its scan. A fixture belongs to the
nearest lamp within 0.3 m and half the lamp's width; the fixtures of one lamp count as one, by their sum. Prints a line a lamp:
area and power found over the true ones (log of luminance times area), the standard error of the latter, and how many of them the
power is off by; then how many lamps lie within one standard error and within two. A fixture without a lamp is called false.
"""
import json
import os
import sys

import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
REACH = 0.3  # m


def area_of(lamp):
    """Of the lamp as it was baked: where the room says so, of its mesh."""
    return lamp.get("mesh_area", lamp["area"])


def nearest(fixture, truth):
    """Number of the lamp that a fixture is; None where it is none."""
    reaches = []
    for number, lamp in enumerate(truth):
        distance = np.linalg.norm(np.subtract(fixture["centre"], lamp["center"]))
        reaches.append((distance / (REACH + 0.5 * np.sqrt(area_of(lamp))), number))
    best = min(reaches, default=(np.inf, None))
    return best[1] if best[0] < 1 else None


def powers(room, result):
    """Lines of (kind, log area, log power, error) of the lamps found, over the truth; number of false ones, of those missed."""
    with open(os.path.join(room, "gt_lights.json"), encoding="utf-8") as file:
        truth = json.load(file)["lights"]
    with open(os.path.join(result, "lights.json"), encoding="utf-8") as file:
        fixtures = json.load(file).get("fixtures", [])
    parts = {}
    for fixture in fixtures:
        parts.setdefault(nearest(fixture, truth), []).append(fixture)
    false = len(parts.pop(None, []))
    lines = []
    for number, found in sorted(parts.items()):
        lamp = truth[number]
        power = np.array([np.dot(LUMINANCE, part["power"]) for part in found])
        error = np.array([np.dot(LUMINANCE, part.get("error", [0, 0, 0])) for part in found])
        true = np.pi * area_of(lamp) * np.dot(LUMINANCE, lamp["radiance"])
        lines.append((lamp["kind"], np.log(sum(part["area"] for part in found) / area_of(lamp)),
                      np.log(power.sum() / true), np.dot(power, error) / power.sum()))
    return lines, false, len(truth) - len(lines)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    all_lines = []
    for named in sys.argv[1:]:
        name, folders = named.split("=", 1)
        lines, false, missed = powers(*folders.split(":"))
        print(f"{name}: {len(lines)} lamps, {missed} missed, {false} false")
        for kind, area, off, error in lines:
            print(f"    {kind:8s} area {area:+.2f} power {off:+.2f} error {error:.2f}: {off / error:+.1f} errors")
        all_lines += lines
    off = np.array([abs(line[2]) / line[3] for line in all_lines])
    print(f"of {len(off)} lamps {np.mean(off <= 1):.0%} within one, {np.mean(off <= 2):.0%} within two; "
          f"median error {np.median([line[3] for line in all_lines]):.3f}")


if __name__ == "__main__":
    main()
