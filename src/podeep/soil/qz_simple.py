"""QzSimple1: a tip with a far field, a yielding near field, and a gap that opens with suction."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from .near_field import Rigid, turned
from .series import Series

_LONGEST = 0.7  # qult: longest rigid range
_SHUT, _OPEN = 1000.0, 1e-6  # qult/z50: stiffness of the closure
_MOST_SUCTION = 0.1


class _Type(NamedTuple):
    elastic: float  # ke z50/qult
    range: float  # Cr
    way: float  # c/z50
    power: float  # n


TYPES: Mapping[int, _Type] = MappingProxyType(
    {1: _Type(0.525, 0.2, 0.35, 1.2), 2: _Type(1.39, 0.3, 12.3, 5.5)}
)


class QzSimple(Series):
    """Reaction of a tip with memory, suction and gap, positive in compression: `Series` with

        range      +-Cr qult of slope 1e4 qult/z50; at a reversal after yield as long as the way
                   that yield came from the other end, 0.7 qult at most
        closure    1000 qult/z50 where shut, 1e-6 qult/z50 where open
        drag       suction Q = Cs qult, w = z50/2

    Type 1 (clay, Reese and O'Neill 1987): ke = 0.525 qult/z50, Cr = 0.2, c = 0.35 z50, n = 1.2.
    Type 2 (sand, Vijayvergiya 1977): 1.39, 0.3, 12.3 z50, 5.5.

    ultimate qult (N), z50 (m): (n,), positive. suction Cs (-), 0 to 0.1.
    Source: Boulanger et al. (1999), QzSimple1 of OpenSees, without its dashpot.
    """

    kept: ClassVar[tuple[str, ...]] = (*Series.kept, "length")

    def __init__(self, ultimate: Array, z50: Array, kind: int, suction: float = 0.0) -> None:
        of = TYPES[kind]
        self.peak, self.z50 = ultimate, z50
        self.far, self.slope = of.elastic * ultimate / z50, 1e4 * ultimate / z50
        self.c, self.n = of.way * z50, of.power
        self.most_drag = min(max(suction, 1e-12), _MOST_SUCTION) * ultimate
        self.drag_way = 0.5 * z50
        self.length = 2.0 * of.range * ultimate
        self._start(of.range * ultimate)

    def _turned(self, rigid: Rigid, force: Array, at: Array) -> Rigid:
        return turned(rigid, force, at, self.slope, self._length(rigid, force), np.array(-np.inf))

    def _length(self, rigid: Rigid, force: Array) -> Array:
        """Of the range that a reversal from the positive side begins."""
        longer = np.minimum(np.maximum(self.length, force - rigid.left), _LONGEST * self.peak)
        return np.where(force > rigid.right, longer, self.length)

    def _closure(self, gap: Array, inner: Array) -> tuple[Array, Array, Array]:
        k = np.where(gap >= 0.0, _SHUT, _OPEN) * self.peak / self.z50
        return k * gap, k, np.zeros(len(gap))

    def _closure_energy(self) -> Array:
        force, k, _ = self._closure(self.gap, self.gap)
        return 0.5 * np.square(force) / k

    def commit(self, u: Array) -> None:
        rigid, down = Rigid(*self.ranges), u < self.u
        turned_down = self._length(rigid, self.force)
        turned_up = self._length(rigid.mirrored(), -self.force)
        length = np.where(u > self.u, turned_up, np.where(down, turned_down, self.length))
        super().commit(u)
        self.length = length
