"""Bakes the light that is in the scene into a texture."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

import bpy

from . import state, switch
from .errors import Refusal
from .materials import SHOWN


class RELAMP_OT_bake(bpy.types.Operator):
    bl_idname = "relamp.bake"
    bl_label = "Bake"
    bl_description = ("Bake the light of this scene, the room's lamps and your own, into a new "
                      "texture of the scan by Cycles")
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.mode == "OBJECT" and state.room_of(context.object) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        room = state.room_of(context.object)
        try:
            bake(context, room, context.scene.relamp.bake_samples)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = (RELAMP_OT_bake,)


def bake(context: bpy.types.Context, room: bpy.types.Collection, samples: int) -> None:
    """Light as `room` is shown, by its lamps or its surfaces; by lamps where it is shown flat."""
    if not hasattr(context.scene, "cycles"):
        raise Refusal("Cycles is switched off; tick Cycles Render Engine in Edit > Preferences > "
                      "Add-ons")
    own = room.relamp
    things = [part.thing for part in own.parts if part.thing]
    for thing in things:
        if not thing.visible_get():
            raise Refusal(f'"{thing.name}" is hidden, and Cycles bakes what is seen; show it')
    if own.mode not in switch.RELIT:
        own.mode = "LAMPS"
    made = state.materials_of(room)
    for former in {material.relamp.baked for material in made if material.relamp.baked}:
        bpy.data.images.remove(former)
    images = {}
    for material in made:
        albedo = material.relamp.albedo
        if albedo.name not in images:
            images[albedo.name] = _new_image(albedo)
        material.relamp.baked = images[albedo.name]
    with (_targets(made), _no_other_material(own, made[0]), _cycles(context.scene, samples),
          _selection(context, things)):
        try:
            bpy.ops.object.bake(type="COMBINED", pass_filter={"DIRECT", "INDIRECT", "DIFFUSE",
                                                              "EMIT"},
                                margin=8, use_clear=True)
        except RuntimeError as error:
            raise Refusal(f"Cycles did not bake: {error}") from error
    for image in images.values():
        image.pack()
    own.is_baked = True
    own.mode = "BAKED"


def _new_image(albedo: bpy.types.Image) -> bpy.types.Image:
    name = albedo.name.replace(" albedo", "") + " baked"
    image = bpy.data.images.new(name, *albedo.size, alpha=False, float_buffer=True)
    image.colorspace_settings.name = "Linear" if bpy.app.version < (4, 0) else "Linear Rec.709"
    return image


@contextlib.contextmanager
def _targets(made: list[bpy.types.Material]) -> Iterator[None]:
    """Cycles bakes into the picture of the active node."""
    nodes = []
    for material in made:
        tree = material.node_tree
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = material.relamp.baked
        tree.nodes.active = node
        nodes.append((tree, node))
    try:
        yield
    finally:
        for tree, node in nodes:
            tree.nodes.remove(node)
            tree.nodes.active = tree.nodes[SHOWN]


@contextlib.contextmanager
def _no_other_material(own: state.Room, made: bpy.types.Material) -> Iterator[None]:
    """In a slot that no face has, the scan's material stays; its texture would be baked over."""
    slots = [slot for part in own.parts if part.thing
             for slot, noted in zip(part.thing.material_slots, part.slots) if not noted.delit]
    before = [slot.material for slot in slots]
    for slot in slots:
        slot.material = made
    try:
        yield
    finally:
        for slot, material in zip(slots, before):
            slot.material = material


@contextlib.contextmanager
def _cycles(scene: bpy.types.Scene, samples: int) -> Iterator[None]:
    engine = scene.render.engine
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    wanted = {"samples": samples, "use_denoising": False, "use_adaptive_sampling": False}
    before = {name: getattr(cycles, name) for name in wanted}
    for name, value in wanted.items():
        setattr(cycles, name, value)
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(cycles, name, value)
        scene.render.engine = engine


@contextlib.contextmanager
def _selection(context: bpy.types.Context, things: list[bpy.types.Object]) -> Iterator[None]:
    active, selected = context.view_layer.objects.active, list(context.selected_objects)
    for thing in selected:
        thing.select_set(False)
    for thing in things:
        thing.select_set(True)
    context.view_layer.objects.active = things[0]
    try:
        yield
    finally:
        for thing in things:
            thing.select_set(False)
        for thing in selected:
            thing.select_set(True)
        context.view_layer.objects.active = active
