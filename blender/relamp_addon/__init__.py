"""relamp in Blender: takes the light out of a scanned room, and puts its lamps into the scene."""

import bpy

from . import bake, delight, hint_picking, hints, panel, preferences, scene_settings, state

bl_info = {
    "name": "relamp",
    "description": "Takes the light out of a scanned room: albedo, and its lamps as lights",
    "author": "relamp maintainers",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > relamp",
    "category": "Lighting",
}

CLASSES = (preferences.Preferences, hints.Hint, scene_settings.SceneSettings, *delight.CLASSES,
           *hint_picking.CLASSES, *bake.CLASSES, *panel.CLASSES)


def register() -> None:
    state.register()
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.relamp = bpy.props.PointerProperty(type=scene_settings.SceneSettings)
    bpy.types.WindowManager.relamp_cancel = bpy.props.BoolProperty(options={"SKIP_SAVE"})


def unregister() -> None:
    delight.stop()
    del bpy.types.WindowManager.relamp_cancel
    del bpy.types.Scene.relamp
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
    state.unregister()
