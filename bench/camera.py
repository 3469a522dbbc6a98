#!/usr/bin/python3
"""Gives a room with ground truth as another camera would have seen it: docs/dev/rooms.md.

    bench/camera.py ROOM OUT MODE [SEED]

ROOM is a room's folder or its recon/, with the scan, its *_hdr.exr and its truth. OUT gets the new scan, links to the truth,
and what was done: camera.json, and gain.exr where the gain is not 1 everywhere. MODE is words joined by +, from

    film      toe and shoulder of film: Hable's curve (2010), white at 3 to 6 times the old
    spline    a random monotone curve: slopes of log over log about 1, falling towards white
    gamma     encoded by a plain power, 1/1.9 or 1/2.6, and read as sRGB
    video     encoded by BT.709's curve and read as sRGB
    local     local tone mapping: brightness over half a metre to the power 0.6, detail as it is
    expose    exposure that wanders by 0.25 EV rms: cubic B-splines over random knots 1.5 m apart
    white     white balance that wanders: 4 % rms between warm and cold, 1.5 % between green and magenta
    ceiling   what faces down within half a metre of the top was not scanned
    none      encoded anew and nothing else

SEED (1) draws curves and fields. Gain comes first, then local tone mapping, then the curve, as in a camera; film and
spline keep mid grey, gamma and video white. With `ceiling`, what is gone is no longer scored; its lamps stay in gt_lights.json.
Needs python3-numpy, -pil, -openimageio.
"""
import json
import os
import sys

import numpy as np
from scan_file import (
    LUMINANCE,
    ScanFile,
    bytes_from_linear,
    continue_charts,
    linear_from_srgb,
    read_linear,
    texel_places,
    write_exr,
)

GREY = 0.18
WORDS = "film spline gamma video local expose white ceiling none".split()


# ---- curves: radiance in the old texture's units to that in the new one's


def film_curve(random):
    white = random.uniform(3, 6)

    def hable(x):
        a, b, c, d, e, f = 0.22, 0.30, 0.10, 0.20, 0.01, 0.30
        return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f

    exposure = np.geomspace(0.05, 50, 4000)  # that keeps mid grey
    exposure = exposure[np.argmin(np.abs(hable(exposure * GREY) / hable(exposure * white) - GREY))]
    return lambda x: hable(exposure * x) / hable(exposure * white)


def monotone_spline(x, y):
    """Fritsch & Carlson 1980 by harmonic means of the slopes; straight beyond the last knots."""
    step, slope = np.diff(x), np.diff(y) / np.diff(x)
    inner = 2 / (1 / slope[:-1] + 1 / slope[1:])
    tangent = np.concatenate([slope[:1], inner, slope[-1:]])

    def at(q):
        i = np.clip(np.searchsorted(x, q) - 1, 0, len(step) - 1)
        t = (q - x[i]) / step[i]
        s = np.clip(t, 0, 1)
        bent = (
            (1 + 2 * s) * (1 - s) ** 2 * y[i]
            + s * (1 - s) ** 2 * step[i] * tangent[i]
            + s * s * (3 - 2 * s) * y[i + 1]
            - s * s * (1 - s) * step[i] * tangent[i + 1]
        )
        return bent + np.where(t < 0, t * step[i] * tangent[0], np.where(t > 1, (t - 1) * step[i] * tangent[-1], 0))

    return at


def spline_curve(random):
    knots = np.log2(GREY) + np.array([-6.0, -4, -2.5, -1, 0, 1, 2, 3, 4])
    contrast = random.uniform(0.8, 1.3)
    slopes = contrast * np.exp(random.normal(0, 0.15, len(knots) - 1))
    slopes[4:] *= [0.95, 0.8, 0.55, 0.35]  # over mid grey: a shoulder
    values = np.concatenate([[0], np.cumsum(slopes * np.diff(knots))])
    curve = monotone_spline(knots, values - values[4] + np.log2(GREY))
    return lambda x: np.exp2(curve(np.log2(np.maximum(x, 1e-6))))


def gamma_curve(random):
    gamma = random.choice([1.9, 2.6])
    return lambda x: linear_from_srgb(np.clip(x, 0, 1) ** (1 / gamma))


def video_curve(random):
    return lambda x: linear_from_srgb(np.where(x < 0.018, 4.5 * x, 1.099 * np.clip(x, 0.018, 1) ** 0.45 - 0.099))


CURVES = {"film": film_curve, "spline": spline_curve, "gamma": gamma_curve, "video": video_curve}


# ---- fields over the room


