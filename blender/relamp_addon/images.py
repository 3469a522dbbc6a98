"""Pictures of a result as images of Blender, kept within its file."""

from __future__ import annotations

import bpy
import numpy

from .errors import Refusal


def load(path: str, name: str, colour_space: str) -> bpy.types.Image:
    """Reads a picture and packs it, for the folder that it lies in may go."""
    try:
        image = bpy.data.images.load(path)
    except RuntimeError as error:
        raise Refusal(f"{path} cannot be read: {error}") from error
    image.name = name
    image.colorspace_settings.name = colour_space
    image.pack()
    return image


def from_array(name: str, values: numpy.ndarray, is_float: bool) -> bpy.types.Image:
    """An image of numbers, not of colours: (height, width, up to 3), rows from below."""
    height, width, channels = values.shape
    image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=is_float)
    image.colorspace_settings.name = "Non-Color"
    whole = numpy.zeros((height, width, 4), numpy.float32)
    whole[..., :channels] = values
    whole[..., 3] = 1
    image.pixels.foreach_set(whole.ravel())
    image.pack()
    return image
