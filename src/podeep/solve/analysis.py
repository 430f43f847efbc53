"""A foundation from scene to solved states: model, steps, error estimate, refinement."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from ..errors import Fault, UserError
from ..model.assemble import Model, assemble, cut
from ..model.effects import PDELTA, check_shear, on_normal_force
from ..model.mesh import active_length, edges
from ..model.needs import Decision, needs
from ..model.results import Results
from ..scene import Foundation, Scene
from ..soil.profile import profile_of
from .accuracy import Estimate, estimate, unestimated
from .newton import Limits
from .path import Path, follow
from .refine import Unresolved, finer, unresolved
from .statics import Failure, NoEquilibrium, State, steps

DEGREE = 5  # of the deflection in an element, unless the scene says otherwise
_SIZE = {3: 0.2, 5: 0.4, 7: 0.8}  # first element length, in characteristic lengths
_FADED = 0.1  # of the accuracy: share of the deflection at the mudline below the active length
_PATIENCE = 5  # rounds without a better mesh
_ROUNDS = 15  # of refinement
_MOST_ELEMENTS = 2000  # of a tube after refinement


@dataclass(frozen=True)
class Solved:
    """What came of one foundation; `failure` tells why the last steps are missing."""

    model: Model
    states: tuple[State, ...]
    estimates: tuple[Estimate, Estimate]  # lateral, axial
    failure: Failure | None
    accuracy: float  # that was asked for
    path: Path | None = None  # what came beyond the failure; its states are the last ones
    interrupted: bool = False  # by the user, before the last step or the accuracy was reached

    @property
    def steps(self) -> int:
        """States under the loads of the steps; those of a path come on top."""
        return len(self.states) - len(self.path.states if self.path else ())

    @property
    def unestimated(self) -> int:
        """States on the path whose errors are not known."""
        beyond = self.estimates[0].displacement[self.steps :]
        return int(np.count_nonzero(beyond == 1.0)) if self.path else 0

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
        return results_of(self.model, self.states)


def results_of(model: Model, states: Sequence[State]) -> Results:
    """The states of a model at once."""
    return Results(
        model, np.array([s.lateral for s in states]), np.array([s.axial for s in states])
    )


def limits(scene: Scene) -> Limits:
    """Iteration limits: what the accuracy needs; *NEWTONSTAT can only tighten them.

    Forces between tubes are small beside those on them, and have to be in balance too.
    """
    newton = scene.newton
    own = min(1e-3 * scene.numerics.accuracy, 1e-10 if scene.slidings else 1e-6)
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
    model, begun = suited_model(scene, foundation)
    factors = factors_of(scene)
    accuracy = scene.numerics.accuracy
    best: Solved | None = None
    stale = 0
    if begun:
        nothing = (unestimated(len(begun)),) * 2
        return Solved(model, tuple(begun), nothing, None, accuracy, interrupted=True)
    for _ in range(_ROUNDS):
        states, failure, interrupted = run(model, factors, limits(scene))
        if not states:  # the tubes do not bear their own weight
            nothing = (unestimated(0),) * 2
            return Solved(model, (), nothing, failure, accuracy, interrupted=interrupted)
        path = None
        try:
            if failure is not None and scene.numerics.follow_path:
                path = follow(model, failure, limits(scene))
                states += path.states
        except KeyboardInterrupt:
            interrupted = True
        parts, found, stopped = estimated(scene, model, states, path)
        interrupted = interrupted or stopped
        one = Solved(model, tuple(states), found, failure, accuracy, path, interrupted)
        if best is None or better(one, best):
            best, stale = one, 0
        else:
            best, stale = replace(best, interrupted=interrupted), stale + 1
        enough = best.accurate or interrupted or scene.numerics.elements is not None
        if enough or stale == _PATIENCE or 2 * model.elements > _MOST_ELEMENTS:
            break
        poor = [e.worst > accuracy for e in found]
        boundaries = finer(parts, [poor[one.problem is model.axial] for one in parts])
        if len(boundaries) == len(model.edges):
            break
        model = rebuilt(scene, model, boundaries, 0)
    assert best is not None
    return best


def estimated(
    scene: Scene, model: Model, states: Sequence[State], path: Path | None
) -> tuple[tuple[Unresolved, ...], tuple[Estimate, Estimate], bool]:
    """What the elements do not resolve, estimated errors, and whether the user ended it."""
    old = results_of(model, states)
    parts = unresolved(old)
    try:
        every = np.ones(len(states), dtype=bool)
        richer = rebuilt(scene, model, finer(parts, [every] * len(parts)), 1)
        found = estimate(old, richer, states, parts, path)
    except KeyboardInterrupt:
        return parts, (unestimated(len(states)),) * 2, True
    return parts, found, False


def better(one: Solved, other: Solved) -> bool:
    """More steps, or as many with smaller errors; too fine a mesh has neither."""
    if one.steps != other.steps:
        return one.steps > other.steps
    return one.error < other.error


def factors_of(scene: Scene) -> Array:
    """Load factors, shape (steps, names)."""
    return np.array(scene.steps.factors).reshape(len(scene.steps.factors), len(scene.steps.names))


def suited_model(scene: Scene, foundation: Foundation) -> tuple[Model, list[State]]:
    """The first model with all that the scene needs.

    Whether the normal force bends the tubes further is told by a solution without it. The states
    are those of this solution if the user ended it, otherwise none. Raises UserError where a curve
    cannot be evaluated.
    """
    model = first_model(scene, foundation)
    open_ = scene.numerics.second_order is None and model.needs.axial
    if not open_ or not (model.lateral.forces.any() or model.lateral.imposed.any()):
        return model, []
    states, failure, interrupted = run(model, factors_of(scene), limits(scene))
    if interrupted:
        return model, states
    if not states:
        return model, []
    found = results_of(model, states)
    decision = on_normal_force(found, scene.numerics.accuracy, complete=failure is None)
    if decision is None:
        return model, []
    needs = replace(model.needs.told(decision), second_order=decision.choice == PDELTA)
    return rebuilt(scene, replace(model, needs=needs), model.edges, 0), []


def first_model(scene: Scene, foundation: Foundation) -> Model:
    """The model on the first mesh. Raises UserError where a curve cannot be evaluated."""
    degree = scene.numerics.degree or DEGREE
    profile = profile_of(scene, foundation)
    pieces = cut(scene, foundation, profile)
    wanted, active = needs(scene, foundation), np.inf
    if scene.numerics.active_length:
        active = active_length(pieces, profile, _FADED * scene.numerics.accuracy)
        wanted = wanted.told(length_decision(active, pieces[-1].bottom, scene.numerics.accuracy))
    boundaries = edges(pieces, profile, _SIZE[degree], scene.numerics.elements, active)
    check_shear(scene.numerics, foundation.name, pieces)
    check_path(scene, foundation)
    model = assemble(scene, foundation, wanted, profile, pieces, boundaries, degree)
    check_restraint(model)
    return model


def length_decision(active: float, tip: float, accuracy: float) -> Decision:
    """The active length in words."""
    if active >= tip:
        return Decision("full length", "the deflection reaches the tip (*MODEL LENGTH=ACTIVE)")
    faded = f"{_FADED * accuracy:.0e} of that at the mudline"
    return Decision(f"active length {active:.3g} m of {tip:.3g} m", f"below it, less than {faded}")


def check_path(scene: Scene, foundation: Foundation) -> None:
    """Raises UserError where a path is asked for that a spudcan's yield surface would end."""
    spudcan = scene.spudcan(foundation)
    if scene.numerics.follow_path and spudcan is not None and spudcan.preload is not None:
        raise UserError(
            Fault(
                f"{foundation.name}: PATH=ON, but its spudcan has a preload; beyond its yield "
                "surface there is no reaction that a path could follow",
                "leave PATH=ON out, or V_PRELOAD of *SPUDCAN: it stays elastic then",
            )
        )


def check_restraint(model: Model) -> None:
    """Raises UserError where neither soil nor holds resist a small lateral load that acts."""
    problem = model.lateral
    driven = bool(problem.forces.any() or problem.imposed.any())
    if driven and not problem.system.restrained():
        raise UserError(
            Fault(
                f"{model.foundation.name}: nothing holds the tube against its lateral loads",
                "give it p-y curves (*GROUNDPROP), or *SUPPORT or *SPRING in the loads' directions",
            )
        )


def rebuilt(scene: Scene, model: Model, boundaries: Array, more: int) -> Model:
    """The same model on other boundaries and with a degree higher by `more`."""
    degree = model.lateral.system.field.degree + more
    same = (model.foundation, model.needs, model.profile, model.pieces)
    return assemble(scene, *same, boundaries, degree)


def run(model: Model, factors: Array, limit: Limits) -> tuple[list[State], Failure | None, bool]:
    """All states that can be found, why they end early if they do, whether the user ended them."""
    states: list[State] = []
    try:
        for state in steps(model, factors, limit):
            states.append(state)  # noqa: PERF402 - keeps what came before a failure
    except NoEquilibrium as stop:
        return states, stop.failure, False
    except KeyboardInterrupt:
        return states, None, True
    return states, None, False
