"""A scan's GLB as numpy sees it: triangles, where its texels are, its texture; and pictures, linear and as bytes.

For bench/camera.py and bench/invariance.py. Knows plain GLBs of one texture, as those of the rooms with ground truth: no
compression, no sparse accessors, indexed triangles. Needs python3-numpy, -pil, -openimageio.
"""
import io
import json
import struct

import numpy as np

TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def linear_from_srgb(value):
    return np.where(value <= 0.04045, value / 12.92, ((np.maximum(value, 0) + 0.055) / 1.055) ** 2.4)


def srgb_from_linear(value):
    value = np.clip(value, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.maximum(value, 1e-9) ** (1 / 2.4) - 0.055)


def bytes_from_linear(rgb):
    return np.uint8(np.round(255 * srgb_from_linear(rgb)))


def read_linear(path):
    """EXR as it is, other files through sRGB; (h, w, 3)."""
    if str(path).endswith(".exr"):
        import OpenImageIO as oiio

        picture = oiio.ImageInput.open(str(path))
        pixels = np.asarray(picture.read_image(oiio.FLOAT), np.float64)
        picture.close()
        return pixels[..., :3]
    from PIL import Image

    return linear_from_srgb(np.asarray(Image.open(path).convert("RGB"), np.float64) / 255)


def write_exr(path, rgb):
    import OpenImageIO as oiio

    picture = oiio.ImageOutput.create(str(path))
    picture.open(str(path), oiio.ImageSpec(rgb.shape[1], rgb.shape[0], 3, oiio.HALF))
    picture.write_image(np.ascontiguousarray(rgb, np.float32))
    picture.close()


class ScanFile:
    """A GLB whose nodes, triangles and texture can be changed and written again."""

    def __init__(self, path):
        data = open(path, "rb").read()
        (length,) = struct.unpack_from("<I", data, 12)
        self.json = json.loads(data[20 : 20 + length])
        self.views = []
        for view in self.json["bufferViews"]:
            begin = 28 + length + view.get("byteOffset", 0)
            self.views.append(data[begin : begin + view["byteLength"]])
        (self.image,) = self.json["images"]

    def primitives(self):
        return [primitive for mesh in self.json["meshes"] for primitive in mesh["primitives"]]

    def numbers(self, accessor):
        """(count, width), a copy."""
        accessor = self.json["accessors"][accessor]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(TYPES[accessor["componentType"]]), WIDTHS[accessor["type"]]
        strides = (view.get("byteStride", kind.itemsize * width), kind.itemsize)
        data, offset = self.views[accessor["bufferView"]], accessor.get("byteOffset", 0)
        return np.ndarray((accessor["count"], width), kind, data, offset, strides).copy()

    def triangles(self):
        """Corners (n, 3, 3) in metres and their texture coordinates (n, 3, 2), as the nodes leave them alone."""
        corners, coordinates = [], []
        for primitive in self.primitives():
            index = self.numbers(primitive["indices"]).reshape(-1, 3).astype(int)
            corners.append(self.numbers(primitive["attributes"]["POSITION"])[index])
            coordinates.append(self.numbers(primitive["attributes"]["TEXCOORD_0"])[index])
        return np.concatenate(corners).astype(float), np.concatenate(coordinates).astype(float)

    def drop(self, gone):
        """Shrinks the marked triangles, in the order of triangles(), to points."""
        begin = 0
        for primitive in self.primitives():
            accessor = self.json["accessors"][primitive["indices"]]
            index = self.numbers(primitive["indices"]).reshape(-1, 3)
            mine = gone[begin : begin + len(index)]
            begin += len(index)
            index[mine] = index[mine][:, :1]
            view, offset = accessor["bufferView"], accessor.get("byteOffset", 0)
            data = bytearray(self.views[view])
            data[offset : offset + index.nbytes] = index.tobytes()
            self.views[view] = bytes(data)

    def turn(self, degrees):
        """Turns the whole about the vertical, y: a point (x, z) comes to (x cos + z sin, z cos - x sin)."""
        half = np.radians(degrees) / 2
        scene = self.json["scenes"][self.json.get("scene", 0)]
        node = {"name": "turned", "rotation": [0.0, float(np.sin(half)), 0.0, float(np.cos(half))]}
        node["children"] = scene["nodes"]
        self.json["nodes"].append(node)
        scene["nodes"] = [len(self.json["nodes"]) - 1]

    def is_jpeg(self):
        return self.image["mimeType"] == "image/jpeg"

    def texture(self):
        """The texture's bytes, (h, w, 3)."""
        from PIL import Image

        return np.asarray(Image.open(io.BytesIO(self.views[self.image["bufferView"]])).convert("RGB"))

    def put_texture(self, rgb, lossless=False):
        """Bytes, (h, w, 3), stored as the scan's were: PNG, or JPEG without subsampling."""
        from PIL import Image

        out = io.BytesIO()
        if lossless:
            self.image["mimeType"] = "image/png"
        how = {"format": "JPEG", "quality": 92, "subsampling": 0} if self.is_jpeg() else {"format": "PNG"}
        Image.fromarray(rgb).save(out, **how)
        self.views[self.image["bufferView"]] = out.getvalue()
        return out.getvalue()

    def write(self, path):
        blob = b""
        for view, data in zip(self.json["bufferViews"], self.views):
            blob += b"\0" * (-len(blob) % 4)
            view["byteOffset"], view["byteLength"] = len(blob), len(data)
            blob += data
        blob += b"\0" * (-len(blob) % 4)
        self.json["buffers"] = [{"byteLength": len(blob)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(blob)))
            out.write(struct.pack("<I4s", len(text), b"JSON") + text)
            out.write(struct.pack("<I4s", len(blob), b"BIN\0") + blob)


