#!/usr/bin/python3
"""Whether relamp's answer depends on what it must not depend on: docs/dev/rooms.md.

    bench/invariance.py ROOMS [RELAMP [RESULTS]]      ROOMS: folders of rooms, or one room, with recon/ beside its scan or not

Every scan is solved as it is and varied, and each pair of results compared:

    seed N      other rays, by --seed
    turn D      the room turned by D degrees about the vertical; its texture is the same
    exposure    the texture 0.7 times as bright before it was encoded: from the room's *_hdr.exr where it has one, where less
                burns out then; else from the texture, where what is burnt out stays so. Against the same at 1
    half, double   the texture in half and double resolution, in linear light; double repeats each texel. Against the same
                texture in PNG, at the lower resolution of the two

Of a pair: PSNR of both albedos against the truth after one scale a channel, on texels that count (mask.png) and are not burnt out;
how like the albedos are to each other; whether the lamps are the same (as many, each in its place, and the sun), and the
greatest step of a lamp's power. The answer is held to 0.3 dB and the same lamps; the exit status says how many are not, up to
99. Needs python3-numpy, -pil, -openimageio.
"""
import json
import os
import subprocess
import sys

import numpy as np
from scan_file import LUMINANCE, ScanFile, bytes_from_linear, continue_charts, linear_from_srgb, read_linear, texel_places

MOST_CHANGE = 0.3  # dB
BURNT_OUT = 0.98  # of white, in any channel
SEEDS = (2, 3, 4, 5)
TURNS = (30, 90, 217)
DARKER = 0.7


# ---- variations of a scan; each gives the scan's new file


def files_of(folder):
    for scan, hdr in (("scan.glb", "scan_hdr.exr"), ("scan_recon.glb", "scan_recon_hdr.exr")):
        if os.path.exists(os.path.join(folder, scan)):
            return os.path.join(folder, scan), os.path.join(folder, hdr)
    return None, None


def turned(scan, degrees):
    scan.turn(degrees)


def exposed(scan, factor, hdr):
    """From light before it burnt out, or from the texture: then what is burnt out stays as it is, in each channel alone."""
    if os.path.exists(hdr):
        seen = read_linear(hdr)
        inside = texel_places(*scan.triangles(), seen.shape[:2], rim=0.0)[1] >= 0
        scan.put_texture(bytes_from_linear(factor * continue_charts(seen, inside)), lossless=True)
    else:
        texture = scan.texture()
        darker = bytes_from_linear(factor * linear_from_srgb(texture / 255))
        scan.put_texture(np.where(texture == 255, texture, darker), lossless=True)


def halved(picture):
    return (picture[::2, ::2] + picture[1::2, ::2] + picture[::2, 1::2] + picture[1::2, 1::2]) / 4


def doubled(picture):
    return picture.repeat(2, 0).repeat(2, 1)


def resampled(scan, how):
    scan.put_texture(bytes_from_linear(how(linear_from_srgb(scan.texture() / 255))), lossless=True)


def variations(hdr):
    """(name, what it is compared with, its file's change or None, arguments); the former come first."""
    yield "as it is", None, None, []
    for seed in SEEDS:
        yield f"seed {seed}", "as it is", None, ["--seed", str(seed)]
    for degrees in TURNS:
        yield f"turn {degrees}", "as it is", lambda scan, d=degrees: turned(scan, d), []
    yield "exposed anew", None, lambda scan: exposed(scan, 1.0, hdr), []
    yield "exposure", "exposed anew", lambda scan: exposed(scan, DARKER, hdr), []
    yield "in PNG", None, lambda scan: resampled(scan, lambda picture: picture), []
    yield "half", "in PNG", lambda scan: resampled(scan, halved), []
    yield "double", "in PNG", lambda scan: resampled(scan, doubled), []


# ---- results


class Result:
    def __init__(self, folder, name):
        self.albedo = read_linear(os.path.join(folder, "albedo.exr"))
        lights = json.load(open(os.path.join(folder, "lights.json")))
        angle = -np.radians(float(name.split()[1])) if name.startswith("turn") else 0.0
        back = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
        unit = 1 / DARKER if name == "exposure" else 1.0
        self.lamps = [
            (back @ lamp["centre"], lamp["area"], unit * np.array(lamp["power"])) for lamp in lights.get("fixtures", [])
        ]
        self.sun = back @ lights["sun"]["direction"] if lights.get("sun") else None


