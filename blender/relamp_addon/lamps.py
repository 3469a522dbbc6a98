"""Lights of Blender that stand for the lamps and windows that relamp found.

What a watt is to Cycles (tests/test_units.py measures it): a point light of W watts has the radiant
intensity W / (4 pi), so that it sends W in all; an area light has W / 4 along its normal, whatever
its shape, so that its radiance is W / (4 area); a sun has the irradiance W on what faces it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import bpy
import numpy
from mathutils import Matrix, Vector

from . import places
from .faces import Samples
from .result import Lamp, Result

ONE_SIDED = 0.9  # length of the mean normal from which on a lamp is one light; a flat one has 1
ROUND = 0.15  # below which it is a ball; half a ball has 0.5, a whole one 0
LEAST = 0.03  # share of a lamp that is worth a light of its own
FULL = 0.85  # share of its rectangle that a lamp fills, if it is one; an ellipse fills 0.79
CLEARANCE = 0.005  # m, of an area light before the surface that it stands for


@dataclass
class Shape:
    """Of a flat lamp: where it is, and how large."""

    centre: numpy.ndarray
    axes: numpy.ndarray  # rows: along its width, its height, its normal
    size: tuple[float, float]
    is_ellipse: bool


def new_lights(result: Result, samples: list[Samples], unit: float) -> list[bpy.types.Object]:
    """Of all lamps. `unit`: metres of a unit of Blender's."""
    lights = []
    for number, lamp in enumerate(result.lamps, 1):
        lights += lights_of(lamp, lamp_samples(samples, number), unit)
    for light in lights:
        light.visible_camera = False  # the lamp's surface is seen instead
    return lights


def lights_of(lamp: Lamp, samples: Samples, unit: float) -> list[bpy.types.Object]:
    """`samples` are those of its surface, none where the scan does not show it."""
    area = lamp.area / unit**2
    if not len(samples.area):
        if lamp.normal is None or area <= 0:
            return [_ball(lamp, area, unit)]
        return [area_light(lamp.name, _disc(lamp, area, unit), lamp.radiance)]
    mean = numpy.average(samples.normal, axis=0, weights=samples.area)
    length = numpy.linalg.norm(mean)
    # A far side faces the other way.
    if length * (1 - 2 * lamp.unseen / max(lamp.area, 1e-9)) < ROUND:
        return [_ball(lamp, area, unit)]
    pieces = [samples] if length > ONE_SIDED else _sides(samples, mean / length)
    lights = []
    for piece in pieces:
        share = piece.area.sum() / samples.area.sum()
        name = lamp.name if not lights else f"{lamp.name} side {len(lights)}"
        shape = _flat(piece, area * share, unit)
        light = area_light(name, shape, lamp.radiance)
        if lights:  # they are moved and turned together
            light.parent = lights[0]
            light.matrix_parent_inverse = lights[0].matrix_world.inverted()
        lights.append(light)
    return lights


def _ball(lamp: Lamp, area: float, unit: float) -> bpy.types.Object:
    light = bpy.data.lights.new(lamp.name, "POINT")
    light.shadow_soft_size = math.sqrt(max(area, 0) / (4 * math.pi))
    # Shadow rays pass the lamp's surface, which the light stands in; rays that come upon it do
    # not, and Cycles must not count on them to find the light.
    if hasattr(light, "cycles"):
        light.cycles.use_multiple_importance_sampling = False
    set_power(light, math.pi * area * lamp.radiance)
    thing = bpy.data.objects.new(lamp.name, light)
    thing.location = places.to_blender(lamp.centre[None])[0] / unit
    return thing


def _sides(samples: Samples, normal: numpy.ndarray) -> list[Samples]:
    """The front of a lamp first, then those of its four sides that are worth a light."""
    front = samples.of(samples.normal @ normal > 0.7)
    width, height = _narrowest(front.place, across_of(normal))[:2] if len(front.area) \
        else across_of(normal)
    faces = numpy.array([normal, width, -width, height, -height])
    nearest = (samples.normal @ faces.T).argmax(axis=1)
    share = numpy.bincount(nearest, samples.area, len(faces)) / samples.area.sum()
    kept = [side for side in range(1, len(faces)) if share[side] > LEAST]
    others = [side for side in range(len(faces)) if side not in kept]
    pieces = [samples.of(numpy.isin(nearest, others)), *(samples.of(nearest == k) for k in kept)]
    return [piece for piece in pieces if len(piece.area)]


