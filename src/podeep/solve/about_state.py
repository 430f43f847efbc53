"""The model and the static state that small motions are about."""

from dataclasses import replace
from typing import Literal

from ..errors import AnalysisFailed, Fault, UserError
from ..model.assemble import Model
from ..model.effects import PDELTA
from ..model.inertia import mass_band
from ..model.needs import Decision, isotropic, lateral_vectors
from ..scene import Foundation, Scene
from .accuracy import unestimated
from .analysis import Solved, factors_of, first_model, limits, rebuilt, run, solve
from .diagnosis import explain
from .statics import State


def suited(scene: Scene, foundation: Foundation, step: int) -> Model:
    """The first model that has the modes in both planes, where these differ, and P-delta.

    Raises UserError where nothing has a mass.
    """
    model = first_model(scene, foundation)
    bent = step > 0 and bool(lateral_vectors(scene, foundation))
    alike = isotropic(scene, foundation) and not bent
    odd = model.lateral.system.points[0].reaction.odd
    if scene.numerics.components is None and model.needs.components == 1 and odd and not alike:
        both = replace(scene, numerics=replace(scene.numerics, components=2))
        model = first_model(both, foundation)
    if scene.numerics.second_order is None and model.needs.axial:
        told = model.needs.told(Decision(PDELTA, "the normal force of the step"))
        needs = replace(told, second_order=True)
        model = rebuilt(scene, replace(model, needs=needs), model.edges, 0)
    if not mass_band(scene, model, "lateral").any():
        raise UserError(
            Fault(f"{foundation.name} has no mass", "give RHO or MASS= in *CASING, or *MASS")
        )
    return resolved(scene, model, step) if step else model


def resolved(scene: Scene, model: Model, step: int) -> Model:
    """The same model on the mesh that the statics up to a step take.

    Its elements end where the soil's tangent jumps. Raises AnalysisFailed where the step has no
    equilibrium.
    """
    needs, steps = model.needs, scene.steps
    components: Literal[1, 2] = 2 if needs.components == 2 else 1
    numerics = replace(scene.numerics, components=components, second_order=needs.second_order)
    first = replace(steps, factors=steps.factors[:step])
    solved = solve(replace(scene, steps=first, numerics=numerics), model.foundation)
    if solved.interrupted:
        raise KeyboardInterrupt
    if solved.failure is not None:
        raise AnalysisFailed(explain(solved, solved.failure, steps.names))
    return rebuilt(scene, model, solved.model.edges, 0)


def state_of(scene: Scene, model: Model, step: int) -> State:
    """The equilibrium of a step. Raises AnalysisFailed where there is none."""
    states, failure, interrupted = run(model, factors_of(scene)[:step], limits(scene))
    if interrupted:
        raise KeyboardInterrupt
    if failure is not None:
        nothing = (unestimated(len(states)),) * 2
        solved = Solved(model, tuple(states), nothing, failure, scene.numerics.accuracy)
        raise AnalysisFailed(explain(solved, failure, scene.steps.names))
    return states[-1]
