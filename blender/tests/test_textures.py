"""The picture that relamp gets is the one that Blender shows, wherever it comes from."""

import os
import tempfile
import unittest

import bpy
import numpy
import scenes
from relamp_addon import textures


class Pictures(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        colours = numpy.random.default_rng(1).random((8, 8, 4), numpy.float32)
        colours[..., 3] = 1
        self.colours = colours

    def expect(self, image: bpy.types.Image, ending: str) -> None:
        file = textures.write_picture(image, os.path.join(self.folder, "written"))
        self.assertTrue(file.endswith(ending), file)
        written = bpy.data.images.load(file, check_existing=False)
        written.colorspace_settings.name = "Non-Color"
        numpy.testing.assert_allclose(scenes.pixels(written)[..., :3],
                                      scenes.pixels(image)[..., :3], atol=1e-3)
        self.assertGreater(scenes.pixels(image)[..., :3].std(), 0.1)
        bpy.data.images.remove(written)

    def generated(self, is_float: bool, colour_space: str) -> bpy.types.Image:
        image = bpy.data.images.new("made", 8, 8, float_buffer=is_float)
        image.colorspace_settings.name = colour_space
        image.pixels.foreach_set(self.colours.ravel())
        return image

    def test_generated(self):
        for is_float, ending in ((False, ".png"), (True, ".exr")):
            for colour_space in ("sRGB", "Non-Color", "Linear"):
                with self.subTest(is_float=is_float, colour_space=colour_space):
                    self.expect(self.generated(is_float, colour_space), ending)

    def test_packed_file_and_painted_over(self):
        made = self.generated(False, "sRGB")
        made.file_format, made.filepath_raw = "PNG", os.path.join(self.folder, "made.png")
        made.save()
        image = bpy.data.images.load(made.filepath_raw)
        self.expect(image, ".png")
        for _ in ("the file", "packed"):
            self.colours = self.colours[::-1].copy()
            image.pixels.foreach_set(self.colours.ravel())
            self.assertTrue(image.is_dirty)
            self.expect(image, ".png")
            image.pack()
            self.expect(image, ".png")

    def test_a_file_goes_as_it_is(self):
        sample = os.path.join(scenes.SAMPLE, "scan_recon.jpg")
        file = textures.write_picture(bpy.data.images.load(sample), f"{self.folder}/written")
        with open(file, "rb") as written, open(sample, "rb") as read:
            self.assertEqual(written.read(), read.read())
        self.assertTrue(file.endswith(".jpg"))


class Materials(unittest.TestCase):
    """Where the texture of a material is found, as importers and people make them."""

    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.material = bpy.data.materials.new("m")
        self.material.use_nodes = True
        self.nodes = self.material.node_tree.nodes
        self.link = self.material.node_tree.links.new
        self.photo = self.texture("photo")

    def texture(self, name: str) -> bpy.types.ShaderNodeTexImage:
        node = self.nodes.new("ShaderNodeTexImage")
        node.image = bpy.data.images.new(name, 4, 4)
        return node

    def found(self) -> textures.Texture:
        return textures.texture_of(self.material)

    def test_of_base_color_and_not_of_a_bump(self):
        bump = self.texture("bump")
        principled = self.nodes["Principled BSDF"]
        self.link(bump.outputs[0], principled.inputs["Roughness"])
        self.link(self.photo.outputs[0], principled.inputs["Base Color"])
        self.assertEqual(self.found().image.name, "photo")

    def test_through_other_nodes(self):
        gamma = self.nodes.new("ShaderNodeGamma")
        self.link(self.photo.outputs[0], gamma.inputs[0])
        self.link(gamma.outputs[0], self.nodes["Principled BSDF"].inputs["Base Color"])
        self.texture("other")
        self.assertEqual(self.found().image.name, "photo")

    def test_of_an_emission_as_unlit_scans_have_it(self):
        emission = self.nodes.new("ShaderNodeEmission")
        self.link(self.photo.outputs[0], emission.inputs["Color"])
        self.assertEqual(self.found().image.name, "photo")

    def test_by_the_uv_map_that_is_named(self):
        uv = self.nodes.new("ShaderNodeUVMap")
        uv.uv_map = "second"
        self.link(uv.outputs[0], self.photo.inputs["Vector"])
        self.assertEqual(self.found().uv_layer, "second")

    def test_mapping_and_tiles_are_refused(self):
        mapping = self.nodes.new("ShaderNodeMapping")
        self.assertEqual(self.found().uv_layer, "")
        link = self.link(mapping.outputs[0], self.photo.inputs["Vector"])
        self.assertEqual(self.found().uv_layer, "")  # as it comes, it changes nothing
        mapping.inputs["Scale"].default_value = (2, 1, 1)
        with self.assertRaisesRegex(textures.Refusal, "Mapping node; apply that to the UV map"):
            self.found()
        self.material.node_tree.links.remove(link)
        self.photo.image.source = "TILED"
        with self.assertRaisesRegex(textures.Refusal, "UDIM tiles"):
            self.found()
