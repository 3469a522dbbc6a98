"""The light of a room as `relamp.delight` finds it (docs/guide/lights.md)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Tuple

from . import _relamp

Triple = Tuple[float, float, float]


@dataclass(frozen=True)
class Fixture:
    """Something that shines by itself: a lamp, a panel, a window pane.

    Places are in metres, radiance is RGB with 1 for the texture's white.
    """

    id: int  #: its number in lights.json and in Page.fixtures
    name: str  #: "ceiling lamp 1"
    centre: Triple  #: m
    normal: Triple  #: unit; (0, 0, 0) where it shines all around
    area: float  #: m^2
    radiance: Triple
    power: Triple  #: pi * radiance * area
    error: Triple  #: standard error of the logarithm of power; 0 where none is known
    determined: bool  #: False: the scan does not tell its radiance, which is a guess


@dataclass(frozen=True)
class Sun:
    """The sun, where it shines into the room."""

    direction: Triple  #: unit, from the room to the sun
    irradiance: Triple  #: on a surface that faces it, radiance * sr
    determined: bool  #: False: irradiance is a lower bound


@dataclass(frozen=True)
class Lights:
    """All light of a room."""

    fixtures: Tuple[Fixture, ...]
    sun: Optional[Sun]
    ambient: Triple  #: radiance of what lies outside, seen through the scan's holes
    json: str  #: the text of lights.json


def lights_of(found: _relamp.Lights) -> Lights:
    """What Python sees of the library's lights."""
    return Lights(
        fixtures=tuple(Fixture(**fixture) for fixture in found.fixtures),
        sun=Sun(**found.sun) if found.sun else None,
        ambient=found.ambient,
        json=found.to_json(),
    )
