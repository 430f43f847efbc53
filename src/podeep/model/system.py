"""The discrete equilibrium of one field on nonlinear reactions, and its tangent in band storage.

    K q + B^T w p(B q) + springs q = f

q are the unknowns, B interpolates the field at the Gauss points, w are their weights and p the
soil's reaction. A deflection may have two components: then q interleaves them and the reaction is
a vector along the displacement, with the secant p/r across it and the tangent p' along it.
"""

import itertools
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.linalg import lapack

from ..arrays import Array, Index
from ..beam.band import band_place, bandwidth, pairs, scatter, scatter_matrix
from ..beam.field import Field, Motion
from ..soil.reaction import Reaction
from .compression import compression

_FAR = 0.1  # displacement at which any soil is taken to have its capacity, m: for directions alone
_SHARE = 1e-4  # of the secant: least modulus where a tangent has to be made positive definite
_DENSE = 40_000  # entries below which a dense product beats a sparse one (call overhead)


@dataclass(frozen=True)
class Points:
    """Where a reaction acts on a field: depths x (m), weights (m; 1 for a tip), and the law.

    motion: what the reaction resists: the field by a force, its slope or the rotation of the
    section by a moment. follows: place of the points, as many, whose current |reaction| scales
    this one; None: nothing does. spread: the reaction acts along the field, not at one end of it.
    compressed: the reaction is that of the normal force, which every step gives anew.
    """

    x: Array
    weight: Array
    reaction: Reaction
    motion: Motion = "value"
    follows: int | None = None
    spread: bool = True
    compressed: bool = False


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
        none = np.zeros(0)
        shape = sparse.csr_array(
            sparse.vstack(
                [field.motion(p.x, p.motion) for p in points] or [field.interpolation(none)]
            )
        )
        self._build_tangent(shape, springs)
        weighted = sparse.csr_array((shape * weight[:, None]).T)
        modes, stiffness = field.strain_modes
        stress = sparse.csr_array((modes * stiffness[:, None]).T)
        # displacements at the points and strains at once; then the forces of both at once
        self._observe = _compact(sparse.csr_array(sparse.vstack([shape, modes])))
        self._balance = _compact(sparse.csr_array(sparse.hstack([weighted, stress])))
        self._count = len(weight)
        capacity = [self._capacity(p) for p in points] or [none]
        self._capacity_moduli = np.nan_to_num(np.concatenate(capacity), posinf=0.0) / _FAR
        self.softening = 1.0
        self._sprung, self._springs = bool(springs), np.zeros(self.size)
        np.add.at(self._springs, [s.dof for s in springs], [s.stiffness for s in springs])
        soft = [s for s in springs if s.softens]
        self._soft = np.zeros(self.size)
        np.add.at(self._soft, [s.dof for s in soft], [s.stiffness for s in soft])

    def _build_tangent(self, shape: sparse.csr_array, springs: Sequence[Spring]) -> None:
        field, m = self.field, self.components
        interleaved = field.dofs[:, :, None] * m + np.arange(m)
        every = interleaved.reshape(len(field.dofs), -1)
        self.width = bandwidth(every)
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
        self._spread = _compact(self._spreading(shape, keep, storage))

    def _kept(self, free: npt.NDArray[np.bool_]) -> Array:
        """1 where row and column of a stored entry are both free, 0 elsewhere."""
        column = np.repeat(np.arange(self.size), self.width)
        row = column + np.tile(np.arange(self.width), self.size)
        inside = row < self.size
        kept = inside & free[column] & free[np.minimum(row, self.size - 1)]
        return kept.astype(np.float64)

    def _spreading(self, shape: sparse.csr_array, keep: Array, storage: int) -> sparse.csr_array:
        """Matrix from the moduli at the points to the band they add to."""
        m, count = self.components, shape.shape[0]
        local = self.field.local
        dofs = shape.indices.reshape(count, local).astype(np.intp)
        values = shape.data.reshape(count, local)
        i, j = np.tril_indices(local)
        product = values[:, i] * values[:, j] * self.weight[:, None]
        source = np.broadcast_to(np.arange(count)[:, None], product.shape)
        places, entries, sources = [], [], []
        for c in range(m):  # direct terms: component c with itself
            places.append(band_place(dofs[:, i] * m + c, dofs[:, j] * m + c, self.width))
            entries.append(product)
            sources.append(source + c * count)
        if m == 2:  # cross terms: component 1 of i with component 0 of j, and the reverse
            first, second = np.meshgrid(np.arange(local), np.arange(local), indexing="ij")
            full = values[:, first.ravel()] * values[:, second.ravel()] * self.weight[:, None]
            one, zero = dofs[:, first.ravel()] * 2 + 1, dofs[:, second.ravel()] * 2
            places.append(band_place(np.maximum(one, zero), np.minimum(one, zero), self.width))
            entries.append(full)
            sources.append(np.broadcast_to(np.arange(count)[:, None] + 2 * count, full.shape))
        place = np.concatenate([p.ravel() for p in places])
        entry = np.concatenate([e.ravel() for e in entries]) * keep[place]
        kinds = 1 if m == 1 else 3
        return scatter_matrix(
            place, entry, np.concatenate([s.ravel() for s in sources]), (storage, kinds * count)
        )

    def compressed(self, force: Array) -> "System":
        """The same system under a normal force (N, compression positive) at its points for it."""
        other = copy(self)
        other.points = tuple(
            replace(p, reaction=compression(force)) if p.compressed else p for p in self.points
        )
        return other

    @property
    def compression_points(self) -> Array:
        """Depths at which the normal force acts on the slope, m; none where it does not."""
        return next((p.x for p in self.points if p.compressed), np.zeros(0))

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

    def total_reaction(self) -> float:
        """Magnitudes of the reaction at the last `internal`, added up, N (N m of rotations)."""
        _, _, force, _ = self._state
        return float(self.weight @ np.abs(force))

    def _capacity(self, points: Points) -> Array:
        """Bound of the reaction at some points, (n,)."""
        own = points.reaction.capacity
        leader = points.follows
        return own if leader is None else own * self.points[leader].reaction.capacity

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

        Where the tangent is not positive definite (a softening law, or soil that gives all it has),
        moduli are first raised to a small share of the secants, which lets a step go far along
        what nothing holds, then taken as the secants, at last as shares of the capacity (a gap
        that has to close): the energy still falls along the answer, and the residual that decides
        on equilibrium stays the exact one.
        """
        _, distance, force, modulus = self._state
        x = self._solve(modulus, right)
        if x is None:
            some = _SHARE * np.abs(secant(force, distance, modulus))
            x = self._solve(np.maximum(modulus, some), right)
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
        if self.components == 2:
            modulus = self._vector_moduli(modulus, across)
        band = self._spread @ modulus
        band += self._linear
        _, x, info = lapack.dpbsv(
            band.reshape((self.width, self.size), order="F"), right, lower=1, overwrite_ab=1
        )
        return x if info == 0 else None

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


def _compact(matrix: sparse.csr_array) -> sparse.csr_array | Array:
    """The matrix as it multiplies fastest."""
    return matrix.toarray() if matrix.shape[0] * matrix.shape[1] <= _DENSE else matrix


def secant(force: Array, u: Array, modulus: Array) -> Array:
    """force / u, with the exact limit at u = 0, where it is the modulus."""
    return np.divide(force, u, out=modulus.copy(), where=u != 0.0)
