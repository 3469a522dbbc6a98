"""What cycles.sh runs inside Blender 3.4; that says how it is called.

relamp finds lamps, albedo and irradiance of a scan. Cycles gets the mesh, the lamps and the albedo, and bakes the
irradiance. The reference is Cycles again, with samples beyond need, at every 64th texel: errors are measured there.
"""
import json
import os
import statistics
import subprocess
import sys
import time

import numpy

numpy.bool = bool  # Blender's importer asks for it, and numpy has it no more
import bpy  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from blender_images import fill, float_image, pixels  # noqa: E402

STRIDE = 8  # of the texels at which errors are measured, across and up
REFERENCE_SAMPLES = 4096
FIRST_SAMPLES = 64  # tell how many will be needed
SAME_ERROR = 0.05  # two errors that differ by less than this share are the same
MOST_TRIES = 5  # to find out how many samples have the same error
MOST_TIMED_SAMPLES = 256  # of a bake of all texels; what more would take follows in proportion
TIMED_RUNS = 3  # of relamp; the median counts
BESIDE = ("read", "write")  # relamp's stages that are no part of the irradiance
DARKEST = 0.08  # irradiance / pi; what gets less has no albedo to speak of, see confidence in docs/guide/results.md


def relative_rms(found, true):
    """RMS of the relative error, at most 1 a texel: albedo is radiance / shading, and no outlier decides alone."""
    return float(numpy.sqrt(numpy.mean(numpy.minimum(numpy.abs(found / true - 1), 1) ** 2)))


def plain_rms(found, true):
    """RMS error over the mean irradiance."""
    return float(numpy.sqrt(numpy.mean((found - true) ** 2)) / true.mean())


def median(found, true):
    return float(numpy.median(numpy.abs(found / true - 1)))


METRICS = {"RMS of relative error, at most 1": relative_rms, "RMS / mean": plain_rms, "median relative error": median}


def run_relamp(program, scan, folder, threads):
    """Seconds of irradiance, of the whole process, and processor seconds of the process."""
    start, before = time.time(), os.times()
    subprocess.run([program, "delight", scan, "-o", folder, "--fill", "--threads", str(threads), "-q"], check=True)
    whole, after = time.time() - start, os.times()
    with open(f"{folder}/report.json") as file:
        stages = json.load(file)["seconds"]["stages"]
    irradiance = sum(seconds for stage, seconds in stages.items() if stage not in BESIDE)
    processor = after.children_user + after.children_system - before.children_user - before.children_system
    return irradiance, whole, processor