def spline_weights(t):
    return np.stack([(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3]) / 6


def smooth_field(places, random, knot):
    """A random field of cubic B-splines over knots `knot` metres apart; mean 0 and rms 1 over the places."""
    low = places.min(0)
    at = (places - low) / knot
    cells = np.floor(at.max(0)).astype(int) + 4
    lattice = random.normal(size=cells)
    base = np.floor(at).astype(int)
    wx, wy, wz = (spline_weights(at[:, k] - base[:, k]) for k in range(3))
    value = np.zeros(len(places))
    for i in range(4):
        for j in range(4):
            for k in range(4):
                value += wx[i] * wy[j] * wz[k] * lattice[base[:, 0] + i, base[:, 1] + j, base[:, 2] + k]
    value -= value.mean()
    return value / np.sqrt((value**2).mean())


def base_layer(places, brightness, cell=0.25, blurs=2):
    """log brightness around each place: means over cells of a grid, blurred, read out trilinearly."""
    low = places.min(0) - 2 * cell
    at = (places - low) / cell - 0.5
    cells = np.ceil(at.max(0)).astype(int) + 3
    base = np.floor(at).astype(int)
    part = at - base
    corners = [np.array(c) for c in np.ndindex(2, 2, 2)]
    index = lambda c: np.ravel_multi_index(tuple((base + c).T), cells)
    weight = lambda c: np.prod(np.where(c, part, 1 - part), 1)
    total, count = np.zeros(np.prod(cells)), np.zeros(np.prod(cells))
    for c in corners:
        total += np.bincount(index(c), weight(c) * brightness, len(total))
        count += np.bincount(index(c), weight(c), len(count))
    total, count = total.reshape(cells), count.reshape(cells)
    for _ in range(blurs):
        for axis in range(3):
            total, count = (g / 2 + (np.roll(g, 1, axis) + np.roll(g, -1, axis)) / 4 for g in (total, count))
    mean = (total / np.maximum(count, 1e-9)).ravel()
    return sum(weight(c) * mean[index(c)] for c in corners)


def gains(words, seen, places, has, random):
    """What the camera multiplies the radiance of each texel by, (h, w, 3)."""
    log_gain, where = np.zeros(seen.shape), places[has]
    if "expose" in words:
        log_gain[has] += 0.25 * np.log(2) * smooth_field(where, random, 1.5)[:, None]
    if "white" in words:
        warm, green = smooth_field(where, random, 1.5), smooth_field(where, random, 1.5)
        log_gain[has] += 0.04 * np.outer(warm, [1, 0, -1]) + 0.015 * np.outer(green, [-1, 1, -1])
    if "local" in words:
        bright = np.log(np.clip((seen[has] * np.exp(log_gain[has])) @ LUMINANCE, 0.01, 2))
        log_gain[has] += (0.6 - 1) * (base_layer(where, bright) - np.log(GREY))[:, None]
    return np.exp(log_gain)


# ---- files


def files_of(room):
    for scan, hdr in (("scan.glb", "scan_hdr.exr"), ("scan_recon.glb", "scan_recon_hdr.exr")):
        if os.path.exists(os.path.join(room, scan)):
            return scan, hdr
    sys.exit(f"camera.py: {room}: neither scan.glb nor scan_recon.glb is there")


def link_truth(room, out):
    for name in os.listdir(room):
        if name.startswith(("gt_", "mask", "relit_", "meta")):
            link = os.path.join(out, name)
            if os.path.lexists(link):
                os.remove(link)
            os.symlink(os.path.join(room, name), link)


def drop_ceiling(scan, room, out, owner):
    from PIL import Image

    corners, _ = scan.triangles()
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    faces_down = normal[:, 1] < -0.7 * np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    gone = faces_down & (corners[..., 1].mean(1) > corners[..., 1].max() - 0.5)
    scan.drop(gone)
    mask = np.asarray(Image.open(os.path.join(room, "mask.png")).convert("L")).copy()
    mask[(owner >= 0) & gone[owner]] = 0
    os.remove(os.path.join(out, "mask.png"))
    Image.fromarray(mask).save(os.path.join(out, "mask.png"))
    return int(gone.sum())


def main():
    if len(sys.argv) < 4 or not set(sys.argv[3].split("+")) <= set(WORDS):
        sys.exit(__doc__)
    room, out, words = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3].split("+")
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    scan_name, hdr_name = files_of(room)
    random = np.random.default_rng([seed, sum(map(ord, sys.argv[3]))])
    scan, seen = ScanFile(os.path.join(room, scan_name)), read_linear(os.path.join(room, hdr_name))
    os.makedirs(out, exist_ok=True)
    link_truth(room, out)
    done = {"room": room, "mode": words, "seed": seed}
    places, owner = texel_places(*scan.triangles(), seen.shape[:2])
    seen = continue_charts(seen, texel_places(*scan.triangles(), seen.shape[:2], rim=0.0)[1] >= 0)
    if {"expose", "white", "local"} & set(words):
        gain = gains(words, seen, places, owner >= 0, random)
        write_exr(os.path.join(out, "gain.exr"), gain)
        done["gainRmsEv"] = float(np.log2(gain[owner >= 0] @ LUMINANCE).std())
        seen = seen * gain
    for word in words:
        if word in CURVES:
            curve = CURVES[word](random)
            at = np.geomspace(2.0**-10, 16, 57)
            done.setdefault("curves", []).append({"kind": word, "in": at.tolist(), "out": curve(at).tolist()})
            seen = curve(seen)
    if "ceiling" in words:
        done["trianglesGone"] = drop_ceiling(scan, room, out, owner)
    done["burntOut"] = float((seen.max(2) >= 1).mean())
    encoded = scan.put_texture(bytes_from_linear(seen))
    scan.write(os.path.join(out, scan_name))
    picture = "scan_recon.jpg" if "recon" in scan_name else "scan.png"
    with open(os.path.join(out, picture), "wb") as file:
        file.write(encoded)
    with open(os.path.join(out, "camera.json"), "w") as file:
        json.dump(done, file, indent=1)


if __name__ == "__main__":
    main()
