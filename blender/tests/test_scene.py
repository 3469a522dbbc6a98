"""What comes back into Blender.

The same room however the scan stands there, and the scan as it was when it is given back.
"""

import tempfile
import unittest

import bpy
import numpy
import scenes
from mathutils import Matrix, Vector
from relamp_addon import confidence, state


def centres(room: bpy.types.Collection) -> dict[str, numpy.ndarray]:
    return {name: numpy.array(light.matrix_world.translation)
            for name, light in scenes.lights(room).items()}


def inventory() -> dict[str, list[str]]:
    return {kind: sorted(one.name for one in getattr(bpy.data, kind)) for kind in
            ("objects", "meshes", "materials", "images", "lights", "worlds", "collections",
             "node_groups")}


class AsImported(unittest.TestCase):
    """One result, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.scan = scenes.import_sample()
        cls.room = scenes.delight()
        cls.own = cls.room.relamp

    def setUp(self):
        self.own.mode = "ALBEDO"

    def materials(self) -> list[str]:
        return [slot.material.name for slot in self.scan.material_slots]

    def test_every_lamp_is_a_light_with_its_name_in_a_collection(self):
        names = sorted(scenes.lights(self.room))
        self.assertTrue(any(name.startswith("window") for name in names), names)
        self.assertTrue(any(name.startswith("ceiling lamp") for name in names), names)
        self.assertTrue(all(light.type == "LIGHT" for light in self.own.lamps.objects))
        self.assertIn(self.room.name, bpy.context.scene.collection.children)

    def test_window_has_its_size_and_power(self):
        """As relamp finds it: 1.57 m^2, and 8.5, 11.4, 16.4 times as bright as white."""
        window = next(light for name, light in scenes.lights(self.room).items()
                      if name.startswith("window"))
        area = window.data.size * window.data.size_y
        self.assertAlmostEqual(area, 1.57, delta=0.15)
        radiance = numpy.array(window.data.color) * window.data.energy / 4 / area
        numpy.testing.assert_allclose(radiance, [8.5, 11.4, 16.4], rtol=0.25)
        shines = window.matrix_world.to_3x3() @ Vector((0, 0, -1))
        self.assertGreater(shines.y, 0.99)  # into the room

    def test_nothing_shines_twice(self):
        for mode, lamps, outside, surfaces in (
                ("SCANNED", False, False, False), ("ALBEDO", False, False, False),
                ("CONFIDENCE", False, False, False), ("LAMPS", True, True, False),
                ("SURFACES", False, True, True)):
            with self.subTest(mode):
                self.own.mode = mode
                self.assertEqual(not self.own.lamps.hide_render, lamps)
                self.assertEqual(not self.own.lamps.hide_viewport, lamps)
                self.assertEqual(not self.own.outside.hide_render, outside)
                self.assertEqual(bpy.context.scene.world == self.own.world, outside)
                value = self.own.switch.nodes["Surfaces"].outputs[0].default_value
                self.assertEqual(bool(value), surfaces)

    def test_one_switch_brings_the_scan_back(self):
        albedo = self.materials()
        self.own.mode = "SCANNED"
        self.assertEqual(set(self.materials()), {"Material_0"})
        self.own.mode = "ALBEDO"
        self.assertEqual(self.materials(), albedo)
        self.assertNotIn("Material_0", albedo)

    def test_flat_modes_show_the_picture_as_it_is(self):
        material = state.materials_of(self.room)[0]
        self.assertEqual(material.node_tree.nodes["shown"].image, material.relamp.albedo)
        self.own.mode = "CONFIDENCE"
        self.assertEqual(material.node_tree.nodes["shown"].image, material.relamp.confidence)

    def test_confidence_is_a_colour_of_the_mesh(self):
        values = numpy.empty(4 * len(self.scan.data.loops), numpy.float32)
        self.scan.data.color_attributes[confidence.NAME].data.foreach_get("color", values)
        values = values.reshape(-1, 4)[:, 0]
        self.assertLess(values.min(), 0.02)
        self.assertGreater(numpy.median(values), 0.7)

    def test_few_faces_are_those_of_lamps(self):
        """Cycles looks for light on each of them."""
        count = numpy.empty(len(self.scan.data.polygons), numpy.int32)
        self.scan.data.polygons.foreach_get("material_index", count)
        self.assertEqual(set(count), {0, 1})
        self.assertLess((count == 1).mean(), 0.2)

    def test_all_pictures_are_in_the_file(self):
        """The folder that they came from is gone; the file has them."""
        with tempfile.TemporaryDirectory() as folder:
            bpy.ops.wm.save_as_mainfile(filepath=f"{folder}/room.blend", copy=True)
            with bpy.data.libraries.load(f"{folder}/room.blend") as (there, here):
                here.images = [name for name in there.images
                               if name.endswith((" albedo", " lamps"))]
            self.assertGreaterEqual(len(here.images), 3)
            for image in here.images:
                self.assertGreater(scenes.pixels(image).max(), 0, image.name)
                bpy.data.images.remove(image)


class AgainAndAgain(unittest.TestCase):
    """One scan, delit a few times; these tests follow each other."""

    @classmethod
    def setUpClass(cls):
        cls.scan = scenes.import_sample()
        cls.world = bpy.data.worlds.new("mine")
        bpy.context.scene.world = cls.world
        cls.before = inventory()
        cls.expected = centres(scenes.delight())

    def test_1_the_scan_is_as_it_was_and_nothing_stays(self):
        self.assertNotEqual(inventory(), self.before)
        state.rooms()[0].relamp.mode = "SURFACES"
        self.assertNotEqual(bpy.context.scene.world, self.world)
        again = centres(scenes.delight())  # takes the place of the first
        self.assertEqual(len(state.rooms()), 1)
        self.assertEqual(again.keys(), self.expected.keys())
        bpy.ops.relamp.remove()
        self.assertEqual(inventory(), self.before)
        self.assertEqual(bpy.context.scene.world, self.world)
        self.assertEqual([slot.material.name for slot in self.scan.material_slots], ["Material_0"])
        self.assertEqual({one.material_index for one in self.scan.data.polygons}, {0})
        self.assertNotIn(confidence.NAME, self.scan.data.color_attributes)

    def expect(self, room: bpy.types.Collection, by: Matrix, within: float) -> None:
        """Lamps are where they were in the scan's own frame, whatever Blender's file says about
        it; all but for sides, the order of which follows the axes.
        """
        found = centres(room)
        for name, centre in self.expected.items():
            if "side" not in name:
                there = numpy.array((by @ Matrix.Translation(centre)).translation)
                self.assertLess(numpy.linalg.norm(found[name] - there), within, name)

    def test_2_turned_and_in_centimetres_and_in_two_pieces_of_two_textures(self):
        scan = self.scan
        by = (Matrix.Translation((300, -50, 20)) @ Matrix.Rotation(0.7, 4, "Z")
              @ Matrix.Scale(100, 4))
        scan.matrix_world = by @ scan.matrix_world
        bpy.context.scene.unit_settings.scale_length = 0.01
        middle = numpy.empty(3 * len(scan.data.polygons), numpy.float32)
        scan.data.polygons.foreach_get("center", middle)
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        for kind in ("vertices", "edges"):
            things = getattr(scan.data, kind)
            things.foreach_set("select", numpy.zeros(len(things), bool))
        scan.data.polygons.foreach_set("select", middle.reshape(-1, 3)[:, 1] > 1.9)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.separate(type="SELECTED")
        bpy.ops.object.mode_set(mode="OBJECT")
        half = next(one for one in bpy.data.objects if one.type == "MESH" and one != scan)
        half.select_set(True)
        scan.select_set(True)
        material = scan.material_slots[0].material.copy()
        half.data.materials[0] = material
        node = next(one for one in material.node_tree.nodes if one.type == "TEX_IMAGE")
        with tempfile.TemporaryDirectory() as folder:  # as a file, where the other is packed
            node.image = node.image.copy()
            content = node.image.packed_file.data
            node.image.unpack(method="REMOVE")
            with open(f"{folder}/half.jpg", "wb") as file:
                file.write(content)
            node.image.filepath = f"{folder}/half.jpg"
            room = scenes.delight()
        self.assertEqual(len(room.relamp.parts), 2)
        self.expect(room, by, within=10)  # centimetres; the draft sees other texels
        pictures = {one.relamp.albedo.name for one in state.materials_of(room)}
        self.assertEqual(len(pictures), 2)
        for part in room.relamp.parts:
            name = next(slot.delit for slot in part.slots if slot.delit).relamp.albedo.name
            self.assertEqual("001" in name, part.thing == half, name)


class Baked(unittest.TestCase):
    def test_bakes_the_light_that_is_there_and_no_other(self):
        """A room whose lamps are off and that has one lamp of the person's own. The scan has a
        second material that no face has, the texture of which must stay as it is.
        """
        scan = scenes.import_sample()
        spare = scan.material_slots[0].material.copy()
        node = next(one for one in spare.node_tree.nodes if one.type == "TEX_IMAGE")
        node.image = node.image.copy()
        spare.node_tree.nodes.active = node
        scan.data.materials.append(spare)
        untouched = scenes.pixels(node.image)
        room = scenes.delight()
        room.relamp.mode = "LAMPS"
        for light in room.relamp.lamps.objects:
            light.hide_render = True
        for thing in room.relamp.outside.objects:
            thing.hide_render = True
        room.relamp.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        bpy.context.scene.relamp.bake_samples = 1
        self.assertEqual(bpy.ops.relamp.bake(), {"FINISHED"})
        self.assertEqual(room.relamp.mode, "BAKED")
        material = state.materials_of(room)[0]
        dark = scenes.pixels(material.relamp.baked)[..., :3]
        unlit = scenes.pixels(material.relamp.albedo)[..., :3].max(axis=2) > 0
        self.assertLess(numpy.median(dark[unlit]), 1e-4)

        mine = bpy.data.objects.new("mine", bpy.data.lights.new("mine", "POINT"))
        mine.data.energy = 100
        mine.location = (2.2, 1.9, 1.5)
        bpy.context.scene.collection.objects.link(mine)
        self.assertEqual(bpy.ops.relamp.bake(), {"FINISHED"})
        lit = scenes.pixels(material.relamp.baked)[..., :3]
        self.assertGreater(lit[unlit].mean(), 0.1)
        self.assertEqual(material.node_tree.nodes["shown"].image, material.relamp.baked)
        self.assertTrue(material.relamp.baked.packed_file)
        self.assertEqual(len([one for one in bpy.data.images if "baked" in one.name]), 1)
        self.assertTrue(scan.select_get())
        numpy.testing.assert_array_equal(scenes.pixels(node.image), untouched)
        self.assertEqual(scan.material_slots[1].material, spare)
        scan.hide_set(True)
        self.assertIn('"scan" is hidden', scenes.refusal_of(bpy.ops.relamp.bake))
