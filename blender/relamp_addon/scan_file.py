"""Writes objects of Blender as the scan that relamp reads: one glTF, its textures as they are.

Blender's own exporter writes no EXR, makes 8 bits of 16, and looks at a material's nodes in its own
way; so the file is written here.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field

import bpy
import numpy

from . import places
from .errors import Refusal
from .state import scanned_material
from .textures import is_linear, texture_of, write_picture

FLOAT, UNSIGNED = 5126, 5125  # glTF's numbers for types of components
ARRAY_BUFFER, ELEMENT_BUFFER = 34962, 34963


@dataclass
class ScanFile:
    """Things are known by name: what Blender hands out is void once a person has pressed undo."""

    path: str
    names: list[str]  # of the objects
    images: list[str] = field(default_factory=list)  # by name_full; image i is the page "page i"
    linear: bool = False

    def page_name(self, image: bpy.types.Image) -> str:
        return f"page {self.images.index(image.name_full)}"

    def objects(self) -> list[bpy.types.Object]:
        """Throws Refusal where one has gone meanwhile."""
        for name in self.names:
            if name not in bpy.data.objects:
                raise Refusal(f'"{name}" was removed or renamed while relamp worked on it; undo '
                              "that and begin again")
        return [bpy.data.objects[name] for name in self.names]


def scan_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """The selected meshes, and those below a selected empty, as importers make one."""
    found = []
    for thing in context.selected_objects:
        for one in [thing, *(thing.children_recursive if thing.type == "EMPTY" else [])]:
            if one.type == "MESH" and len(one.data.polygons) and one not in found:
                found.append(one)
    if not found:
        raise Refusal("no scan is selected; click its mesh in the 3D view, all of them where there "
                      "are several")
    for one in found:
        if one.library or one.data.library:
            raise Refusal(f'"{one.name}" is linked from another file, so it gets no new materials '
                          "here; Object > Relations > Make Local")
        if sum(other.data == one.data for other in found) > 1:
            raise Refusal(f'"{one.name}" shares its mesh with another selected object, so its '
                          "texture stands for two places; Object > Relations > Make Single User")
    return sorted(found, key=lambda one: one.name)


def write_scan(context: bpy.types.Context, objects: list[bpy.types.Object],
               folder: str) -> ScanFile:
    """Throws Refusal where an object has no texture or no UV map."""
    scan = ScanFile(os.path.join(folder, "scan.gltf"), [thing.name for thing in objects])
    gltf = _Gltf()
    depsgraph = context.evaluated_depsgraph_get()
    for thing in objects:
        _add_object(gltf, scan, thing, depsgraph, places.metres_per_unit(context.scene))
    images = {image.name_full: image for image in bpy.data.images}
    transfers = {is_linear(images[name]) for name in scan.images}
    if len(transfers) > 1:
        raise Refusal("some textures of the scan have the colour space sRGB and some a linear one; "
                      "delight the objects of each kind by themselves")
    scan.linear = transfers == {True}
    for index, name in enumerate(scan.images):
        file = write_picture(images[name], os.path.join(folder, f"page{index}"))
        gltf.add_image(os.path.basename(file), scan.page_name(images[name]))
    gltf.write(scan.path)
    return scan


def _add_object(gltf: "_Gltf", scan: ScanFile, thing: bpy.types.Object,
                depsgraph: bpy.types.Depsgraph, metres: float) -> None:
    if not any(slot.material for slot in thing.material_slots):
        raise Refusal(f'"{thing.name}" has no material, so no texture; give it one that shows the '
                      "scan's photo, or leave it out of the selection")
    evaluated = thing.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        corners = _Corners(mesh, thing, metres)
        slots: dict[tuple[int, str], list[int]] = {}  # by texture and UV map
        for slot in numpy.unique(corners.slot):
            material = scanned_material(thing, min(slot, len(thing.material_slots) - 1))
            if material is None:
                raise Refusal(f'faces of "{thing.name}" have no material, so no texture; give them '
                              "one that shows the scan's photo")
            texture = texture_of(material)
            if texture.image.name_full not in scan.images:
                scan.images.append(texture.image.name_full)
            page = scan.images.index(texture.image.name_full)
            slots.setdefault((page, texture.uv_layer), []).append(slot)
        for (page, uv_layer), those in slots.items():
            gltf.add_primitive(thing.name, *corners.of_slots(those, uv_layer), page)
    finally:
        evaluated.to_mesh_clear()


class _Corners:
    """The triangles of a mesh, as arrays over their corners."""

    def __init__(self, mesh: bpy.types.Mesh, thing: bpy.types.Object, metres: float):
        self.mesh, self.thing = mesh, thing
        mesh.calc_loop_triangles()
        self.loops = read(mesh.loop_triangles, "loops", 3, numpy.int32)
        self.slot = read(mesh.loop_triangles, "material_index", 1, numpy.int32).ravel()
        self.vertex = read(mesh.loops, "vertex_index", 1, numpy.int32).ravel()
        local = read(mesh.vertices, "co", 3)
        self.position = places.to_relamp(places.transformed(thing.matrix_world, local)) * metres
        by = numpy.array(thing.matrix_world)[:3, :3]
        if abs(numpy.linalg.det(by)) < 1e-12:
            raise Refusal(f'"{thing.name}" is scaled to nothing along an axis')
        if numpy.linalg.det(by) < 0:
            self.loops = self.loops[:, ::-1]  # a mirrored object keeps its outside
        normal = corner_normals(mesh) @ numpy.linalg.inv(by)
        length = numpy.linalg.norm(normal, axis=1, keepdims=True)
        self.normal = places.to_relamp(normal / numpy.maximum(length, 1e-20))

    def of_slots(self, slots: list[int], uv_layer: str) -> tuple[numpy.ndarray, ...]:
        """Positions, normals and texture coordinates of vertices, and the triangles of these."""
        loops = self.loops[numpy.isin(self.slot, slots)].ravel()
        uv = read(uv_layer_of(self.mesh, self.thing, uv_layer).data, "uv", 2)
        row = numpy.concatenate([self.vertex[:, None].view(numpy.float32), uv,
                                 self.normal.astype(numpy.float32)], axis=1)[loops]
        whole = numpy.ascontiguousarray(row).view(f"V{row.shape[1] * 4}").ravel()
        _, first, index = numpy.unique(whole, return_index=True, return_inverse=True)
        kept = loops[first]
        down = numpy.stack([uv[kept, 0], 1 - uv[kept, 1]], axis=1)  # glTF counts v from above
        return self.position[self.vertex[kept]], self.normal[kept], down, index


def uv_layer_of(mesh: bpy.types.Mesh, thing: bpy.types.Object,
                name: str) -> bpy.types.MeshUVLoopLayer:
    if not mesh.uv_layers:
        raise Refusal(f'"{thing.name}" has no UV map: relamp needs one that gives every place a '
                      "texel of its own, as the scanning program made it; import the scan with it")
    if name and name not in mesh.uv_layers:
        raise Refusal(f'"{thing.name}" has no UV map called "{name}", which its material names')
    if name:
        return mesh.uv_layers[name]
    return next((layer for layer in mesh.uv_layers if layer.active_render), mesh.uv_layers[0])


def read(collection, attribute: str, width: int, kind=numpy.float32) -> numpy.ndarray:
    """A (N, width) array of an attribute of all in a collection of Blender's."""
    values = numpy.empty(len(collection) * width, kind)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width)


