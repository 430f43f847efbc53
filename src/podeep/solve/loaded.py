"""A problem under loads that one factor scales: what is out of balance, and what the factor pulls.

Where the normal force bends the tube, it is that of the same factor, and its change with the factor
is part of the pull.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import Array
from ..model.assemble import Model, Problem
from ..model.coupling import pressing, under
from ..model.system import System
from .newton import Ending, Limits, Work, newton
from .statics import Which

_EXACT = 1e-10  # residual of the stretch: what its normal force leaves must not disturb
_DIFFERENCE = 1e-6  # of the factor, for the change of the normal force


@dataclass
class Loaded:
    """A problem under its loads at factors `origin` + factor `growth`.

    squeeze: what the normal force does to the system at a factor, as the system and the change of
    its internal forces at q for each unit of the factor; None where nothing does.
    """

    problem: Problem
    origin: Array
    growth: Array
    squeeze: Callable[[Array, float], tuple[System, Array] | None] | None = None
    work: Work = field(default_factory=Work)

    def __post_init__(self) -> None:
        self.system = self.problem.system
        self.load_growth = self.problem.load(self.growth)
        self.moved = self.problem.prescribed(self.growth)
        self.squeezed = np.zeros(self.system.size)

    def factors(self, factor: float) -> Array:
        """Factors of the named loads."""
        return np.asarray(self.origin + factor * self.growth)

    def hold(self, q: Array, factor: float) -> None:
        """Put the held unknowns of q where the factor wants them."""
        held = self.system.held
        if len(held):
            q[held] = self.problem.prescribed(self.factors(factor))[held]

    def evaluate(self, q: Array, factor: float) -> tuple[Array, Array]:
        """Internal forces and what is out of balance; the latter is inf where there is no state."""
        if self.squeeze is not None:
            found = self.squeeze(q, factor)
            if found is None:
                return q, np.full(len(q), np.inf)
            self.system, self.squeezed = found
        internal = self.system.internal(q)
        self.work.evaluations += 1
        residual = self.problem.load(self.factors(factor)) - internal
        residual[self.system.held] = 0.0
        return internal, residual

    def pull(self) -> Array:
        """p at the last state evaluated; what they move by in the places of held unknowns."""
        pull = self.load_growth - self.squeezed
        held = self.system.held
        if len(held):
            pull = pull - self.system.tangent_times(self.moved)
            pull[held] = self.moved[held]
        return np.asarray(pull)


@dataclass
class Squeeze:
    """What the normal force does to a deflection, as `Loaded` wants it."""

    model: Model
    axial: Array
    origin: Array
    growth: Array
    limits: Limits

    def __call__(self, q: Array, factor: float) -> tuple[System, Array] | None:
        problem, system = self.model.axial, self.model.axial.system
        factors = self.origin + factor * self.growth
        start = self.axial.copy()
        start[system.held] = problem.prescribed(factors)[system.held]
        found = newton(system, start, problem.load(factors), self.limits)
        if found.ending is not Ending.CONVERGED:
            return None
        self.axial = found.q
        bare = self.model.lateral.system
        force = pressing(self.model, found.q, q, bare)
        nearby = pressing(self.model, found.q + _DIFFERENCE * self._move(), q, bare)
        change = under(bare, (nearby - force) / _DIFFERENCE).internal(q) - bare.internal(q)
        return under(bare, force), change

    def _move(self) -> Array:
        """What the stretch grows by for each unit of the factor, at its last state."""
        problem, system = self.model.axial, self.model.axial.system
        moved = problem.prescribed(self.growth)
        right = problem.load(self.growth) - system.tangent_times(moved)
        right[system.held] = 0.0
        move = system.solve(right)
        return moved if move is None else move + moved


def loaded_at(
    model: Model,
    which: Which,
    line: tuple[Array, Array],
    axial: Array,
    limits: Limits,
) -> Loaded:
    """One of the two problems of a model on a line of load factors (one of them, growth).

    axial: unknowns of the stretch at the first; it gives the normal force that bends the tube.
    """
    problem = model.lateral if which == "lateral" else model.axial
    squeeze = None
    if which == "lateral" and problem.system.second_order:
        squeeze = Squeeze(model, axial, *line, replace(limits, residual=_EXACT))
    return Loaded(problem, *line, squeeze)
