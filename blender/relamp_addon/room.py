"""Brings a result of relamp into Blender: materials, lights, world, in a collection."""

from __future__ import annotations

import bpy
import numpy

from . import confidence, faces, lamps, materials, outside, places, state, switch
from .result import Result
from .scan_file import ScanFile, uv_layer_of
from .textures import texture_of


def build(context: bpy.types.Context, scan: ScanFile, result: Result,
          name: str) -> bpy.types.Collection:
    """Everything is made first, and the scan's objects are touched last."""
    unit = places.metres_per_unit(context.scene)
    room = bpy.data.collections.new(f"relamp {name}")
    own = room.relamp
    own.is_room = True
    own.switch = materials.new_switch(f"relamp {name}")
    own.world = outside.new_world(f"relamp {name}", result)
    pages = _Pages(scan, result, name, own.switch)
    samples = []
    for thing in scan.objects():
        samples += _dress(thing, own, pages)

    own.lamps = _collection(room, f"{name} lamps", lamps.new_lights(result, samples, unit))
    beyond = outside.new_panes(result, unit)
    if result.lights.get("sun"):
        beyond.append(lamps.new_sun(result.lights["sun"]))
    own.outside = _collection(room, f"{name} outside", beyond)
    own.summary = _summary(result)
    own.warnings = "\n".join(result.report.get("warnings", []))
    context.scene.collection.children.link(room)
    switch.show(room)
    return room


class _Pages:
    """Materials, made once for each of the scan's and each UV map that it is seen by."""

    def __init__(self, scan: ScanFile, result: Result, name: str, tree: bpy.types.NodeTree):
        self.scan, self.tree = scan, tree
        palette = materials.new_palette(f"{name} lamps", result)
        self.pages = {image.name_full: materials.load_page(result, scan.page_name(image),
                                                           image.name, palette)
                      for image in list(bpy.data.images) if image.name_full in scan.images}
        self.made: dict[tuple, bpy.types.Material] = {}

    def page(self, material: bpy.types.Material) -> materials.PageImages:
        return self.pages[texture_of(material).image.name_full]

    def material(self, scanned: bpy.types.Material, uv_layer: str,
                 of_lamps: bool) -> bpy.types.Material:
        key = (scanned.name_full, uv_layer, of_lamps)
        if key not in self.made:
            name = f"{scanned.name} {'lamps' if of_lamps else 'albedo'}"
            self.made[key] = materials.new_material(name, self.page(scanned), uv_layer, self.tree,
                                                    of_lamps)
            self.made[key].relamp.scanned = scanned
        return self.made[key]


def _dress(thing: bpy.types.Object, own: state.Room, pages: _Pages) -> list[faces.Samples]:
    """Gives an object a slot more for each, for its lamps' faces, and notes what was in them."""
    part = own.parts.add()
    part.thing = thing
    mesh = thing.data
    count = len(thing.material_slots)
    of_face = numpy.empty(len(mesh.polygons), numpy.int32)
    mesh.polygons.foreach_get("material_index", of_face)
    of_face = numpy.minimum(of_face, count - 1)
    scanned = [slot.material for slot in thing.material_slots]
    delit, samples, second = [], [], []
    for index, material in enumerate(scanned):
        if material is None or not (of_face == index).any():
            delit.append(None)
            continue
        page = pages.page(material)
        layer = uv_layer_of(mesh, thing, texture_of(material).uv_layer)
        delit.append(pages.material(material, layer.name, False))
        chosen = faces.faces_of_lamps(mesh, layer, page.lamp_numbers) & (of_face == index)
        if chosen.any():
            samples.append(faces.samples_of_lamps(thing, layer, page.lamp_numbers, chosen))
            second.append((material, pages.material(material, layer.name, True)))
            of_face[chosen] = count + len(second) - 1
        confidence.to_attribute(mesh, layer, page, chosen | (of_face == index))
    for material, _ in second:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", of_face)
    mesh.update()
    for index, (material, made) in enumerate([*zip(scanned, delit), *second]):
        slot = part.slots.add()
        slot.scanned, slot.of_lamps = material, index >= count
        if made:
            slot.delit = made
    return samples


def _collection(parent: bpy.types.Collection, name: str,
                things: list[bpy.types.Object]) -> bpy.types.Collection:
    collection = bpy.data.collections.new(name)
    parent.children.link(collection)
    for thing in things:
        collection.objects.link(thing)
    return collection


def _summary(result: Result) -> str:
    return f"lamps and windows found: {len(result.lamps) or 'none'}"


def remove(room: bpy.types.Collection) -> None:
    """Gives the scan back as it was, and takes away all that `build` made."""
    own = room.relamp
    own.mode = "SCANNED"  # puts the scan's materials and the world back
    made = state.materials_of(room)
    for part in own.parts:
        if part.thing:
            _undress(part)
    images = {image for material in made for node in material.node_tree.nodes
              if node.type == "TEX_IMAGE" and (image := node.image)}
    images |= {image for material in made
               for image in (material.relamp.confidence, material.relamp.baked) if image}
    for thing in list(room.all_objects):
        data = thing.data
        bpy.data.objects.remove(thing)
        things = bpy.data.lights if isinstance(data, bpy.types.Light) else bpy.data.meshes
        if data.users == 0:
            for material in list(getattr(data, "materials", [])):
                bpy.data.materials.remove(material)
            things.remove(data)
    for material in made:
        bpy.data.materials.remove(material)
    for image in images:
        bpy.data.images.remove(image)
    world, tree = own.world, own.switch
    for child in list(room.children):
        bpy.data.collections.remove(child)
    bpy.data.collections.remove(room)
    if world:
        bpy.data.worlds.remove(world)
    if tree:
        bpy.data.node_groups.remove(tree)


def _undress(part: state.Part) -> None:
    mesh = part.thing.data
    first = {}
    for index, slot in enumerate(part.slots):
        if slot.scanned:
            first.setdefault(slot.scanned.name_full, index)
    of_face = numpy.empty(len(mesh.polygons), numpy.int32)
    mesh.polygons.foreach_get("material_index", of_face)
    for index in reversed(range(len(part.slots))):
        slot = part.slots[index]
        if slot.of_lamps and index < len(mesh.materials):
            of_face[of_face == index] = first.get(slot.scanned.name_full, 0) if slot.scanned else 0
            mesh.materials.pop(index=index)
    mesh.polygons.foreach_set("material_index", of_face)
    if confidence.NAME in mesh.color_attributes:
        mesh.color_attributes.remove(mesh.color_attributes[confidence.NAME])
    mesh.update()
