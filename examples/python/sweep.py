"""Carries a lamp along the room's ceiling, four pictures from left to right: sweep.py SCAN PICTURE.png"""

import sys

import matplotlib.image
import numpy as np
import relamp


def main(scan: str, picture: str, quality: str = "standard") -> None:
    room = relamp.delight(scan, quality=quality)
    there = np.linalg.norm(room.normals, axis=-1) > 0
    low, high = room.positions[there].min(axis=0), room.positions[there].max(axis=0)
    frames = []
    for part in (0.35, 0.5, 0.65, 0.8):
        x, _, z = low + part * (high - low)
        y = high[1] - 0.3
        lamp = {"type": "sphere", "position": [float(x), float(y), float(z)], "radius": 0.1, "radiance": [80, 70, 55]}
        # Rays are cast for the first light only; every further one is sums and its own shadows.
        frames.append(room.relight({"lights": [lamp]}).picture(size=(320, 240), exposure=1.0))
    matplotlib.image.imsave(picture, np.concatenate(frames, axis=1))


if __name__ == "__main__":
    main(*sys.argv[1:])
