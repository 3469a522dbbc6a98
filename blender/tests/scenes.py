"""The sample in Blender, and pictures of it."""

from __future__ import annotations

import json
import math
import os

import bpy
import numpy
from mathutils import Vector
from relamp_addon import state

SAMPLE = os.environ["RELAMP_SAMPLES"] + "/bedroom"


def import_sample() -> bpy.types.Object:
    """An empty file with the sample's scan, which is selected and active."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="relamp_addon")
    bpy.ops.import_scene.gltf(filepath=f"{SAMPLE}/scan.glb")
    return bpy.context.object


def delight(quality: str = "draft") -> bpy.types.Collection:
    """Takes the light out of what is selected."""
    bpy.context.scene.relamp.quality = quality
    bpy.context.preferences.addons["relamp_addon"].preferences.threads = 1
    assert bpy.ops.relamp.delight() == {"FINISHED"}
    return state.rooms()[0]


def refusal_of(operator, *arguments, **keywords) -> str:
    """The sentence with which an operator refuses, "" where it does not."""
    try:
        operator(*arguments, **keywords)
    except RuntimeError as error:
        return str(error).removeprefix("Error: ").strip()
    return ""


def lights(room: bpy.types.Collection) -> dict[str, bpy.types.Object]:
    bpy.context.view_layer.update()
    return {thing.name: thing for thing in room.relamp.lamps.objects}


def look_by(file: str, width: int, height: int) -> None:
    """A camera as one of relamp's camera files says."""
    with open(file, encoding="utf-8") as content:
        view = json.load(content)

    def place(name: str) -> Vector:
        x, y, z = view[name]
        return Vector((x, -z, y))

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = place("position")
    camera.rotation_euler = (place("target") - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.angle = math.radians(view["fieldOfView"])
    camera.data.clip_start = 0.01
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = width, height


def render(samples: int, folder: str) -> numpy.ndarray:
    """Radiance by Cycles and opacity, (height, width, 4), rows from below."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False  # Debian's has none
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 12
    scene.cycles.sample_clamp_indirect = 0  # which takes light away
    scene.render.film_transparent = True
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = os.path.join(folder, "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    values = pixels(image)
    bpy.data.images.remove(image)
    return values


def pixels(image: bpy.types.Image) -> numpy.ndarray:
    values = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], -1)


def srgb(radiance: numpy.ndarray) -> numpy.ndarray:
    """As a screen shows it by the view transform Standard, 0 to 1."""
    light = numpy.clip(radiance, 0, 1)
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
