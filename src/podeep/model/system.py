"""The discrete equilibrium of one field on nonlinear reactions, and its tangent in band storage.

    K q + B^T w p(B q) + springs q = f

q are the unknowns, B interpolates the field at the Gauss points, w are their weights and p the
soil's reaction. A deflection may have two components: then q interleaves them and the reaction is
a vector along the displacement, with the secant p/r across it and the tangent p' along it.
"""

import itertools
from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.linalg import lapack

from ..arrays import Array, Index
from ..beam.band import band_place, bandwidth, pairs, scatter, scatter_matrix
from ..beam.field import Field, Motion
from ..soil.reaction import Reaction
from .contact import Friction

_FAR = 0.1  # displacement at which any soil is taken to have its capacity, m: for directions alone
_FURTHEST = 10.0  # displacement at which a contact is surely closed, m
_DENSE = 40_000  # entries below which a dense product beats a sparse one (call overhead)


@dataclass(frozen=True)
class Points:
    """Where a reaction acts on a field: depths x (m), weights (m; 1 for a tip), and the law.

    motion: what the reaction resists: the field by a force, its slope or the rotation of the
    section by a moment. follows: place of the points, as many, whose current |reaction| scales
    this one; None: nothing does. spread: the reaction acts along the field, not at one end of it.
    compressed: the reaction is that of the normal force, which every step gives anew. tube: number
    of the tube that it acts on, one or for each point. against: the tube whose motion is taken off
    and on which the opposite acts; None is the ground.
    """

    x: Array
    weight: Array
    reaction: Reaction
    motion: Motion = "value"
    follows: int | None = None
    spread: bool = True
    compressed: bool = False
    tube: Index | int = 0
    against: int | None = None

    @property
    def friction(self) -> Friction | None:
        """The friction of tubes against each other, if that is what acts."""
        law = self.reaction.laws[0].law if self.reaction.laws else None
        return law if isinstance(law, Friction) else None

    def matrix(self, field: Field) -> sparse.csr_array:
        """From the unknowns to the motion at each point, (points, unknowns)."""
        return _stacked([self.rows(field)], field.size)

    def rows(self, field: Field) -> tuple[Index, Array]:
        """Unknowns that the motion at each point consists of, and their shares, (points, n)."""
        matrices = [field.motion(self.x, self.motion, self.tube)]
        if self.against is not None:
            matrices.append(-field.motion(self.x, self.motion, self.against))
        split = [
            (m.indices.reshape(len(self.x), -1), m.data.reshape(len(self.x), -1)) for m in matrices
        ]
        dofs, shares = (np.concatenate(parts, axis=1) for parts in zip(*split, strict=True))
        return dofs.astype(np.intp), shares


