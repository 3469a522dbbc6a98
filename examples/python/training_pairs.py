"""Scans to training data: tiles of scan, albedo, shading and confidence: training_pairs.py FOLDER SCAN ...

Each tile of 128 × 128 texels of which most are certain becomes one .npz with float16 arrays.
"""

import sys
from pathlib import Path

import numpy as np
import relamp

TILE = 128


def tiles(page: relamp.Page):
    height, width = page.confidence.shape
    for row in range(0, height - TILE + 1, TILE):
        for column in range(0, width - TILE + 1, TILE):
            at = np.s_[row : row + TILE, column : column + TILE]
            if (page.confidence[at] > 0.5).mean() > 0.5:
                yield {name: getattr(page, name)[at] for name in ("albedo", "shading", "confidence")}


def main(folder: str, *scans: str, quality: str = "standard") -> None:
    Path(folder).mkdir(parents=True, exist_ok=True)
    for scan in scans:
        try:
            room = relamp.delight(scan, quality=quality)
        except relamp.Error as error:
            print(error, file=sys.stderr)  # one bad scan does not stop the others
            continue
        number = 0
        for page in room.pages:
            for tile in tiles(page):
                tile["scan"] = tile["albedo"] * tile["shading"]
                halves = {name: values.astype(np.float16) for name, values in tile.items()}
                np.savez_compressed(Path(folder) / f"{Path(scan).stem}_{number:04}.npz", **halves)
                number += 1
        print(f"{scan}: {number} tiles")


if __name__ == "__main__":
    main(*sys.argv[1:])
