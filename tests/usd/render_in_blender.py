"""What a USD scene of relamp's says, rendered by another program and held against the scan.

Runs inside Blender 3.4, with arguments SCENE.usda CAMERA.json SCAN.exr SAMPLES. SCAN is what the
camera sees of the scan as it came, as radiance.

Debian's Blender is built without USD, so the scene is read by usda.py and set up as the schemas
say: an intensity is radiance, of the normalized sun irradiance. Blender's area lights have to have
four times radiance times area in watts, for they make a quarter of watts over area of them, not the
share of pi of a matte surface.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import numpy

numpy.bool = bool  # Blender 3.4 asks for it, and Debian's numpy has it no more
import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).parent))
from usda import Prim, prims_below, read  # noqa: E402

Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def add_mesh(prim: Prim, materials: dict) -> None:
    value = {name: attribute.value for name, attribute in prim.attributes.items()}
    faces = value["faceVertexIndices"].astype(int).reshape(-1, 3)
    mesh = bpy.data.meshes.new(prim.name)
    mesh.from_pydata(value["points"].tolist(), [], faces.tolist())
    st = mesh.uv_layers.new(name="st")
    st.data.foreach_set("uv", value["primvars:st"][faces.ravel()].ravel())
    mesh.materials.append(materials[prim.relationships["material:binding"]])
    thing = bpy.data.objects.new(prim.name, mesh)
    thing.matrix_world = Z_UP
    bpy.context.collection.objects.link(thing)


def image_node(nodes, folder: Path, texture: Prim):
    node = nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(str(folder / texture.attributes["inputs:file"].value))
    is_raw = texture.attributes["inputs:sourceColorSpace"].value == "raw"
    node.image.colorspace_settings.name = "Linear" if is_raw else "sRGB"
    return node


def material_of(prim: Prim, folder: Path, shines: bool):
    """Matte: by the specular workflow with a specular colour of 0."""
    material = bpy.data.materials.new(prim.name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    matte = nodes.new("ShaderNodeBsdfDiffuse")
    albedo = image_node(nodes, folder, prim.child("albedo"))
    links.new(albedo.outputs["Color"], matte.inputs["Color"])
    surface = matte.outputs["BSDF"]
    if shines and prim.child("emission"):
        glow = nodes.new("ShaderNodeEmission")
        emission = image_node(nodes, folder, prim.child("emission"))
        links.new(emission.outputs["Color"], glow.inputs["Color"])
        both = nodes.new("ShaderNodeAddShader")
        links.new(surface, both.inputs[0])
        links.new(glow.outputs["Emission"], both.inputs[1])
        surface = both.outputs["Shader"]
    links.new(surface, output.inputs["Surface"])
    return material


def add_light(prim: Prim) -> None:
    value = {name: attribute.value for name, attribute in prim.attributes.items()}
    intensity, color = value["inputs:intensity"], value["inputs:color"]
    if prim.type == "DomeLight":
        background = bpy.context.scene.world.node_tree.nodes["Background"].inputs
        background["Color"].default_value = (*color, 1)
        background["Strength"].default_value = intensity
        return
    if prim.type == "SphereLight":
        return add_sphere(prim, value["inputs:radius"], intensity, color)
    light = bpy.data.lights.new(prim.name, "SUN" if prim.type == "DistantLight" else "AREA")
    light.color = color
    radius, width, height = (value.get("inputs:" + name) for name in ("radius", "width", "height"))
    if prim.type == "DistantLight":
        light.energy = intensity
        light.angle = math.radians(value["inputs:angle"])
    elif radius:
        light.shape, light.size = "DISK", 2 * radius
        light.energy = 4 * math.pi * radius**2 * intensity
    else:
        light.shape, light.size, light.size_y = "RECTANGLE", width, height
        light.energy = 4 * width * height * intensity
    light_at(prim, light)


def add_sphere(prim: Prim, radius: float, intensity: float, color) -> None:
    """A surface that shines: a point light of Cycles 3.4 is hidden in part by the lamp inside."""
    material = bpy.data.materials.new(prim.name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    glow = nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (*color, 1)
    glow.inputs["Strength"].default_value = intensity
    links.new(glow.outputs["Emission"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    middle = Vector(prim.attributes["xformOp:transform"].value[3][:3])
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=Z_UP @ middle)
    bpy.context.object.data.materials.append(material)


def light_at(prim: Prim, light) -> None:
    thing = bpy.data.objects.new(prim.name, light)
    thing.matrix_world = Z_UP @ Matrix(prim.attributes["xformOp:transform"].value).transposed()
    bpy.context.collection.objects.link(thing)


def add_scene(file: Path, light: str) -> None:
    room = read(file).children[0]
    chosen = room.variant_sets["light"][light]
    shines = any(prim.attributes for _, prim in prims_below(chosen))
    materials = {}
    for path, prim in prims_below(Prim("layer", "", "", children=[room])):
        if prim.type == "Material":
            materials[path] = material_of(prim, file.parent, shines)
    for prim in room.child("Geometry").children:
        add_mesh(prim, materials)
    lights = list(room.child("Lights").children)
    if not chosen.child("Lamps"):  # else it switches them off
        lights += room.child("Lamps").children
    for prim in lights:
        add_light(prim)


def add_camera(file: Path) -> None:
    view = json.loads(file.read_text())
    place = Z_UP @ Vector(view["position"])
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = place
    towards = Z_UP @ Vector(view["target"]) - place
    camera.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
    camera.data.angle = math.radians(view["fieldOfView"])
    camera.data.clip_start = 0.01
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def pixels_of(file: str):
    """Linear RGB, row 0 below."""
    image = bpy.data.images.load(file)
    width, height = image.size
    return numpy.array(image.pixels[:]).reshape(height, width, -1)[:, :, :3]


def render(picture: str, width: int, height: int, samples: int):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.use_denoising = False
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 8
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.filepath = picture
    scene.render.image_settings.file_format = "OPEN_EXR"
    bpy.ops.render.render(write_still=True)
    return pixels_of(picture)


def blocks_of(pixels, side: int = 5):
    """Means of blocks, in which the noise of few samples goes."""
    height, width = (size // side for size in pixels.shape[:2])
    cut = pixels[: height * side, : width * side]
    return cut.reshape(height, side, width, side, 3).mean(axis=(1, 3))


def srgb(light):
    light = light.clip(0, 1)
    return numpy.where(light < 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def compare(rendered, scan) -> "tuple[float, float]":
    """PSNR in dB, and light over the scan's, where the scan is not burnt out."""
    is_below = (scan < 0.97).all(axis=2, keepdims=True).repeat(3, axis=2)
    known = blocks_of(is_below.astype(float)).min(axis=2) == 1
    seen, wanted = blocks_of(rendered)[known], blocks_of(scan)[known]
    error = ((srgb(seen) - srgb(wanted)) ** 2).mean()
    return -10 * math.log10(error), seen.mean() / wanted.mean()


def empty_scene() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    world = bpy.context.scene.world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0


def main() -> None:
    scene, camera, scan_file, samples = sys.argv[sys.argv.index("--") + 1:]
    for light, least in (("lamps", 25), ("emissive", 22)):
        empty_scene()
        scan = pixels_of(scan_file)
        add_scene(Path(scene), light)
        add_camera(Path(camera))
        picture = str(Path(scan_file).with_name(light + ".exr"))
        rendered = render(picture, scan.shape[1], scan.shape[0], int(samples))
        decibels, ratio = compare(rendered, scan)
        print(f"RESULT {light}: {decibels:.2f} dB, {ratio:.3f} of the scan's light")
        assert decibels > least and 0.9 < ratio < 1.1, "not the light of the scan"


main()
