"""Springs of Boulanger et al. (1999): far field, near field and gap, one after the other."""

from abc import abstractmethod
from dataclasses import fields
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from .approach import ROUNDING, reached, recoverable, root
from .memory import Memory
from .near_field import Rigid, chosen, displaced, rigid_between

_SHY = 1e-12  # of the peak, which is never quite reached


class Place(NamedTuple):
    """Where a displacement leads: sense of motion, force, derivative, near field, gap, drag."""

    sense: Array
    force: Array
    stiffness: Array
    rigid: Rigid
    near: Array
    gap: Array
    drag: Array


class Series(Memory):
    """u = ue + un + ug under one force p.

        far field   p = ke ue
        near field  rigid within a range of force; beyond its end (p0, un0)
                    p = +-peak -+ (peak -+ p0) [c / (c + |un - un0|)]^n
        gap         p = q(ug) + closure(ug); drag q = +-Q -+ (Q -+ q0) w / (w + |ug - ug0|)

    (q0, ug0): where the gap turned last. What the range becomes at a reversal after yield, and the
    closure, are those of each spring. Every element is followed exactly along a straight path of
    any length, but for a gap that turns on it: long steps then miss 0.1 % of the peak of PySimple1.
    One unknown, the force, is found by Newton's steps and halving.

    Energy lost is the work by the trapezoidal rule over the committed path, less what is stored.
    """

    kept: ClassVar[tuple[str, ...]] = (
        "u", "force", "near", "gap", "drag", "start", "start_drag", "sense", "drag_sense",
        "worked", "ranges",
    )  # fmt: skip

    peak: Array
    far: Array  # stiffness of the far field, N/m
    slope: Array  # stiffness within the rigid range, N/m
    c: Array
    n: float
    most_drag: Array
    drag_way: Array

    def _start(self, rigid: Array) -> None:
        """At rest, with a rigid range of +-rigid."""
        zero = np.zeros(len(self.peak))
        self.u, self.force, self.near, self.gap = (zero.copy() for _ in range(4))
        self.drag, self.start, self.start_drag, self.worked = (zero.copy() for _ in range(4))
        self.sense, self.drag_sense = np.ones(len(zero)), np.ones(len(zero))
        self.ranges = _stacked(rigid_between(-rigid, rigid, self.slope))

    @abstractmethod
    def _turned(self, rigid: Rigid, force: Array, at: Array) -> Rigid:
        """The range when motion turns from the positive side at a force, if it has yielded."""

    @abstractmethod
    def _closure(self, gap: Array, inner: Array) -> tuple[Array, Array, Array]:
        """Force at a gap and at a displacement inner = un + ug, and its two derivatives."""

    @abstractmethod
    def _closure_energy(self) -> Array:
        """What the closure has stored."""

    def _move(self, gap: Array, inner: Array) -> None:
        """The closure remembers where it has been."""

    def _place(self, u: Array) -> Place:
        sense = np.where(u == self.u, self.sense, np.sign(u - self.u))
        # the near field as motion sees it: going on, or turned from the side behind
        ahead, behind = Rigid(*self.ranges), Rigid(*self.ranges).mirrored()
        down = self._turned(ahead, self.force, self.near)  # seen along +, motion along -
        up = self._turned(behind, -self.force, -self.near)  # seen along -, motion along +
        rising = sense > 0.0
        rigid = chosen(rising, up.mirrored(), down)
        seen = chosen(rising, rigid, rigid.mirrored())

        def parts(x: Array) -> tuple[Array, Array, Array, Array, Array, Array, Array]:
            p = sense * x
            near, rate = displaced(x, seen, self.peak, self.slope, self.c, self.n)
            near = sense * near
            inner = u - p / self.far
            gap = inner - near
            drag, kd = self._dragged(gap)
            closure, kg, ki = self._closure(gap, inner)
            return near, gap, drag, closure, kd + kg, ki, rate

        def excess(x: Array) -> tuple[Array, Array]:
            _, _, drag, closure, kg, ki, rate = parts(x)
            value = x - sense * (drag + closure)
            return value, 1.0 + kg * (1.0 / self.far + rate) + ki / self.far

        limit = self.peak * (1.0 - _SHY)
        low, high = np.minimum(sense * self.force, limit), limit
        noise = ROUNDING * (self.far * np.abs(u) + np.abs(self.force))
        x = root(excess, low, high, low, noise)
        near, gap, drag, _, kg, ki, rate = parts(x)
        rise = 1.0 + kg * (1.0 / self.far + rate) + ki / self.far
        return Place(sense, sense * x, (kg + ki) / rise, rigid, near, gap, drag)

    def _dragged(self, gap: Array) -> tuple[Array, Array]:
        """Drag at a gap: the gap may turn while the pile goes on, as the soil behind stays back."""
        back = (gap - self.gap) * self.drag_sense < 0.0
        sense = np.where(back, -self.drag_sense, self.drag_sense)
        start = np.where(back, self.gap, self.start)
        base = sense * np.where(back, self.drag, self.start_drag)
        way = np.maximum(sense * (gap - start), 0.0)
        force, stiffness = reached(self.most_drag, base, way, self.drag_way, 1.0)
        return sense * force, stiffness

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        place = self._place(u)
        return place.force, place.stiffness

    def commit(self, u: Array) -> None:
        place = self._place(u)
        moved = u != self.u
        turns = moved & ((place.gap - self.gap) * self.drag_sense < 0.0)
        self.start = np.where(turns, self.gap, self.start)
        self.start_drag = np.where(turns, self.drag, self.start_drag)
        self.drag_sense = np.where(turns, -self.drag_sense, self.drag_sense)
        self.worked = self.worked + 0.5 * (self.force + place.force) * (u - self.u)
        self.ranges = np.where(moved, _stacked(place.rigid), self.ranges)
        self.force = np.where(moved, place.force, self.force)
        self.near = np.where(moved, place.near, self.near)
        self.gap = np.where(moved, place.gap, self.gap)
        self.drag = np.where(moved, place.drag, self.drag)
        self.sense, self.u = place.sense, np.array(u)
        self._move(self.gap, self.near + self.gap)

    @property
    def dissipated(self) -> Array:
        elastic = 0.5 * np.square(self.force) * (1.0 / self.far + 1.0 / self.slope)
        start = np.where(self.drag * self.drag_sense < 0.0, self.start_drag, self.drag)
        drag = recoverable(self.most_drag, self.drag, start, self.drag_way, 1.0)
        return self.worked - elastic - drag - self._closure_energy()


def _stacked(rigid: Rigid) -> Array:
    return np.array([getattr(rigid, f.name) for f in fields(rigid)])
