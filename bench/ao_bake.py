"""What ao_division.py runs inside Blender 3.4: bakes ambient occlusion of a scan into its own texture's layout.

    blender -b --python bench/ao_bake.py -- SCAN.glb OUT.exr WIDTH HEIGHT SAMPLES
"""
import sys
import time

import numpy

numpy.bool = bool  # Blender's importer asks for it, and numpy has it no more
import bpy  # noqa: E402

scan, out, width, height, samples = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=scan)
scene = bpy.context.scene
scene.world = bpy.data.worlds.new("world")  # whose ambient occlusion reaches 10 m, as Blender has it
image = bpy.data.images.new("occlusion", int(width), int(height), float_buffer=True, alpha=False)
image.colorspace_settings.name = "Non-Color"
for item in bpy.data.objects:
    item.select_set(item.type == "MESH")
    if item.type == "MESH":
        bpy.context.view_layer.objects.active = item
for material in bpy.data.materials:
    if not material.use_nodes:
        continue
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
scene.render.engine = "CYCLES"
scene.cycles.samples = int(samples)
scene.cycles.use_adaptive_sampling = False
begin = time.time()
bpy.ops.object.bake(type="AO", margin=4)
print(f"BAKED {time.time() - begin:.2f}")
image.filepath_raw = out
image.file_format = "OPEN_EXR"
image.save()
