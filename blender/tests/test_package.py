"""The archive is an add-on of Blender 3.4, and an extension of 4.2 by the rules of its manual."""

import ast
import importlib
import os
import re
import shutil
import sys
import tempfile
import tomllib
import unittest

import bpy
import relamp_addon

FOLDER = os.path.dirname(relamp_addon.__file__)
SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "relamp_addon")
TAGS = {"3D View", "Add Curve", "Add Mesh", "Animation", "Bake", "Camera", "Compositing",
        "Development", "Game Engine", "Geometry Nodes", "Grease Pencil", "Import-Export",
        "Lighting", "Material", "Mesh", "Modeling", "Node", "Object", "Paint", "Physics",
        "Pipeline", "Render", "Rigging", "Scene", "Sculpt", "Sequencer", "System", "Text Editor",
        "Tracking", "User Interface", "UV"}


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(f"{FOLDER}/blender_manifest.toml", "rb") as file:
            cls.manifest = tomllib.load(file)

    def test_manifest_has_what_an_extension_must_have(self):
        manifest = self.manifest
        for key in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type",
                    "blender_version_min", "license"):
            self.assertIn(key, manifest)
        self.assertEqual(manifest["schema_version"], "1.0.0")
        self.assertEqual(manifest["type"], "add-on")
        self.assertRegex(manifest["id"], r"^[A-Za-z]\w*$")
        self.assertNotIn("__", manifest["id"])
        self.assertGreaterEqual(_numbers(manifest["blender_version_min"]), (4, 2, 0))
        self.assertTrue(all(one.startswith("SPDX:") for one in manifest["license"]))
        self.assertLessEqual(set(manifest["tags"]), TAGS)
        self.assertLessEqual(set(manifest["permissions"]),
                             {"files", "network", "clipboard", "camera", "microphone"})
        for sentence in (manifest["tagline"], *manifest["permissions"].values()):
            self.assertLessEqual(len(sentence), 64)
            self.assertRegex(sentence, r"\w$")  # no full stop

    def test_add_on_and_extension_say_the_same(self):
        self.assertEqual(_numbers(self.manifest["version"]), relamp_addon.bl_info["version"])
        self.assertEqual(self.manifest["name"], relamp_addon.bl_info["name"])
        self.assertEqual(self.manifest["version"], os.environ["RELAMP_VERSION"])

    def test_bl_info_can_be_read_without_running_the_file(self):
        """As Blender's list of add-ons does."""
        with open(f"{FOLDER}/__init__.py", encoding="utf-8") as file:
            tree = ast.parse(file.read())
        found = [one for one in tree.body if isinstance(one, ast.Assign)
                 and one.targets[0].id == "bl_info"]
        written = ast.literal_eval(found[0].value)  # Blender adds to what it has read
        self.assertLessEqual(written.items(), relamp_addon.bl_info.items())

    def test_archive_holds_all_files(self):
        self.assertEqual({name for name in os.listdir(FOLDER) if name != "__pycache__"},
                         {name for name in os.listdir(SOURCE) if name != "__pycache__"})

    def test_it_registers_under_the_name_of_an_extension(self):
        """Which is bl_ext.REPOSITORY.ID."""
        bpy.ops.preferences.addon_disable(module="relamp_addon")
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(FOLDER, f"{folder}/bl_ext/user_default/relamp")
            sys.path.insert(0, folder)
            try:
                extension = importlib.import_module("bl_ext.user_default.relamp")
                extension.register()
                self.assertEqual(extension.preferences.Preferences.bl_idname,
                                 "bl_ext.user_default.relamp")
                self.assertTrue(hasattr(bpy.types, "RELAMP_PT_delight"))
                extension.unregister()
                self.assertFalse(hasattr(bpy.types, "RELAMP_PT_delight"))
                self.assertFalse(hasattr(bpy.types.Scene, "relamp"))
            finally:
                sys.path.remove(folder)
                bpy.ops.preferences.addon_enable(module="relamp_addon")

    def test_it_imports_itself_by_relative_names_alone(self):
        for name in os.listdir(FOLDER):
            if name.endswith(".py"):
                with open(f"{FOLDER}/{name}", encoding="utf-8") as file:
                    found = re.search(r"^\s*(import|from) relamp", file.read(), re.M)
                self.assertIsNone(found, name)


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(word) for word in version.split("."))
