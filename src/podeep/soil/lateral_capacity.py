"""Ultimate lateral load of a pile that turns or shifts through the soil as a rigid body.

A free pile turns about a pivot at depth a, and the soil gives all it has: against the load above
the pivot, with it below. With T(z) and B(z) the integrals of pu and pu z from the mudline to z,

    H = 2 T(a) - T(L) - S          M = B(L) - 2 B(a) + S L + int m dz + Mb

H lateral load and M its moment about the mudline, positive where H acts above it; pu ultimate
resistance (N/m), m moment against rotation (N m/m), S and Mb shear and moment of the base (0 but
for PISA). a follows from the ratio of M to H. A pile that cannot turn shifts: H = T(L) + S.
A real pile may fail earlier, by a plastic hinge: its strength is not looked at.

Source: statics; Broms, J. Soil Mech. Found. Div. 90 (1964) SM2 and SM3, for short piles.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.optimize import brentq

from ..arrays import Array
from .profile import Profile

_PANELS = 400  # of the pile, besides cuts at boundaries
_POINTS = 5


@dataclass(frozen=True, slots=True)
class RigidMechanism:
    """Loads at which a rigid pile moves: H (N) and M (N m) at the mudline, and the pivot (m).

    pivot: None where the pile shifts without turning. translation: H of a pile that cannot turn.
    """

    lateral_load: float
    moment: float
    pivot: float | None
    translation: float


def rigid_mechanism(
    profile: Profile,
    diameter: Callable[[Array], Array],
    length: float,
    load: tuple[float, float],
    cuts: Sequence[float] = (),
) -> RigidMechanism:
    """The mechanism of a pile of an embedded length (m) under loads in the ratio H to M.

    diameter: outer, of depths. load: H (N) and M (N m) about the mudline, H not negative. cuts:
    depths where the diameter steps, m. Loads are inf where the soil's reaction has no bound.
    """
    inside = [z for z in (*profile.boundaries, *cuts) if 0.0 < z < length]
    edges = np.union1d(np.linspace(0.0, length, _PANELS + 1), inside)

    def resistance(a: Array, b: Array) -> tuple[Array, Array]:
        """Integrals of pu and pu z over panels from a to b."""
        z, weight = _gauss(a, b)
        flat = z.ravel()
        pu = profile.lateral(flat, diameter(flat)).capacity.reshape(z.shape) * weight
        return pu.sum(axis=1), (pu * z).sum(axis=1)

    parts = resistance(edges[:-1], edges[1:])
    if not all(np.isfinite(p).all() for p in parts):
        return RigidMechanism(inf, inf, None, inf)
    T, B = (np.concatenate(([0.0], np.cumsum(p))) for p in parts)
    turning, shear = _beside(profile, diameter, edges)
    H, M = load

    def loads(way: float) -> tuple[float, float]:
        """Of a pivot from the mudline (0) to the tip (1), then about the tip as its base shear
        turns from against the load to with it (2), then without turning (3)."""
        a = min(way, 1.0) * length
        base = min(max(2.0 * way - 3.0, -1.0), 1.0) * shear
        couple = min(5.0 - 2.0 * way, 1.0) * turning
        i = min(int(np.searchsorted(edges, a, side="right")) - 1, len(edges) - 2)
        t, b = resistance(edges[i : i + 1], np.array([a]))
        lateral = 2.0 * (T[i] + t[0]) - T[-1] + base
        return float(lateral), float(B[-1] - 2.0 * (B[i] + b[0]) - base * length + couple)

    def imbalance(way: float) -> float:
        lateral, moment = loads(way)
        return lateral * M - moment * H

    # both ends are the same shift to either side: the sign does change between them
    way = float(brentq(imbalance, 0.0, 3.0, xtol=1e-13, rtol=1e-14))
    lateral, moment = loads(way)
    sense = -1.0 if lateral * H + moment * M < 0.0 else 1.0  # the pile may turn either way
    pivot = None if way >= 2.0 else min(way, 1.0) * length
    return RigidMechanism(sense * lateral, sense * moment, pivot, float(T[-1] + shear))


def _gauss(a: Array, b: Array) -> tuple[Array, Array]:
    """Points and weights of panels from a to b, shape (panels, points)."""
    xi, weight = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * (b - a)[:, None]
    return a[:, None] + half * (xi + 1.0), half * weight


def _beside(
    profile: Profile, diameter: Callable[[Array], Array], edges: Array
) -> tuple[float, float]:
    """What resists rotation besides pu, N m, and the shear of the base, N."""
    tip = float(edges[-1])
    shear, base = profile.base(tip, float(diameter(edges[-1:])[0]))
    z, weight = (x.ravel() for x in _gauss(edges[:-1], edges[1:]))
    moment = profile.moment(z, diameter(z))
    along = moment.part(lambda law: not law.follows_lateral).capacity
    following = moment.part(lambda law: law.follows_lateral)
    if following.laws:
        along = along + following.capacity * profile.lateral(z, diameter(z)).capacity
    return float(along @ weight + base.capacity[0]), float(shear.capacity[0])
