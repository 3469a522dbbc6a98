"""What the add-on's watts are to Cycles: a light has the radiance and size that it was given."""

import math
import tempfile
import types
import unittest

import bpy
import numpy
import scenes
from relamp_addon import faces, images, lamps, materials, outside, places
from relamp_addon.faces import Samples
from relamp_addon.result import Lamp

RADIANCE = numpy.array([3.0, 2.0, 1.0])
SAMPLES = 2048
NOTHING = Samples(numpy.empty((0, 3)), numpy.empty((0, 3)), numpy.empty(0), numpy.empty(0))


class Units(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module="relamp_addon")
        scene = bpy.context.scene
        scene.render.resolution_x = scene.render.resolution_y = 4
        bpy.ops.mesh.primitive_plane_add(size=0.02)
        paper = bpy.data.materials.new("paper")
        paper.use_nodes = True
        paper.node_tree.nodes.clear()
        diffuse = paper.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
        output = paper.node_tree.nodes.new("ShaderNodeOutputMaterial")
        paper.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
        bpy.context.object.data.materials.append(paper)
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        camera.data.type, camera.data.ortho_scale = "ORTHO", 0.01
        camera.location = (0, 0, 0.05)
        camera.data.clip_start = 0.01
        scene.collection.objects.link(camera)
        scene.camera = camera

    def shown(self, *lights: bpy.types.Object) -> numpy.ndarray:
        """What white paper at the origin, facing up, shows under them."""
        for light in lights:
            bpy.context.scene.collection.objects.link(light)
        with tempfile.TemporaryDirectory() as folder:
            return scenes.render(SAMPLES, folder)[..., :3].mean(axis=(0, 1))

    def test_flat_lamp_has_its_radiance_whatever_its_shape(self):
        """Irradiance / pi of a small lamp straight above is L A / d^2 / pi."""
        lamp = Lamp(0, "lamp", numpy.array([0.0, 2, 0]), numpy.array([0.0, -1, 0]), 0.01, RADIANCE)
        by_disc = self.shown(*lamps.lights_of(lamp, NOTHING, 1.0))
        numpy.testing.assert_allclose(by_disc, RADIANCE * 0.01 / 4 / math.pi, rtol=0.01)

    def test_rectangle_of_a_surface_sends_what_the_surface_does(self):
        grid = (numpy.indices((40, 10)).reshape(2, -1).T + 0.5) / [40, 10] - 0.5
        place = numpy.column_stack([grid * [0.2, 0.05], numpy.full(400, 2.0)])
        samples = Samples(place, numpy.tile([0.0, 0, -1], (400, 1)), numpy.full(400, 0.01 / 400),
                          numpy.ones(400))
        lamp = Lamp(0, "lamp", numpy.zeros(3), numpy.array([0.0, -1, 0]), 0.01, RADIANCE)
        light, = lamps.lights_of(lamp, samples, 1.0)
        self.assertEqual(light.data.shape, "RECTANGLE")
        self.assertAlmostEqual(light.data.size * light.data.size_y, 0.01, places=5)
        self.assertAlmostEqual(max(light.data.size, light.data.size_y), 0.2, delta=0.01)
        numpy.testing.assert_allclose(self.shown(light), RADIANCE * 0.01 / 4 / math.pi, rtol=0.015)

    def test_lamp_of_a_single_sample_has_a_size(self):
        samples = Samples(numpy.array([[0.0, 0, 2]]), numpy.array([[0.0, 0, -1]]),
                          numpy.array([1e-4]), numpy.ones(1))
        lamp = Lamp(0, "lamp", numpy.zeros(3), numpy.array([0.0, -1, 0]), 1e-4, RADIANCE)
        light, = lamps.lights_of(lamp, samples, 1.0)
        self.assertAlmostEqual(light.data.size, light.data.size_y)
        self.assertAlmostEqual(light.data.energy, 4 * 1e-4 * 3, delta=1e-6)

    def test_lamp_that_shines_all_around_sends_pi_l_a(self):
        lamp = Lamp(0, "lamp", numpy.array([0.0, 2, 0]), None, 0.01, RADIANCE)
        light, = lamps.lights_of(lamp, NOTHING, 1.0)
        self.assertEqual(light.data.type, "POINT")
        self.assertAlmostEqual(4 * math.pi * light.data.shadow_soft_size**2, 0.01, places=6)
        # A ball of radius r has the radiant intensity L pi r^2 = L A / 4.
        numpy.testing.assert_allclose(self.shown(light), RADIANCE * 0.0025 / 4 / math.pi, rtol=0.01)

    def test_sun_has_its_irradiance(self):
        sun = lamps.new_sun({"direction": [0, 1, 0], "irradiance": list(RADIANCE)})
        numpy.testing.assert_allclose(self.shown(sun), RADIANCE / math.pi, rtol=0.01)

    def test_opening_shows_its_radiance_in_place_of_the_ambient_light(self):
        """Of all that paper sees, F = A / (pi d^2) is the opening; not both shine there."""
        ambient = numpy.array([0.3, 0.2, 0.1])
        opening = {"centre": [0, 2, 0], "normal": [0, -1, 0], "area": 0.36,
                   "radiance": list(5 * RADIANCE)}
        found = types.SimpleNamespace(lights={"ambient": list(ambient)},
                                      report={"lights": {"openings": [opening]}})
        bpy.context.scene.world = outside.new_world("outside", found)
        pane, = outside.new_panes(found, 1.0)
        share = 0.0278  # of a square of 0.6 m at 2 m: 0.36 / (4 pi), less as it is not far off
        numpy.testing.assert_allclose(
            self.shown(pane), share * 5 * RADIANCE + (1 - share) * ambient, rtol=0.02)

    def test_box_is_a_light_a_side_that_go_with_the_front(self):
        """Half a cube under the ceiling: its front and its four sides."""
        normals = numpy.array([[0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]], float)
        place, normal = [], []
        for one in normals:
            across = numpy.array(lamps.across_of(one))
            grid = (numpy.indices((10, 10)).reshape(2, -1).T + 0.5) / 50 - 0.1
            place.append(grid @ across + one * 0.1 + [0, 0, 2])
            normal.append(numpy.tile(one, (100, 1)))
        samples = Samples(numpy.concatenate(place), numpy.concatenate(normal),
                          numpy.full(500, 0.04 / 100), numpy.ones(500))
        lamp = Lamp(7, "box", numpy.zeros(3), numpy.array([0.0, -1, 0]), 0.2, RADIANCE)
        made = lamps.lights_of(lamp, samples, 1.0)
        self.assertEqual([one.name for one in made],
                         ["box", "box side 1", "box side 2", "box side 3", "box side 4"])
        for one in made:
            self.assertAlmostEqual(one.data.energy, 4 * 0.04 * 3, delta=0.01)
            bpy.context.scene.collection.objects.link(one)
        bpy.context.view_layer.update()
        side = made[1]
        before = side.matrix_world.translation.copy()
        made[0].location.z -= 1
        bpy.context.view_layer.update()
        self.assertAlmostEqual((before - side.matrix_world.translation).z, 1, places=5)
        self.assertGreater(before.to_2d().length, 0.1)  # outside of the box

    def test_shade_of_which_half_was_scanned_sends_light_to_its_far_side_too(self):
        normal = numpy.array([[0.6, 0.8, 0.0], [-0.6, 0.8, 0.0]]).repeat(50, axis=0)
        samples = Samples(normal * 0.1, normal, numpy.full(100, 0.01 / 100), numpy.ones(100))
        lamp = Lamp(0, "shade", numpy.array([0.0, 1, 0]), numpy.array([0.0, 0, -1]), 0.02, RADIANCE,
                    unseen=0.01)
        light, = lamps.lights_of(lamp, samples, 1.0)
        self.assertEqual(light.data.type, "POINT")
        self.assertEqual(tuple(light.location), (0, 0, 1))
        numpy.testing.assert_allclose(numpy.array(light.data.color) * light.data.energy,
                                      math.pi * 0.02 * RADIANCE, rtol=1e-5)

    def test_globe_lights_as_much_by_its_surface_as_by_the_light_in_it(self):
        """The globe must not stand in the light's way, and no light must be missing where a ray
        meets it. A ball of radius r shows L r^2 / d^2.
        """
        bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=0.2,
                                             location=(0, 0, 0.3))
        globe = bpy.context.object
        white = images.from_array("white", numpy.ones((4, 4, 3)), is_float=False)
        palette = images.from_array("palette", numpy.array([[[0, 0, 0], RADIANCE]]), is_float=True)
        numbers = images.from_array("numbers", numpy.full((4, 4, 1), 1 / 255), is_float=False)
        page = materials.PageImages(numpy.ones((4, 4), int), white, white, numbers, palette)
        switch = materials.new_switch("switch")
        layer = globe.data.uv_layers[0]
        globe.data.materials.append(materials.new_material("globe", page, layer.name, switch, True))
        chosen = faces.faces_of_lamps(globe.data, layer, page.lamp_numbers)
        self.assertTrue(chosen.all())
        bpy.context.view_layer.update()
        samples = faces.samples_of_lamps(globe, layer, page.lamp_numbers, chosen)
        area = 4 * math.pi * 0.2**2
        self.assertAlmostEqual(samples.area.sum(), area, delta=0.005 * area)
        lamp = Lamp(0, "globe", numpy.array([0.0, 0.3, 0]), None, area, RADIANCE)
        light, = lamps.lights_of(lamp, samples, 1.0)
        numpy.testing.assert_allclose(light.location, (0, 0, 0.3), atol=1e-3)
        bpy.context.scene.collection.objects.link(light)

        value = {name: switch.nodes[name].outputs[0] for name in ("Flat", "Shine", "Surfaces")}
        value["Flat"].default_value, value["Shine"].default_value = 0, 1
        ball = RADIANCE * 0.2**2 / 0.3**2
        disc = RADIANCE * 0.2**2 / (0.3**2 + 0.2**2)  # as Blender 3.4 has a point light so near
        value["Surfaces"].default_value = 1
        light.hide_render = True
        materials.lights_by_surface(globe.material_slots[0].material, True)
        numpy.testing.assert_allclose(self.shown(), ball, rtol=0.02)

        value["Surfaces"].default_value = 0
        light.hide_render = False
        materials.lights_by_surface(globe.material_slots[0].material, False)
        shown = self.shown()
        self.assertTrue((shown > 0.98 * disc).all() and (shown < 1.02 * ball).all(), shown)

    def test_frames_go_there_and_back(self):
        some = numpy.array([[1.0, 2, 3], [-4, 5, 6]])
        numpy.testing.assert_array_equal(places.to_blender(places.to_relamp(some)), some)
        numpy.testing.assert_array_equal(places.to_relamp(numpy.array([[0.0, 0, 1]])), [[0, 1, 0]])
