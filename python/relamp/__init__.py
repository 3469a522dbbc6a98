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
from .lights import Fixture, Lights, Sun
from .relit import Camera, Relit
from .room import CrossValidation, Page, Room

__all__ = [
    "Camera",
    "CrossValidation",
    "Error",
    "Fixture",
    "Lights",
    "Page",
    "Relit",
    "Room",
    "Scan",
    "Sun",
    "__version__",
    "delight",
    "read_scan",
]
for _public in (Error, Scan, read_scan):
    _public.__module__ = "relamp"
