"""Foundations in motion, followed step by step from the end of statics."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np
from scipy.linalg import blas

from ..arrays import Array
from ..scene import Dynamics, Method
from ..soil.memory import Memory
from .body import Body
from .conserving import Conserving
from .equations import State
from .integrators import (
    Bathe,
    CentralDifference,
    Integrator,
    Rosenbrock,
    Weighted,
    initial,
)
from .mover import Pair, Row, Standing, alike, rows_of, state_from
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


def integrator(dynamics: Dynamics, default: Method = "HHT") -> Integrator:
    """The method that is asked for; default: where none is named, see `Scene.default_method`."""
    match dynamics.method or default:
        case "HHT":
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
        case "CONSERVE":
            return Conserving()


def in_parts(go: Callable[[float], None], h: float) -> float:
    """Go h seconds on, in halves where there is no equilibrium otherwise; the smallest part, s.

    go: takes such a part. Raises NoBalance, after some of them.
    """
    smallest, parts, done = h, 1, 0
    while done < parts:
        try:
            go(h / parts)
            done += 1
        except NoBalance:
            if parts == 2**HALVINGS:
                raise
            parts, done = 2 * parts, 2 * done
            smallest = h / parts
    return smallest


@dataclass(slots=True)
class Motion:
    """A body on its way, a `Mover`: where its deflection and its stretch (None: at rest) are.

    reach: largest unknown so far or expected, m; what an iteration may leave is a share of it.
    part: the smallest one that the last step was taken in, s. work: of the loads since the start,
    J. force: the largest that was met where balance was checked, N.
    """

    body: Body
    method: Integrator
    lateral: State
    axial: State | None
    reach: float
    effort: Effort = field(default_factory=Effort)
    part: float = np.inf
    work: float = 0.0
    force: float = 0.0

    @property
    def time(self) -> float:
        return self.lateral.time

    def step(self, h: float, end: float, share: float, iterations: int) -> None:
        way = largest(self.lateral.q) + h * largest(self.lateral.velocity)
        self.reach = max(self.reach, way)
        patience = Patience(share * self.reach, iterations)
        self.part = in_parts(lambda part: self._go(part, patience), h)
        self.lateral = replace(self.lateral, time=end)  # sums of steps would drift
        self.axial = replace(self.axial, time=end) if self.axial is not None else None

    def _go(self, h: float, patience: Patience) -> None:
        body, axial = self.body, self.axial
        if body.axial is not None and axial is not None:
            before, axial = axial.q, self._stepped(body.axial, axial, h, patience)
            if body.squeeze is not None:
                met = 0.5 * (before + axial.q) if self.method.mean else axial.q
                body.lateral.press(body.squeeze.band(met))
        lateral = replace(self.lateral, time=self.lateral.time + h)
        if body.sways:
            lateral = self._stepped(body.lateral, self.lateral, h, patience)
            self._accept(body.lateral, self.lateral, lateral)
        if body.axial is not None and self.axial is not None and axial is not None:
            self._accept(body.axial, self.axial, axial)
        self.axial, self.lateral = axial, lateral

    def _stepped(self, equations: Moving, state: State, h: float, patience: Patience) -> State:
        """The state of one problem after a step."""
        equations.begin = state.q if self.method.mean else None
        try:
            return self.method.step(equations, state, h, patience, self.effort)
        finally:
            equations.begin = None

    def _accept(self, equations: Moving, before: State, after: State) -> None:
        """Commit a step; the work of its loads is that of their mean."""
        load = equations.load(before.time) + equations.load(after.time)
        self.work += 0.5 * blas.ddot(load, after.q - before.q)
        equations.commit(after.q)

    def standing(self) -> Standing:
        memories = tuple(memory.state() for memory in self._memories())
        return Standing(self.lateral, self.axial, self.work, self.force, memories)

    def stand(self, at: Standing) -> None:
        self.lateral, self.axial, self.work, self.force = at.lateral, at.axial, at.work, at.force
        for memory, state in zip(self._memories(), at.memories, strict=True):
            memory.restore(state)

    def _problems(self) -> Iterator[tuple[str, Moving, State]]:
        """What moves: its equations and its state."""
        yield "lateral", self.body.lateral, self.lateral
        if self.body.axial is not None and self.axial is not None:
            yield "axial", self.body.axial, self.axial

    def _memories(self) -> Iterator[Memory]:
        for _, equations, _ in self._problems():
            if equations.memory is not None:
                yield equations.memory

    def pair(self) -> Pair:
        rows = [(state, equations.remembered(state.q)) for _, equations, state in self._problems()]
        return rows[0], rows[1] if rows[1:] else None

    def settled(self, pair: Pair) -> Pair:
        if not self.method.mean:
            return pair
        body, (row, along) = self.body, pair
        if body.squeeze is not None and along is not None:
            body.lateral.press(body.squeeze.band(along[0].q))
        if body.sways:
            row = self._balanced(body.lateral, row)
        if body.axial is not None and along is not None:
            along = self._balanced(body.axial, along)
        return row, along

    def _balanced(self, equations: Moving, row: Row) -> Row:
        """A row with the acceleration that balances there."""
        state, resisted = row
        at = initial(equations, state.time, state.q, state.velocity, self.effort)
        return at, resisted

    def dissipated(self) -> float:
        return sum(equations.dissipated() for _, equations, _ in self._problems())

    def state(self) -> dict[str, Array]:
        found = {"sums": np.array((self.time, self.work, self.force, self.reach), dtype=np.float64)}
        for name, equations, state in self._problems():
            found |= rows_of(name, state)
            if equations.memory is not None:
                for part, value in equations.memory.state().items():
                    found[f"{name}/memory/{part}"] = value
        return found

    def restore(self, found: Mapping[str, Array]) -> None:
        time, self.work, self.force, self.reach = map(float, found["sums"])
        states = []
        for name, equations, state in self._problems():
            states.append(state_from(name, found, time, len(state.q)))
            if equations.memory is not None:
                kept = equations.memory.state()
                equations.memory.restore(alike(f"{name}/memory", found, kept))
        self.lateral, self.axial = states[0], states[1] if states[1:] else None

    def imbalance(self) -> float:
        along = None if self.axial is None else (self.axial, None)
        rows, left = self.settled(((self.lateral, None), along)), 0.0
        for equations, row in zip((self.body.lateral, self.body.axial), rows, strict=True):
            if equations is not None and row is not None:
                out, size = out_of_balance(equations, row[0])
                self.force, left = max(self.force, size), max(left, out)
        return left / self.force if self.force else 0.0

    def sizes(self, other: "Motion | None" = None) -> tuple[float, float]:
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


def started(body: Body, method: Integrator, time: float, start: Beginning, reach: float) -> Motion:
    """A body where its motion begins."""
    effort = Effort()
    lateral = initial(body.lateral, time, start.lateral, start.lateral_velocity, effort)
    axial = None
    if body.axial is not None:
        axial = initial(body.axial, time, start.axial, start.axial_velocity, effort)
    return Motion(body, method, lateral, axial, reach, effort)
