"""Takes the light out of a scanned room: albedo, lamps and shading as NumPy arrays.

    import relamp
    room = relamp.delight("kitchen.glb")
    room.albedo          # (H, W, 3) float32, linear: what the surfaces are painted with
    room.shading         # (H, W, 3) float32: the light that was taken out, irradiance / pi
    room.lights.fixtures # the lamps and windows that were on
    room.save("kitchen") # all that the program `relamp delight` writes

Of several texture pages `room.pages` has each. What goes wrong with a file is a relamp.Error whose
text names the file, the thing in it and the way out; a wrong argument is a ValueError.
"""

from ._relamp import Error, Scan, __version__, read_scan
from .delight import delight
from .inspection import Cost, Inspection, PageInspection, inspect
from .lights import Fixture, Lights, Sun
from .page import DOUBTS, Page
from .relit import Camera, Relit
from .room import CameraModel, CrossValidation, Opening, Room
from .verification import Verification, VerifiedBin, verify

__all__ = [
    "DOUBTS",
    "Camera",
    "CameraModel",
    "Cost",
    "CrossValidation",
    "Error",
    "Fixture",
    "Inspection",
    "Lights",
    "Opening",
    "Page",
    "PageInspection",
    "Relit",
    "Room",
    "Scan",
    "Sun",
    "Verification",
    "VerifiedBin",
    "__version__",
    "delight",
    "inspect",
    "read_scan",
    "verify",
]
for _public in (Error, Scan, read_scan):
    _public.__module__ = "relamp"
