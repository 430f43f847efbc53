"""One problem of a foundation as equations of motion: its system, mass, damping and loads."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh, lapack

from ..arrays import Array, Index
from ..beam.band import Times, band_times, dense, times, without
from ..model.assemble import Problem
from ..model.mean import corners_of, mean_internal
from ..model.system import Reached, System
from ..soil.memory import Memory

_LOADS = 4  # times whose loads are kept: a step asks for those at its ends
_SECANT = 1e-3  # displacement whose secant stands for an infinite slope at rest, m
_KEPT = 8  # weights of mass and damping whose matrices are kept: steps are halved and doubled

#: Factors of the loads at a time, s: values, first and second derivatives, (names,) each.
Factors = Callable[[float], tuple[Array, Array, Array]]


@dataclass(slots=True)
class _Weighed:
    """D, the system whose tangent has it too, and the factors of D once they are asked for.

    share: of its linear part that the tangent has. pressed: what of the normal force it has.
    """

    band: Array
    times: Times
    system: System
    free: Array
    share: float
    pressed: Array | None = None
    factors: Array | None = None


class Moving:
    """Equations of motion of a problem; see `Equations`.

    mass, damping: lower bands, shape (width, size), held unknowns among them. factors: of the
    named loads. origin: unknowns from which the soil's motion counts; base: internal forces that
    are there already, N. memory: what resists at the points, where that depends on the way.
    begin: where a step begins on whose way `internal` is the mean force; None: it is that at q.
    """

    feels_velocity = False

    def __init__(
        self,
        problem: Problem,
        mass: Array,
        damping: Array,
        factors: Factors,
        origin: Array,
        base: Array,
        memory: Memory | None = None,
    ) -> None:
        self.problem, self.system = problem, problem.system
        self.mass, self.damping, self.memory = mass, damping, memory
        self.origin, self.base = origin, base
        self._factors = factors
        self._mass, self._damping = times(mass), times(damping)
        self._loads: dict[float, Array] = {}
        self._kept: dict[tuple[float, float, bool], _Weighed] = {}
        self._pressed: Array | None = None
        self._frozen: Reached | None = None
        self.begin: Array | None = None
        # soil that remembers has its corners anywhere
        self._corners = corners_of(self.system)[: None if memory is None else 0]
        self.weigh(1.0, 0.0, 0.0)

    @property
    def held(self) -> Index:
        return self.system.held

    def load(self, time: float) -> Array:
        found = self._loads.get(time)
        if found is None:
            if len(self._loads) == _LOADS:
                del self._loads[next(iter(self._loads))]
            found = self._loads[time] = self.problem.load(self._factors(time)[0])
        return found

    def given(self, time: float) -> tuple[Array, Array, Array]:
        value, rate, second = (self.problem.prescribed(f)[self.held] for f in self._factors(time))
        return value, rate, second

    def mass_times(self, x: Array) -> Array:
        return self._mass(x)

    def damping_times(self, x: Array) -> Array:
        return self._damping(x)

    def press(self, geometric: Array) -> None:
        """Take from the stiffness what the normal force does to slopes, a band as `mass`."""
        self._pressed = geometric

    def weigh(self, inertia: float, damping: float, rate: float) -> None:
        mean = self.begin is not None
        key = inertia, damping, mean
        one = self._kept.get(key)
        if one is None:
            if len(self._kept) == _KEPT:
                del self._kept[next(iter(self._kept))]
            band = np.asfortranarray(inertia * self.mass + damping * self.damping)
            share = 0.5 if mean else 1.0
            system = self.system.stiffened(band, self.memory)
            system.linear -= (1.0 - share) * self.system.linear
            one = self._kept[key] = _Weighed(band, times(band), system, system.linear, share)
        if one.pressed is not self._pressed:
            assert self._pressed is not None
            one.pressed = self._pressed
            more = one.share * without(one.pressed, self.held)
            one.system.linear = one.free - more.ravel(order="F")
        self._weighed = one

    def weighed_times(self, q: Array) -> Array:
        return self._weighed.times(q)

    def internal(self, q: Array, velocity: Array | None) -> Array:
        system, begin = self._weighed.system, self.begin
        if begin is None:
            force = system.internal(q - self.origin)
        else:
            force = mean_internal(system, begin - self.origin, q - self.origin, self._corners)
            q = 0.5 * (begin + q)
        force += self.base
        if self._pressed is not None:
            force -= band_times(self._pressed, q)  # differs from step to step
        return force

    def solve(self, right: Array) -> Array | None:
        system = self._weighed.system
        if self._frozen is not None:
            system.reached = self._frozen
        return system.solve(right)

    def keep_tangent(self, kept: bool) -> None:
        self._frozen = self._weighed.system.reached if kept else None

    def solve_weighed(self, right: Array) -> Array:
        one = self._weighed
        right = right.copy()
        right[self.held] = 0.0
        if one.factors is None:
            band = without(one.band, self.held)
            band[0, self.held] = 1.0
            one.factors, info = lapack.dpbtrf(band, lower=1)
            if info:
                raise RuntimeError("an unknown has no mass")
        return np.asarray(lapack.dpbtrs(one.factors, right, lower=1)[0])

    def fastest(self) -> float:
        """As `Equations.fastest`, about the origin; secants stand for infinite slopes."""
        return self._frequency(self.system.size - len(self.held) - 1)

    def slowest(self) -> float:
        """Smallest natural frequency about the origin, rad/s, as `fastest`."""
        return self._frequency(0)

    def _frequency(self, place: int) -> float:
        """One of the natural frequencies, by size, rad/s."""
        self.system.internal(np.zeros(self.system.size))
        self.system.blunted(_SECANT)
        tangent = self.system.tangent()
        if self._pressed is not None:
            tangent = tangent - without(self._pressed, self.held)
        free = np.delete(np.arange(self.system.size), self.held)
        stiffness, mass = (dense(band)[np.ix_(free, free)] for band in (tangent, self.mass))
        square = eigh(stiffness, mass, eigvals_only=True, subset_by_index=(place, place))[0]
        return float(np.sqrt(max(square, 0.0)))

    def commit(self, q: Array) -> None:
        if self.memory is not None:
            self.memory.commit(self._felt(q))

    def remembered(self, q: Array) -> Array | None:
        """What the soil resists at the points in the state q, the last that was committed.

        Shape (points,), in two planes (2, points); None where it follows from q alone.
        """
        return None if self.memory is None else self.memory.evaluate(self._felt(q))[0].T

    def dissipated(self) -> float:
        """Energy that the soil has lost since the start, J."""
        lost = 0.0 if self.memory is None else self.memory.dissipated
        return float(np.sum(self.system.weight * lost))

    def _felt(self, q: Array) -> Array:
        felt = self.system.displacement(q - self.origin)
        return felt if self.system.components == 2 else felt[:, 0]