def lamp_step(one, other):
    """Whether the lamps are the same, and the greatest step of log luminous power among those that are in both."""
    left, step = list(other.lamps), 0.0
    same = len(one.lamps) == len(left) and (one.sun is None) == (other.sun is None)
    if one.sun is not None and other.sun is not None:
        same &= bool(one.sun @ other.sun > np.cos(np.radians(5)))
    for centre, area, power in one.lamps:
        reach = 0.1 + 0.25 * np.sqrt(area)
        near = [(np.linalg.norm(lamp[0] - centre), i) for i, lamp in enumerate(left)]
        if not near or min(near)[0] > reach:
            same = False
            continue
        _, _, there = left.pop(min(near)[1])
        step = max(step, abs(np.log((there @ LUMINANCE) / max(power @ LUMINANCE, 1e-9))))
    return same, step


def scaled(estimate, truth):
    """The estimate after one least-squares scale a channel, with what is above white cut off."""
    out = np.empty_like(estimate)
    for c in range(3):
        scale = np.median(truth[:, c]) / max(np.median(estimate[:, c]), 1e-6)
        for _ in range(5):
            cut = np.clip(estimate[:, c], 0, 1 / scale)
            scale = (cut * truth[:, c]).sum() / max((cut * cut).sum(), 1e-12)
        out[:, c] = np.clip(scale * estimate[:, c], 0, 1)
    return out


def decibels(difference):
    return -10 * np.log10(max((difference**2).mean(), 1e-12))


class Truth:
    def __init__(self, folder, texture):
        from PIL import Image

        self.albedo = read_linear(os.path.join(folder, "gt_albedo.exr"))
        mask = np.asarray(Image.open(os.path.join(folder, "mask.png")).convert("L")) > 127
        self.counts = mask & (linear_from_srgb(texture / 255).max(2) < BURNT_OUT)

    def compare(self, one, other):
        """PSNR of both against the truth, and of one against the other."""
        height = min(one.shape[0], other.shape[0])
        truth, counts = self.albedo, self.counts.astype(float)
        while height < truth.shape[0]:
            truth, counts = halved(truth), halved(counts)
        one, other = (halved(a) if a.shape[0] > height else a for a in (one, other))
        at = counts > 0.999
        one, other = (scaled(a[at], truth[at]) for a in (one, other))
        return decibels(one - truth[at]), decibels(other - truth[at]), decibels(one - other)


def solve(relamp, scan, out, arguments):
    run = subprocess.run([relamp, "delight", scan, "-o", out, "--force", "-q", *arguments], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"invariance.py: {scan}: {run.stderr.strip()}")


def test(room, folder, relamp, results):
    """Prints a row a variation; the rows that are held and those that are not."""
    scan, hdr = files_of(folder)
    truth, found, held = Truth(folder, ScanFile(scan).texture()), {}, []
    for name, against, change, arguments in variations(hdr):
        place = os.path.join(results, room, name.replace(" ", "_"))
        os.makedirs(place, exist_ok=True)
        file = scan
        if name == "in PNG" and not ScanFile(scan).is_jpeg():
            found[name] = found["as it is"]
            continue
        if change:
            varied = ScanFile(scan)
            change(varied)
            file = os.path.join(place, "scan.glb")
            varied.write(file)
        solve(relamp, file, os.path.join(place, "result"), arguments)
        found[name] = Result(os.path.join(place, "result"), name)
        if not against:
            continue
        before, after, alike = truth.compare(found[against].albedo, found[name].albedo)
        same, step = lamp_step(found[against], found[name])
        held.append(same and abs(after - before) <= MOST_CHANGE)
        print(
            f"| {room} | {name} | {before:.2f} | {after - before:+.2f} | {alike:.1f} "
            f"| {len(found[against].lamps)} | {'same' if same else f'{len(found[name].lamps)} **other**'} | {step:.2f} "
            f"| {'yes' if held[-1] else '**no**'} |",
            flush=True,
        )
    return held


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    rooms = sys.argv[1]
    repository = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    relamp = sys.argv[2] if len(sys.argv) > 2 else os.path.join(repository, "build/release/apps/cli/relamp")
    results = sys.argv[3] if len(sys.argv) > 3 else os.path.join(repository, "build/invariance")
    names = [""] if files_of(rooms)[0] else sorted(os.listdir(rooms))
    print("| scan | variation | PSNR, dB | change | alike, dB | lamps | then | step of power, log | held |")
    print("| --- | --- | ---: | ---: | ---: | ---: | --- | ---: | --- |")
    held = []
    for name in names:
        for sub in ("", "recon"):
            folder = os.path.join(rooms, name, sub)
            if files_of(folder)[0]:
                room = (name or os.path.basename(os.path.abspath(rooms))) + (" recon" if sub else "")
                held += test(room, folder, relamp, results)
    print(f"\n{sum(held)} of {len(held)} held")
    sys.exit(min(len(held) - sum(held), 99))


if __name__ == "__main__":
    main()
