#!/usr/bin/python3
"""A room's scan with its texture cut into many large pages, as photogrammetry gives them.

    bench/pages.py OUT.glb SCAN.glb PAGES SIDE

The texture is cut into PAGES tiles, and each is enlarged to SIDE x SIDE pixels (each pixel repeated, JPEG). A triangle goes to the
tile that its middle lies in; tiles reach as far beyond as their triangles do. Knows plain GLBs of one texture, as
bench/scan_file.py does.
"""
import copy
import io
import sys

import numpy as np
from PIL import Image
from scan_file import ScanFile

QUALITY = 90  # of JPEG


def tiles_of(pages: int) -> tuple[int, int]:
    """Columns and rows, as near to a square as can be."""
    rows = max(n for n in range(1, int(pages**0.5) + 1) if pages % n == 0)
    return pages // rows, rows


def enlarged(texture: np.ndarray, low: np.ndarray, high: np.ndarray, side: int) -> bytes:
    """The part of a texture between two texture coordinates as a JPEG of side x side."""
    middle = (np.arange(side) + 0.5) / side
    column, row = (np.clip((low[k] + middle * (high[k] - low[k])) * texture.shape[1 - k], 0, texture.shape[1 - k] - 1).astype(int)
                   for k in (0, 1))
    out = io.BytesIO()
    Image.fromarray(texture[row][:, column]).save(out, "JPEG", quality=QUALITY)
    return out.getvalue()


def main() -> None:
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    scan, pages, side = ScanFile(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    texture, (columns, rows) = scan.texture(), tiles_of(pages)
    Image.MAX_IMAGE_PIXELS = None
    document = scan.json
    image, material = document["images"].pop(), document["materials"][scan.primitives()[0]["material"]]
    document["materials"], document["textures"] = [], []

    def add(data: np.ndarray | bytes, **accessor: object) -> int:
        raw = data.tobytes() if isinstance(data, np.ndarray) else data
        document["bufferViews"].append({"buffer": 0, "byteLength": len(raw)})
        scan.views.append(raw)
        if accessor:
            document["accessors"].append({"bufferView": len(scan.views) - 1, **accessor})
        return len(scan.views) - 1 if not accessor else len(document["accessors"]) - 1

    parts = []
    for primitive in scan.primitives():
        index = scan.numbers(primitive["indices"]).reshape(-1, 3)
        coordinates = scan.numbers(primitive["attributes"]["TEXCOORD_0"])
        tile = np.minimum((coordinates[index].mean(1) % 1.0 * [columns, rows]).astype(int), [columns - 1, rows - 1])
        parts.append((primitive, index, coordinates, tile[:, 0] + columns * tile[:, 1]))
    made = []
    for page in range(pages):
        mine = [(primitive, index[tile == page], coordinates) for primitive, index, coordinates, tile in parts]
        used = np.concatenate([coordinates[index].reshape(-1, 2) for _, index, coordinates in mine])
        if len(used) == 0:
            continue
        low, high = used.min(0), used.max(0)
        number = len(document["materials"])
        picture = enlarged(texture, low, high, side)
        view = add(picture) if number > 0 else image["bufferView"]
        if number == 0:
            scan.views[view] = picture
        document["images"].append({"bufferView": view, "mimeType": "image/jpeg", "name": f"page {number}"})
        document["textures"].append({"source": number})
        new = copy.deepcopy(material)
        new["pbrMetallicRoughness"]["baseColorTexture"]["index"] = number
        document["materials"].append(new)
        for primitive, index, coordinates in mine:
            if len(index) == 0:
                continue
            part = copy.deepcopy(primitive)
            part["material"] = number
            part["indices"] = add(index.astype(np.uint32), componentType=5125, type="SCALAR", count=index.size)
            moved = ((coordinates - low) / (high - low)).astype(np.float32)
            part["attributes"]["TEXCOORD_0"] = add(moved, componentType=5126, type="VEC2", count=len(moved))
            made.append(part)
    document["meshes"] = [{"name": mesh.get("name", "room"), "primitives": made} for mesh in document["meshes"][:1]]
    for node in document["nodes"]:
        if "mesh" in node:
            node["mesh"] = 0
    scan.write(sys.argv[1])


if __name__ == "__main__":
    main()
