"""A curve of equilibria in unknowns and load factor, followed by arc length over peaks and back.

Distances are relative: sqrt(|dq|^2 / |q|^2 + (w dl)^2), w being what a unit of the load factor
adds to the load, as a share of the forces. Each part of a step is a predictor along the tangent and
Newton in the plane across it (Riks, Wempner).

The way forward along a tangent t is told by the sign of det [K -p; t], which is the same all along
a curve (Allgower and Georg, Introduction to numerical continuation methods, 2003, chapter 2), kinks
of piecewise linear laws included. Angles between one tangent and the next, or the sign of the load
alone, would turn back where a brittle law makes the curve turn sharply.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from .bordered import Bordered
from .loaded import Loaded
from .newton import Limits, Scale, largest, unmoved

_ITERATIONS = 20  # of a part; one that needs more is halved
_EASY = 6  # iterations up to which the next part may be twice as long
_HALVINGS = 12
_FAR = 2.0  # chord of a part over its length: more is a jump to another piece of the curve
_SUMMIT = 14  # halvings of a part for a peak in it
_TURNS = (1.0, 4.0, 16.0)  # lengths of the part across a kink, in smallest parts


@dataclass(frozen=True)
class Point:
    """A point of the curve: unknowns, load factor, internal forces, the tangent of length 1."""

    q: Array
    l: float  # noqa: E741
    internal: Array
    residual: float
    ahead: tuple[Array, float]


@dataclass(frozen=True)
class Metric:
    """Lengths on the curve: |q| in m, w of a unit of the load factor."""

    unknown: float
    load: float

    def row(self, direction: tuple[Array, float]) -> tuple[Array, float]:
        """What measures the way along a direction."""
        return direction[0] / self.unknown**2, direction[1] * self.load**2

    def along(self, one: tuple[Array, float], other: tuple[Array, float]) -> float:
        row, corner = self.row(one)
        return float(row @ other[0]) + corner * other[1]

    def unit(self, direction: tuple[Array, float], sign: float = 1.0) -> tuple[Array, float]:
        """The direction with the length 1."""
        size = sign * np.sqrt(self.along(direction, direction))
        return direction[0] / size, direction[1] / size


@dataclass(frozen=True)
class Control:
    """How points of a curve are found: the measure of lengths, the limits, sizes of the run."""

    metric: Metric
    limits: Limits
    scale: Scale

    @np.errstate(over="ignore", invalid="ignore")
    def corrected(
        self,
        loaded: Loaded,
        q: Array,
        l: float,  # noqa: E741
        across: tuple[Array, float],
    ) -> tuple[Point, int] | None:
        """The point of the curve in the plane through (q, l) across a direction, and iterations."""
        row, corner = self.metric.row(across)
        least = max(1e-6 * self.scale.force, np.finfo(float).tiny)
        for iteration in range(_ITERATIONS):
            internal, residual = loaded.evaluate(q, l)
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
                ahead = self.metric.unit(bordered.solve(np.zeros(len(q)), 1.0), bordered.sign)
                return Point(q, l, internal, worst / size, ahead), iteration
            q, l = q + step, l + change
        return None


def measured(q: Array, load: float, scale: Scale) -> Metric:
    """Lengths relative to the unknowns q, and to the forces by `load`, their share that l adds."""
    size = float(np.linalg.norm(q))
    return Metric(max(size, 1e-6 * scale.unknown, 1e-12), max(load, 1e-12))


class Walk:
    """Goes along the curve of a loaded problem from one stable state on."""

    def __init__(self, loaded: Loaded, q: Array, limits: Limits, scale: Scale) -> None:
        self.loaded, self.limits, self.scale = loaded, limits, scale
        self.part, self.smallest, self.iterations = 1.0, 1.0, 0
        self.highest, self.topped = -np.inf, False
        internal, _ = loaded.evaluate(q, 0.0)
        force = max(largest(internal), scale.force)
        self.load = largest(loaded.load_growth + loaded.squeezed) / force if force else 0.0
        self.metric = measured(q, self.load, scale)
        pull = loaded.pull()
        row = pull / max(largest(pull), np.finfo(float).tiny) / self.metric.unknown
        found = self._tangent(row, self.load)
        self.point = None if found is None else Point(q, 0.0, internal, 0.0, found)

    def _tangent(self, row: Array, corner: float) -> tuple[Array, float] | None:
        """The tangent at the state last evaluated, forward."""
        bordered = Bordered(self.loaded.system, self.loaded.pull(), row, corner)
        self.loaded.work.iterations += 1
        if bordered.sign == 0.0:
            return None
        return self.metric.unit(bordered.solve(np.zeros(len(row)), 1.0), bordered.sign)

    def _corrected(self, q: Array, l: float, across: tuple[Array, float]) -> Point | None:  # noqa: E741
        found = Control(self.metric, self.limits, self.scale).corrected(self.loaded, q, l, across)
        if found is None:
            return None
        self.iterations = found[1]
        return found[0]

    def _try(self, length: float, across: tuple[Array, float], far: float = _FAR) -> Point | None:
        """The point ahead at a length across a direction; None if it is not ahead, or too far."""
        start = self.point
        q, l = start.q + length * across[0], start.l + length * across[1]
        found = self._corrected(q, l, across)
        if found is None:
            return None
        chord = (found.q - start.q, found.l - start.l)
        forward = self.metric.along(found.ahead, chord)
        whole = np.sqrt(self.metric.along(chord, chord))
        return found if forward > 0.0 and whole <= far * length else None

    def _turn(self, length: float) -> Point | None:
        """The point beyond a kink that is sharper than a right angle, or nearly so.

        The tangent beyond it is that of the law's piece there; a plane across the mean of both
        tangents cuts the curve once on each side.
        """
        ahead = self.point.ahead
        for times in _TURNS:
            beyond = 2.0 * times * length
            self.loaded.evaluate(
                self.point.q + beyond * ahead[0], self.point.l + beyond * ahead[1]
            )
            turned = self._tangent(*self.metric.row(ahead))
            if turned is None:
                continue
            mean = (ahead[0] + turned[0], ahead[1] + turned[1])
            if self.metric.along(mean, mean) < 1e-4:
                continue
            found = self._try(times * length, self.metric.unit(mean), 2.0 * _FAR / 0.1)
            if found is not None:
                return found
        return None

    def stride(self, length: float) -> list[Point] | None:
        """Go a length along the curve, in parts as small as it takes; None where it is lost.

        A stride ends at a summit of the load that is higher than all before.
        """
        self.metric = measured(self.point.q, self.load, self.scale)
        self.point = self._renewed()
        done, passed = 0.0, []
        self.smallest = 1.0
        while done < 1.0 - 1e-9:
            part = min(self.part, 1.0 - done)
            found = self._try(part * length, self.point.ahead)
            if found is None and part > 2.0**-_HALVINGS:
                self.part = 0.5 * part
                continue
            if found is None:
                found = self._turn(part * length)
            elif self._passes_summit(found):
                found, done, self.topped = self._summit(part * length, found), 1.0, True
            else:
                self.topped = False
            if found is None:
                return None
            self.smallest = min(self.smallest, part)
            done += part
            self.point, self.highest = found, max(self.highest, found.l)
            passed.append(found)
            if self.iterations <= _EASY:
                self.part = min(2.0 * part, 1.0)
        return passed

    def _passes_summit(self, found: Point) -> bool:
        """Whether a new highest load lies before a point; not twice in the same place."""
        rises = self.point.ahead[1] > 0.0 > found.ahead[1]
        return rises and self.point.l >= self.highest and not self.topped

    def _summit(self, length: float, beyond: Point) -> Point:
        """The highest point between this one and one beyond a peak, a length away."""
        low, high, best = 0.0, length, max(self.point, beyond, key=lambda p: p.l)
        for _ in range(_SUMMIT):
            middle = 0.5 * (low + high)
            found = self._try(middle, self.point.ahead)
            if found is None:
                break
            best = max(best, found, key=lambda p: p.l)
            low, high = (middle, high) if found.ahead[1] > 0.0 else (low, middle)
        return best

    def level(self, l: float) -> Point | None:  # noqa: E741
        """The point at a load factor, near the last one."""
        p = self.point
        share = (l - p.l) / p.ahead[1]
        return self._corrected(p.q + share * p.ahead[0], l, (np.zeros(len(p.q)), 1.0))

    def _renewed(self) -> Point:
        """The point with a tangent of length 1 in the metric as it is now."""
        return replace(self.point, ahead=self.metric.unit(self.point.ahead))
