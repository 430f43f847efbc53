"""Contact of a node with the seabed, and how deep a pipe at rest presses its nodes in.

The normal force is that of a linear spring, smooth over a tolerance e on the penetration d:

    F = 0                  for d <= 0
    F = k d^2 / (2 e)      for 0 < d <= e
    F = k (d - e/2)        beyond

The original's page prints F = -k (dZ - e/2) for the last line, a misprint: with dZ < 0 it would
jump from k e/2 to 3 k e/2 at |dZ| = e.
"""

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from ..soil.polyline import Values


def normal_force(penetration: Values, stiffness: Values, tolerance: Values) -> tuple[Array, Array]:
    """Force and its derivative; penetration d, m, stiffness k, N/m, tolerance e > 0, m.

    With a stiffness per metre, N/m2, the force is per metre, too.
    """
    depth = np.maximum(penetration, 0.0)
    soft = np.minimum(depth, tolerance)
    force = stiffness * (depth - soft + 0.5 * soft**2 / tolerance)
    return np.asarray(force), np.asarray(stiffness * soft / tolerance)


def penetration_at_rest(force: Values, stiffness: Values, tolerance: Values) -> Array:
    """The inverse: d = sqrt(2 e F/k) up to F = k e/2, F/k + e/2 beyond, m.

    force F >= 0, N. Raises InvalidData for a negative one, and where k or e is not positive.
    """
    for name, value, field in (("stiffness", stiffness, "KN"), ("tolerance", tolerance, "DISCON")):
        if not (least := float(np.min(value))) > 0.0:
            raise InvalidData(f"the contact's {name} {least:g} is not positive", "give one", field)
    if not (least := float(np.min(force))) >= 0.0:
        raise InvalidData(f"a force of {least:g} N does not press on the seabed", "give 0 or more")
    linear = np.divide(force, stiffness)
    soft = np.sqrt(2.0 * np.asarray(tolerance) * linear)
    return np.where(soft <= tolerance, soft, linear + 0.5 * np.asarray(tolerance))


class NodeForces(NamedTuple):
    """What the nodes of a pipe that lies flat carry, N."""

    end: Array
    interior: Array


def node_forces(weight: Values, length: Values) -> NodeForces:
    """Forces on the nodes at an end and inside of elements of a length (m); weight in N/m.

    The original's page gives w L / (2 k) as the penetration, that of an end without a tolerance.
    """
    whole = np.multiply(weight, length)
    return NodeForces(np.asarray(0.5 * whole), np.asarray(whole))
