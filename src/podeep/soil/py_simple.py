"""PySimple1: a p-y spring with a far field, a yielding near field and a gap."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from .near_field import Rigid, turned
from .series import Series

_TINY = 1e-30
_SHUT = 0.01  # y50: room at the start
_STIFF = 0.02  # y50: how soft the closure is
_CLOSURE = 1.8  # pult
_REBOUND = 1.5  # y50
_PAST = 0.25  # pult: how far a rigid range reaches beyond zero at least


class _Type(NamedTuple):
    elastic: float  # ke y50/pult
    range: float  # Cr
    way: float  # c/y50
    power: float  # n


TYPES: Mapping[int, _Type] = MappingProxyType(
    {1: _Type(1.0 / (8.0 * 0.35**2), 0.35, 10.0, 5.0), 2: _Type(0.542, 0.2, 0.5, 2.0)}
)


class PySimple(Series):
    """Lateral reaction with memory and gap: `Series` with

        range      +-Cr pult of slope 50 pult/y50; at a reversal after yield 2 Cr pult long from
                   there, 0.25 pult past zero at least
        closure    1.8 pult [ a / (a + yr - yg) - a / (a + yg - yl) ] ,  a = y50/50
        room       yl = -y50/100, or less: min over the past of 1.5 y50 - (yn + yg); yr likewise
        drag       Q = Cd pult, w = y50/2

    Type 1 (clay, near Matlock's curve): ke = pult/(8 Cr^2 y50), Cr = 0.35, c = 10 y50, n = 5.
    Type 2 (sand, near API's): ke = 0.542 pult/y50, Cr = 0.2, c = 0.5 y50, n = 2.

    ultimate pult (N/m), y50 (m): (n,), positive. drag Cd (-).
    Source: Boulanger, Curras, Kutter, Wilson and Abghari, ASCE JGGE 125(9) (1999); PySimple1 of
    OpenSees, without its dashpot.
    """

    kept: ClassVar[tuple[str, ...]] = (*Series.kept, "left", "right")

    def __init__(self, ultimate: Array, y50: Array, kind: int, drag: Array | float) -> None:
        of = TYPES[kind]
        self.peak, self.y50, self.range = ultimate, y50, of.range
        self.far, self.slope = of.elastic * ultimate / y50, 50.0 * ultimate / y50
        self.c, self.n = of.way * y50, of.power
        self.most_drag, self.drag_way = drag * ultimate, 0.5 * y50
        self.left, self.right = -_SHUT * y50, _SHUT * y50
        self._start(of.range * ultimate)

    def _turned(self, rigid: Rigid, force: Array, at: Array) -> Rigid:
        length, past = 2.0 * self.range * self.peak, _PAST * self.peak
        return turned(rigid, force, at, self.slope, length, past)

    def _room(self, inner: Array) -> tuple[Array, Array]:
        rebound = _REBOUND * self.y50
        return np.minimum(self.left, rebound - inner), np.maximum(self.right, -rebound - inner)

    def _closure(self, gap: Array, inner: Array) -> tuple[Array, Array, Array]:
        a, F = _STIFF * self.y50, _CLOSURE * self.peak
        left, right = self._room(inner)
        ahead, behind = a + right - gap, a + gap - left
        bad = (ahead <= 0.0) | (behind <= 0.0)
        ahead, behind = np.maximum(ahead, _TINY), np.maximum(behind, _TINY)
        push, pull = F * a / ahead, F * a / behind
        kr, kl = push / ahead, pull / behind
        # by how much the ends follow a displacement of the soil
        ki = np.where(left < self.left, kl, 0.0) + np.where(right > self.right, kr, 0.0)
        return push - pull, np.where(bad, np.nan, kr + kl), ki

    def _closure_energy(self) -> Array:
        a, F = _STIFF * self.y50, _CLOSURE * self.peak
        ahead, behind = a + self.right - self.gap, a + self.gap - self.left
        return F * a * np.log(np.square(0.5 * (ahead + behind)) / (ahead * behind))

    def _move(self, gap: Array, inner: Array) -> None:
        self.left, self.right = self._room(inner)
