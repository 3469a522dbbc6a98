"""The folder that relamp delight writes: see docs/guide/results.md and lights.md of relamp."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass

import bpy
import numpy

from .errors import Refusal

NOBODYS = 16777215  # of fixtures.png: burnt out, and no lamp's


@dataclass
class Lamp:
    number: int
    name: str
    centre: numpy.ndarray  # m, Y up
    normal: numpy.ndarray | None  # None: shines all around
    area: float  # m^2
    radiance: numpy.ndarray
    unseen: float = 0.0  # m^2 of the area: a far side that the scan does not show


class Result:
    def __init__(self, folder: str):
        self.folder = folder
        self.lights = self._json("lights.json")
        self.report = self._json("report.json")
        self.lamps = [_lamp(entry) for entry in self.lights.get("fixtures", [])]
        self.pages = [page["name"] for page in self.report["scan"]["pages"]]

    def picture(self, kind: str, page_name: str, ending: str = ".png") -> str:
        """The path of albedo.png, or albedo.2.png where there are several pages."""
        page = self.pages.index(page_name)
        number = f".{page}" if len(self.pages) > 1 else ""
        return os.path.join(self.folder, f"{kind}{number}{ending}")

    def lamp_map(self, page_name: str) -> numpy.ndarray:
        """(height, width), rows from below: 1 + index in `lamps` of what shines, else 0."""
        rgb = numpy.rint(pixels(self.picture("fixtures", page_name))[..., :3] * 255)
        number = (rgb.astype(numpy.int64) * [1, 256, 65536]).sum(axis=2)
        index = numpy.zeros(number.shape, numpy.int32)
        for i, lamp in enumerate(self.lamps):
            index[number == lamp.number + 1] = i + 1
        return index

    def _json(self, name: str) -> dict:
        path = os.path.join(self.folder, name)
        try:
            with open(path, encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError) as error:
            raise Refusal(f"{path} cannot be read: {error}") from error


def pixels(path: str) -> numpy.ndarray:
    """(height, width, channels) of a picture's own numbers, rows from below."""
    image = bpy.data.images.load(path)
    try:
        image.colorspace_settings.name = "Non-Color"
        values = numpy.empty(len(image.pixels), numpy.float32)
        image.pixels.foreach_get(values)
        return values.reshape(image.size[1], image.size[0], -1)
    finally:
        bpy.data.images.remove(image)


def _lamp(entry: dict) -> Lamp:
    normal = entry.get("normal", "omni")
    on = 1.0 if entry.get("on", True) else 0.0
    return Lamp(int(entry["id"]), entry.get("name") or f"lamp {entry['id']}",
                numpy.array(entry["centre"], float),
                None if isinstance(normal, str) else numpy.array(normal, float),
                float(entry.get("area", 0)), on * numpy.array(entry["radiance"], float),
                float(entry.get("unseen", 0)))
