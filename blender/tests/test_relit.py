"""The proof of units and colours to the end.

The sample, delit and lit by Cycles with the lamps that were found, looks as it was scanned.
"""

import math
import os
import tempfile
import unittest

import numpy
import scenes

UNCLIPPED = 0.97  # of white; what is brighter a texture does not tell
LEAST = 25  # dB
SIZE = (80, 45)


class Relit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scenes.import_sample()
        cls.room = scenes.delight("standard")
        cls.folder = tempfile.TemporaryDirectory()
        scenes.look_by(f"{scenes.SAMPLE}/camera.json", *SIZE)
        cls.room.relamp.mode = "SCANNED"
        shown = scenes.render(16, cls.folder.name)
        cls.scan = shown[..., :3]
        # Told by the scan: not burnt out, and no hole of it, through which one sees outside.
        cls.told = (cls.scan < UNCLIPPED).all(axis=2) & (shown[..., 3] > 0.999)
        assert cls.told.mean() > 0.9

    def psnr(self, mode: str, samples: int) -> float:
        self.room.relamp.mode = mode
        picture = scenes.render(samples, self.folder.name)[..., :3]
        error = (scenes.srgb(picture) - scenes.srgb(self.scan))[self.told]
        psnr = -10 * math.log10(float(numpy.mean(error**2)))
        print(f"{mode}: {psnr:.2f} dB")
        if os.environ.get("RELAMP_PICTURES"):
            numpy.save(f"{os.environ['RELAMP_PICTURES']}/{mode}.npy", picture[::-1])
            numpy.save(f"{os.environ['RELAMP_PICTURES']}/SCANNED.npy", self.scan[::-1])
        return psnr

    def test_by_the_lights_found_it_looks_as_it_was_scanned(self):
        self.assertGreater(self.psnr("LAMPS", 160), LEAST)

    def test_by_the_surfaces_of_its_lamps_it_looks_as_it_was_scanned(self):
        self.assertGreater(self.psnr("SURFACES", 320), LEAST)

