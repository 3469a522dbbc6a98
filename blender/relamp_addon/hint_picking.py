"""Operators that take hints from selected faces, or from a click into the 3D view."""

import bpy
from bpy_extras import view3d_utils

from . import hints
from .errors import Refusal


class RELAMP_OT_hint(bpy.types.Operator):
    bl_idname = "relamp.hint"
    bl_label = "Tell relamp"
    bl_description = "In Edit Mode of the selected faces, in Object Mode of the place clicked next"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(name="What", items=hints.ITEMS)

    @classmethod
    def description(cls, _context: bpy.types.Context, properties) -> str:
        about = next(about for kind, _, about in hints.ITEMS if kind == properties.kind)
        return (f"{about}. In Edit Mode of the selected faces, in Object Mode of what is clicked "
                "next")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Of the selected faces."""
        picked = hints.selected_faces(context)
        if not picked:
            self.report({"ERROR"}, "no face is selected; select one in Edit Mode, or call this in "
                                   "Object Mode and click into the scan")
            return {"CANCELLED"}
        return self._add(context, picked)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if context.mode == "EDIT_MESH":
            return self.execute(context)
        if context.area is None or context.area.type != "VIEW_3D":
            self.report({"ERROR"}, "a place is picked in a 3D view; call this from its sidebar")
            return {"CANCELLED"}
        self.picked = []
        context.window_manager.modal_handler_add(self)
        self._ask(context)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {"ESC", "RIGHTMOUSE"}:
            return self._end(context, {"CANCELLED"})
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}
        hit = _under(context, event)
        if not hit:
            self.report({"WARNING"}, "there is no surface; click into the scan, or Esc")
            return {"RUNNING_MODAL"}
        self.picked.append(hit)
        if self.kind == "SAME" and len(self.picked) < 2:
            self._ask(context)
            return {"RUNNING_MODAL"}
        return self._end(context, self._add(context, self.picked))

    def _add(self, context: bpy.types.Context, picked: list) -> set[str]:
        try:
            hints.add(context.scene, self.kind, picked)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        return {"FINISHED"}

    def _ask(self, context: bpy.types.Context) -> None:
        name = next(name for kind, name, _ in hints.ITEMS if kind == self.kind)
        which = ", the second place" if self.picked else ""
        context.workspace.status_text_set(f"{name}{which}: click the surface     Esc: cancel")

    def _end(self, context: bpy.types.Context, with_what: set[str]) -> set[str]:
        context.workspace.status_text_set(None)
        return with_what


class RELAMP_OT_forget_hint(bpy.types.Operator):
    bl_idname = "relamp.forget_hint"
    bl_label = "Forget"
    bl_description = "Forget this hint"
    bl_options = {"REGISTER", "UNDO"}

    index: bpy.props.IntProperty()

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.scene.relamp.hints.remove(self.index)
        return {"FINISHED"}


CLASSES = (RELAMP_OT_hint, RELAMP_OT_forget_hint)


def _under(context: bpy.types.Context, event: bpy.types.Event):
    """The object under the mouse and the place on it, in its own space; None for none."""
    region = next(one for one in context.area.regions if one.type == "WINDOW")
    at = (event.mouse_x - region.x, event.mouse_y - region.y)
    if not (0 <= at[0] < region.width and 0 <= at[1] < region.height):
        return None
    view = context.area.spaces.active.region_3d
    origin = view3d_utils.region_2d_to_origin_3d(region, view, at)
    towards = view3d_utils.region_2d_to_vector_3d(region, view, at)
    hit, place, _, _, thing, _ = context.scene.ray_cast(
        context.evaluated_depsgraph_get(), origin, towards)
    if not hit or thing.type != "MESH":
        return None
    thing = thing.original
    return thing, thing.matrix_world.inverted() @ place
