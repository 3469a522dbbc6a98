"""Images as arrays, inside Blender 3.4."""
import bpy
import numpy


def pixels(image):
    """RGB, rows as Blender counts them: from below."""
    values = numpy.empty(image.size[0] * image.size[1] * image.channels, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], -1)[..., :3].astype(float)


def float_image(name, width, height):
    image = bpy.data.images.new(name, width, height, float_buffer=True, alpha=False)
    image.colorspace_settings.name = "Non-Color"
    return image


def fill(image, values):
    """Gives the image the RGB values of an array of its size."""
    rgba = numpy.dstack([values, numpy.ones(values.shape[:2])])
    image.pixels.foreach_set(rgba.astype(numpy.float32).ravel())


def save(values, path):
    """Writes RGB values as an EXR of floats."""
    image = float_image("saved", values.shape[1], values.shape[0])
    fill(image, values)
    image.filepath_raw = path
    image.file_format = "OPEN_EXR"
    image.save()
    bpy.data.images.remove(image)