def texel_places(corners, coordinates, shape, rim=2.5):
    """Where each texel is, (h, w, 3) in metres; which triangle's it is, (h, w), -1 for none.

    Texels up to `rim` outside of a triangle are its own where they are no other's inside.
    """
    height, width = shape
    places, owner = np.zeros((height, width, 3)), np.full((height, width), -1)
    uv = coordinates * [width, height] - 0.5
    edge = uv[:, [1, 2, 0]] - uv
    twice = edge[:, 0, 0] * -edge[:, 2, 1] + edge[:, 0, 1] * edge[:, 2, 0]  # area, signed
    low = np.maximum(np.floor(uv.min(1) - rim), 0).astype(int)
    high = np.minimum(np.ceil(uv.max(1) + rim), [width - 1, height - 1]).astype(int)
    reach = (high - low).max(1) + 1
    usable = np.flatnonzero((np.abs(twice) > 1e-9) & (reach > 0))
    for least in (-rim, -1e-6):  # what lies inside comes last
        for size in 2 ** np.arange(2, 14):
            group = usable[(reach[usable] <= size) & (reach[usable] > (size // 2 if size > 4 else 0))]
            for some in np.array_split(group, max(1, len(group) * size * size // 2_000_000)):
                if len(some) == 0:
                    continue
                step = np.arange(size)
                x = low[some, 0][:, None, None] + step[None, None, :]
                y = low[some, 1][:, None, None] + step[None, :, None]
                off, weight = [], []
                for k in range(3):
                    a, e = uv[some, k][:, None, None], edge[some, k][:, None, None]
                    cross = (e[..., 0] * (y - a[..., 1]) - e[..., 1] * (x - a[..., 0])) * np.sign(twice[some])[:, None, None]
                    off.append(cross / np.maximum(np.hypot(e[..., 0], e[..., 1]), 1e-9))
                    weight.append(cross / np.abs(twice[some])[:, None, None])
                inside = (np.minimum.reduce(off) >= least) & (x < width) & (y < height)
                t, yy, xx = np.nonzero(inside)
                at = (low[some[t], 1] + yy, low[some[t], 0] + xx)
                share = np.stack([weight[1][inside], weight[2][inside], weight[0][inside]], 1)  # of corners 0, 1, 2
                places[at] = (share[..., None] * corners[some[t]]).sum(1)
                owner[at] = some[t]
    return places, owner


def continue_charts(seen, is_inside, steps=4):
    """What is outside of charts goes on as the chart beside it does, or filters and JPEG would mix in black."""
    seen, known = seen * is_inside[..., None], is_inside.copy()
    for _ in range(steps):
        total, count = np.zeros(seen.shape), np.zeros(known.shape)
        for y, x in np.argwhere(np.ones((3, 3))) - 1:
            total += np.roll(seen, (y, x), (0, 1))
            count += np.roll(known, (y, x), (0, 1))
        new = ~known & (count > 0)
        seen[new] = total[new] / count[new][:, None]
        known |= new
    return seen
