"""Shows a room as one of state.MODES says: one switch, so that no light shines twice."""

from __future__ import annotations

import bpy

from . import materials, state

RELIT = ("LAMPS", "SURFACES")


def show(room: bpy.types.Collection) -> None:
    own = room.relamp
    mode = own.mode
    _set_numbers(own.switch, mode)
    for part in own.parts:
        if part.thing:
            _dress(part, mode)
    for material in state.materials_of(room):
        _prepare(material, mode)
    _switch(own.lamps, mode == "LAMPS")
    _switch(own.outside, mode in RELIT)
    _set_worlds(room)


def _set_numbers(tree: bpy.types.NodeTree, mode: str) -> None:
    value = {name: tree.nodes[name].outputs[0] for name in
             (materials.FLAT, materials.SHINE, materials.SURFACES)}
    value[materials.FLAT].default_value = mode not in RELIT
    value[materials.SHINE].default_value = mode in RELIT
    value[materials.SURFACES].default_value = mode == "SURFACES"


def _dress(part: state.Part, mode: str) -> None:
    for slot, own in zip(part.thing.material_slots, part.slots):
        slot.material = own.scanned if mode == "SCANNED" or not own.delit else own.delit


def _prepare(material: bpy.types.Material, mode: str) -> None:
    own = material.relamp
    picture = {"CONFIDENCE": own.confidence, "BAKED": own.baked}.get(mode) or own.albedo
    material.node_tree.nodes[materials.SHOWN].image = picture
    materials.lights_by_surface(material, own.is_of_lamps and mode == "SURFACES")


def _switch(collection: bpy.types.Collection | None, on: bool) -> None:
    if collection:
        collection.hide_viewport = collection.hide_render = not on


def _set_worlds(room: bpy.types.Collection) -> None:
    """A scene has one world: that of the room that is relit, else what it was before."""
    own = room.relamp
    for scene in bpy.data.scenes:
        if room not in scene.collection.children_recursive:
            continue
        if own.mode in RELIT:
            if scene.world != own.world:
                if not any(scene.world == one.relamp.world for one in state.rooms()):
                    own.world_before = scene.world
                scene.world = own.world
        elif scene.world == own.world:
            scene.world = own.world_before
