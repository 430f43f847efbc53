"""The discrete equilibrium of one field on nonlinear reactions, and its tangent in band storage.

    K q + B^T w p(B q) + springs q = f

q are the unknowns, B interpolates the field at the Gauss points, w are their weights and p the
soil's reaction. A deflection may have two components: then q interleaves them and the reaction is
a vector along the displacement, with the secant p/r across it and the tangent p' along it.
"""

import itertools
from collections.abc import Iterable, Sequence
from copy import copy
from functools import cached_property
from typing import Protocol, TypeAlias

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.linalg import lapack

from ..arrays import Array, Index
from ..beam.band import add_product, band_place, bandwidth, element_band, pairs, without
from ..beam.field import Field
from ..beam.rows import Rows, stacked
from ..soil.reaction import Reaction
from .moduli import NOTHING, directed, raised, secant
from .points import Points
from .springs import Spring, springs_of

_FAR = 0.1  # displacement at which any soil is taken to have its capacity, m: for directions alone
_FURTHEST = 10.0  # displacement at which a contact is surely closed, m
_FIRST = 1e-3  # displacement whose secants take a state from rest, m
_STEEP = 100.0  # times these secants from which the tangent at rest counts as infinite
_TINY = 1e-6  # displacement whose secant the tangent at rest exceeds by far if it is infinite, m
_INFINITE = 2.0  # times that secant
_SHARE = 1e-4  # of the secant: least modulus where a tangent has to be made positive definite


#: Of points at a state: their motion, its size, force and modulus along it, and p / r across it.
#: Of soil that remembers in two planes the modulus is xx, yy and xy of a matrix, (3, points).
Reached: TypeAlias = tuple[Array, Array, Array, Array, Array | None]


