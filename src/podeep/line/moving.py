"""A line as equations of motion: inertia of pipe and water, drag, damping, ends that are driven.

    M a + C v + F(q, v) = P

Water that moves with the line is felt across it alone: M = m + rho CA A (1 - t t'), per length,
and so is drag, F = rho/2 CD D |v_n| v_n with v_n the velocity across it, in water at rest. Both
take the direction t of the line in the middle of a step, as it is foreseen when the step begins.
C = alpha M + beta K, K the stiffness to stretching and bending alone.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi

import numpy as np
from scipy.linalg import eigh, lapack

from ..arrays import Array, Index
from ..beam.band import band_times, dense, general_band
from ..scene import Damping, LineSection, Sea
from .equations import LineSystem
from .rod import strained
from .rod_step import material, mean_strained

#: Values, velocities and accelerations of the held unknowns at a time, s, (held,) each.
Given = Callable[[float], tuple[Array, Array, Array]]


@dataclass(frozen=True, eq=False)
class LineInertia:
    """Of each element, (n,): mass with contents and added mass, kg/m, rho/2 CD D, N s2/m3."""

    mass: Array
    added: Array
    drag: Array

    @classmethod
    def of(cls, sections: list[LineSection], sea: Sea) -> "LineInertia":
        """Of elements that lie in these sections, in water."""
        return cls(
            np.array([s.total_mass for s in sections]),
            np.array(
                [
                    s.added_mass_coefficient * sea.density * pi / 4.0 * s.outer_diameter**2
                    for s in sections
                ]
            ),
            np.array([0.5 * sea.density * s.drag_coefficient * s.outer_diameter for s in sections]),
        )


class LineMoving:
    """Equations of motion of a line; see `solve.equations.Equations`.

    q: where it begins, (size,). mean: F is the mean on the way of a step, which begins at the last
    `commit`; otherwise that at its end.
    """

    def __init__(
        self,
        system: LineSystem,
        inertia: LineInertia,
        given: Given,
        damping: Damping,
        q: Array,
        *,
        mean: bool,
    ) -> None:
        self.system, self.given, self.damping, self.mean = system, given, damping, mean
        self._mass, self._added, self._drag = (
            value[system.element] for value in (inertia.mass, inertia.added, inertia.drag)
        )
        self.feels_velocity = bool(self._drag.any())
        self._weights = (1.0, 0.0, 0.0)
        self._kept: tuple[Array, Array] | None = None
        self.before = q
        self._stand(q, q)

    def _stand(self, q: Array, before: Array) -> None:
        """The next step begins at q, and is foreseen to go on from `before`."""
        system, m = self.system, self.system.components
        self.before, self._q, self._begun = before, q, system.curve(q)
        a, b = system.curve(q + 0.5 * (q - before))
        along = a / np.linalg.norm(a, axis=1, keepdims=True)
        self._across = np.eye(m) - along[:, :, None] * along[:, None, :]
        inertia = self._mass[:, None, None] * np.eye(m) + self._added[:, None, None] * self._across
        self._inertia = system.band(inertia[:, None, :, None, :], 0)
        stiffness, self._loss = self.damping.stiffness_factor, None
        if stiffness:
            self._loss = stiffness * system.band(material(a, b, system.axial, system.bending))

    @property
    def held(self) -> Index:
        return self.system.held

    def load(self, time: float) -> Array:
        return self.system.load

    def mass_times(self, x: Array) -> Array:
        return band_times(self._inertia, x)

    def damping_times(self, x: Array) -> Array:
        lost = self.damping.mass_factor * self.mass_times(x)
        return lost if self._loss is None else lost + band_times(self._loss, x)

    def weigh(self, inertia: float, damping: float, rate: float) -> None:
        self._weights = inertia, damping, rate

    @property
    def _weighed(self) -> Array:
        inertia, damping, _ = self._weights
        band = (inertia + damping * self.damping.mass_factor) * self._inertia
        return band if self._loss is None else np.asarray(band + damping * self._loss)

    def weighed_times(self, q: Array) -> Array:
        inertia, damping, _ = self._weights
        return np.asarray(inertia * self.mass_times(q) + damping * self.damping_times(q))

    def internal(self, q: Array, velocity: Array | None) -> Array:
        system, (axial, bending) = self.system, (self.system.axial, self.system.bending)
        end = system.curve(q)
        if self.mean:
            self._strained = mean_strained(self._begun, end, axial, bending)
            total = system.clamped(0.5 * (self._q + q))
        else:
            self._strained = strained(*end, axial, bending)
            total = system.clamped(q)
        total += system.forces(self._strained.gradient)
        if system.bed is not None:
            total += system.bed.mean(q) if self.mean else system.bed.internal(q)
        if velocity is not None:
            total += self._dragged(velocity)
        return total

    def _dragged(self, velocity: Array) -> Array:
        """Drag at a velocity, (size,), N."""
        across = np.einsum("nij,nj->ni", self._across, self.system.at_points(velocity))
        speed = np.linalg.norm(across, axis=1)
        self._flow = across, speed
        return self.system.forces((self._drag * speed)[:, None, None] * across[:, None], 0)

    def _drag_band(self) -> Array:
        """Derivative of the drag to the velocity at the last `internal`."""
        across, speed = self._flow
        each = across / np.maximum(speed, 1e-300)[:, None]
        matrix = self._across + each[:, :, None] * each[:, None, :]
        return self.system.band(
            (self._drag * speed)[:, None, None, None, None] * matrix[:, None, :, None], 0
        )

    def _tangent(self) -> tuple[Array, Array]:
        """Lower bands of dF/dq at the last `internal`, and of its transpose."""
        if self.mean:
            bands = self.system.bands(self._strained.hessian)
        else:
            band = self.system.band(self._strained.hessian)
            bands = band, band.copy(order="F")
        for band in bands:
            self.system.clamp(band, 0.5 if self.mean else 1.0)
            if self.system.bed is not None:
                self.system.bed.stiffen(band)
        return bands

    def solve(self, right: Array) -> Array | None:
        lower, upper = self._kept or self._whole()
        right = right.copy()
        right[self.held] = 0.0
        below = len(lower) - 1
        _, _, x, info = lapack.dgbsv(
            below, below, general_band(lower, upper), right, overwrite_ab=1
        )
        if info == 0 and right @ x > 0.0:
            return np.asarray(x)
        return self.system.solve_band(0.5 * (lower + upper), right)

    def _whole(self) -> tuple[Array, Array]:
        """What `solve` solves with, and its transpose, as lower bands."""
        same, rate = self._weighed, self._weights[2]
        if self.feels_velocity and rate:
            same = same + rate * self._drag_band()
        lower, upper = self._tangent()
        return self.system.apart(lower + same), self.system.apart(upper + same)

    def keep_tangent(self, kept: bool) -> None:
        self._kept = self._whole() if kept else None

    def solve_weighed(self, right: Array) -> Array:
        right = right.copy()
        right[self.held] = 0.0
        found = self.system.solve_band(self.system.apart(self._weighed), right)
        assert found is not None
        return found

    def fastest(self) -> float:
        free = np.delete(np.arange(self.system.size), self.held)
        stiffness, mass = (
            dense(b)[np.ix_(free, free)] for b in (self._tangent()[0], self._inertia)
        )
        last = len(free) - 1
        square = eigh(stiffness, mass, eigvals_only=True, subset_by_index=(last, last))[0]
        return float(np.sqrt(max(square, 0.0)))

    def commit(self, q: Array, time: float = 0.0) -> None:
        """The unknowns have come to q, in so many seconds."""
        if self.system.bed is not None:
            self.system.bed.commit(q, time)
        self._stand(q, self._q)

    def energy(self, velocity: Array) -> float:
        """Of motion, J."""
        return 0.5 * float(velocity @ self.mass_times(velocity))

    def state(self) -> dict[str, Array]:
        """What the way has left, as copies."""
        bed = {} if self.system.bed is None else self.system.bed.state()
        return {"before": self.before.copy(), **bed}

    def restore(self, state: Mapping[str, Array], q: Array) -> None:
        """Go back to a `state`, which was that of the unknowns q."""
        if self.system.bed is not None:
            self.system.bed.restore(state, q)
        self._stand(q, np.array(state["before"]))
