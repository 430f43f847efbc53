"""Geometry of a pipe pressed into the seabed, and bearing capacity factors of the soil."""

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from ..soil.polyline import Values

SELF_WEIGHT_FACTOR = 1.8  # n of N_gamma on the original's page


class BearingFactors(NamedTuple):
    """Bearing capacity factors: of overburden Nq, of self-weight N_gamma, of cohesion Nc."""

    overburden: Values
    self_weight: Values
    cohesion: Values


CLAY = BearingFactors(1.0, 0.0, 5.14)
"""Of undrained clay, as the original's page prints them."""


def sand_factors(
    friction_angle: Values, self_weight_factor: Values = SELF_WEIGHT_FACTOR
) -> BearingFactors:
    """Bearing capacity factors of sand.

        Nq = exp(pi tan phi) tan^2(pi/4 + phi/2)
        N_gamma = n (Nq - 1) tan phi
        Nc = (Nq - 1) / tan phi

    friction_angle phi (rad, above 0), self_weight_factor n (-): 1.8 on the original's page (Brinch
    Hansen 1961, from memory), 1.5 in API RP 2GEO, DNV-RP-C212 and RP-F105.
    Source: API RP 2GEO. The original's page prints e^(arctan phi) in Nq, a misprint: 4.86 in place
    of 18.40 at 30 degrees.
    """
    tangent = np.tan(friction_angle)
    Nq = np.exp(np.pi * tangent) * np.tan(0.25 * np.pi + 0.5 * np.asarray(friction_angle)) ** 2
    return BearingFactors(Nq, self_weight_factor * (Nq - 1.0) * tangent, (Nq - 1.0) / tangent)


def strength(
    undrained_shear_strength: Values | None,
    friction_angle: Values | None,
    self_weight_factor: Values = SELF_WEIGHT_FACTOR,
) -> tuple[Values, BearingFactors]:
    """Cohesion (Pa) and bearing capacity factors of clay, by its strength, or sand, by its angle.

    Raises InvalidData for both and for neither.
    """
    if undrained_shear_strength is not None and friction_angle is None:
        return undrained_shear_strength, CLAY
    if undrained_shear_strength is None and friction_angle is not None:
        return 0.0, sand_factors(friction_angle, self_weight_factor)
    raise InvalidData(
        "soil is either clay, by its undrained shear strength, or sand, by its friction angle",
        "give one of them",
        "CU",
    )


def contact_width(penetration: Values, diameter: Values) -> Array:
    """Width B of the pipe in the plane of the seabed, m.

        B = 2 sqrt(z (D - z))    for z <= D/2, D beyond

    penetration z of the invert and diameter D, m; z <= 0 is no contact.
    """
    half = 0.5 * np.asarray(diameter)
    z = np.clip(penetration, 0.0, half)
    return np.asarray(2.0 * np.sqrt(z * (diameter - z)))


def embedded_area(penetration: Values, diameter: Values) -> Array:
    """Cross section A_bm of the pipe below the seabed, with the box above its widest point, m2.

        A = (D^2/4) (theta - sin theta cos theta),  sin theta = B/D    for z <= D/2
        A = pi D^2/8 + D (z - D/2)                                     beyond

    Its derivative is the contact width. Source: DNV-RP-F114 as two public programs have it.
    """
    D = np.asarray(diameter, dtype=float)
    z = np.maximum(penetration, 0.0)
    # the half angle keeps its digits at both ends, where arcsin(B/D) does not
    theta = 2.0 * np.arcsin(np.sqrt(np.minimum(z / D, 0.5)))
    segment = 0.25 * D**2 * (theta - 0.5 * np.sin(2.0 * theta))
    return np.asarray(segment + D * np.maximum(z - 0.5 * D, 0.0))