def area_light(name: str, shape: Shape, radiance: numpy.ndarray) -> bpy.types.Object:
    light = bpy.data.lights.new(name, "AREA")
    light.shape = "ELLIPSE" if shape.is_ellipse else "RECTANGLE"
    light.size, light.size_y = shape.size
    share = math.pi / 4 if shape.is_ellipse else 1
    set_power(light, 4 * shape.size[0] * shape.size[1] * share * radiance)
    thing = bpy.data.objects.new(name, light)
    width, height, normal = (Vector(axis) for axis in shape.axes)
    turn = Matrix((width, height, -normal)).transposed()  # a light shines along its -Z
    if turn.determinant() < 0:
        turn = Matrix((-width, height, -normal)).transposed()
    thing.matrix_world = Matrix.Translation(Vector(shape.centre)) @ turn.to_4x4()
    return thing


def new_sun(sun: dict) -> bpy.types.Object:
    light = bpy.data.lights.new("sun", "SUN")
    light.angle = math.radians(0.53)
    set_power(light, numpy.array(sun["irradiance"], float))
    thing = bpy.data.objects.new("sun", light)
    towards = places.to_blender(numpy.array([sun["direction"]], float))[0]
    thing.rotation_euler = Vector(towards).to_track_quat("Z", "Y").to_euler()
    return thing


def set_power(light: bpy.types.Light, watts: numpy.ndarray) -> None:
    """Power of each channel, as power and colour."""
    most = float(watts.max())
    light.energy = most
    if most > 0:
        light.color = watts / most


def lamp_samples(all_samples: list[Samples], number: int) -> Samples:
    """Those of one lamp, of all objects."""
    own = [one.of(one.lamp == number) for one in all_samples]
    if not own:
        return Samples(numpy.empty((0, 3)), numpy.empty((0, 3)), numpy.empty(0), numpy.empty(0))
    return Samples(*(numpy.concatenate([getattr(one, name) for one in own])
                     for name in ("place", "normal", "area", "lamp")))


def _disc(lamp: Lamp, area: float, unit: float) -> Shape:
    normal = places.to_blender(lamp.normal[None])[0]
    side = 2 * math.sqrt(area / math.pi)
    axes = numpy.array([*across_of(normal), normal])
    return Shape(places.to_blender(lamp.centre[None])[0] / unit, axes, (side, side), True)


def _flat(samples: Samples, area: float, unit: float) -> Shape:
    mean = numpy.average(samples.normal, axis=0, weights=samples.area)
    normal = mean / numpy.linalg.norm(mean)
    middle = numpy.average(samples.place, axis=0, weights=samples.area)
    away = samples.place - middle
    width, height, low, high = _narrowest(away, across_of(normal))
    extent = numpy.maximum(high - low, 0.01 * math.sqrt(area))  # of a few samples it may be 0
    fills = samples.area.sum() / float(extent.prod())
    before = float((away @ normal).max()) + CLEARANCE / unit
    centre = middle + normal * before + numpy.array([width, height]).T @ ((low + high) / 2)
    is_ellipse = fills < FULL
    # The area is relamp's; only the proportions are those of its surface.
    grown = math.sqrt(area / (extent.prod() * (math.pi / 4 if is_ellipse else 1)))
    return Shape(centre, numpy.array([width, height, normal]), tuple(extent * grown), is_ellipse)


def across_of(normal: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Two axes at right angles to a normal and to each other; the first is level."""
    helper = [0, 0, 1] if abs(normal[2]) < 0.9 else [0, 1, 0]
    first = numpy.cross(helper, normal)
    first /= numpy.linalg.norm(first)
    return first, numpy.cross(normal, first)


def _narrowest(away: numpy.ndarray, axes) -> tuple[numpy.ndarray, ...]:
    """Axes of the smallest rectangle around nearly all places, and its ends."""
    best = None
    for turn in numpy.radians(numpy.arange(0, 90, 3)):
        width = math.cos(turn) * axes[0] + math.sin(turn) * axes[1]
        height = math.cos(turn) * axes[1] - math.sin(turn) * axes[0]
        on = away @ numpy.array([width, height]).T
        low, high = numpy.quantile(on, [0.005, 0.995], axis=0)
        area = float((high - low).prod())
        if best is None or area < 0.98 * best[0]:  # a level one unless another is clearly smaller
            best = (area, width, height, low, high)
    return best[1:]
