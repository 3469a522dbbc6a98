"""What ambient_occlusion.sh runs inside Blender 3.4; that says how it is called.

Bakes the ambient occlusion of a scan by Cycles and divides the texture by it, as artists do by hand: in linear light, and
as the blend mode "divide" of an image editor does it, on encoded values. A closed room is dark in ambient occlusion of
unlimited reach, so there is a bake for each of several reaches, and who compares may take the best.
"""
import os
import sys
import time

import numpy

numpy.bool = bool  # Blender's importer asks for it, and numpy has it no more
import bpy  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from blender_images import float_image, pixels, save  # noqa: E402

REACHES = (0.5, 1.0, 2.0, 10.0)  # m; the last is the default of Blender
SAMPLES = 128  # xNormal's default
DARKEST = 0.05  # of occlusion that is divided by


def import_scan(path):
    """The scan's mesh object, and its texture as encoded in the file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    rooms = [o for o in bpy.data.objects if o.type == "MESH"]
    images = [i for i in bpy.data.images if i.size[0] > 0]
    if len(rooms) != 1 or len(images) != 1:
        sys.exit("the scan must be one mesh with one texture")
    images[0].colorspace_settings.name = "Non-Color"
    return rooms[0], pixels(images[0])


def prepare(room, shape, threads):
    """A scene that bakes into the image that is returned."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.world = bpy.data.worlds.new("world")
    target = float_image("occlusion", shape[1], shape[0])
    matte = bpy.data.materials.new("matte")  # that of an unlit scan lets shadow rays through
    matte.use_nodes = True
    node = matte.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = target
    matte.node_tree.nodes.active = node
    room.data.materials.clear()
    room.data.materials.append(matte)
    bpy.context.view_layer.objects.active = room
    room.select_set(True)
    return target


def decoded(srgb):
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def main(scan, folder, threads):
    room, texture = import_scan(scan)
    target = prepare(room, texture.shape, int(threads))
    with open(f"{folder}/divided", "w") as table:
        for reach in REACHES:
            bpy.context.scene.world.light_settings.distance = reach
            start = time.time()
            bpy.ops.object.bake(type="AO", margin=0)
            seconds = time.time() - start
            occlusion = numpy.maximum(pixels(target)[..., :1], DARKEST)
            for how, albedo in (
                ("linear", decoded(texture) / occlusion),
                ("encoded", decoded(numpy.minimum(texture / occlusion, 1))),
            ):
                path = f"{folder}/{how}_{reach}.exr"
                save(albedo, path)
                print(path, f"AO of {reach} m, divided {how}", f"{seconds:.1f}", sep="\t", file=table)


main(*sys.argv[sys.argv.index("--") + 1 :])
