"""Newton's method for many states of one problem at once.

Without a search: what does not converge in a few iterations is left to the caller.
"""

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..model.many import internal_of_many, solve_many
from ..model.system import System
from .newton import ROUNDING_CAP, STILL, rounding

_ROUNDS = 4
_AT_ONCE = 2_000_000  # stored numbers of the tangents that are solved together


@np.errstate(over="ignore", invalid="ignore")  # what runs away does not converge
def equilibria(
    system: System, starts: Array, loads: Array, limit: float
) -> tuple[Array, npt.NDArray[np.bool_]]:
    """States near `starts`, shape (steps, size), and which of them are in equilibrium, (steps,).

    limit: largest force out of balance over the largest force. Held unknowns keep their values.
    """
    found, settled = starts.copy(), np.zeros(len(starts), dtype=bool)
    size = max(_AT_ONCE // (system.width * system.size), 1)
    for first in range(0, len(starts), size):
        part = slice(first, first + size)
        found[part], settled[part] = _together(system, starts[part], loads[part], limit)
    return found, settled


def _together(
    system: System, starts: Array, loads: Array, limit: float
) -> tuple[Array, npt.NDArray[np.bool_]]:
    q, settled = starts, np.zeros(len(starts), dtype=bool)
    forces = np.abs(loads).max(axis=1)
    for remaining in range(_ROUNDS, -1, -1):
        internal, moduli = internal_of_many(system, q)
        residual = loads - internal
        residual[:, system.held] = 0.0
        worst = np.abs(residual).max(axis=1)
        size = np.maximum(np.abs(internal).max(axis=1), forces)
        settled = worst <= limit * size
        if settled.all() or remaining == 0:
            break
        moves = solve_many(system, moduli, residual)
        if moves is None:
            break
        if remaining < _ROUNDS:  # what rounding leaves cannot get smaller
            still = np.abs(moves).max(axis=1) <= STILL * limit * np.abs(q).max(axis=1)
            settled |= still & (worst <= np.minimum(rounding(system, q), ROUNDING_CAP * size))
            if settled.all():
                break
        q = q + moves
    return q, settled
