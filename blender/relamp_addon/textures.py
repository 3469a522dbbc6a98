"""Which texture a scan's material shows, and its file."""

from __future__ import annotations

import os
from dataclasses import dataclass

import bpy
import numpy

from .errors import Refusal

# Where a scan's colour goes in, by what importers make: a lit material, an unlit one, a simple one.
COLOUR_SOCKETS = (
    ("BSDF_PRINCIPLED", "Base Color"),
    ("EMISSION", "Color"),
    ("BACKGROUND", "Color"),
    ("BSDF_DIFFUSE", "Color"),
)
ENDINGS = {"JPEG": ".jpg", "PNG": ".png", "OPEN_EXR": ".exr", "OPEN_EXR_MULTILAYER": ".exr",
           "TIFF": ".tif", "HDR": ".hdr", "BMP": ".bmp", "TARGA": ".tga", "TARGA_RAW": ".tga",
           "WEBP": ".webp"}
LINEAR = ("Non-Color", "Linear", "Raw", "Linear Rec.709")


@dataclass(frozen=True)
class Texture:
    image: bpy.types.Image
    uv_layer: str  # "": the one that the mesh renders by


def texture_of(material: bpy.types.Material) -> Texture:
    """The picture that a material takes its colour from. Throws Refusal where there is none."""
    if material.use_nodes and material.node_tree:
        for node in _colour_nodes(material.node_tree):
            if node.image:
                return Texture(_checked(node.image, material), _uv_layer(node, material))
    raise Refusal(f'material "{material.name}" has no texture: relamp needs the scan\'s photo as '
                  "an Image Texture that goes into the material's Base Color or Emission")


def write_picture(image: bpy.types.Image, stem: str) -> str:
    """Writes the picture of an image, as it was read wherever that is possible; the file's name."""
    content = None
    if not image.is_dirty:
        content = image.packed_file.data if image.packed_file else _content_of_file(image)
    if content is None:
        return _write_pixels(image, stem)
    name = stem + ENDINGS.get(image.file_format, ".png")
    with open(name, "wb") as file:
        file.write(content)
    return name


def _write_pixels(image: bpy.types.Image, stem: str) -> str:
    """Of one that was painted or generated: what Blender holds, which no file has."""
    values = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(values)
    rgba = numpy.ones((image.size[0] * image.size[1], 4), numpy.float32)
    rgba[:, :image.channels] = values.reshape(-1, image.channels)
    if image.channels < 3:
        rgba[:, 1:3] = rgba[:, :1]
    copy = bpy.data.images.new(image.name, *image.size, alpha=True, float_buffer=image.is_float)
    try:
        copy.colorspace_settings.name = "Non-Color"  # numbers stay as they are
        copy.pixels.foreach_set(rgba.ravel())
        copy.file_format = "OPEN_EXR" if image.is_float else "PNG"
        copy.filepath_raw = stem + ENDINGS[copy.file_format]
        copy.save()
        return copy.filepath_raw
    except RuntimeError as error:
        raise Refusal(f'image "{image.name}" cannot be written: {error}') from error
    finally:
        bpy.data.images.remove(copy)


def is_linear(image: bpy.types.Image) -> bool:
    """Whether Blender takes the numbers of a picture of integers for light, and not for sRGB."""
    return not image.is_float and image.colorspace_settings.name in LINEAR


def _colour_nodes(tree: bpy.types.NodeTree) -> list[bpy.types.ShaderNodeTexImage]:
    found = []
    for kind, socket in COLOUR_SOCKETS:
        for node in tree.nodes:
            if node.type == kind and node.inputs[socket].links:
                _climb(node.inputs[socket], found, set())
    # Where nothing is wired to a shader, what a person has clicked last, then whatever there is.
    others = [node for node in tree.nodes if node.type == "TEX_IMAGE"]
    others.sort(key=lambda node: node != tree.nodes.active)
    return found + others


def _climb(socket: bpy.types.NodeSocket, found: list, seen: set) -> None:
    for link in socket.links:
        node = link.from_node
        if node in seen:
            continue
        seen.add(node)
        if node.type == "TEX_IMAGE":
            found.append(node)
            continue
        for above in node.inputs:
            _climb(above, found, seen)


def _uv_layer(node: bpy.types.ShaderNode, material: bpy.types.Material) -> str:
    for link in node.inputs["Vector"].links:
        source = link.from_node
        if source.type == "MAPPING" and _changes_nothing(source):
            return _uv_layer(source, material)
        if source.type == "MAPPING":
            raise Refusal(f'material "{material.name}" moves or scales its texture by a Mapping '
                          "node; apply that to the UV map and remove the node")
        if source.type == "UVMAP":
            return source.uv_map
        if source.type != "TEX_COORD" or link.from_socket.name != "UV":
            raise Refusal(f'material "{material.name}" places its texture by the node '
                          f'"{source.name}"; relamp reads UV maps only')
    return ""


def _changes_nothing(mapping: bpy.types.ShaderNodeMapping) -> bool:
    expected = {"Location": (0, 0, 0), "Rotation": (0, 0, 0), "Scale": (1, 1, 1)}
    return all(socket.name not in expected or
               not socket.links and tuple(socket.default_value) == expected[socket.name]
               for socket in mapping.inputs)


def _checked(image: bpy.types.Image, material: bpy.types.Material) -> bpy.types.Image:
    if image.source == "TILED":
        raise Refusal(f'image "{image.name}" of material "{material.name}" consists of UDIM tiles, '
                      "which relamp does not read; bake it into one picture a material")
    if image.source in ("MOVIE", "SEQUENCE", "VIEWER"):
        raise Refusal(f'image "{image.name}" of material "{material.name}" is no still picture')
    if image.size[0] == 0:
        raise Refusal(f'image "{image.name}" of material "{material.name}" has no content: its '
                      f"file {image.filepath or '(none)'} is missing; find it by File > External "
                      "Data > Find Missing Files")
    return image


def _content_of_file(image: bpy.types.Image) -> bytes | None:
    path = bpy.path.abspath(image.filepath, library=image.library)
    if image.source != "FILE" or not os.path.isfile(path):
        return None
    with open(path, "rb") as file:
        return file.read()
