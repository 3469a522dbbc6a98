"""What run.sh runs inside Blender, with arguments ARCHIVE MODULE."""

import os
import sys
import unittest

import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # which Blender's importer asks for, and Debian's numpy has no more
import bpy  # noqa: E402

archive, module = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module="relamp_addon")
assert "relamp_addon" in bpy.context.preferences.addons, "the archive is no add-on"

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
if module == "test_window":
    __import__(module).begin()  # and goes on once there is a window
else:
    suite = unittest.defaultTestLoader.loadTestsFromName(module)
    assert suite.countTestCases() > 0
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(suite)
    if not result.wasSuccessful():
        sys.exit(1)
