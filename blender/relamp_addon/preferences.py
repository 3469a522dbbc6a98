"""What is set once for all files: where relamp is."""

import bpy

from . import program
from .errors import Refusal


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH",
        description="The program relamp; empty: the one on PATH")
    threads: bpy.props.IntProperty(
        name="Threads", min=0, max=1024,
        description="That relamp works with; 0 is one a core")

    def draw(self, _context: bpy.types.Context) -> None:
        column = self.layout.column()
        column.prop(self, "program")
        column.prop(self, "threads")
        try:
            column.label(text=f"relamp is {program.find_program(self.program)}", icon="CHECKMARK")
        except Refusal as refusal:
            column.label(text=str(refusal), icon="ERROR")


def current(context: bpy.types.Context) -> Preferences | None:
    """None where the package runs without being enabled as an add-on."""
    addon = context.preferences.addons.get(__package__)
    return addon.preferences if addon else None
