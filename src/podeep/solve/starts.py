"""Where a motion starts: at the end of statics, or from values that *INITIAL gives.

Tubes that are held at given values take the shape that statics gives them there; velocities have
the shape by which that changes.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from ..errors import AnalysisFailed
from ..model.assemble import Model
from ..scene import Displacement, Scene, Start, Steps
from .analysis import limits, rebuilt, run
from .statics import State

_NAME = "*INITIAL"  # no load of a deck has this name
_MOMENT = 1e-3  # s: over so much of its motion a shape's change is a velocity


@dataclass(frozen=True, eq=False)
class Beginning:
    """Unknowns and velocities of deflection and stretch at the start, (unknowns,) each."""

    lateral: Array
    lateral_velocity: Array
    axial: Array
    axial_velocity: Array


def beginning(scene: Scene, model: Model, rest: State) -> Beginning:
    """The start of a foundation whose statics end in `rest`.

    Raises AnalysisFailed where statics has no equilibrium with the values given.
    """
    given = [s for s in scene.starts if s.tube in model.foundation.tubes]
    still = np.zeros_like(rest.lateral), np.zeros_like(rest.axial)
    if not given:
        return Beginning(rest.lateral, still[0], rest.axial, still[1])
    at, later = (
        _held(scene, model, [replace(s, value=s.value + t * s.velocity) for s in given])
        for t in (0.0, _MOMENT)
    )
    return Beginning(
        at.lateral,
        (later.lateral - at.lateral) / _MOMENT,
        at.axial,
        (later.axial - at.axial) / _MOMENT,
    )


def _held(scene: Scene, model: Model, given: list[Start]) -> State:
    """The end of statics with degrees of freedom at given values."""
    names, factors = scene.steps.names, scene.steps.factors
    last = factors[-1] if factors else (0.0,) * len(names)
    moves = tuple(Displacement(_NAME, s.tube, s.elevation, s.dof, s.value) for s in given)
    holding = replace(
        scene,
        displacements=(*scene.displacements, *moves),
        steps=Steps((*names, _NAME), ((*last, 1.0),)),
        numerics=replace(scene.numerics, accuracy=1e-6 * scene.numerics.accuracy),
    )
    same = rebuilt(holding, model, model.edges, 0)
    states, failure, _ = run(same, np.array(holding.steps.factors), limits(holding))
    if failure is not None:
        raise AnalysisFailed(
            f"{model.foundation.name}: there is no equilibrium with the values of *INITIAL"
        )
    return states[-1]
