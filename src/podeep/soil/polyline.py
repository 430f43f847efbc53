"""Straight lines through points, at many points of the soil at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ..arrays import Array, Index

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
        x, v, count = self.nodes, self.values, len(self.nodes)
        n = v.shape[1] if len(self.scale) == 1 else len(self.scale)
        slope, intercept = np.zeros((count + 1, n)), np.empty((count + 1, n))
        slope[1:-1] = (v[1:] - v[:-1]) / (x[1:] - x[:-1])[:, None]
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
    def corners(self) -> Array:
        """Distances from 0 at which lines meet, (corners, n), m; 0 where both ways differ."""
        shape = np.broadcast_shapes(self.values.shape, self.scale.shape)
        slope = np.zeros((len(self.nodes) + 1, self.values.shape[1]))
        slope[1:-1] = np.diff(self.values, axis=0) / np.diff(self.nodes)[:, None]
        bent = (np.diff(slope, axis=0) != 0.0).any(axis=1)
        distances = np.unique(np.abs(self.nodes[bent]))
        return np.asarray(
            np.broadcast_to(distances[:, None] * self.scale, (len(distances), shape[1]))
        )

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
