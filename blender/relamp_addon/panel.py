"""The panel in the 3D view's sidebar."""

from __future__ import annotations

import textwrap

import bpy

from . import hints, state
from .delight import RELAMP_OT_delight

COLUMNS = 44  # of a sentence in the sidebar


class _Panel(bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "relamp"


class RELAMP_PT_delight(_Panel):
    bl_label = "relamp"

    def draw(self, context: bpy.types.Context) -> None:
        layout, job = self.layout, RELAMP_OT_delight.job
        settings = context.scene.relamp
        if job:
            layout.label(text=f"{100 * job.run.fraction:.0f} %, {job.run.stage}", icon="TIME")
            layout.operator("relamp.cancel", icon="X")
            return
        layout.prop(settings, "quality")
        layout.prop(settings, "sun")
        layout.prop(settings, "allow_overlap")
        layout.operator("relamp.delight", icon="LIGHT")


class RELAMP_PT_hints(_Panel):
    bl_label = "Tell relamp"
    bl_parent_id = "RELAMP_PT_delight"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        grid = self.layout.grid_flow(columns=2, align=True)
        for kind, name, _ in hints.ITEMS:
            grid.operator("relamp.hint", text=name).kind = kind
        column = self.layout.column(align=True)
        for index, hint in enumerate(context.scene.relamp.hints):
            row = column.row()
            name = hint.thing.name if hint.thing else "(gone)"
            x, y, z = hint.place
            kind = next(name for kind, name, _ in hints.ITEMS if kind == hint.kind)
            row.label(text=f"{kind}: {name} at {x:.2f}, {y:.2f}, {z:.2f}")
            row.operator("relamp.forget_hint", text="", icon="X").index = index


class RELAMP_PT_room(_Panel):
    bl_label = "Room"
    bl_parent_id = "RELAMP_PT_delight"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return state.room_of(context.object) is not None

    def draw(self, context: bpy.types.Context) -> None:
        layout, room = self.layout, state.room_of(context.object)
        own = room.relamp
        layout.label(text=own.summary)
        column = layout.column(align=True)
        for mode, _, _ in state.MODES:
            if mode != "BAKED" or own.is_baked:
                column.prop_enum(own, "mode", mode)
        if context.scene.view_settings.view_transform != "Standard":
            _sentence(layout, f"Colours are shown by {context.scene.view_settings.view_transform}, "
                              "which is flatter than the scan; Standard shows them as they are.")
            layout.operator("relamp.standard_view")
        column = layout.column(align=True)
        column.prop(context.scene.relamp, "bake_samples")
        column.operator("relamp.bake", icon="RENDER_STILL")
        for warning in own.warnings.splitlines():
            _sentence(layout, warning, "ERROR")
        layout.operator("relamp.remove", icon="LOOP_BACK")


class RELAMP_OT_standard_view(bpy.types.Operator):
    bl_idname = "relamp.standard_view"
    bl_label = "Show by Standard"
    bl_description = "Set the scene's view transform to Standard, without exposure or look"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        view = context.scene.view_settings
        view.view_transform, view.look, view.exposure, view.gamma = "Standard", "None", 0, 1
        return {"FINISHED"}


CLASSES = (RELAMP_PT_delight, RELAMP_PT_hints, RELAMP_PT_room, RELAMP_OT_standard_view)


def _sentence(layout: bpy.types.UILayout, text: str, icon: str = "NONE") -> None:
    """A sentence in lines, for a label is cut off where the sidebar ends."""
    column = layout.column(align=True)
    for index, line in enumerate(textwrap.wrap(text, COLUMNS)):
        column.label(text=line, icon=icon if index == 0 else "BLANK1" if icon != "NONE" else "NONE")
