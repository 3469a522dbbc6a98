#!/usr/bin/python3
"""relamp beside the usual do-it-yourself way: Blender bakes ambient occlusion, and the texture is divided by it.

    bench/ao_division.py RELAMP ROOM ...

ROOM is a folder of a room with ground truth (docs/dev/rooms.md), or its recon/. Prints a row a room: PSNR of the texture as it is, of the
texture divided by its occlusion, and of relamp's albedo, against the truth after one scale a channel, over texels that count (mask.png) and
are not burnt out; and the seconds of Blender's bake and of `relamp delight` from command to end. Needs Debian's blender and what
bench/invariance.py needs.
"""
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from invariance import Truth, decibels, files_of, scaled
from scan_file import ScanFile, linear_from_srgb, read_linear

SAMPLES = 64  # of ambient occlusion, as Blender's users take it
LEAST = 0.05  # of occlusion that divides: a crevice is not lit a hundred times as little
BAKE = Path(__file__).parent / "ao_bake.py"


def occlusion(scan: str, size: tuple[int, int], folder: str) -> tuple[np.ndarray, float]:
    """0..1 of each texel, and the seconds that it took."""
    out = os.path.join(folder, "occlusion.exr")
    said = subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", BAKE, "--", scan, out, str(size[1]),
                           str(size[0]), str(SAMPLES)], capture_output=True, text=True)
    baked = [line for line in said.stdout.splitlines() if line.startswith("BAKED")]
    if not baked:
        sys.exit(f"ao_division.py: {scan}: Blender stopped: {said.stderr.strip()[-300:]}")
    return read_linear(out), float(baked[0].split()[1])


def main() -> None:
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    relamp = os.path.abspath(sys.argv[1])
    print("| room | texture, dB | divided by occlusion | relamp | bake, s | relamp, s |\n| --- | --- | --- | --- | --- | --- |")
    for room in sys.argv[2:]:
        scan, _ = files_of(room)
        texture = ScanFile(scan).texture()
        truth = Truth(room, texture)
        light = linear_from_srgb(texture / 255)
        with tempfile.TemporaryDirectory() as folder:
            shade, bake = occlusion(scan, texture.shape[:2], folder)
            begin = time.time()
            subprocess.run([relamp, "delight", "-q", scan, "-o", os.path.join(folder, "out")], check=True)
            seconds = time.time() - begin
            ours = read_linear(os.path.join(folder, "out", "albedo.exr"))
        at, true = truth.counts, truth.albedo
        score = [decibels(scaled(a[at], true[at]) - true[at]) for a in (light, light / np.maximum(shade, LEAST), ours)]
        print(f"| {room} | {score[0]:.1f} | {score[1]:.1f} | {score[2]:.1f} | {bake:.1f} | {seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
