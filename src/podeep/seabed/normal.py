"""Normal reaction of a seabed that cannot pull, smooth where a pipe touches down.

    F = 0                       for z <= 0
    F = K z^2 / (2 e)           up to the tolerance e
    F = K (z - e/2)             beyond

z is the penetration, positive down, F the reaction, positive up. DeepLines' theory page prints the
last line with the wrong sign, F = -K (dZ - e/2) for dZ = -z: it would jump from K e/2 to 3 K e/2 at
z = e (derived; seen by continuity).
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.energy import energy
from ..soil.memory import Backbone
from ..soil.polyline import Values
from ..soil.way import crossed, mean_of
from .bounds import POSITIVE, within


def rounded(penetration: Values, tolerance: Values) -> tuple[Array, Array]:
    """The penetration with its corner at 0 rounded off, m, and its derivative.

    z^2/(2 e) up to the tolerance e (m, above 0), z - e/2 beyond, and 0 above the seabed.
    """
    depth = np.maximum(penetration, 0.0)
    soft = np.minimum(depth, tolerance)
    return np.asarray(depth - soft + 0.5 * soft**2 / tolerance), np.asarray(soft / tolerance)


@dataclass(frozen=True, eq=False)
class OneSided:
    """Any backbone f with its corner rounded off: F = f(r), r as `rounded`.

    backbone: what `evaluate(z)` gives in N/m; it is asked for z > 0 alone. tolerance e: m. The
    force is smooth at 0 where f starts with a power above 1/2, as all seabed models here do.
    """

    backbone: Backbone
    tolerance: Values

    #: Gauss points between corners that `mean_force` takes
    nodes: ClassVar[int] = 8

    def __post_init__(self) -> None:
        within("tolerance on penetration, m,", self.tolerance, POSITIVE, field="DISCON")

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force, N/m, and its derivative at penetrations u, shape (..., n)."""
        depth, slope = rounded(u, self.tolerance)
        inside = depth > 0.0
        force, stiffness = self.backbone.evaluate(np.where(inside, depth, self.tolerance))
        return np.where(inside, force, 0.0), np.where(inside, stiffness * slope, 0.0)

    def energy(self, u: Array) -> Array:
        """What is stored at penetrations u, J/m, as `soil.energy`."""
        return energy(self, np.maximum(u, 0.0))


@dataclass(frozen=True, eq=False)
class Winkler:
    """Springs side by side: F = K r, r as `rounded`.

    stiffness K: N/m per metre of pipe with F in N/m, or N/m with F in N at a node; tolerance e: m.
    Source: theory page of DeepLines, with the sign put right.
    """

    stiffness: Values
    tolerance: Values

    nodes: ClassVar[int] = 2  # exact

    def __post_init__(self) -> None:
        within("contact stiffness", self.stiffness, 0.0, field="KN")
        within("tolerance on penetration, m,", self.tolerance, POSITIVE, field="DISCON")

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and its derivative at penetrations u, shape (..., n)."""
        depth, slope = rounded(u, self.tolerance)
        return self.stiffness * depth, self.stiffness * slope

    def energy(self, u: Array) -> Array:
        """What is stored: K z^3/(6 e) up to e, K (z^2/2 - e z/2 + e^2/6) beyond, J/m (J)."""
        e, depth = self.tolerance, np.maximum(u, 0.0)
        soft, beyond = np.minimum(depth, e), np.maximum(depth - e, 0.0)
        return np.asarray(self.stiffness * (soft**3 / (6.0 * e) + 0.5 * beyond * (beyond + e)))


def mean_force(bed: Winkler | OneSided, start: Array, end: Array) -> tuple[Array, Array]:
    """Mean force on the way between two penetrations, (n,), and its derivative to the end.

    Times the way it is what the bed stores on it: the discrete gradient (U1 - U0)/(z1 - z0),
    without its cancellation on short ways; to rounding for `Winkler`, to 1e-6 for a power behind a
    rounded corner. With it a contact gives back in time steps what it has taken, neither more nor
    less (`solve.conserving`). See `soil.way.mean_of`; corners are at 0 and at the tolerance.
    """
    corners = np.stack([np.zeros_like(start), np.broadcast_to(bed.tolerance, start.shape)])
    return mean_of(bed.evaluate, start, end, crossed(corners, start, end), bed.nodes)
