#!/usr/bin/python3
"""Rooms side by side in one file, as a house is scanned.

    bench/house.py OUT.glb SCAN.glb SCAN.glb ...

Each scan stands on the floor, 0.3 m beside the last along x, and keeps its texture: albedo.N.exr of the house is to be scored as
albedo.exr of that room. Knows plain GLBs, as those of the rooms with ground truth: one buffer, one scene, no extensions.
"""
import json
import struct
import sys

APART = 0.3  # m
LISTS = ("nodes", "meshes", "materials", "textures", "images", "samplers", "accessors", "bufferViews")


def read(path):
    data = open(path, "rb").read()
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def padded(data, by):
    return data + by * (-len(data) % 4)


def moved(item, first):
    """An item of a scan with its indices as they are in the house."""
    points_at = {"mesh": "meshes", "bufferView": "bufferViews", "source": "images", "sampler": "samplers", "material": "materials",
                 "indices": "accessors", "index": "textures"}
    if isinstance(item, list):
        return [moved(part, first) for part in item]
    if not isinstance(item, dict):
        return item
    result = {}
    for key, value in item.items():
        if key == "attributes":
            result[key] = {name: accessor + first["accessors"] for name, accessor in value.items()}
        elif key == "children":
            result[key] = [node + first["nodes"] for node in value]
        elif key in points_at and isinstance(value, int):
            result[key] = value + first[points_at[key]]
        else:
            result[key] = moved(value, first)
    return result


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    house = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], **{name: [] for name in LISTS}}
    blob = b""
    x = 0.0
    for path in sys.argv[2:]:
        scan, data = read(path)
        first = {name: len(house[name]) for name in LISTS}
        for view in scan["bufferViews"]:
            view["byteOffset"] = view.get("byteOffset", 0) + len(blob)
        for name in LISTS:
            house[name] += moved(scan.get(name, []), first)
        corners = [scan["accessors"][part["attributes"]["POSITION"]] for mesh in scan["meshes"] for part in mesh["primitives"]]
        least = [min(c["min"][axis] for c in corners) for axis in range(3)]
        roots = [node + first["nodes"] for node in scan["scenes"][scan.get("scene", 0)]["nodes"]]
        house["scenes"][0]["nodes"].append(len(house["nodes"]))
        house["nodes"].append({"translation": [x - least[0], -least[1], -least[2]], "children": roots})
        x += max(c["max"][0] for c in corners) - least[0] + APART
        blob = padded(blob + data, b"\0")
    house["buffers"] = [{"byteLength": len(blob)}]
    text = padded(json.dumps({name: part for name, part in house.items() if part != []}).encode(), b" ")
    with open(sys.argv[1], "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(blob)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob)


if __name__ == "__main__":
    main()
