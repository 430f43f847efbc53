"""Piecewise linear reactions: the tables of the standards and the user's own rows.

One mechanism serves them all. What differs is where the points come from and their two scales.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar, Protocol, TypeAlias, runtime_checkable

import numpy as np

from ..arrays import Array, Index
from ..errors import InvalidData
from .law import Law

#: A parameter of a law: one value, or one for each of its n points.
Values: TypeAlias = float | Array
#: Points (displacement, reaction) of a normalised curve from (0, 0) on.
Points: TypeAlias = Sequence[tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Polyline:
    """Straight lines through points, constant before the first and after the last.

    nodes: displacements in multiples of `scale`, rising, 0 among them, shape (m,).
    values: reactions there, shape (m, n) or (m, 1). scale: metres, shape (n,) or (1,).
    """

    nodes: Array
    values: Array
    scale: Array

    @classmethod
    def through(cls, points: Points, factor: Values, scale: Values, odd: bool = True) -> "Polyline":
        """A curve from (0, 0) times `factor` (N/m or N) over displacements times `scale` (m).

        Mirrored through the origin if `odd`, otherwise zero on the negative side.
        """
        nodes, ratios = np.array(points, dtype=float).T
        values = ratios[:, None] * np.atleast_1d(factor)
        curve = cls(nodes, values, np.atleast_1d(np.asarray(scale, dtype=float)))
        return curve.mirrored() if odd else curve

    def mirrored(self) -> "Polyline":
        """The odd curve whose positive side is this one; nodes[0] is 0."""
        return Polyline(
            np.concatenate((-self.nodes[:0:-1], self.nodes)),
            np.concatenate((-self.values[:0:-1], self.values)),
            self.scale,
        )

    @classmethod
    def joined(cls, curves: "Sequence[Polyline]") -> "Polyline":
        """Curves at one point after the other, each with the nodes of all."""
        nodes = np.unique(np.concatenate([c.nodes for c in curves]))
        values, scales = [], []
        for c in curves:
            count, n = np.broadcast_shapes(c.values.shape, c.scale.shape)
            own = np.broadcast_to(c.values, (count, n))
            left = np.clip(np.searchsorted(c.nodes, nodes, side="right") - 1, 0, count - 2)
            first, width = c.nodes[left], np.diff(c.nodes)[left]
            share = np.clip((nodes - first) / width, 0.0, 1.0)[:, None]
            values.append((1.0 - share) * own[left] + share * own[left + 1])
            scales.append(np.broadcast_to(c.scale, (n,)))
        return cls(nodes, np.concatenate(values, axis=1), np.concatenate(scales))

    @cached_property
    def _segments(self) -> tuple[Array, Index, Array, Array]:
        """Edges, and of every segment of every point the intercept and the slope, flattened.

        A negative edge is moved by one bit so that the same search gives the derivative away from
        zero on both sides. Lines are anchored at their end nearer to zero: exact there, and odd.
        """
        x, (count, n) = self.nodes, np.broadcast_shapes(self.values.shape, self.scale.shape)
        v = np.broadcast_to(self.values, (count, n))
        slope, intercept = np.zeros((count + 1, n)), np.empty((count + 1, n))
        slope[1:-1] = np.diff(v, axis=0) / np.diff(x)[:, None]
        near = np.arange(count - 1) + (x[:-1] < 0.0)
        intercept[1:-1] = v[near] - slope[1:-1] * x[near][:, None]
        intercept[0], intercept[-1] = v[0], v[-1]
        edges = np.where(x < 0.0, np.nextafter(x, 0.0), x)
        offset = np.arange(n) * (count + 1)
        return edges, offset, intercept.T.ravel(), (slope / self.scale).T.ravel()

    @cached_property
    def capacity(self) -> Array:
        """Largest |reaction| at each point, shape (n,)."""
        shape = np.broadcast_shapes(self.values.shape, self.scale.shape)
        return np.asarray(np.abs(np.broadcast_to(self.values, shape)).max(axis=0))

    @cached_property
    def _work(self) -> tuple[Array, Array, Array]:
        """Nodes from 0 on, the reactions there, and their integral from 0, (m, n), over x."""
        x = self.nodes[self.nodes >= 0.0]
        count, n = np.broadcast_shapes(self.values.shape, self.scale.shape)
        v = np.broadcast_to(self.values, (count, n))[count - len(x) :]
        work = np.zeros((len(x), n))
        np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(x)[:, None], axis=0, out=work[1:])
        return x, v, work

    def energy(self, u: Array) -> Array:
        """Integral of the reaction from 0 to u >= 0 of shape (..., n)."""
        nodes, values, work = self._work
        x = u / self.scale
        left = nodes.searchsorted(x, side="right") - 1
        right, point = np.minimum(left + 1, len(nodes) - 1), np.arange(values.shape[1])
        step, width = x - nodes[left], nodes[right] - nodes[left]
        start = values[left, point]
        rise = np.divide(
            values[right, point] - start, width, out=np.zeros(x.shape), where=width > 0.0
        )
        return self.scale * (work[left, point] + step * (start + 0.5 * rise * step))

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Reaction and derivative, as `Law.evaluate`."""
        edges, offset, intercept, slope = self._segments
        segment = edges.searchsorted(u / self.scale, side="right") + offset
        stiffness = slope.take(segment)
        force = stiffness * u
        force += intercept.take(segment)
        return force, stiffness


