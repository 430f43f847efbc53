"""A curve of equilibria in unknowns and load factor, followed by arc length over peaks and back.

Lengths are relative: sqrt(|dq|^2 / |q|^2 + (w dl)^2), w being what a unit of the load factor l
adds to the forces, as a share of them. Each part of a step is a predictor along the tangent and
Newton in the plane across it (Riks 1979, Wempner 1971).

The way forward along a tangent t is told by the sign of det [K -p; t], which is the same all along
a curve (Allgower and Georg, Introduction to numerical continuation methods, 2003, chapter 2), kinks
of piecewise linear laws included. Angles between one tangent and the next, or the sign of the load
alone, would turn back where a brittle law makes the curve turn sharply.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .bordered import Bordered
from .loaded import Loaded
from .newton import Limits, Scale, largest, unmoved

_ITERATIONS = 20  # of a part; one that needs more is halved
_EASY = 6  # iterations up to which the next part may be twice as long
_HALVINGS = 12
_FAR = 2.0  # chord of a part over its length: more is a jump to another piece of the curve
_FAR_TURN = 40.0  # the same of a part across a sharp kink
_SUMMIT = 14  # halvings of a part for a peak in it
_TURNS = (1.0, 4.0, 16.0)  # lengths of the part across a kink, in smallest parts
_OPPOSITE = 1e-4  # length squared of the sum of two tangents that point against each other
_REST = 1e-6  # share of the run's largest force and unknown below which a state is at rest


class Way(NamedTuple):
    """A direction, or a stretch, in unknowns and load factor."""

    q: Array
    factor: float


@dataclass(frozen=True)
class Point:
    """A point of the curve: unknowns, load factor, internal forces, relative residual, and the
    tangent forward, of length 1."""

    q: Array
    factor: float
    internal: Array
    residual: float
    ahead: Way

    def beyond(self, way: Way, length: float) -> tuple[Array, float]:
        """Where a length along a way leads."""
        return self.q + length * way.q, self.factor + length * way.factor


@dataclass(frozen=True)
class Metric:
    """Lengths on the curve: |q| in m, w of a unit of the load factor."""

    unknown: float
    load: float

    @classmethod
    def at(cls, q: Array, load: float, scale: Scale) -> "Metric":
        """Lengths relative to the unknowns q."""
        size = float(np.linalg.norm(q))
        return cls(max(size, _REST * scale.unknown, 1e-12), max(load, 1e-12))

    def row(self, way: Way) -> tuple[Array, float]:
        """What measures the length along a way of length 1."""
        return way.q / self.unknown**2, way.factor * self.load**2

    def along(self, one: Way, other: Way) -> float:
        """The product of two ways."""
        row, corner = self.row(one)
        return float(row @ other.q) + corner * other.factor

    def unit(self, q: Array, factor: float, sign: float = 1.0) -> Way:
        """The way of length 1."""
        size = sign * np.sqrt(self.along(Way(q, factor), Way(q, factor)))
        return Way(q / size, factor / size)


@dataclass(frozen=True)
class Control:
    """How points of a curve are found: the measure of lengths, the limits, sizes of the run."""

    metric: Metric
    limits: Limits
    scale: Scale

    @np.errstate(over="ignore", invalid="ignore")
    def corrected(
        self, loaded: Loaded, q: Array, factor: float, across: Way
    ) -> tuple[Point, int] | None:
        """The point in the plane through (q, factor) across a way, and the iterations it took."""
        row, corner = self.metric.row(across)
        least = max(_REST * self.scale.force, np.finfo(float).tiny)
        q = q.copy()
        loaded.hold(q, factor)
        for iteration in range(_ITERATIONS):
            internal, residual = loaded.evaluate(q, factor)
            worst, size = largest(residual), max(largest(internal), least)
            if not np.isfinite(worst):
                return None
            done = worst <= self.limits.residual * size
            bordered = Bordered(loaded.system, loaded.pull(), row, corner)
            loaded.work.iterations += 1
            if bordered.sign == 0.0:
                return None
            if not done:
                step, change = bordered.solve(residual, 0.0)
                done = unmoved(loaded.system, q, step, (worst, size), self.limits, self.scale)
            if done:
                along = bordered.solve(np.zeros(len(q)), 1.0)
                ahead = self.metric.unit(*along, bordered.sign)
                return Point(q, factor, internal, worst / size, ahead), iteration
            q, factor = q + step, factor + change
            loaded.hold(q, factor)
        return None

    def tangent(self, loaded: Loaded, row: Array, corner: float) -> Way | None:
        """The tangent forward at the state last evaluated; None where there is no single one."""
        bordered = Bordered(loaded.system, loaded.pull(), row, corner)
        loaded.work.iterations += 1
        if bordered.sign == 0.0:
            return None
        return self.metric.unit(*bordered.solve(np.zeros(len(row)), 1.0), bordered.sign)


class Walk:
    """Goes along the curve of a loaded problem from a point on.

    part: of a stride that is tried at once; smallest: that was taken in the last stride. load: w.
    """

    def __init__(self, loaded: Loaded, point: Point, load: float, control: Control) -> None:
        self.loaded, self.point, self.load, self.control = loaded, point, load, control
        self.part, self.smallest, self.iterations = 1.0, 1.0, 0
        self.highest, self.topped = point.factor, False

    @classmethod
    def start(cls, loaded: Loaded, q: Array, limits: Limits, scale: Scale) -> "Walk | None":
        """From a stable state at a load factor of 0; None where nothing holds the tube there."""
        internal, residual = loaded.evaluate(q, 0.0)
        force = largest(loaded.problem.load(loaded.origin))
        force = max(force or largest(internal), _REST * scale.force)
        load = largest(loaded.load_growth - loaded.squeezed) / force if force else 0.0
        control = Control(Metric.at(q, load, scale), limits, scale)
        pull = loaded.pull()
        row = pull / max(largest(pull), np.finfo(float).tiny) / control.metric.unknown
        ahead = control.tangent(loaded, row, load)
        if ahead is None:
            return None
        share = largest(residual) / force if force else 0.0
        return cls(loaded, Point(q, 0.0, internal, share, ahead), load, control)

    def stride(self, length: float) -> list[Point] | None:
        """Go a length along the curve, in parts as small as it takes; None where it is lost.

        A stride ends at a summit of the load that is higher than all before.
        """
        self._measure()
        done, passed = 0.0, []
        self.smallest = 1.0
        while done < 1.0 - 1e-9:
            part = min(self.part, 1.0 - done)
            found = self._try(part * length, self.point.ahead)
            if found is None and part > 2.0**-_HALVINGS:
                self.part = 0.5 * part
                continue
            found = found or self._turn(part * length)
            if found is None:
                return None
            self.topped = self._passes_summit(found)
            if self.topped:
                found, done = self._summit(part * length, found), 1.0
            self.smallest = min(self.smallest, part)
            done += part
            self.point, self.highest = found, max(self.highest, found.factor)
            passed.append(found)
            if self.iterations <= _EASY:
                self.part = min(2.0 * part, 1.0)
        return passed

    def level(self, factor: float) -> Point | None:
        """The point at a load factor, near the last one."""
        ahead = self.point.ahead
        start = self.point.beyond(ahead, (factor - self.point.factor) / ahead.factor)
        return self._corrected(*start, Way(np.zeros(len(ahead.q)), 1.0))

    def _measure(self) -> None:
        """Lengths are relative to where the point is now."""
        metric = Metric.at(self.point.q, self.load, self.control.scale)
        self.control = replace(self.control, metric=metric)
        self.point = replace(self.point, ahead=metric.unit(*self.point.ahead))

    def _corrected(self, q: Array, factor: float, across: Way) -> Point | None:
        found = self.control.corrected(self.loaded, q, factor, across)
        if found is None:
            return None
        self.iterations = found[1]
        return found[0]

    def _try(self, length: float, across: Way, far: float = _FAR) -> Point | None:
        """The point at a length along a way; None if it does not lie ahead, or too far off."""
        start, along = self.point, self.control.metric.along
        found = self._corrected(*start.beyond(across, length), across)
        if found is None:
            return None
        chord = Way(found.q - start.q, found.factor - start.factor)
        far_off = along(chord, chord) > (far * length) ** 2
        return found if along(found.ahead, chord) > 0.0 and not far_off else None

    def _turn(self, length: float) -> Point | None:
        """The point beyond a kink that is sharper than a right angle, or nearly so.

        The tangent beyond it is that of the law's piece there; a plane across the mean of both
        tangents cuts the curve once.
        """
        metric, ahead = self.control.metric, self.point.ahead
        for times in _TURNS:
            self.loaded.evaluate(*self.point.beyond(ahead, 2.0 * times * length))
            turned = self.control.tangent(self.loaded, *metric.row(ahead))
            if turned is None:
                continue
            mean = Way(ahead.q + turned.q, ahead.factor + turned.factor)
            if metric.along(mean, mean) < _OPPOSITE:
                continue
            found = self._try(times * length, metric.unit(*mean), _FAR_TURN)
            if found is not None:
                return found
        return None

    def _passes_summit(self, found: Point) -> bool:
        """Whether a new highest load lies before a point; not twice in the same place."""
        here = self.point
        if self.topped or here.factor < self.highest or here.ahead.factor <= 0.0:
            return False
        return found.ahead.factor < 0.0 or found.factor < here.factor

    def _summit(self, length: float, beyond: Point) -> Point:
        """The highest point between this one and one beyond a peak, a length away."""
        low, high, best = 0.0, length, max(self.point, beyond, key=lambda p: p.factor)
        for _ in range(_SUMMIT):
            middle = 0.5 * (low + high)
            found = self._try(middle, self.point.ahead)
            if found is None:
                break
            best = max(best, found, key=lambda p: p.factor)
            rises = found.ahead.factor > 0.0 and found.factor > self.point.factor
            low, high = (middle, high) if rises else (low, middle)
        return best
