"""Places in a room, as people name them."""

from __future__ import annotations

from typing import Iterable, List, Sequence, Tuple

import numpy as np

Place = Sequence[float]


def is_finite(numbers: Sequence[float]) -> bool:
    """Whether they are, also as the library's floats, which end at 3.4e38."""
    return bool((np.abs(np.asarray(numbers, dtype=np.float64)) <= np.finfo(np.float32).max).all())


def places_of(keyword: str, places: Iterable[Place]) -> List[Tuple[float, ...]]:
    """Those that `keyword` names; ValueError where one is not three finite numbers."""
    found = [tuple(float(number) for number in place) for place in places]
    if any(len(place) != 3 or not is_finite(place) for place in found):
        raise ValueError(f"{keyword}: a place is three finite numbers, in metres")
    return found


def ends_of(keyword: str, pairs: Iterable[Tuple[Place, Place]]) -> List[Tuple[float, ...]]:
    """Both places of each pair, one after the other."""
    found = list(pairs)
    if any(len(pair) != 2 for pair in found):
        raise ValueError(f"{keyword}: each is a pair of places, ((x, y, z), (x, y, z))")
    return places_of(keyword, [end for pair in found for end in pair])
