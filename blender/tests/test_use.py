"""What a person does with the add-on, and what it says where something stands in the way."""

import os
import stat
import tempfile
import time
import unittest

import bpy
import scenes
from relamp_addon import delight, hints, preferences, process, program, state
from relamp_addon.errors import Refusal


class Refusals(unittest.TestCase):
    """Each is one sentence, and nothing has changed."""

    def setUp(self):
        self.scan = scenes.import_sample()
        bpy.context.scene.relamp.quality = "draft"

    def tearDown(self):
        self.assertEqual(state.rooms(), [])
        self.assertEqual(len(bpy.data.materials), 1)

    def expect(self, *words: str) -> None:
        sentence = scenes.refusal_of(bpy.ops.relamp.delight)
        for word in words:
            self.assertIn(word, sentence)
        self.assertNotIn("Traceback", sentence)

    def test_nothing_is_selected(self):
        bpy.ops.object.select_all(action="DESELECT")
        self.expect("no scan is selected", "click")

    def test_no_texture(self):
        material = self.scan.material_slots[0].material
        for node in list(material.node_tree.nodes):
            if node.type == "TEX_IMAGE":
                material.node_tree.nodes.remove(node)
        self.expect('"Material_0" has no texture', "Image Texture")

    def test_no_material(self):
        self.scan.data.materials.clear()
        self.expect('"scan" has no material', "leave it out")
        bpy.data.materials.new("put back")
        bpy.data.materials.remove(bpy.data.materials[0])

    def test_no_uv_map(self):
        self.scan.data.uv_layers.remove(self.scan.data.uv_layers[0])
        self.expect('"scan" has no UV map', "import the scan with it")

    def test_mesh_that_stands_twice(self):
        twin = self.scan.copy()
        bpy.context.scene.collection.objects.link(twin)
        twin.select_set(True)
        self.expect("shares its mesh", "Make Single User")

    def test_missing_picture(self):
        image = next(one for one in bpy.data.images if one.size[0])
        image.filepath = "/nowhere/scan.jpg"
        image.unpack(method="REMOVE")
        image.filepath = "/nowhere/scan.jpg"
        image.reload()
        self.expect(f'"{image.name}"', "/nowhere/scan.jpg", "Find Missing Files")

    def test_what_relamp_refuses_is_said_in_its_own_words(self):
        """All places on one texel."""
        layer = self.scan.data.uv_layers[0].data
        layer.foreach_set("uv", [0.5] * (2 * len(layer)))
        self.scan.data.update()
        sentence = scenes.refusal_of(bpy.ops.relamp.delight)
        self.assertRegex(sentence, "^the scan: .*texture coordinates")


class Program(unittest.TestCase):
    def test_is_looked_for_on_path_and_the_way_out_is_told(self):
        before = os.environ["PATH"]
        self.assertTrue(program.find_program("").endswith("relamp"))
        os.environ["PATH"] = "/nowhere"
        try:
            with self.assertRaisesRegex(Refusal, "not on PATH.*Preferences > Add-ons > relamp"):
                program.find_program("")
            scenes.import_sample()
            self.assertIn("not on PATH", scenes.refusal_of(bpy.ops.relamp.delight))
        finally:
            os.environ["PATH"] = before

    def test_is_the_one_that_the_preferences_name(self):
        real = program.find_program("")
        self.assertEqual(program.find_program(os.path.dirname(real)), real)
        with self.assertRaisesRegex(Refusal, "/nowhere/relamp, .* is not there"):
            program.find_program("/nowhere/relamp")
        with tempfile.NamedTemporaryFile() as file:
            os.chmod(file.name, stat.S_IREAD)
            with self.assertRaisesRegex(Refusal, "may not be executed"):
                program.find_program(file.name)

    def test_preferences_are_there(self):
        scenes.import_sample()
        self.assertIsNotNone(preferences.current(bpy.context))

    def test_that_is_none_ends_with_a_sentence(self):
        for script, words in (("exit 1", "exit code 1 without a word"),
                              ("kill -9 $$", "ended by signal 9.*memory"),
                              ("echo relamp: bad luck >&2; exit 1", "^bad luck$")):
            run = process.Run(["/bin/sh", "-c", script])
            process.wait(run)
            with self.assertRaisesRegex(Refusal, words):
                run.check()
        with self.assertRaisesRegex(Refusal, "/etc/passwd cannot be run"):
            process.Run(["/etc/passwd"])