def load(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    return pixels(image)


def import_room(path):
    """The mesh object of relamp's GLB, and which texels shine."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    for light in [o for o in bpy.data.objects if o.type == "LIGHT"]:
        bpy.data.objects.remove(light)  # points; the lamps' faces shine instead
    rooms = [o for o in bpy.data.objects if o.type == "MESH"]
    if len(rooms) != 1 or len(rooms[0].data.materials) != 1:
        sys.exit("the scan must be one mesh of one material")
    for node in rooms[0].data.materials[0].node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED" and node.inputs["Emission"].links:
            return rooms[0], pixels(node.inputs["Emission"].links[0].from_node.image).max(axis=2) > 0
    sys.exit("relamp found no lamp in the scan")


def triangles(room):
    """Corners in the world, and on the page."""
    mesh = room.data
    count = len(mesh.polygons)
    uv = numpy.empty(6 * count, numpy.float32)
    mesh.uv_layers[0].data.foreach_get("uv", uv)
    vertex = numpy.empty(3 * count, numpy.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    position = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", position)
    world = numpy.array(room.matrix_world)
    position = position.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    return position[vertex].reshape(count, 3, 3), uv.reshape(count, 3, 2)


def lamp_of_faces(corners, uv, shines, fixtures):
    """0 for a wall, else 1 + fixture: the nearest by its size, for faces of which more than half shines."""
    height, width = shines.shape
    share = numpy.zeros(len(uv))
    grid = [(i + 1 / 3, j + 1 / 3) for i in range(6) for j in range(6 - i)]
    for i, j in grid:
        place = uv.transpose(0, 2, 1) @ (numpy.array([i, j, 20 / 3 - 2 / 3 - i - j]) / 6)
        column = numpy.clip((place[:, 0] * width).astype(int), 0, width - 1)
        row = numpy.clip((place[:, 1] * height).astype(int), 0, height - 1)
        share += shines[row, column] / len(grid)
    centres = numpy.array([[x, -z, y] for x, y, z in (f["centre"] for f in fixtures)])  # Blender has Z up
    sizes = numpy.sqrt([f["area"] for f in fixtures])
    distance = numpy.linalg.norm(corners.mean(axis=1)[:, None] - centres, axis=2) / sizes
    return numpy.where(share > 0.5, 1 + distance.argmin(axis=1), 0)


def new_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, material.node_tree.nodes, material.node_tree.links


def wall_material(albedo, uv_name):
    material, nodes, links = new_material("wall")
    height, width = albedo.shape[:2]
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = float_image("albedo", width, height)
    texture.interpolation = "Closest"
    fill(texture.image, numpy.clip(albedo, 0.02, 0.95))
    uv = nodes.new("ShaderNodeUVMap")
    uv.uv_map = uv_name
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    links.new(uv.outputs[0], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], diffuse.inputs["Color"])
    links.new(diffuse.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def lamp_material(radiance):
    """Shines to the front alone and does not reflect, as relamp's lamps."""
    material, nodes, links = new_material("lamp")
    strength = nodes.new("ShaderNodeMath")
    strength.operation = "MULTIPLY_ADD"  # radiance - radiance * backfacing
    strength.inputs[1].default_value = -radiance.max()
    strength.inputs[2].default_value = radiance.max()
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (*radiance / radiance.max(), 1)
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], strength.inputs[0])
    links.new(strength.outputs[0], emission.inputs["Strength"])
    links.new(emission.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def dress(room, shines, lights, albedo):
    """Gives the room its walls and lamps; a lamp's faces send the power that relamp's lamp sends."""
    corners, uv = triangles(room)
    fixtures = lights["fixtures"]
    lamp = lamp_of_faces(corners, uv, shines, fixtures)
    a, b, c = corners.transpose(1, 0, 2)
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
    mesh = room.data
    mesh.materials.clear()
    mesh.materials.append(wall_material(albedo, mesh.uv_layers[0].name))
    for index, fixture in enumerate(fixtures, 1):
        own = area[lamp == index].sum()
        print("lamp", index, "area", fixture["area"], "of its faces", own)
        if own == 0:
            sys.exit(f"lamp {index} of lights.json has no face of its own")
        mesh.materials.append(lamp_material(numpy.array(fixture["radiance"]) * fixture["area"] / own))
    mesh.polygons.foreach_set("material_index", lamp.astype(numpy.int32))
    world = bpy.data.worlds.new("ambient")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*lights["ambient"], 1)
    world.cycles.sampling_method = "NONE"
    bpy.context.scene.world = world


class Baker:
    """Bakes irradiance / pi by Cycles, of all texels or of those at which errors are measured."""

    def __init__(self, room, width, height, threads):
        scene = bpy.context.scene
        scene.render.engine = "CYCLES"
        scene.render.threads_mode = "FIXED"
        scene.render.threads = threads
        self.cycles = scene.cycles
        self.cycles.device = "CPU"
        self.cycles.use_adaptive_sampling = False
        self.cycles.use_denoising = False
        self.cycles.max_bounces = self.cycles.diffuse_bounces = 12
        self.cycles.sample_clamp_direct = self.cycles.sample_clamp_indirect = 0
        self.room = room
        self.layers = room.data.uv_layers
        self.page = self.layers[0].name
        self.some = self.layers.new(name="some").name
        uv = numpy.empty(2 * len(room.data.loops), numpy.float32)
        self.layers[self.page].data.foreach_get("uv", uv)
        # Half a texel up, and the middle of a pixel of STRIDE texels is the middle of a texel.
        self.layers[self.some].data.foreach_set("uv", (uv.reshape(-1, 2) + 0.5 / numpy.array([width, height])).ravel())
        self.targets = {
            self.page: float_image("all texels", width, height),
            self.some: float_image("some texels", width // STRIDE, height // STRIDE),
        }
        bpy.context.view_layer.objects.active = room
        room.select_set(True)
        self.seed = 0

    def bake(self, layer, samples):
        """Irradiance / pi; seconds; processor seconds. Every bake has random numbers of its own."""
        for material in self.room.data.materials:
            nodes = material.node_tree.nodes
            node = nodes.get("target") or nodes.new("ShaderNodeTexImage")
            node.name = "target"
            node.image = self.targets[layer]
            nodes.active = node
        self.layers.active = self.layers[layer]
        self.seed += 1
        self.cycles.seed = self.seed
        self.cycles.samples = samples
        start, before = time.time(), os.times()
        bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=0, uv_layer=layer)
        seconds, after = time.time() - start, os.times()
        processor = after.user + after.system - before.user - before.system
        print("baked", layer, samples, "samples", seconds, "s", flush=True)
        return pixels(self.targets[layer]), seconds, processor


