"""The proof of units and colours to the end: the sample, delit and lit by Cycles with what was found, looks as it was scanned."""

import math
import os
import tempfile
import unittest

import bpy
import numpy
import scenes

UNCLIPPED = 0.97  # of white; what is brighter a texture does not tell
LEAST = 25  # dB
SIZE = (96, 54)


class Relit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scenes.import_sample()
        cls.room = scenes.delight("standard")
        cls.folder = tempfile.TemporaryDirectory()
        scenes.look_by(f"{scenes.SAMPLE}/camera.json", *SIZE)
        cls.room.relamp.mode = "SCANNED"
        cls.scan = scenes.render(16, cls.folder.name)

    def psnr(self, mode: str, samples: int) -> float:
        self.room.relamp.mode = mode
        picture = scenes.render(samples, self.folder.name)
        unclipped = (self.scan < UNCLIPPED).all(axis=2)
        self.assertGreater(unclipped.mean(), 0.9)
        error = (scenes.srgb(picture) - scenes.srgb(self.scan))[unclipped]
        psnr = -10 * math.log10(float(numpy.mean(error**2)))
        print(f"{mode}: {psnr:.2f} dB")
        if os.environ.get("RELAMP_PICTURES"):
            bpy.data.images["Render Result"].save_render(
                f"{os.environ['RELAMP_PICTURES']}/{mode}.exr")
        return psnr

    def test_by_the_lights_found_it_looks_as_it_was_scanned(self):
        self.assertGreater(self.psnr("LAMPS", 256), LEAST)

    def test_by_the_surfaces_of_its_lamps_it_looks_as_it_was_scanned(self):
        self.assertGreater(self.psnr("SURFACES", 512), LEAST)

    def test_one_kind_of_lamp_alone_lights_it(self):
        """Both at once would be twice the light; the two kinds agree."""
        self.room.relamp.mode = "LAMPS"
        lamps = scenes.render(32, self.folder.name)
        self.room.relamp.mode = "SURFACES"
        surfaces = scenes.render(64, self.folder.name)
        seen = (self.scan < UNCLIPPED).all(axis=2)
        ratio = numpy.minimum(lamps, 2)[seen].mean() / numpy.minimum(surfaces, 2)[seen].mean()
        self.assertAlmostEqual(ratio, 1, delta=0.15)