def corner_normals(mesh: bpy.types.Mesh) -> numpy.ndarray:
    if hasattr(mesh, "corner_normals"):  # since 4.1
        return read(mesh.corner_normals, "vector", 3)
    mesh.calc_normals_split()
    return read(mesh.loops, "normal", 3)


class _Gltf:
    """A glTF file with its numbers beside it in scan.bin."""

    def __init__(self) -> None:
        self.binary: list[bytes] = []
        self.length = 0
        self.document = {
            "asset": {"version": "2.0", "generator": "relamp's add-on for Blender"},
            "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "accessors": [],
            "bufferViews": [], "materials": [], "textures": [], "images": [],
        }

    def add_primitive(self, name: str, position: numpy.ndarray, normal: numpy.ndarray,
                      uv: numpy.ndarray, index: numpy.ndarray, material: int) -> None:
        primitive = {
            "attributes": {"POSITION": self._add(position, "VEC3", ARRAY_BUFFER),
                           "NORMAL": self._add(normal, "VEC3", ARRAY_BUFFER),
                           "TEXCOORD_0": self._add(uv, "VEC2", ARRAY_BUFFER)},
            "indices": self._add(index, "SCALAR", ELEMENT_BUFFER),
            "material": material,
        }
        document = self.document
        document["scenes"][0]["nodes"].append(len(document["nodes"]))
        document["nodes"].append({"mesh": len(document["meshes"]), "name": name})
        document["meshes"].append({"name": name, "primitives": [primitive]})

    def add_image(self, uri: str, name: str) -> None:
        document = self.document
        index = len(document["images"])
        document["images"].append({"uri": uri, "name": name})
        document["textures"].append({"source": index})
        document["materials"].append({"pbrMetallicRoughness": {
            "baseColorTexture": {"index": index}, "metallicFactor": 0, "roughnessFactor": 1}})

    def write(self, path: str) -> None:
        self.document["buffers"] = [{"uri": "scan.bin", "byteLength": self.length}]
        with open(os.path.join(os.path.dirname(path), "scan.bin"), "wb") as file:
            file.writelines(self.binary)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.document, file)

    def _add(self, values: numpy.ndarray, kind: str, target: int) -> int:
        is_index = target == ELEMENT_BUFFER
        content = values.astype("<u4" if is_index else "<f4")
        document = self.document
        accessor = {"bufferView": len(document["bufferViews"]), "count": len(content),
                    "componentType": UNSIGNED if is_index else FLOAT, "type": kind}
        if kind == "VEC3":
            accessor["min"] = content.min(axis=0).tolist()
            accessor["max"] = content.max(axis=0).tolist()
        document["bufferViews"].append({"buffer": 0, "byteOffset": self.length,
                                        "byteLength": content.nbytes, "target": target})
        self.binary.append(content.tobytes())
        self.length += content.nbytes
        document["accessors"].append(accessor)
        return len(document["accessors"]) - 1
