"""What gltf_imports.sh runs inside Blender 3.4, with arguments GLB CAMERA.json PICTURE.png SAMPLES.

Imports a GLB as the menu does, with Blender's own defaults, and renders it from where a relamp camera file looks. What is
changed is what a picture needs, and nothing of its light: Cycles for Eevee, which needs a screen; no denoiser, which
Debian's has not; and neither cube nor lamp nor camera of the start-up file, that stand where the room is.
"""

import json
import math
import sys

import numpy

numpy.bool = bool  # Blender 3.4 asks for it, and Debian's numpy has it no more
import bpy
from mathutils import Vector


def blender_from_gltf(v):
    return Vector((v[0], -v[2], v[1]))


glb, camera_file, picture, samples = sys.argv[sys.argv.index("--") + 1:]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
bpy.ops.import_scene.gltf(filepath=glb)

with open(camera_file) as file:
    view = json.load(file)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = blender_from_gltf(view["position"])
towards = blender_from_gltf(view["target"]) - camera.location
camera.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
camera.data.angle = math.radians(view["fieldOfView"])
camera.data.clip_start = 0.01
bpy.context.collection.objects.link(camera)

scene = bpy.context.scene
scene.camera = camera
scene.render.engine = "CYCLES"
scene.cycles.use_denoising = False
scene.cycles.samples = int(samples)
scene.render.resolution_x, scene.render.resolution_y = 400, 225
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
