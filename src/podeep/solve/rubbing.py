"""A step of tubes that rub against each other: deflection and stretch until they agree.

Friction follows from how the deflection presses the tubes together, the normal force that bends
them further from the stretch. One is solved after the other, near where it was the last time, until
the stretch moves no more; without P-delta once is enough.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from ..arrays import Array
from ..model.assemble import Model
from ..model.coupling import pressed, rubbed
from .advance import Advance, Track
from .newton import Ending, largest

_ROUNDS = 50
_SETTLED = 1e-9  # change of the stretch between two rounds over its largest value


def advance_rubbing(
    model: Model, lateral: Track, axial: Track, before: Array, after: Array
) -> tuple[list[Advance], Literal["lateral", "axial"]]:
    """Take both tracks from factors `before` to `after`.

    Returns what it took and the problem that was solved last: the one without equilibrium, if
    there is one.
    """
    starts = replace(lateral), replace(axial)
    made: list[Advance] = []
    bend, stretch = lateral.q, axial.q
    for _ in range(_ROUNDS):
        bent, pulled = (replace(start) for start in starts)
        if made:
            bent.increment, pulled.increment = bend - bent.q, stretch - pulled.q
        if model.needs.second_order:
            system = pressed(model, stretch, bend, bent.problem.system)
            bent.problem = replace(bent.problem, system=system)
        made.append(bent.advance(before, after))
        lateral.take(bent)
        bend = bent.q
        if made[-1].outcome.ending is not Ending.CONVERGED:
            return made, "lateral"
        system = rubbed(model, bent.q, pulled.problem.system)
        pulled.problem = replace(pulled.problem, system=system)
        made.append(pulled.advance(before, after))
        axial.take(pulled)
        if made[-1].outcome.ending is not Ending.CONVERGED:
            return made, "axial"
        change, stretch = np.array(pulled.q - stretch), pulled.q
        if not model.needs.second_order or largest(change) <= _SETTLED * largest(stretch):
            return made, "axial"
    last = made[-1]
    made[-1] = replace(last, outcome=replace(last.outcome, ending=Ending.EXHAUSTED))
    return made, "axial"
