"""What is said before a run, kept with the scene."""

import bpy

from . import hints

QUALITIES = (
    ("draft", "Draft", "For a first look; a small lamp may be missed"),
    ("standard", "Standard", "As relamp does without being told"),
    ("high", "High", "Four times the rays"),
)


class SceneSettings(bpy.types.PropertyGroup):
    quality: bpy.props.EnumProperty(name="Quality", items=QUALITIES, default="standard")
    sun: bpy.props.BoolProperty(name="Look for the Sun", default=True)
    allow_overlap: bpy.props.BoolProperty(
        name="Allow Overlap",
        description="Go on where many texels of the scan stand for several places")
    hints: bpy.props.CollectionProperty(type=hints.Hint)
    bake_samples: bpy.props.IntProperty(
        name="Samples", default=64, min=1, max=65536, description="Paths from every texel")
