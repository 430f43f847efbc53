"""How deep a pipe at rest presses its nodes into a linear seabed (`normal.Winkler`)."""

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from ..soil.polyline import Values


def penetration_at_rest(force: Values, stiffness: Values, tolerance: Values) -> Array:
    """Penetration d that gives a force: sqrt(2 e F/k) up to F = k e/2, F/k + e/2 beyond, m.

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
