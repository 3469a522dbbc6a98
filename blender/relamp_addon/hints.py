"""What a person tells relamp about the scan: places, picked on its faces."""

import bpy
import numpy
from mathutils import Vector

from . import places
from .errors import Refusal

# Identifier, name, what that says; then the option of relamp delight.
KINDS = (
    ("LAMP", "This is a lamp", "What is burnt out here shines", "--light"),
    ("NO_LAMP", "This is no lamp", "What is burnt out here is only much lit", "--not-a-light"),
    ("SAME", "Same paint", "The surfaces at these two places are of one paint", "--same"),
    ("WHITE", "This is white", "This surface is as white as paper", "--white"),
)
OPTIONS = {kind: option for kind, _, _, option in KINDS}
ITEMS = [(kind, name, about) for kind, name, about, _ in KINDS]


class Hint(bpy.types.PropertyGroup):
    kind: bpy.props.EnumProperty(items=ITEMS)
    thing: bpy.props.PointerProperty(type=bpy.types.Object)
    place: bpy.props.FloatVectorProperty(subtype="XYZ")  # in the object's own space
    other: bpy.props.PointerProperty(type=bpy.types.Object)  # of SAME
    other_place: bpy.props.FloatVectorProperty(subtype="XYZ")


def options(scene: bpy.types.Scene, objects: list[bpy.types.Object]) -> list[str]:
    """The hints about these objects, as relamp delight wants them."""
    words = []
    for hint in scene.relamp.hints:
        if hint.thing not in objects or (hint.kind == "SAME" and hint.other not in objects):
            continue
        told = _told(scene, hint.thing, hint.place)
        if hint.kind == "SAME":
            told += ":" + _told(scene, hint.other, hint.other_place)
        words.append(f"{OPTIONS[hint.kind]}={told}")
    return words


def add(scene: bpy.types.Scene, kind: str,
        picked: list[tuple[bpy.types.Object, Vector]]) -> None:
    """`picked`: objects with a place in their own space; two of SAME, else one or more."""
    if kind == "SAME" and len(picked) != 2:
        raise Refusal("the same paint is said of two places; select two faces")
    for thing, place in picked[:1] if kind == "SAME" else picked:
        hint = scene.relamp.hints.add()
        hint.kind, hint.thing, hint.place = kind, thing, place
        if kind == "SAME":
            hint.other, hint.other_place = picked[1]


def selected_faces(context: bpy.types.Context) -> list[tuple[bpy.types.Object, Vector]]:
    """Middles of the selected faces of the meshes in Edit Mode, or else selected there last."""
    picked = []
    for thing in context.selected_objects:
        if thing.type == "MESH":
            thing.update_from_editmode()
            picked += [(thing, face.center.copy()) for face in thing.data.polygons if face.select]
    return picked


def _told(scene: bpy.types.Scene, thing: bpy.types.Object, place) -> str:
    world = numpy.array([thing.matrix_world @ Vector(place)])
    x, y, z = places.to_relamp(world)[0] * places.metres_per_unit(scene)
    return f"{x:.6f},{y:.6f},{z:.6f}"