def picked(layer):
    return layer[STRIDE // 2 - 1 :: STRIDE, STRIDE // 2 - 1 :: STRIDE]


def samples_of_same_error(bake_error, goal):
    """How many samples Cycles needs, and the error that it has then; noise falls with their square root."""
    samples = FIRST_SAMPLES
    for _ in range(MOST_TRIES):
        error = bake_error(samples)
        if abs(error / goal - 1) < SAME_ERROR or (error > goal and samples == REFERENCE_SAMPLES):
            break
        tried, samples = samples, min(max(1, round(samples * (error / goal) ** 2)), REFERENCE_SAMPLES)
    else:
        samples = tried
    return samples, error


def main(scan, relamp, results, threads, started):
    threads, folder = int(threads), f"{results}/relamp"
    setup = time.time() - float(started)
    runs = [run_relamp(relamp, scan, folder, threads) for _ in range(TIMED_RUNS)]
    ours = [statistics.median(column) for column in zip(*runs)]

    start = time.time()
    with open(f"{folder}/lights.json") as file:
        lights = json.load(file)
    room, shines = import_room(f"{folder}/{os.path.basename(scan)}")
    dress(room, shines, lights, load(f"{folder}/albedo.exr"))
    height, width = shines.shape
    baker = Baker(room, width, height, threads)
    setup += time.time() - start

    reference = baker.bake(baker.some, REFERENCE_SAMPLES)[0]
    confidence = picked(load(f"{folder}/confidence.png"))[..., 0]
    scored = (confidence >= 0.5) & (reference.min(axis=2) >= DARKEST)
    true = reference[scored]
    shading = picked(load(f"{folder}/shading.exr"))[scored]
    rows = []
    for name, metric in METRICS.items():
        goal = metric(shading, true)
        bake_error = lambda samples: metric(baker.bake(baker.some, samples)[0][scored], true)  # noqa: B023, E731
        rows.append((name, goal, *samples_of_same_error(bake_error, goal)))

    timed = min(rows[0][2], MOST_TIMED_SAMPLES)
    _, seconds, processor = baker.bake(baker.page, timed)
    with open(f"{results}/table.md", "w") as table:
        print(f"{scan}: {scored.sum()} texels scored, {threads} threads", file=table)
        print(f"relamp: irradiance {ours[0]:.2f} s, whole {ours[1]:.2f} s, processor {ours[2]:.2f} s", file=table)
        print(f"Cycles, {timed} samples: bake {seconds:.1f} s, whole {setup + seconds:.1f} s, "
              f"processor {processor:.1f} s", file=table)
        print("\n| error | relamp | Cycles | samples | relamp, s | Cycles, s | ratio | of processor time |", file=table)
        print("| --- |" + " ---: |" * 7, file=table)
        for name, goal, samples, reached in rows:
            share = samples / timed
            bound = "" if abs(reached / goal - 1) < SAME_ERROR else "> " if reached > goal else "< "
            print(f"| {name} | {goal:.3f} | {reached:.3f} | {samples} | {ours[0]:.1f} | {seconds * share:.0f} | "
                  f"{bound}{seconds * share / ours[0]:.0f} | {bound}{processor * share / ours[2]:.0f} |", file=table)


main(*sys.argv[sys.argv.index("--") + 1 :])
