"""Work of a path independent reaction from rest, and the envelope of one that falls."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .law import Law
from .memory import Backbone
from .polyline import Polyline
from .reaction import Reaction, Term, plain_lines

_PANELS, _ORDER = 128, 4
_GRID = np.geomspace(1e-9, 1e2, 441)  # displacements at which curves are looked at, m
_SLACK = 1e-9  # of a force: what rounding may take


def energy(backbone: Backbone, x: Array) -> Array:
    """Integral of the force from 0 to x >= 0, shape (..., n), J/m (J at a tip).

    Exact for straight lines. Other laws by Gauss points, of x t^3 so that an infinite slope at
    rest does no harm: to 1e-14 of the energy where the law is smooth, 1e-5 across a kink, 1e-4
    across the small jumps that some published laws have.
    """
    if isinstance(backbone, Reaction):
        total = np.zeros(x.shape)
        for term in backbone.laws:
            share = 1.0 if term.weight is None else term.weight
            total[..., term.at] += share * energy(term.law, x[..., term.at])
        return total
    if isinstance(backbone, Held):
        return backbone.energy(x)
    lines = backbone if isinstance(backbone, Polyline) else None
    if isinstance(backbone, Law):
        lines = plain_lines(backbone)
    return _gauss(backbone, x) if lines is None else lines.energy(x)


def _points() -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(_ORDER)
    start = np.arange(_PANELS)[:, None]
    t = ((nodes + 1.0) / 2.0 + start).ravel() / _PANELS
    w = np.tile(weights / 2.0, _PANELS) / _PANELS
    return t**3, 3.0 * t * t * w


_SHARE, _WEIGHT = _points()


def _gauss(backbone: Backbone, x: Array) -> Array:
    force, _ = backbone.evaluate(_SHARE.reshape(-1, *(1,) * x.ndim) * x)
    force *= _WEIGHT.reshape(-1, *(1,) * x.ndim)
    return np.asarray(np.add.reduce(force, axis=0) * x)


# --- envelopes --------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Lines(Law):
    """Straight lines as they are given."""

    source: ClassVar[str] = "its lines"

    lines: Polyline

    @property
    def polyline(self) -> Polyline:
        return self.lines

    @property
    def capacity(self) -> Array:
        return self.lines.capacity

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self.lines.evaluate(u)


@dataclass(frozen=True, eq=False)
class Held(Law):
    """An odd law up to its peak at displacement `reach` (m, (n,)), and its peak from there on."""

    source: ClassVar[str] = "its law"

    law: Law
    reach: Array

    @cached_property
    def _peak(self) -> Array:
        return self.law.force(np.where(np.isfinite(self.reach), self.reach, 0.0))

    @property
    def capacity(self) -> Array:
        return np.where(np.isfinite(self.reach), self._peak, self.law.capacity)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, stiffness = self.law.evaluate(np.clip(u, -self.reach, self.reach))
        return force, np.where(np.abs(u) >= self.reach, 0.0, stiffness)

    def energy(self, x: Array) -> Array:
        """As `energy`."""
        inside = np.minimum(x, self.reach)
        return energy(self.law, inside) + self._peak * (x - inside)


def held(reaction: Reaction) -> Reaction:
    """The running envelope: each odd law that falls after a peak keeps its peak instead."""
    return Reaction(reaction.size, tuple(_held(term) for term in reaction.laws))


def softens(reaction: Reaction) -> bool:
    """Whether any of its laws falls after a peak."""
    return any(_held(term) is not term for term in reaction.laws)


def _held(term: Term) -> Term:
    law, lines = term.law, plain_lines(term.law)
    if not law.odd:
        return term
    if lines is not None:
        positive = lines.nodes >= 0.0
        values = lines.values[positive]
        rising = np.maximum.accumulate(values, axis=0)
        if (rising == values).all():
            return term
        return replace(
            term, law=Lines(Polyline(lines.nodes[positive], rising, lines.scale).mirrored())
        )
    force = law.force(np.repeat(_GRID[:, None], len(term.at), axis=1))
    top = force.argmax(axis=0)
    fallen = force[-1] < force.max(axis=0) * (1.0 - _SLACK)
    if not fallen.any():
        return term
    low, high = _GRID[np.maximum(top - 1, 0)], _GRID[np.minimum(top + 1, len(_GRID) - 1)]
    for _ in range(60):  # the slope changes its sign once between them
        middle = 0.5 * (low + high)
        rises = law.stiffness(middle) > 0.0
        low, high = np.where(rises, middle, low), np.where(rises, high, middle)
    return replace(term, law=Held(law, np.where(fallen, low, np.inf)))


def gives_back(reaction: Reaction) -> bool:
    """Whether the tangent exceeds the secant anywhere: such a curve has loops that give energy."""
    u = np.repeat(_GRID[:, None], reaction.size, axis=1)
    force, stiffness = reaction.evaluate(u)
    return bool((u * stiffness > force + _SLACK * np.abs(force).max(axis=0)).any())


def half_way(reaction: Reaction, peak: Array) -> Array:
    """Displacement at half the peak (m, (n,)) of a reaction that does not fall; inf without one."""
    low, high = np.full(reaction.size, np.log(_GRID[0])), np.full(reaction.size, np.log(_GRID[-1]))
    for _ in range(60):
        middle = 0.5 * (low + high)
        below = reaction.evaluate(np.exp(middle))[0] < 0.5 * peak
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.where(np.isfinite(peak) & (peak > 0.0), np.exp(high), np.inf)
