"""Blender's world, in scene units with Z up, and relamp's, in metres with Y up."""

from __future__ import annotations

import bpy
import numpy


def metres_per_unit(scene: bpy.types.Scene) -> float:
    return scene.unit_settings.scale_length or 1.0


def to_relamp(points: numpy.ndarray) -> numpy.ndarray:
    """(N, 3) vectors with Z up to vectors with Y up; lengths stay."""
    return numpy.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


def to_blender(points: numpy.ndarray) -> numpy.ndarray:
    """(N, 3) vectors with Y up to vectors with Z up; lengths stay."""
    return numpy.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)


def transformed(matrix, points: numpy.ndarray) -> numpy.ndarray:
    """(N, 3) points by a 4 x 4 matrix of Blender's."""
    by = numpy.array(matrix)
    return points @ by[:3, :3].T + by[:3, 3]
