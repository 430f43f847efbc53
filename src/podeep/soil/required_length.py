"""The embedded length that a pile needs under given axial loads."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import zip_longest
from math import ceil
from typing import Literal

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from ..scene import Section
from .axial_capacity import Flags, PileCapacity, Plug, axial_capacity
from .profile import Profile

_STEP = 0.1  # of the scan, m
_CLOSE = 1e-9  # lengths that are told apart, m
_PARTS = 16  # of an interval in which something changes


@dataclass(frozen=True, eq=False, kw_only=True)
class RequiredLength:
    """The smallest embedded length that holds, and what is said beside it.

    length: m; None where no length in the range holds. governing: which load leaves the lesser
    margin at that length, or at the end of the range. failing_again: intervals of greater length
    that fail, each from the last length that holds to the next that does, or to the end of the
    range. scanned: shortest and longest length looked at, m. capacity: at the length, or at the
    end of the range.
    """

    length: float | None
    governing: Literal["compression", "tension"]
    failing_again: tuple[tuple[float, float], ...]
    scanned: tuple[float, float]
    capacity: PileCapacity


def required_length(
    profile: Profile,
    sections: Sequence[Section],
    longest: float,
    *,
    compression: float = 0.0,
    tension: float = 0.0,
    compression_safety: float = 2.0,
    tension_safety: float = 2.0,
    weigh_pile: bool = True,
    shortest: float = 0.0,
    plug: Plug = "AUTO",
    tension_factor: float = 1.0,
    water_density: float = 1025.0,
    gravity: float = 9.80665,
    mudline: float = 0.0,
) -> RequiredLength:
    """The smallest length between `shortest` and `longest` (m) that bears both loads.

        compression   capacity / safety >= load + W (+ Wp if plugged)    with `weigh_pile`
        tension       capacity / safety >= load                          capacity has W (and Wp)

    compression, tension: loads at the mudline, N, none negative. Plugged and unplugged pile each
    meet their own weight, and both must hold where `plug` is AUTO. Capacity is not monotone in
    length: end bearing falls where a weaker layer begins. So lengths are scanned every 0.1 m and
    on both sides of every boundary, and each change is then narrowed down to 1e-9 m; a length
    that holds over less than 0.1 m within a layer may be overlooked. For the rest see
    `axial_capacity`.

    Source: API RP 2A-WSD 6.3.4 (safety 2.0 in operating, 1.5 in extreme conditions).
    """
    _check((compression, tension), (compression_safety, tension_safety), (shortest, longest))
    capacity = partial(
        axial_capacity,
        profile,
        sections,
        plug=plug,
        tension_factor=tension_factor,
        water_density=water_density,
        gravity=gravity,
        mudline=mudline,
    )

    def margins(at: PileCapacity) -> tuple[Array, Array]:
        pile, soil = (at.pile_weight, at.plug_weight) if weigh_pile else (0.0, 0.0)
        pressed = at.governing(
            at.compression_plugged / compression_safety - compression - pile - soil,
            at.compression_unplugged / compression_safety - compression - pile,
        )
        if not compression:  # nothing presses: own weight is no demand of itself
            pressed = np.full_like(pressed, np.inf)
        return pressed, at.tension / tension_safety - tension

    def holds(length: Array) -> Flags:
        pressed, pulled = margins(capacity(length))
        return np.minimum(pressed, pulled) >= 0.0

    steps = ceil((longest - shortest) / _STEP) + 1
    changes = np.array([*profile.boundaries, *(mudline - s.bottom for s in sections)])
    both_sides = np.append(changes, np.nextafter(changes, np.inf))
    inside = both_sides[(both_sides > shortest) & (both_sides < longest)]
    grid = np.union1d(np.linspace(shortest, longest, steps), inside)
    held = holds(grid)
    turns = [
        _last_held(holds, grid[i], grid[i + 1], bool(held[i]))
        for i in np.flatnonzero(held[:-1] != held[1:]).tolist()
    ]
    # where it starts to hold, stops, starts again and so on
    edges = [shortest, *turns] if held[0] else turns
    length, again = (edges[0], edges[1:]) if edges else (None, [])
    at = capacity(np.array([longest if length is None else length]))
    pressed, pulled = margins(at)
    decided = bool(pressed[0] <= pulled[0])  # by compression
    return RequiredLength(
        length=length,
        governing="tension" if tension and not (compression and decided) else "compression",
        failing_again=tuple(zip_longest(again[::2], again[1::2], fillvalue=longest)),
        scanned=(shortest, longest),
        capacity=at,
    )


def _check(loads: Sequence[float], safeties: Sequence[float], scanned: Sequence[float]) -> None:
    if not min(loads) >= 0.0:
        raise InvalidData(
            f"a load of {min(loads):g} N is negative",
            "give compression and tension each by its magnitude",
        )
    if not min(safeties) > 0.0:
        raise InvalidData(
            f"a safety factor of {min(safeties):g} is not positive", "give 1 or more as a rule"
        )
    if not 0.0 <= scanned[0] < scanned[1]:
        raise InvalidData(
            f"there is no length between {scanned[0]:g} and {scanned[1]:g} m",
            "give the longest length above the shortest, which is not below 0",
        )


def _last_held(holds: Callable[[Array], Flags], a: float, b: float, first: bool) -> float:
    """The length that holds, of two next to each other between a and b of which one does.

    first: whether it is a that holds, then b does not.
    """
    while b - a > _CLOSE:
        grid = np.linspace(a, b, _PARTS + 1)
        changed = holds(grid) != first
        changed[-1] = True  # as was found before: rounding must not tell otherwise
        after = max(int(np.argmax(changed)), 1)
        a, b = float(grid[after - 1]), float(grid[after])
    return float(a if first else b)
