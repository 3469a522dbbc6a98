"""Confidence as a colour attribute of the mesh, beside the image of it."""

from __future__ import annotations

import bpy
import numpy

from .materials import PageImages
from .scan_file import read

NAME = "relamp confidence"


def to_attribute(mesh: bpy.types.Mesh, layer: bpy.types.MeshUVLoopLayer, page: PageImages,
                 polygons: numpy.ndarray) -> None:
    """Gives the corners of the chosen `polygons` the confidence of the texel that they lie on."""
    image = page.confidence
    width, height = image.size
    values = numpy.empty(width * height * image.channels, numpy.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, -1)[..., 0]
    uv = read(layer.data, "uv", 2)
    column = numpy.clip((uv[:, 0] * width).astype(int), 0, width - 1)
    row = numpy.clip((uv[:, 1] * height).astype(int), 0, height - 1)

    attribute = mesh.color_attributes.get(NAME) or mesh.color_attributes.new(
        name=NAME, type="BYTE_COLOR", domain="CORNER")
    colour = read(attribute.data, "color", 4)
    count = read(mesh.polygons, "loop_total", 1, numpy.int32).ravel()
    begin = read(mesh.polygons, "loop_start", 1, numpy.int32).ravel()
    loops = numpy.repeat(begin - numpy.cumsum(count) + count, count) + numpy.arange(count.sum())
    chosen = loops[numpy.repeat(polygons, count)]
    colour[chosen, :3] = values[row, column][chosen, None]
    colour[chosen, 3] = 1
    attribute.data.foreach_set("color", colour.ravel())
