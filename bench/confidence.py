#!/usr/bin/python3
"""Draws risk against confidence: docs/images/confidence.svg of docs/guide/quality.md.

    bench/confidence.py METRICS OUT.svg NAME=ROOM:RESULT ...

METRICS is metrics.py of the rooms with ground truth, ROOM a folder of them (or its recon/), RESULT what `relamp delight` wrote
of its scan. Risk is the share of texels whose albedo is off by more than 15 % in luminance after one scale for the room; texels are
those of the room's mask that are not burnt out. For each name a line: of all texels of at least this confidence, how many are
off. Prints the share of texels at 0.8 and more, and how many of them are right. Needs what metrics.py needs.
"""
import importlib.util
import os
import sys

import numpy as np
from PIL import Image

WRONG = 0.15  # of the truth, in luminance
TRUSTED = 0.8
LEVELS = np.linspace(0, 1, 41)
COLOURS = ["#1b6ca8", "#3fa34d", "#c8553d", "#7fb3d5", "#a3d9a5", "#e8a598"]


def risks(metrics, room, result):
    """(share wrong among texels of at least each level, share of texels trusted, share of these that are right)"""
    truth = metrics.Truth(room)
    scored = truth.mask & ~truth.clip
    albedo = metrics.resize(metrics.read_img(os.path.join(result, "albedo.exr")), truth.mask.shape)
    picture = Image.open(os.path.join(result, "confidence.png")).convert("L")
    confidence = metrics.resize(np.asarray(picture, np.float32)[..., None] / 255, truth.mask.shape)[..., 0][scored]
    estimate, _ = metrics.fit(albedo[scored], truth.alb[scored], False)
    off = np.abs(estimate @ metrics.LUM / np.maximum(truth.alb[scored] @ metrics.LUM, 1e-4) - 1) > WRONG
    at_least = [off[confidence >= level].mean() if (confidence >= level).any() else np.nan for level in LEVELS]
    trusted = confidence >= TRUSTED
    return at_least, trusted.mean(), 1 - off[trusted].mean()


def svg(lines):
    """Lines of (name, risks) as a picture of 560 by 340; 0 to 25 % upwards."""
    x, y = (lambda c: 60 + 340 * c), (lambda r: 300 - 1040 * r)
    out = ['<svg xmlns="http://www.w3.org/2000/svg" width="560" height="340" font-family="sans-serif" font-size="12">',
           '<rect width="560" height="340" fill="white"/>']
    for percent in (0, 5, 10, 15, 20, 25):
        out.append(f'<path d="M60 {y(percent / 100):.0f}H400" stroke="{"#888" if percent == 10 else "#ddd"}"/>'
                   f'<text x="52" y="{y(percent / 100) + 4:.0f}" text-anchor="end">{percent} %</text>')
    for tenth in range(0, 11, 2):
        out.append(f'<text x="{x(tenth / 10):.0f}" y="318" text-anchor="middle">{tenth / 10}</text>')
    out.append('<text x="230" y="335" text-anchor="middle">texels of at least this confidence</text>'
               '<text x="60" y="22">share of them off by more than 15 %</text>'
               f'<path d="M{x(TRUSTED):.0f} 300V40" stroke="#888" stroke-dasharray="3"/>')
    for i, (name, line) in enumerate(lines):
        colour = COLOURS[i % len(COLOURS)]
        points = " ".join(f"{x(c):.1f},{y(r):.1f}" for c, r in zip(LEVELS, line) if np.isfinite(r))
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>'
                   f'<text x="415" y="{60 + 20 * i}" fill="{colour}">{name}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    spec = importlib.util.spec_from_file_location("metrics", sys.argv[1])
    metrics = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(metrics)
    lines = []
    for named in sys.argv[3:]:
        name, folders = named.split("=", 1)
        line, trusted, right = risks(metrics, *folders.split(":"))
        print(f"{name}: {trusted:.1%} of texels at {TRUSTED} and more, {right:.1%} of them right")
        lines.append((name, line))
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write(svg(lines))


if __name__ == "__main__":
    main()