@runtime_checkable
class Drawn(Protocol):
    """A law that may be straight lines alone."""

    @property
    def polyline(self) -> Polyline | None:
        """Its lines, None where it has others."""


class TableLaw(Law):
    """A law that is a polyline at each of its points."""

    @cached_property
    @abstractmethod
    def _backbone(self) -> Polyline:
        """The curve, made once."""

    @property
    def polyline(self) -> Polyline:
        return self._backbone

    @property
    def capacity(self) -> Array:
        return self._backbone.capacity

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self._backbone.evaluate(u)


@dataclass(frozen=True, eq=False, kw_only=True)
class UserCurve(TableLaw):
    """Reaction through the user's own points, straight lines between them.

    The curve starts at (0, 0), is odd, and holds the last reaction beyond the last point.

        force = multiplier force_scale P(|u| / displacement_scale) sign(u)

    points: rows (P, y), P in Pa; one table for all n points.
    force_scale: D for p-y, pi D for t-z (m); the tip's area for Q-z (m2).
    displacement_scale: 1 where y is in metres, D where it is in diameters.
    multiplier: factor on the force at the same displacement.
    Source: the user; the layout is that of DeepLines' *PYCURVE and *TZCURVE.
    """

    source: ClassVar[str] = "the user's own rows"

    points: tuple[tuple[float, float], ...]
    force_scale: Values
    displacement_scale: Values = 1.0
    multiplier: Values = 1.0

    @cached_property
    def _backbone(self) -> Polyline:
        return self._drawn().mirrored()

    def _drawn(self) -> Polyline:
        return Polyline.through(
            sorted_points(self.points),
            np.multiply(self.multiplier, self.force_scale),
            self.displacement_scale,
            odd=False,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class SignedUserCurve(UserCurve):
    """Reaction through the user's own points, which stand for both signs as they are given.

    As `UserCurve`, but not mirrored: the point (0, 0) is added, and the first reaction is held
    before the first point as the last one is beyond the last. Without points of negative y it
    resists positive displacements only, as a tip does.
    """

    odd: ClassVar[bool] = False

    @cached_property
    def _backbone(self) -> Polyline:
        return self._drawn()


def sorted_points(rows: Points) -> list[tuple[float, float]]:
    """Points (y, P) in rising y with (0, 0) among them, from rows (P, y) in any order.

    Raises InvalidData for a row that pushes instead of resisting, and for two reactions at one y.
    """
    points = sorted({(0.0, 0.0), *((y + 0.0, p + 0.0) for p, y in rows)})
    for (y, p), (above, q) in pairwise(points):
        if y == above:
            raise InvalidData(
                f"the curve has two reactions, {p:g} and {q:g} Pa, at {y:g}",
                "displacements differ from row to row, and the reaction at 0 is 0",
                "Y",
            )
    for y, p in points:
        if y * p < 0.0:
            raise InvalidData(
                f"the curve has a reaction of {p:g} Pa at {y:g}, along the displacement",
                "a reaction resists: it has the sign of its displacement",
                "P",
            )
    return points


def user_law(
    rows: Sequence[tuple[float, ...]],
    force_scale: Values,
    displacement_scale: Values,
    multiplier: Values = 1.0,
    compression_only: bool = False,
) -> UserCurve | None:
    """The law of rows (P, y), odd unless a y is negative; None where they are all zero.

    The scales and the multiplier are those of `UserCurve`. Raises InvalidData as `sorted_points`,
    and for a negative y where only compression is resisted.
    """
    points = tuple((p, y) for p, y in rows)
    if not any(p for p, _ in points):
        return None
    negative = any(y < 0.0 for _, y in points)
    if compression_only and negative:
        raise InvalidData(
            f"the tip has a displacement of {min(y for _, y in points):g} in its rows",
            "a tip resists compression alone: give its rows with yq >= 0",
            "yq",
        )
    law = SignedUserCurve if compression_only or negative else UserCurve
    return law(
        points=points,
        force_scale=force_scale,
        displacement_scale=displacement_scale,
        multiplier=multiplier,
    )
