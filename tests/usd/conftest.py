"""Results with USD scenes, made once by the real program.

Of the sample, and of a room of coloured vertices whose names are none of USD's.
"""

import base64
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

PROGRAM = os.environ["RELAMP_PROGRAM"]
SAMPLE = Path(os.environ["RELAMP_SAMPLES"]) / "bedroom" / "scan.glb"
NAMES = ["2nd wall", 'wall "a" \\ b', "Küche 部屋", "wall", "wall", ""]


def delight(*words, check=True):
    command = [PROGRAM, "delight", *map(str, words), "--quality", "draft", "-q"]
    return subprocess.run(command, check=check, capture_output=True, text=True)


def wall(corner, along_u, along_v, is_lamp):
    """A grid of coloured vertices; where it is a lamp, its middle is burnt out."""
    side = np.linspace(0, 1, 25)
    u, v = (grid.ravel() for grid in np.meshgrid(side, side))
    points = corner + u[:, None] * along_u + v[:, None] * along_v
    lit = (abs(u - 0.5) < 0.1) & (abs(v - 0.5) < 0.1) & is_lamp
    colors = np.where(lit[:, None], 1.0, [0.3, 0.25, 0.2] * (1 + 0.1 * points[:, 1:2]))
    first = np.arange(25 * 24).reshape(24, 25)[:, :24].ravel()
    squares = np.stack([first, first + 1, first + 26, first, first + 26, first + 25], axis=1)
    return points.astype("<f4"), colors.astype("<f4"), squares.astype("<u4").ravel()


def room_of_vertices(file):
    """A box of 3 x 2.5 x 3 m, a mesh a wall, its light in the colours of vertices."""
    x, y, z = np.eye(3) * [3, 2.5, 3]
    o = np.zeros(3)
    walls = [wall(o, z, x, False), wall(y, x, z, True), wall(o, y, z, False), wall(x, z, y, False),
             wall(o, x, y, False), wall(z, y, x, False)]
    document = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": []}
    document |= {"meshes": [], "nodes": []}
    binary = b""

    def accessor(array, kind, component):
        nonlocal binary
        view = {"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes}
        document["bufferViews"].append(view)
        binary += array.tobytes()
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "type": kind,
                                      "componentType": component, "count": len(array)})
        return len(document["accessors"]) - 1

    for name, (points, colors, indices) in zip(NAMES, walls):
        primitive = {"indices": accessor(indices, "SCALAR", 5125),
                     "attributes": {"POSITION": accessor(points, "VEC3", 5126),
                                    "COLOR_0": accessor(colors, "VEC3", 5126)}}
        ends = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
        document["accessors"][-2].update(ends)
        document["meshes"].append({"name": name, "primitives": [primitive]})
        document["nodes"].append({"name": name, "mesh": len(document["meshes"]) - 1})
    uri = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    document["buffers"] = [{"byteLength": len(binary), "uri": uri}]
    document["scenes"] = [{"nodes": list(range(len(walls)))}]
    file.write_text(json.dumps(document))


@pytest.fixture(scope="session")
def sample(tmp_path_factory):
    """The folder of the sample's result."""
    folder = tmp_path_factory.mktemp("usd") / "sample"
    delight(SAMPLE, "--usd", "-o", folder)
    return folder


@pytest.fixture(scope="session")
def vertices(tmp_path_factory):
    """The folder of the result of a room of coloured vertices."""
    folder = tmp_path_factory.mktemp("usd")
    room_of_vertices(folder / "wände 1.gltf")
    delight(folder / "wände 1.gltf", "--usd", "--light", "1.5,2.5,1.5", "-o", folder / "out")
    return folder / "out"
