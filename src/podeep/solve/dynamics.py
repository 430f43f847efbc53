"""Foundations in motion, followed step by step from the end of statics."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np
from scipy.linalg import blas

from ..arrays import Array
from ..scene import Dynamics
from ..soil.memory import Memory
from .body import Body
from .equations import State
from .integrators import (
    Bathe,
    CentralDifference,
    Integrator,
    Rosenbrock,
    Weighted,
    initial,
)
from .moving import Moving
from .newton import largest
from .stage import Effort, NoBalance, Patience
from .starts import Beginning

HALVINGS = 12  # of a step without equilibrium
_ALPHA = -0.05  # of HHT, which stands for the original's damped Newmark
_RADIUS = 0.8  # of the generalised-alpha method


class End(Enum):
    """How a motion ended; the value is what the user reads."""

    COMPLETE = "the whole time was followed"
    NO_BALANCE = "no equilibrium was found in the smallest part of a step"
    LOST = "the foundation is lost: it goes on moving, and the soil has no more to give"


def integrator(dynamics: Dynamics) -> Integrator:
    """The method that a scene asks for."""
    match dynamics.method:
        case None | "HHT":
            return Weighted.hht(_ALPHA)
        case "NEWMARK":
            return Weighted(dynamics.gamma, dynamics.beta)
        case "GALPHA":
            return Weighted.generalised_alpha(_RADIUS)
        case "BATHE":
            return Bathe()
        case "ROS2":
            return Rosenbrock()
        case "CENTRAL":
            return CentralDifference()


@dataclass(frozen=True, slots=True)
class Standing:
    """Where a motion was, to go back to: its states, the work of its loads, J, and the largest
    force, N, so far, and what its soil remembers of deflection and stretch."""

    lateral: State
    axial: State | None
    work: float
    force: float
    memories: tuple[Mapping[str, Array], ...]


@dataclass(slots=True)
class Motion:
    """A body on its way: where its deflection and its stretch (None: at rest) are.

    reach: largest unknown so far or expected, m; what an iteration may leave is a share of it.
    part: the smallest one that the last step was taken in, s. work: of the loads since the start,
    J. force: the largest that was met where balance was checked, N.
    """

    body: Body
    lateral: State
    axial: State | None
    reach: float
    effort: Effort = field(default_factory=Effort)
    part: float = np.inf
    work: float = 0.0
    force: float = 0.0

    def step(self, method: Integrator, h: float, end: float, share: float, iterations: int) -> None:
        """Go h seconds on, to the time `end`, in halves where there is no equilibrium otherwise.

        share: of the reach, what an iteration may leave. Raises NoBalance, at a state before.
        """
        way = largest(self.lateral.q) + h * largest(self.lateral.velocity)
        self.reach = max(self.reach, way)
        patience = Patience(share * self.reach, iterations)
        self.part, parts, done = h, 1, 0
        while done < parts:
            try:
                self._go(method, h / parts, patience)
                done += 1
            except NoBalance:
                if parts == 2**HALVINGS:
                    raise
                parts, done = 2 * parts, 2 * done
                self.part = h / parts
        self.lateral = replace(self.lateral, time=end)  # sums of steps would drift
        self.axial = replace(self.axial, time=end) if self.axial is not None else None

    def _go(self, method: Integrator, h: float, patience: Patience) -> None:
        body, axial = self.body, self.axial
        if body.axial is not None and axial is not None:
            axial = method.step(body.axial, axial, h, patience, self.effort)
            if body.squeeze is not None:
                body.lateral.press(body.squeeze.band(axial.q))
        lateral = replace(self.lateral, time=self.lateral.time + h)
        if body.sways:
            lateral = method.step(body.lateral, self.lateral, h, patience, self.effort)
            self._accept(body.lateral, self.lateral, lateral)
        if body.axial is not None and self.axial is not None and axial is not None:
            self._accept(body.axial, self.axial, axial)
        self.axial, self.lateral = axial, lateral

    def _accept(self, equations: Moving, before: State, after: State) -> None:
        """Commit a step; the work of its loads is that of their mean."""
        load = equations.load(before.time) + equations.load(after.time)
        self.work += 0.5 * blas.ddot(load, after.q - before.q)
        equations.commit(after.q)

    def standing(self) -> Standing:
        """Where it is, for it or another one of the same body to `stand` at."""
        memories = tuple(memory.state() for memory in self._memories())
        return Standing(self.lateral, self.axial, self.work, self.force, memories)

    def stand(self, at: Standing) -> None:
        """Go where it, or another one of the same body, was."""
        self.lateral, self.axial, self.work, self.force = at.lateral, at.axial, at.work, at.force
        for memory, state in zip(self._memories(), at.memories, strict=True):
            memory.restore(state)

    def _memories(self) -> Iterator[Memory]:
        for equations in (self.body.lateral, self.body.axial):
            if equations is not None and equations.memory is not None:
                yield equations.memory

    def imbalance(self) -> float:
        """Largest force out of balance over the largest force so far."""
        pairs = (self.body.lateral, self.lateral), (self.body.axial, self.axial)
        left = 0.0
        for equations, state in pairs:
            if equations is not None and state is not None:
                out, size = out_of_balance(equations, state)
                self.force, left = max(self.force, size), max(left, out)
        return left / self.force if self.force else 0.0

    def sizes(self, other: "Motion | None" = None) -> tuple[float, float]:
        """Largest unknowns of deflection and stretch, or of their distance from another's, m."""
        q, axial = self.lateral.q, self.axial
        if other is not None:
            q = q - other.lateral.q
        if axial is None:
            return largest(q), 0.0
        along = axial.q if other is None or other.axial is None else axial.q - other.axial.q
        return largest(q), largest(along)

    def lost(self) -> bool:
        """Whether the foundation is lost: its tip has settled by a diameter, or it went further."""
        model = self.body.model
        if largest(self.lateral.q) > float(np.ptp(model.edges)):
            return True
        if self.axial is None:
            return False
        tip = self.axial.q[model.axial.system.field.node(float(model.edges[-1]))]
        return bool(abs(tip) > model.parts.width[-1])


def out_of_balance(equations: Moving, state: State) -> tuple[float, float]:
    """Largest of P - M a - C v - F in a committed state, and the largest of these, N."""
    velocity = state.velocity
    forces = np.array(
        [
            equations.load(state.time),
            -equations.mass_times(state.acceleration),
            -equations.damping_times(velocity),
            -equations.internal(state.q, velocity if equations.feels_velocity else None),
        ]
    )
    forces[:, equations.held] = 0.0
    return float(np.abs(forces.sum(axis=0)).max()), float(np.abs(forces).max())


def started(body: Body, time: float, start: Beginning, reach: float) -> Motion:
    """A body where its motion begins."""
    effort = Effort()
    lateral = initial(body.lateral, time, start.lateral, start.lateral_velocity, effort)
    axial = None
    if body.axial is not None:
        axial = initial(body.axial, time, start.axial, start.axial_velocity, effort)
    return Motion(body, lateral, axial, reach, effort)
