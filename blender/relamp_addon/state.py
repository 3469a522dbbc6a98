"""What the add-on keeps in Blender's file: which scans were delit, and how they are shown."""

import bpy

# How the objects of a room are shown: identifier, name, what that is.
MODES = (
    ("SCANNED", "As scanned", "The scan's own materials, its lamps off"),
    ("ALBEDO", "Albedo", "The colour of every surface without any light on it"),
    ("LAMPS", "Relit by lamps", "Albedo, lit by Blender lights that stand for the lamps found"),
    ("SURFACES", "Relit by surfaces", "Albedo, lit by the surfaces of the lamps themselves"),
    ("CONFIDENCE", "Confidence", "How far the albedo can be believed: white well, black not"),
    ("BAKED", "Baked", "The light that was baked last"),
)


def _show(room: "Room", _context: bpy.types.Context) -> None:
    from . import switch  # which needs this module
    switch.show(room.id_data)


class Slot(bpy.types.PropertyGroup):
    """A material slot of a scan's object."""

    scanned: bpy.props.PointerProperty(type=bpy.types.Material)
    delit: bpy.props.PointerProperty(type=bpy.types.Material)
    of_lamps: bpy.props.BoolProperty()  # a slot that was added for the faces of lamps


class Part(bpy.types.PropertyGroup):
    """An object of the scan."""

    thing: bpy.props.PointerProperty(type=bpy.types.Object)
    slots: bpy.props.CollectionProperty(type=Slot)


class Room(bpy.types.PropertyGroup):
    """Of a collection: a scan that was delit."""

    is_room: bpy.props.BoolProperty()
    mode: bpy.props.EnumProperty(name="Show", items=MODES, default="ALBEDO", update=_show)
    parts: bpy.props.CollectionProperty(type=Part)
    switch: bpy.props.PointerProperty(type=bpy.types.NodeTree)
    lamps: bpy.props.PointerProperty(type=bpy.types.Collection)
    outside: bpy.props.PointerProperty(type=bpy.types.Collection)
    world: bpy.props.PointerProperty(type=bpy.types.World)
    world_before: bpy.props.PointerProperty(type=bpy.types.World)
    summary: bpy.props.StringProperty()
    warnings: bpy.props.StringProperty()  # a line each
    is_baked: bpy.props.BoolProperty()


class Page(bpy.types.PropertyGroup):
    """Of a material that the add-on made: the pictures of its texture."""

    albedo: bpy.props.PointerProperty(type=bpy.types.Image)
    confidence: bpy.props.PointerProperty(type=bpy.types.Image)
    baked: bpy.props.PointerProperty(type=bpy.types.Image)
    is_of_lamps: bpy.props.BoolProperty()
    scanned: bpy.props.PointerProperty(type=bpy.types.Material)  # whose place it takes


CLASSES = (Slot, Part, Room, Page)


def rooms() -> list[bpy.types.Collection]:
    return [one for one in bpy.data.collections if one.relamp.is_room]


def room_of(thing: bpy.types.Object | None) -> bpy.types.Collection | None:
    """The room that an object belongs to, as a part of the scan or as one of its lights."""
    for room in rooms():
        if thing and (thing.name in room.all_objects or
                      any(part.thing == thing for part in room.relamp.parts)):
            return room
    return None


def scanned_material(thing: bpy.types.Object, slot: int) -> bpy.types.Material | None:
    """The scan's own material in a slot, whatever is shown."""
    for room in rooms():
        for part in room.relamp.parts:
            if part.thing == thing and slot < len(part.slots):
                return part.slots[slot].scanned
    material = thing.material_slots[slot].material
    return material and (material.relamp.scanned or material)


def materials_of(room: bpy.types.Collection) -> list[bpy.types.Material]:
    """Those that the add-on made for it, each once."""
    found = {}
    for part in room.relamp.parts:
        for slot in part.slots:
            if slot.delit:
                found[slot.delit.name] = slot.delit
    return list(found.values())


def register() -> None:
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Collection.relamp = bpy.props.PointerProperty(type=Room)
    bpy.types.Material.relamp = bpy.props.PointerProperty(type=Page)


def unregister() -> None:
    del bpy.types.Material.relamp
    del bpy.types.Collection.relamp
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