@dataclass(frozen=True)
class Spring:
    """A linear spring to ground at one unknown, N/m in the field's scaling.

    softens: its stiffness is multiplied by the system's `softening`.
    """

    dof: int
    stiffness: float
    softens: bool = False


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
        shape = _stacked(rows, field.size)
        self._build_tangent(rows, springs)
        weighted = sparse.csr_array((shape * weight[:, None]).T)
        modes, stiffness = field.strain_modes
        stress = sparse.csr_array((modes * stiffness[:, None]).T)
        # displacements at the points and strains at once; then the forces of both at once
        self._observe = _compact(sparse.csr_array(sparse.vstack([shape, modes])))
        self._balance = _compact(sparse.csr_array(sparse.hstack([weighted, stress])))
        self._count = len(weight)
        moduli = [self._capacity_modulus(p) for p in points]
        self._capacity_moduli = np.concatenate([np.zeros(0), *moduli])
        self.softening = 1.0
        self._sprung, self._springs = bool(springs), np.zeros(self.size)
        np.add.at(self._springs, [s.dof for s in springs], [s.stiffness for s in springs])
        soft = [s for s in springs if s.softens]
        self._soft = np.zeros(self.size)
        np.add.at(self._soft, [s.dof for s in soft], [s.stiffness for s in soft])

    def _build_tangent(
        self, points: Sequence[tuple[Index, Array]], springs: Sequence[Spring]
    ) -> None:
        field, m = self.field, self.components
        coupled = [field.dofs, *(dofs for dofs, _ in points if len(dofs))]
        self.width = max(bandwidth(dofs) for dofs in coupled) * m
        storage = self.width * self.size
        free = np.ones(self.size, dtype=bool)
        free[self.held] = False

        i, j, rows, columns = pairs(field.dofs)
        entries = field.element_stiffness[:, i, j]
        linear = np.zeros(storage)
        for c in range(m):
            place = band_place(rows * m + c, columns * m + c, self.width)
            linear += scatter(place, entries, storage)
        for spring in springs:
            linear[spring.dof * self.width] += spring.stiffness
        self.diagonal = linear[:: self.width].copy()
        keep = self._kept(free)
        linear *= keep
        held_place = np.asarray(self.held) * self.width
        linear[held_place] = 1.0
        self._linear = linear
        self._spread = _compact(self._spreading(points, keep, storage))

    def _kept(self, free: npt.NDArray[np.bool_]) -> Array:
        """1 where row and column of a stored entry are both free, 0 elsewhere."""
        column = np.repeat(np.arange(self.size), self.width)
        row = column + np.tile(np.arange(self.width), self.size)
        inside = row < self.size
        kept = inside & free[column] & free[np.minimum(row, self.size - 1)]
        return kept.astype(np.float64)

    def _spreading(
        self, points: Sequence[tuple[Index, Array]], keep: Array, storage: int
    ) -> sparse.csr_array:
        """Matrix from the moduli at the points to the band they add to."""
        m, count = self.components, len(self.weight)
        places, entries, sources = [np.zeros(0, np.intp)], [np.zeros(0)], [np.zeros(0, np.intp)]

        def add(rows: Index, columns: Index, entry: Array, source: Index) -> None:
            places.append(band_place(rows, columns, self.width).ravel())
            entries.append(entry.ravel())
            sources.append(np.broadcast_to(source, entry.shape).ravel())

        for (dofs, shares), at in zip(points, self._slices, strict=True):
            weighted, local = shares * self.weight[at, None], dofs.shape[1]
            source = np.arange(at.start, at.stop)[:, None]
            i, j = np.tril_indices(local)
            rows, columns = np.maximum(dofs[:, i], dofs[:, j]), np.minimum(dofs[:, i], dofs[:, j])
            twice = 1.0 + ((rows == columns) & (i != j))  # one unknown of both tubes
            for c in range(m):  # direct terms: component c with itself
                entry = twice * shares[:, i] * weighted[:, j]
                add(rows * m + c, columns * m + c, entry, source + c * count)
            if m == 2:  # cross terms: component 1 of i with component 0 of j, and the reverse
                first, second = (a.ravel() for a in np.indices((local, local)))
                one, zero = dofs[:, first] * 2 + 1, dofs[:, second] * 2
                entry = shares[:, first] * weighted[:, second]
                add(np.maximum(one, zero), np.minimum(one, zero), entry, source + 2 * count)
        place = np.concatenate(places)
        kinds = 1 if m == 1 else 3
        return scatter_matrix(
            place,
            np.concatenate(entries) * keep[place],
            np.concatenate(sources),
            (storage, kinds * count),
        )

    def replaced(self, points: Iterable[Points]) -> "System":
        """The same system with other reactions at its points."""
        other = copy(self)
        other.points = tuple(points)
        return other

    @property
    def second_order(self) -> bool:
        """Whether a normal force works on the slope."""
        return any(p.compressed for p in self.points)

    def stable(self) -> bool:
        """Whether the tangent at the last `internal` is positive definite."""
        _, _, _, modulus = self._state
        return self._solve(modulus, np.zeros(self.size)) is not None

    def outer_forces(self, q: Array, load: Array) -> Array:
        """Loads and forces of the springs to ground at each unknown, N in the field's scaling."""
        return np.asarray(np.maximum(np.abs(load), np.abs(self._springs * q)))

    def softened(self, factor: float) -> "System":
        """The same system with the springs that soften at a share of their full stiffness."""
        if factor == self.softening:
            return self
        other = copy(self)
        change = (factor - self.softening) * self._soft
        change[self.held] = 0.0
        other.softening, other._springs = factor, self._springs + change
        other._linear = self._linear.copy()
        other._linear[:: self.width] += change
        other.diagonal = self.diagonal + change
        return other

    def displacement(self, q: Array) -> Array:
        """The field at the Gauss points, shape (points, components)."""
        return np.asarray((self._observe @ q.reshape(-1, self.components))[: self._count])

    def _capacity_modulus(self, points: Points) -> Array:
        """Share of the bound of the reaction at some points, (n,), or its last modulus."""
        bound, leader = points.reaction.capacity, points.follows
        if leader is not None:
            bound = bound * self.points[leader].reaction.capacity
        last = points.reaction.evaluate(np.full(len(bound), _FURTHEST))[1]
        return np.asarray(np.where(np.isfinite(bound), bound / _FAR, last))

    def react(self, u: Array) -> tuple[Array, Array]:
        """Reaction and modulus at signed displacements or distances u, shape (..., points).

        The modulus of a reaction that follows another one leaves out how that one changes: the
        tangent stays symmetric, and the iteration converges all the same, if less fast.
        """
        if len(self.points) == 1:
            return self.points[0].reaction.evaluate(u)
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
        if self.components == 1:
            seen = self._observe @ q
            u = distance = seen[:count].copy()
            force, modulus = self.react(distance)
            seen[:count] = force
        else:
            seen = self._observe @ q.reshape(-1, 2)
            u = seen[:count].copy()
            distance = np.hypot(u[:, 0], u[:, 1])
            force, modulus = self.react(distance)
            seen[:count] *= secant(force, distance, modulus)[:, None]
        self._state = (u, distance, force, modulus)
        inner: Array = (self._balance @ seen).ravel()
        if self._sprung:
            inner += self._springs * q
        return inner

    def solve(self, right: Array) -> Array | None:
        """Solve with the tangent at the last `internal`; None for a mechanism.

        Where the tangent is not positive definite (a softening law), its negative moduli are
        first taken as zero, then all moduli as secants, at last as shares of the capacity (a gap
        that has to close): the energy still falls along the answer, and the residual that decides
        on equilibrium stays the exact one.
        """
        _, _, _, modulus = self._state
        x = self._solve(modulus, right)
        if x is None:
            x = self._solve(np.maximum(modulus, 0.0), right)
        if x is None:
            x = self.solve_by_secants(right)
        if x is None:
            x = self._solve(self._capacity_moduli, right, across=self._capacity_moduli)
        return x

    def solve_by_secants(self, right: Array) -> Array | None:
        """Solve with the secant moduli at the last `internal`; None for a mechanism."""
        _, distance, force, modulus = self._state
        secants = secant(force, distance, modulus)
        return self._solve(secants, right, across=secants)

    def restrained(self) -> bool:
        """Whether soil and holds carry any small load, wherever the soil has some capacity."""
        moduli = self._capacity_moduli
        self._state = (
            np.zeros((self._count, self.components)),
            *np.zeros((2, self._count)),
            moduli,
        )
        return self._solve(moduli, np.zeros(self.size), across=moduli) is not None

    def _solve(self, modulus: Array, right: Array, across: Array | None = None) -> Array | None:
        """Solve with moduli along the displacement, and across it (None: the exact secants)."""
        _, x, info = lapack.dpbsv(self._band(modulus, across), right, lower=1, overwrite_ab=1)
        return x if info == 0 else None

    def _band(self, modulus: Array, across: Array | None = None) -> Array:
        """Lower band of the matrix with these moduli, shape (width, size), Fortran order."""
        if self.components == 2:
            modulus = self._vector_moduli(modulus, across)
        band = self._spread @ modulus
        band += self._linear
        return np.asarray(band.reshape((self.width, self.size), order="F"))

    def tangent(self) -> Array:
        """Lower band of the exact tangent at the last `internal`, held unknowns apart from it."""
        return self._band(self._state[3])

    def tangent_times(self, move: Array) -> Array:
        """What the last `internal` grows by along a small move of all unknowns, held ones too."""
        modulus, count = self._state[3], self._count
        if self.components == 1:
            seen = self._observe @ move
            seen[:count] *= modulus
        else:
            seen = self._observe @ move.reshape(-1, 2)
            xx, yy, xy = self._vector_moduli(modulus, None).reshape(3, -1)
            u, v = seen[:count].T.copy()
            seen[:count, 0] = xx * u + xy * v
            seen[:count, 1] = xy * u + yy * v
        return np.asarray((self._balance @ seen).ravel() + self._springs * move)

    def _vector_moduli(self, along: Array, across: Array | None) -> Array:
        """xx, yy and xy moduli, one after the other, of a reaction along the displacement."""
        u, distance, force, modulus = self._state
        if across is None:
            across = secant(force, distance, modulus)
        direction = np.divide(u, distance[:, None], out=np.zeros_like(u), where=u != 0.0)
        more = (along - across)[:, None] * direction
        count = len(distance)
        moduli = np.empty(3 * count)
        moduli[:count] = across + more[:, 0] * direction[:, 0]
        moduli[count : 2 * count] = across + more[:, 1] * direction[:, 1]
        moduli[2 * count :] = more[:, 0] * direction[:, 1]
        return moduli


def _stacked(rows: Sequence[tuple[Index, Array]], size: int) -> sparse.csr_array:
    """Matrix from the unknowns to the motions at all points."""
    matrices = [
        sparse.csr_array((v.ravel(), d.ravel(), np.arange(len(d) + 1) * d.shape[1]), (len(d), size))
        for d, v in rows
    ]
    return sparse.csr_array(sparse.vstack([sparse.csr_array((0, size)), *matrices]))


def _compact(matrix: sparse.csr_array) -> sparse.csr_array | Array:
    """The matrix as it multiplies fastest."""
    return matrix.toarray() if matrix.shape[0] * matrix.shape[1] <= _DENSE else matrix


def secant(force: Array, u: Array, modulus: Array) -> Array:
    """force / u, with the exact limit at u = 0, where it is the modulus."""
    return np.divide(force, u, out=modulus.copy(), where=u != 0.0)
