"""One texture of a room that `relamp.delight` took apart, as arrays."""

from __future__ import annotations

import threading
from typing import Any, Callable, Dict, Tuple

import numpy as np
import numpy.typing as npt

from . import _relamp

Array = npt.NDArray[Any]

#: Names of what can speak against an albedo; Page.doubt has their numbers.
DOUBTS: Tuple[str, ...] = _relamp.DOUBTS


def _frozen(values: Array) -> Array:
    values.flags.writeable = False
    return values


class Page:
    """One texture of a room. Arrays have its size, row 0 on top, and are read-only.

    They are computed when the first is asked for, once, and every later look at them is at the same
    memory, which an array keeps for as long as it is used, whether the room is or not.
    """

    def __init__(self, decomposition: _relamp.Decomposition, index: int, threads: int) -> None:
        self._decomposition = decomposition
        self._index = index
        self._threads = threads
        self._lock = threading.RLock()
        self._made: Dict[str, Any] = {}

    def _once(self, name: str, make: Callable[[], Any]) -> Any:
        with self._lock:
            if name not in self._made:
                self._made[name] = make()
            return self._made[name]

    def _layers(self) -> Dict[str, Array]:
        """The library's half floats and bytes."""
        made: Dict[str, Array] = self._once(
            "layers", lambda: self._decomposition.layers(self._index, self._threads, None)
        )
        return made

    def _float(self, name: str) -> Array:
        """A layer as floats; only those that are asked for are made."""
        return _frozen(self._layers()[name].astype(np.float32))

    def _layer(self, name: str) -> Array:
        made: Array = self._once(name, lambda: self._float(name))
        return made

    def _geometry(self) -> Tuple[Array, Array]:
        made: Tuple[Array, Array] = self._once(
            "geometry", lambda: self._decomposition.geometry(self._index, self._threads)
        )
        return made

    @property
    def albedo(self) -> Array:
        """(H, W, 3) float32, linear, 0..0.87: the colour of the surfaces without any light."""
        return self._layer("albedo")

    @property
    def direct(self) -> Array:
        """(H, W, 3) float32: irradiance / pi straight from the lamps, windows and the sun."""
        return self._layer("direct")

    @property
    def indirect(self) -> Array:
        """(H, W, 3) float32: irradiance / pi by way of other surfaces, and through holes."""
        return self._layer("indirect")

    @property
    def shading(self) -> Array:
        """(H, W, 3) float32: direct + indirect. Times the albedo it is the scan, linear."""
        made: Array = self._once("shading", lambda: _frozen(self.direct + self.indirect))
        return made

    @property
    def confidence(self) -> Array:
        """(H, W) float32, 0 (albedo is a guess) to 1. Source: docs/method/confidence.md."""
        made: Array = self._once(
            "confidence", lambda: _frozen(self._float("confidence") / np.float32(255))
        )
        return made

    @property
    def doubt(self) -> Array:
        """(H, W) uint8: what speaks most against the albedo where confidence is below 0.5.

        `relamp.DOUBTS[number]` is its name, as reasons.png and report.json have it; 0: nothing does.
        """
        return _frozen(self._layers()["doubt"])

    @property
    def correction(self) -> Array:
        """(H, W) float32, 0..1.275: shading is the light that the mesh tells of, times this.

        Below 1 where the mesh lets light in, above where it throws a shadow that the texture does
        not show; 0 where no surface is. 1 everywhere by solvers that correct nothing.
        Source: docs/method/light_correction.md.
        """
        made: Array = self._once("correction", self._correction)
        return made

    def _correction(self) -> Array:
        share = self._decomposition.correction(self._index, self._threads)
        if share is None:
            return _frozen(np.ones(self.albedo.shape[:2], np.float32))
        return _frozen(share.astype(np.float32) / np.float32(_relamp.ALL_LIGHT))

    @property
    def emission(self) -> Array:
        """(H, W, 3) float32: radiance of what shines by itself, as lights.json has it; else 0."""
        made: Array = self._once("emission", self._emission)
        return made

    def _emission(self) -> Array:
        found = self._decomposition.lights.fixtures
        radiance = np.zeros((max((lamp["id"] for lamp in found), default=-1) + 2, 3), np.float32)
        for lamp in found:
            radiance[lamp["id"]] = lamp["radiance"]
        return _frozen(radiance[np.where(self.fixtures >= 0, self.fixtures, -1)])

    @property
    def fixtures(self) -> Array:
        """(H, W) int32: the id of the lamp or window; -1 none, -2 burnt out and no lamp."""
        made: Array = self._once(
            "fixtures", lambda: self._decomposition.fixtures(self._index, self._threads)
        )
        return made

    @property
    def positions(self) -> Array:
        """(H, W, 3) float32: where texels lie in the world, m; 0 where no surface is."""
        return self._geometry()[0]

    @property
    def normals(self) -> Array:
        """(H, W, 3) float32, unit; 0 where no surface is."""
        return self._geometry()[1]

    def __repr__(self) -> str:
        return f"<relamp.Page {self._index} of {self._decomposition.name!r}>"