class Evaluated(Protocol):
    """A reaction at points, as it is evaluated."""

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at motions u."""


class System:
    """Equations of one field; `internal` at a state comes before `solve` with its tangent."""

    def __init__(
        self,
        field: Field,
        components: int,
        points: Sequence[Points],
        springs: Sequence[Spring],
        held: Index,
    ) -> None:
        self.field, self.components, self.points = field, components, tuple(points)
        self.size = field.size * components
        self.held = held
        cuts = np.cumsum([0, *(len(p.x) for p in points)])
        self._slices = [slice(a, b) for a, b in itertools.pairwise(cuts)]
        weight = np.concatenate([p.weight for p in points]) if points else np.zeros(0)
        self.weight = weight
        rows = [p.rows(field) for p in points]
        self.springs = springs_of(springs, self.size)
        self._build_tangent(rows)
        modes, stiffness = field.strain_modes
        # displacements at the points and strains at once; then the forces of both at once
        self._observe = stacked([*rows, modes], field.size)
        factors = np.concatenate([weight, stiffness])
        self._balance = _transposed(self._observe * factors[:, None])
        self._count, self._at_rest = len(weight), self.points
        self.softening = 1.0
        self._memory: Evaluated | None = None
        self._at: Array | None = None
        self.reached: Reached

    def _build_tangent(self, points: Sequence[Rows]) -> None:
        field, m = self.field, self.components
        coupled = [field.dofs, *(rows.dofs for rows in points if len(rows.dofs))]
        self.width = max(bandwidth(dofs) for dofs in coupled) * m
        storage = self.width * self.size
        free = np.ones(self.size, dtype=bool)
        free[self.held] = False

        shape = (field.size, m)
        linear = element_band(field.dofs, field.element_stiffness, self.width, shape)
        self.springs.add_to(linear, self.width)
        self.diagonal = linear[:: self.width].copy()
        keep = self._kept(free)
        linear *= keep
        held_place = np.asarray(self.held) * self.width
        linear[held_place] = 1.0
        self.linear = linear
        self._spread = self._spreading(points, keep, storage)

    def _kept(self, free: npt.NDArray[np.bool_]) -> Array:
        """1 where row and column of a stored entry are both free, 0 elsewhere."""
        column = np.repeat(np.arange(self.size), self.width)
        row = column + np.tile(np.arange(self.width), self.size)
        inside = row < self.size
        kept = inside & free[column] & free[np.minimum(row, self.size - 1)]
        return kept.astype(np.float64)

    def _spreading(self, points: Sequence[Rows], keep: Array, storage: int) -> sparse.csc_array:
        """Matrix from the moduli at the points to the band they add to, a column for each."""
        m = self.components
        places, entries, counts = [np.zeros(0, np.intp)], [np.zeros(0)], [np.zeros(1, np.intp)]

        def add(rows: Index, columns: Index, entry: Array) -> None:
            places.append(band_place(rows, columns, self.width).ravel())
            entries.append(entry.ravel())
            counts.append(np.full(len(entry), entry.shape[1]))

        weighted = [
            p.shares * self.weight[at, None] for p, at in zip(points, self._slices, strict=True)
        ]
        for c in range(m):  # direct terms: component c with itself
            for p, moved in zip(points, weighted, strict=True):
                i, j, rows, columns = pairs(p.dofs)
                twice = 1.0 + ((rows == columns) & (i != j))  # one unknown of both tubes
                add(rows * m + c, columns * m + c, twice * p.shares[:, i] * moved[:, j])
        if m == 2:  # cross terms: component 1 of i with component 0 of j, and the reverse
            for p, moved in zip(points, weighted, strict=True):
                first, second = (a.ravel() for a in np.indices((p.dofs.shape[1],) * 2))
                one, zero = p.dofs[:, first] * 2 + 1, p.dofs[:, second] * 2
                entry = p.shares[:, first] * moved[:, second]
                add(np.maximum(one, zero), np.minimum(one, zero), entry)
        place, pointers = np.concatenate(places), np.cumsum(np.concatenate(counts))
        entry = np.concatenate(entries) * keep[place]
        return sparse.csc_array((entry, place, pointers), (storage, len(pointers) - 1))

    @cached_property
    def length(self) -> float:
        """Of the tubes, from the highest top to the lowest tip, m."""
        return float(np.ptp(self.field.edges))

    def replaced(self, points: Iterable[Points]) -> "System":
        """The same system with other reactions at its points."""
        other = copy(self)
        other.points, other._at = tuple(points), None
        other.__dict__.pop("_together", None)
        return other

    @cached_property
    def second_order(self) -> bool:
        """Whether a normal force works on the slope."""
        return any(p.compressed for p in self.points)

    def stable(self) -> bool:
        """Whether the tangent at the last `internal` is positive definite."""
        modulus = self.reached[3]
        return self._solve(modulus, np.zeros(self.size)) is not None

    def outer_forces(self, q: Array, load: Array) -> Array:
        """Loads and forces of the springs to ground at each unknown, N in the field's scaling."""
        return np.asarray(np.maximum(np.abs(load), np.abs(self.springs.forces(q))))

    def softened(self, factor: float) -> "System":
        """The same system with the springs that soften at a share of their full stiffness."""
        if factor == self.softening:
            return self
        other = copy(self)
        change = (factor - self.softening) * self.springs.soft
        change[self.held] = 0.0
        other.softening, other.springs = factor, self.springs.stiffer(change)
        other._at = None
        other.linear = self.linear.copy()
        other.linear[:: self.width] += change
        other.diagonal = self.diagonal + change
        return other

    def stiffened(self, more: Array, reaction: Evaluated | None = None) -> "System":
        """The same system whose tangent, not whose forces, has a matrix more.

        more: lower band, shape (width, size). reaction: of all points, in place of their own.
        """
        other = copy(self)
        other.linear = self.linear + without(more, self.held).ravel(order="F")
        other._at = None
        if reaction is not None and self.components == 1:
            other.__dict__["_together"] = reaction
        elif reaction is not None:
            other._memory = reaction
        return other

    def spread(self, modulus: Array) -> Array:
        """Lower band, (width, size), of what moduli at the points, alike all around, add up to."""
        moduli = modulus if self.components == 1 else self._vector_moduli(modulus, modulus)
        band = np.zeros(self.width * self.size)
        add_product(self._spread, moduli, band)
        return band.reshape((self.width, self.size), order="F")

    def displacement(self, q: Array) -> Array:
        """The field at the Gauss points, shape (points, components)."""
        return np.asarray((self._observe @ q.reshape(-1, self.components))[: self._count])

    @cached_property
    def _capacity_moduli(self) -> Array:
        """Moduli for directions alone, of the reactions that the system was built with."""
        return np.concatenate([np.zeros(0), *map(self._capacity_modulus, self._at_rest)])

    def _capacity_modulus(self, points: Points) -> Array:
        """Share of the bound of the reaction at some points, (n,), or its last modulus."""
        bound, leader = points.reaction.capacity, points.follows
        if leader is not None:
            bound = bound * self._at_rest[leader].reaction.capacity
        last = points.reaction.evaluate(np.full(len(bound), _FURTHEST))[1]
        return np.asarray(np.where(np.isfinite(bound), bound / _FAR, last))

    @cached_property
    def _together(self) -> Evaluated | None:
        """All reactions as one; None where one follows another or changes with the step."""
        if any(p.compressed or p.follows is not None for p in self.points):
            return None
        return Reaction.joined([p.reaction for p in self.points])

    def total_reaction(self) -> float:
        """Magnitudes of the reaction at the last `internal`, added up, N (N m of rotations)."""
        return float(self.weight @ np.abs(self.reached[2]))

    def react(self, u: Array) -> tuple[Array, Array]:
        """Reaction and modulus at signed displacements or distances u, shape (..., points).

        The modulus of a reaction that follows another one leaves out how that one changes: the
        tangent stays symmetric, and the iteration converges all the same, if less fast.
        """
        if self._together is not None:
            return self._together.evaluate(u)
        force, modulus = np.empty_like(u), np.empty_like(u)
        for at, point in zip(self._slices, self.points, strict=True):
            force[..., at], modulus[..., at] = point.reaction.evaluate(u[..., at])
            if point.follows is not None:
                leading = np.abs(force[..., self._slices[point.follows]])
                force[..., at] *= leading
                modulus[..., at] *= leading
        return force, modulus

    def internal(self, q: Array) -> Array:
        """Internal forces at q; what the tangent needs there is kept for `solve`."""
        count = self._count
        across: Array | None = None
        if self.components == 1:
            seen = self._observe.dot(q)
            u = distance = seen[:count].copy()
            force, modulus = self.react(distance)
            seen[:count] = force
        else:
            seen = self._observe.dot(q.reshape(-1, 2))
            u = seen[:count].copy()
            distance = np.hypot(u[:, 0], u[:, 1])
            np.maximum(distance, NOTHING, out=distance)
            if self._memory is None:
                force, modulus = self.react(distance)
                across = force / distance
                seen[:count] *= across[:, None]
            else:
                seen[:count], modulus = self._memory.evaluate(u)
                force = np.hypot(seen[:count, 0], seen[:count, 1])
        self._at, self.reached = q, (u, distance, force, modulus, across)
        inner: Array = self._balance.dot(seen).ravel()
        if self.springs.any:
            inner += self.springs.forces(q)
        return inner

    def solve(self, right: Array) -> Array | None:
        """Solve with the tangent at the last `internal`; None for a mechanism.

        Where the tangent is not positive definite (a softening law, or soil that gives all it has),
        moduli are first raised to a small share of the secants, which lets a step go far along
        what nothing holds, then taken as the secants, at last as shares of the capacity (a gap
        that has to close): the energy still falls along the answer, and the residual that decides
        on equilibrium stays the exact one.
        """
        modulus = self.reached[3]
        x = self._solve(modulus, right)
        if x is None:
            x = self._solve(raised(modulus, _SHARE * np.abs(self._secants())), right)
        if x is None:
            x = self.solve_by_secants(right)
        if x is None:
            x = self._solve(self._capacity_moduli, right, across=self._capacity_moduli)
        return x

    def solve_by_secants(self, right: Array) -> Array | None:
        """Solve with the secant moduli at the last `internal`; None for a mechanism."""
        secants = self._secants()
        return self._solve(secants, right, across=secants)

    def _secants(self) -> Array:
        """Of the reactions at the last `internal`; shares of the capacity where these remember."""
        _, distance, force, modulus, _ = self.reached
        return secant(force, distance, modulus) if modulus.ndim == 1 else self._capacity_moduli

    def restrained(self) -> bool:
        """Whether soil and holds carry any small load, wherever the soil has some capacity."""
        moduli = self._capacity_moduli
        return self._solve(moduli, np.zeros(self.size), across=moduli) is not None

    def motions(self, states: Array) -> Array:
        """What all points feel of some states, (steps, size): shape (steps, components, points)."""
        steps, m = len(states), self.components
        columns = states.reshape(steps, -1, m).transpose(1, 0, 2).reshape(-1, steps * m)
        seen = self._observe.dot(columns)[: self._count]
        return np.ascontiguousarray(seen.reshape(-1, steps, m).transpose(1, 2, 0))

    def leave_rest(self, load: Array) -> Array | None:
        """Unknowns on the way from rest to a load; None where the tangent at rest is a better one.

        A cube root's infinite slope at rest would let the first steps of an iteration move next to
        nothing. Secants at a millimetre take its place, if the soil moves so far at all.
        """
        force, modulus = self.react(np.outer((0.0, _FIRST), np.ones(self._count)))
        secants = force[1] / _FIRST
        if not (modulus[0] > _STEEP * np.abs(secants)).any():
            return None
        q = self._solve(secants, load, across=secants)
        if q is None or np.abs(self.displacement(q)).max() < 0.1 * _FIRST:
            return None
        return q

    def follow(self, q: Array, change: Array) -> Array | None:
        """Move of the unknowns, from an equilibrium q, that a small change of the load asks for."""
        if self._at is not q:
            self.internal(q)
        return self.solve(change)

    def _solve(self, modulus: Array, right: Array, across: Array | None = None) -> Array | None:
        """Solve with moduli along the displacement, and across it (None: the exact secants)."""
        _, x, info = lapack.dpbsv(self._band(modulus, across), right, lower=1, overwrite_ab=1)
        return x if info == 0 else None

    def _band(self, modulus: Array, across: Array | None = None) -> Array:
        """Lower band of the matrix with these moduli, shape (width, size), Fortran order."""
        if self.components == 2:
            modulus = self._vector_moduli(modulus, across)
        band = self.linear.copy()
        add_product(self._spread, modulus, band)
        return band.reshape((self.width, self.size), order="F")

    def tangent(self) -> Array:
        """Lower band of the exact tangent at the last `internal`, held unknowns apart from it."""
        return self._band(self.reached[3])

    def blunted(self, displacement: float) -> bool:
        """Make the tangent at the last `internal` a secant where it has no bound; whether it had.

        A reaction whose slope at rest is infinite has a tangent, within a micrometre of rest, that
        is far steeper than its secant there. The secant at the given displacement (m) takes its
        place.
        """
        u, distance, force, modulus, across = self.reached
        places = np.outer((_TINY, displacement), np.ones(self._count))
        near, far = np.abs(self.react(places)[0]) / places
        steep = (np.abs(distance) < _TINY) & (modulus > _INFINITE * near)
        modulus = np.where(steep, far, modulus)
        if across is not None:
            across = np.where(steep, far, across)
        self._at, self.reached = None, (u, distance, force, modulus, across)
        return bool(steep.any())

    def tangent_times(self, move: Array) -> Array:
        """What the last `internal` grows by along a small move of all unknowns, held ones too."""
        modulus, count = self.reached[3], self._count
        if self.components == 1:
            seen = self._observe @ move
            seen[:count] *= modulus
        else:
            seen = self._observe @ move.reshape(-1, 2)
            xx, yy, xy = self._vector_moduli(modulus, None).reshape(3, -1)
            u, v = seen[:count].T.copy()
            seen[:count, 0] = xx * u + xy * v
            seen[:count, 1] = xy * u + yy * v
        return np.asarray((self._balance @ seen).ravel() + self.springs.forces(move))

    def _vector_moduli(self, along: Array, across: Array | None) -> Array:
        """xx, yy and xy moduli, one after the other, of a reaction along the displacement."""
        if across is along:
            return np.concatenate([across, across, np.zeros(self._count)])
        if along.ndim == 2:
            return along.ravel()
        u, distance, _, _, exact = self.reached
        if across is None:
            assert exact is not None
            across = exact
        return directed(along, across, u, distance).ravel()


def _transposed(matrix: sparse.csr_array | Array) -> sparse.csr_array | Array:
    """The transpose with its own rows side by side in memory."""
    if isinstance(matrix, np.ndarray):
        return np.ascontiguousarray(matrix.T)
    return sparse.csr_array(matrix.T)
