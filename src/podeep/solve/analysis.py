"""A foundation from scene to solved states: model, steps, error estimate, refinement."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..model.assemble import Model, assemble, cut
from ..model.mesh import edges
from ..model.needs import needs
from ..model.results import Results
from ..scene import Foundation, Scene
from ..soil.profile import Profile
from .accuracy import Estimate, estimate, refine
from .newton import Limits
from .statics import Failure, NoEquilibrium, State, steps

DEGREE = 5  # of the deflection in an element, unless the scene says otherwise
_SIZE = {3: 0.2, 5: 0.4, 7: 0.8}  # first element length, in characteristic lengths
_ROUNDS = 14  # of refinement
_MOST_ELEMENTS = 2000  # of a tube after refinement


@dataclass(frozen=True)
class Solved:
    """What came of one foundation; `failure` tells why the last steps are missing."""

    model: Model
    states: tuple[State, ...]
    estimates: tuple[Estimate, Estimate]  # lateral, axial
    failure: Failure | None
    accuracy: float  # that was asked for

    @property
    def error(self) -> float:
        """Largest estimated error in any step."""
        return max(float(e.worst.max()) for e in self.estimates)

    @property
    def accurate(self) -> bool:
        """Whether the estimated errors are within the accuracy asked."""
        return self.error <= self.accuracy

    @property
    def results(self) -> Results:
        """All steps at once."""
        return Results(
            self.model,
            np.array([s.lateral for s in self.states]),
            np.array([s.axial for s in self.states]),
        )


def limits(scene: Scene) -> Limits:
    """Iteration limits: what the accuracy needs; *NEWTONSTAT can only tighten them."""
    newton = scene.newton
    own = min(1e-3 * scene.numerics.accuracy, 1e-6)
    return Limits(
        residual=max(min(own, newton.force, newton.moment), 1e-13),
        increment=min(newton.translation, newton.rotation),
        iterations=newton.iterations,
    )


def solve(scene: Scene, foundation: Foundation) -> Solved:
    """Solve all steps of one foundation to the accuracy asked, or as far as there is equilibrium.

    The mesh starts from the soil's characteristic length and is refined until the estimated error
    of displacement, reaction and moment is within the accuracy; a number of elements given by the
    scene is taken as it is.
    """
    model = first_model(scene, foundation)
    factors = np.array(scene.steps.factors).reshape(len(scene.steps.factors), -1)
    best: Solved | None = None
    for round_ in range(_ROUNDS + 1):
        states, failure = run(model, factors, limits(scene))
        found = estimate(model, rebuilt(scene, model, model.edges, 1), states)
        if best is not None and len(states) < len(best.states):
            break  # finer elements than the arithmetic carries: the coarser ones stand
        best = Solved(model, tuple(states), found, failure, scene.numerics.accuracy)
        last = round_ == _ROUNDS or 2 * model.elements > _MOST_ELEMENTS
        if best.accurate or last or scene.numerics.elements is not None:
            break
        field = model.lateral.system.field
        finer = refine(model.edges, field, found, scene.numerics.accuracy)
        model = rebuilt(scene, model, finer, 0)
    assert best is not None
    return best


def first_model(scene: Scene, foundation: Foundation) -> Model:
    """The model on the first mesh. Raises UserError where a curve cannot be evaluated."""
    degree = scene.numerics.degree or DEGREE
    profile = Profile(scene.ground)
    pieces = cut(scene, foundation, profile)
    boundaries = edges(pieces, profile, _SIZE[degree], scene.numerics.elements)
    wanted = needs(scene, foundation)
    return assemble(scene, foundation, wanted, profile, pieces, boundaries, degree)


def rebuilt(scene: Scene, model: Model, boundaries: Array, more: int) -> Model:
    """The same model on other boundaries and with a degree higher by `more`."""
    degree = model.lateral.system.field.degree + more
    same = (model.foundation, model.needs, model.profile, model.pieces)
    return assemble(scene, *same, boundaries, degree)


def run(model: Model, factors: Array, limit: Limits) -> tuple[list[State], Failure | None]:
    """All states that can be found, and why they end before the last step, if they do."""
    states: list[State] = []
    try:
        for state in steps(model, factors, limit):
            states.append(state)  # noqa: PERF402 - keeps what came before a failure
    except NoEquilibrium as stop:
        return states, stop.failure
    return states, None
