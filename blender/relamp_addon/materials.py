"""Materials of a room without its light.

A texel is matte and has the albedo; one of a lamp shines to its front and reflects nothing, as
relamp takes it. Which texel is of which lamp stands in the lamp map, the lamps' radiance in the
palette, an image with one pixel a lamp: so radiance is exact, and 8 bits a texel are enough.

All materials of a room hang on one node group, the switch (switch.py), with three numbers:
Flat (1: show the picture of the node "shown" as it is, without light), Shine (1: lamps are on) and
Surfaces (1: what shines lights the room; 0: it is only seen to shine, for lights stand for it).
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy

from . import images
from .nodes import Builder
from .result import Result

FLAT, SHINE, SURFACES = "Flat", "Shine", "Surfaces"
SHOWN = "shown"  # the node whose image a flat mode exchanges


def new_switch(name: str) -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    build = Builder(tree)
    outputs = build.add("NodeGroupOutput")
    for number in (FLAT, SHINE, SURFACES):
        if hasattr(tree, "interface"):  # since 4.0
            tree.interface.new_socket(number, in_out="OUTPUT", socket_type="NodeSocketFloat")
        else:
            tree.outputs.new("NodeSocketFloat", number)
        value = build.add("ShaderNodeValue", name=number, label=number)
        build.link(value.outputs[0], outputs.inputs[number])
    return tree


def new_palette(name: str, result: Result) -> bpy.types.Image:
    """Radiance by the number in the lamp map; the first pixel is of what does not shine."""
    radiance = numpy.zeros((1, 1 + len(result.lamps), 3))
    for index, lamp in enumerate(result.lamps, 1):
        radiance[0, index] = lamp.radiance
    return images.from_array(name, radiance, is_float=True)


@dataclass
class PageImages:
    """The pictures of one texture of the scan."""

    lamp_numbers: numpy.ndarray  # result.Result.lamp_map
    albedo: bpy.types.Image
    confidence: bpy.types.Image
    lamp_map: bpy.types.Image
    palette: bpy.types.Image


def load_page(result: Result, page: str, name: str, palette: bpy.types.Image) -> PageImages:
    numbers = result.lamp_map(page)
    bytes_of = numpy.stack([numbers % 256, numbers // 256], axis=2) / 255
    return PageImages(
        numbers,
        images.load(result.picture("albedo", page), f"{name} albedo", "sRGB"),
        images.load(result.picture("confidence", page), f"{name} confidence", "Non-Color"),
        images.from_array(f"{name} lamps", bytes_of, is_float=False), palette)


def new_material(name: str, page: PageImages, uv_layer: str, switch: bpy.types.NodeTree,
                 is_of_lamps: bool) -> bpy.types.Material:
    """`is_of_lamps`: for the faces of lamps. Those of others are no lights to Cycles, which would
    else look for light on every wall.
    """
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    build = Builder(material.node_tree)
    uv = build.add("ShaderNodeUVMap", uv_map=uv_layer).outputs[0]
    by = build.add("ShaderNodeGroup", node_tree=switch).outputs
    albedo = build.texture(page.albedo, uv)
    diffuse = build.add("ShaderNodeBsdfDiffuse")
    build.link(albedo.outputs["Color"], diffuse.inputs["Color"])
    surface = diffuse.outputs[0]
    if is_of_lamps:
        surface = _with_lamps(build, page, uv, by, surface)
    shown = build.texture(page.albedo, uv, name=SHOWN, label=SHOWN)
    surface = build.mix(by[FLAT], surface, build.emission(shown.outputs["Color"]))
    build.link(surface, build.add("ShaderNodeOutputMaterial").inputs["Surface"])
    material.node_tree.nodes.active = shown  # what the viewport shows in Solid mode
    own = material.relamp
    own.albedo, own.confidence, own.is_of_lamps = page.albedo, page.confidence, is_of_lamps
    return material


def lights_by_surface(material: bpy.types.Material, does: bool) -> None:
    """Whether Cycles looks for light on the material's faces."""
    if not hasattr(material, "cycles"):
        return  # Cycles is switched off in the preferences
    if hasattr(material.cycles, "emission_sampling"):  # since 3.5
        material.cycles.emission_sampling = "AUTO" if does else "NONE"
    else:
        material.cycles.sample_as_light = does


def _with_lamps(build: Builder, page: PageImages, uv: bpy.types.NodeSocket, by,
                wall: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
    texel = build.texture(page.lamp_map, uv, interpolation="Closest")
    split = build.add("ShaderNodeSeparateXYZ")
    build.link(texel.outputs["Color"], split.inputs[0])
    low = build.maths("MULTIPLY", split.outputs[0], 255.0)
    number = build.maths("MULTIPLY_ADD", split.outputs[1], 255.0 * 256, low)
    place = build.add("ShaderNodeCombineXYZ")
    middle = build.maths("ADD", number, 0.5)
    build.link(build.maths("DIVIDE", middle, float(page.palette.size[0])), place.inputs[0])
    place.inputs[1].default_value = 0.5
    radiance = build.texture(page.palette, place.outputs[0], interpolation="Closest")

    path = build.add("ShaderNodeLightPath").outputs
    front = build.maths("SUBTRACT", 1.0, build.add("ShaderNodeNewGeometry").outputs["Backfacing"])
    seen = build.maths("MAXIMUM", by[SURFACES], path["Is Camera Ray"])
    shines = build.emission(radiance.outputs["Color"], build.maths("MULTIPLY", front, seen))
    # Where lights stand for it, its surface must not be in their way.
    in_the_way = build.maths("MULTIPLY", path["Is Shadow Ray"],
                             build.maths("SUBTRACT", 1.0, by[SURFACES]))
    through = build.add("ShaderNodeBsdfTransparent").outputs[0]
    lamp = build.mix(in_the_way, shines, through)
    is_lamp = build.maths("MULTIPLY", by[SHINE], build.maths("GREATER_THAN", number, 0.5))
    return build.mix(is_lamp, wall, lamp)