class Progress(unittest.TestCase):
    def test_goes_on_and_cancel_ends_it_at_once_with_nothing_left(self):
        scenes.import_sample()
        bpy.context.scene.relamp.quality = "high"
        job = delight.Job(bpy.context)
        seen = []
        begin = time.monotonic()
        while job.run.fraction < 0.1 and time.monotonic() - begin < 60:
            self.assertFalse(job.run.poll())
            seen.append(job.run.fraction)
            time.sleep(0.02)
        self.assertEqual(seen, sorted(seen))
        self.assertGreater(len(set(seen)), 3)
        self.assertIn("%", job.run.stage)
        begin = time.monotonic()
        job.run.cancel()
        self.assertLess(time.monotonic() - begin, 10)  # where much else runs
        self.assertEqual(job.run.child.returncode, 130)
        self.assertEqual([name for name in os.listdir(job.folder) if "result" in name], [])
        job.close()
        self.assertFalse(os.path.exists(job.folder))
        self.assertEqual(state.rooms(), [])

    def test_object_that_went_meanwhile_is_told(self):
        scan = scenes.import_sample()
        bpy.context.scene.relamp.quality = "draft"
        job = delight.Job(bpy.context)
        process.wait(job.run)
        scan.name = "another"
        with self.assertRaisesRegex(Refusal, '"scan" was removed or renamed'):
            job.finish(bpy.context)
        job.close()


class Hints(unittest.TestCase):
    def setUp(self):
        self.scan = scenes.import_sample()

    def select(self, *faces: int) -> None:
        values = [index in faces for index in range(len(self.scan.data.polygons))]
        self.scan.data.polygons.foreach_set("select", values)

    def test_are_places_in_metres_with_y_up_whatever_the_scan_stands_like(self):
        self.select(100)
        self.assertEqual(bpy.ops.relamp.hint(kind="WHITE"), {"FINISHED"})
        centre = self.scan.data.polygons[100].center
        self.scan.scale = (100, 100, 100)
        self.scan.location = (0, 0, 50)
        bpy.context.scene.unit_settings.scale_length = 0.01
        bpy.context.view_layer.update()
        told, = hints.options(bpy.context.scene, [self.scan])
        self.assertTrue(told.startswith("--white="))
        place = [float(word) for word in told.removeprefix("--white=").split(",")]
        for found, expected in zip(place, (centre.x, centre.z + 0.5, -centre.y)):
            self.assertAlmostEqual(found, expected, places=4)

    def test_same_paint_is_said_of_two_faces(self):
        self.select(100)
        self.assertIn("two places", scenes.refusal_of(bpy.ops.relamp.hint, kind="SAME"))
        self.select(100, 2000)
        self.assertEqual(bpy.ops.relamp.hint(kind="SAME"), {"FINISHED"})
        told, = hints.options(bpy.context.scene, [self.scan])
        self.assertRegex(told, r"^--same=[-.\d]+,[-.\d]+,[-.\d]+:[-.\d]+,[-.\d]+,[-.\d]+$")
        self.assertEqual(hints.options(bpy.context.scene, []), [])
        bpy.ops.relamp.forget_hint(index=0)
        self.assertEqual(len(bpy.context.scene.relamp.hints), 0)

    def test_nothing_selected_is_told(self):
        self.select()
        self.assertIn("no face is selected", scenes.refusal_of(bpy.ops.relamp.hint, kind="LAMP"))

    def test_what_is_no_lamp_is_none_in_the_result(self):
        """The ceiling lamp, else `ceiling lamp 2`."""
        hit, place, _, _ = self.scan.closest_point_on_mesh((2.2, 1.9, 2.45))
        self.assertTrue(hit)
        hints.add(bpy.context.scene, "NO_LAMP", [(self.scan, place)])
        found = scenes.lights(scenes.delight())
        self.assertTrue([name for name in found if name.startswith("window")])
        self.assertNotIn("ceiling lamp 2", found)
