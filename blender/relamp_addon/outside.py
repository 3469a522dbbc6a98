"""Light from outside the scan, through its holes: a world, and squares before the large holes.

relamp finds one radiance for all small holes together, and one or two for each large one. The world
has the mean of all, `ambient`. What a large hole shows more or less than that, a pane in it shows
instead of the world: a mesh, not a light of Blender's, for that would shine beside the world and
not instead of it.
"""

from __future__ import annotations

import math

import bpy
import numpy
from mathutils import Matrix, Vector

from . import lamps, places
from .nodes import Builder
from .result import Result


def new_world(name: str, result: Result) -> bpy.types.World:
    ambient = numpy.array(result.lights.get("ambient", [0, 0, 0]), float)
    world = bpy.data.worlds.new(name)
    world.color = numpy.minimum(ambient, 1)
    world.use_nodes = True
    world.node_tree.nodes.clear()
    build = Builder(world.node_tree)
    background = build.add("ShaderNodeBackground")
    _send(background, ambient)
    build.link(background.outputs[0], build.add("ShaderNodeOutputWorld").inputs["Surface"])
    return world


def new_panes(result: Result, unit: float) -> list[bpy.types.Object]:
    return [_pane(f"opening {index}", opening, unit)
            for index, opening in enumerate(result.report["lights"].get("openings", []), 1)]


def _pane(name: str, opening: dict, unit: float) -> bpy.types.Object:
    side = math.sqrt(opening["area"]) / unit
    mesh = bpy.data.meshes.new(name)
    half = side / 2
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [],
                     [(0, 1, 2, 3)])
    mesh.materials.append(_glowing(name, numpy.array(opening["radiance"], float)))
    thing = bpy.data.objects.new(name, mesh)
    thing.display_type = "WIRE"
    normal = places.to_blender(numpy.array([opening["normal"]], float))[0]
    first, second = lamps.across_of(normal)
    turn = Matrix([Vector(first), Vector(second), Vector(normal)]).transposed().to_4x4()
    centre = places.to_blender(numpy.array([opening["centre"]], float))[0] / unit
    thing.matrix_world = Matrix.Translation(Vector(centre)) @ turn
    return thing


def _glowing(name: str, radiance: numpy.ndarray) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    build = Builder(material.node_tree)
    emission = build.add("ShaderNodeEmission")
    _send(emission, radiance)
    build.link(emission.outputs[0], build.add("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def _send(node: bpy.types.Node, radiance: numpy.ndarray) -> None:
    """Sets what a Background or an Emission sends."""
    most = float(radiance.max())
    node.inputs["Color"].default_value = (*(radiance / most if most > 0 else radiance), 1)
    node.inputs["Strength"].default_value = most
