"""The faces of a mesh that lamps shine on, and samples of their surface."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy

from . import places
from .scan_file import read

STEPS = 6  # samples along an edge


@dataclass
class Samples:
    """Places of surface in Blender's world."""

    place: numpy.ndarray   # (N, 3)
    normal: numpy.ndarray  # (N, 3)
    area: numpy.ndarray    # (N,), in square units
    lamp: numpy.ndarray    # (N,), 1 + index of the lamp, 0: none

    def of(self, chosen: numpy.ndarray) -> "Samples":
        return Samples(self.place[chosen], self.normal[chosen], self.area[chosen],
                       self.lamp[chosen])


def faces_of_lamps(mesh: bpy.types.Mesh, uv_layer: bpy.types.MeshUVLoopLayer,
                   lamp_map: numpy.ndarray) -> numpy.ndarray:
    """A truth value a polygon: whether a texel of a lamp lies in the box around it on the page."""
    height, width = lamp_map.shape
    begin = read(mesh.polygons, "loop_start", 1, numpy.int32).ravel()
    texel = read(uv_layer.data, "uv", 2) * [width, height]
    low = numpy.floor(numpy.minimum.reduceat(texel, begin)).astype(int)
    high = numpy.floor(numpy.maximum.reduceat(texel, begin)).astype(int) + 1
    size = [width, height]
    low, high = numpy.clip(low, 0, size), numpy.clip(high, 0, size)
    # The sum over any box is that of four corners.
    total = numpy.zeros((height + 1, width + 1), numpy.int64)
    total[1:, 1:] = (lamp_map > 0).cumsum(axis=0).cumsum(axis=1)
    (left, below), (right, above) = low.T, high.T
    return (total[above, right] - total[below, right] - total[above, left]
            + total[below, left]) > 0


def samples_of_lamps(thing: bpy.types.Object, uv_layer: bpy.types.MeshUVLoopLayer,
                     lamp_map: numpy.ndarray, chosen: numpy.ndarray) -> Samples:
    """Samples all over the `chosen` polygons of an object."""
    mesh = thing.data
    mesh.calc_loop_triangles()
    polygon = read(mesh.loop_triangles, "polygon_index", 1, numpy.int32).ravel()
    loops = read(mesh.loop_triangles, "loops", 3, numpy.int32)[chosen[polygon]]
    vertex = read(mesh.loops, "vertex_index", 1, numpy.int32).ravel()[loops]
    corner = places.transformed(thing.matrix_world, read(mesh.vertices, "co", 3))[vertex]
    uv = read(uv_layer.data, "uv", 2)[loops]
    across = numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    if thing.matrix_world.determinant() < 0:
        across = -across
    double = numpy.linalg.norm(across, axis=1)
    normal = across / numpy.maximum(double, 1e-20)[:, None]

    weights = _middles()
    place = numpy.einsum("si,tij->tsj", weights, corner).reshape(-1, 3)
    on_page = numpy.einsum("si,tij->tsj", weights, uv).reshape(-1, 2)
    height, width = lamp_map.shape
    column = numpy.clip((on_page[:, 0] * width).astype(int), 0, width - 1)
    row = numpy.clip((on_page[:, 1] * height).astype(int), 0, height - 1)
    count = len(weights)
    return Samples(place, numpy.repeat(normal, count, axis=0),
                   numpy.repeat(double / 2 / count, count), lamp_map[row, column])


def _middles() -> numpy.ndarray:
    """(STEPS^2, 3) barycentric: the middles of equal parts of a triangle."""
    found = []
    for i in range(STEPS):
        for j in range(STEPS - i):
            found.append(((i + 1 / 3) / STEPS, (j + 1 / 3) / STEPS))
            if i + j < STEPS - 1:
                found.append(((i + 2 / 3) / STEPS, (j + 2 / 3) / STEPS))
    two = numpy.array(found)
    return numpy.column_stack([two, 1 - two.sum(axis=1)])
