"""Many states of one system at once: their internal forces, and Newton's moves.

The same equations as in `System`, for which each call serves all states.
"""

import numpy as np
from scipy.linalg import lapack

from ..arrays import Array
from .moduli import NOTHING, directed
from .system import System


def internal_of_many(system: System, states: Array) -> tuple[Array, Array]:
    """Internal forces of many states, shape (steps, size), and moduli for `solve_many`."""
    steps, m, count = len(states), system.components, system._count
    columns = states.reshape(steps, -1, m).transpose(1, 0, 2).reshape(-1, steps * m)
    seen = system._observe.dot(columns)
    u = np.ascontiguousarray(seen[:count].reshape(count, steps, m).transpose(1, 0, 2))
    if m == 1:
        force, moduli = system.react(u[..., 0])
        seen[:count] = force.T
    else:
        distance = np.maximum(np.hypot(u[..., 0], u[..., 1]), NOTHING)
        force, modulus = system.react(distance)
        across = force / distance
        moduli = directed(modulus, across, u, distance)
        seen[:count] = (u * across[..., None]).transpose(1, 0, 2).reshape(count, steps * m)
    inner = system._balance.dot(seen).reshape(-1, steps, m).transpose(1, 0, 2)
    return inner.reshape(steps, -1) + system.springs.forces(states), moduli


def solve_many(system: System, moduli: Array, right: Array) -> Array | None:
    """Solve each state with its own tangent, (steps, size); None where one has none.

    States one after the other have a band as narrow as that of one.
    """
    steps, size = right.shape
    bands = (system._spread @ moduli.reshape(steps, -1).T).T + system.linear
    band = bands.reshape(steps * size, system.width).T
    _, x, info = lapack.dpbsv(band, right.ravel(), lower=1, overwrite_ab=1)
    return x.reshape(right.shape) if info == 0 else None
