"""Vertical bearing capacity of spudcans by ISO 19905-1; symbols and marks as `spudcan`."""

from collections.abc import Mapping
from math import pi
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .polyline import Values
from .spudcan import require_positive

#: Dp/B and Nc sc dc of a circular footing on clay
_CLAY_FACTORS = ((0.0, 0.1, 0.25, 0.5, 1.0, 2.5), (6.0, 6.3, 6.6, 7.0, 7.7, 9.0))
DEEP = 2.5  # Dp/B from which depth changes nothing in clay


class Bearing(NamedTuple):
    """Vertical capacity without backfill and buoyancy (N), per area (Pa), its factors by name."""

    capacity: Array
    unit_capacity: Array
    factors: Mapping[str, Array]


def _bearing(unit_capacity: Values, diameter: Values, **factors: Values) -> Bearing:
    unit = np.asarray(unit_capacity, dtype=float)
    named = {name: np.asarray(value, dtype=float) for name, value in factors.items()}
    return Bearing(unit * (0.25 * pi * np.square(diameter)), unit, MappingProxyType(named))


def _clay_factor(depth: Values, diameter: Values) -> Array:
    require_positive("diameter", diameter, "B")
    return np.asarray(np.interp(np.divide(depth, diameter), *_CLAY_FACTORS))


def clay_bearing_capacity(
    undrained_shear_strength: Values, diameter: Values, depth: Values, effective_overburden: Values
) -> Bearing:
    """Capacity in clay, Qv = (su Nc sc dc + s'v) A.

        Dp/B        0     0.1   0.25  0.5   1.0   2.5
        Nc sc dc    6.0   6.3   6.6   7.0   7.7   9.0     straight lines between, held beyond

    su is the mean over B/2 below Dp, over B where it varies strongly. Gross capacity.
    Source: ISO 19905-1 A.9.3.2; the factors from one source.
    """
    factor = _clay_factor(depth, diameter)
    unit = undrained_shear_strength * factor + effective_overburden
    return _bearing(unit, diameter, NcScDc=factor)


def sand_bearing_capacity(
    friction_angle: Values,
    diameter: Values,
    depth: Values,
    effective_unit_weight: Values,
    effective_overburden: Values,
) -> Bearing:
    """Capacity in sand, Qv = (0.5 g' B Ng sg dg + s'v Nq sq dq) A; g' below Dp.

        Nq = e^(pi tan phi) tan^2(45 deg + phi/2),  Ng = 2 (Nq + 1) tan phi
        sg = 0.6,  sq = 1 + tan phi,  dg = 1
        dq = 1 + 2 tan phi (1 - sin phi)^2 Dp/B;  for Dp > B with atan(Dp/B) in place of Dp/B

    At Dp = B the printed dq falls, from 1.289 to 1.227 at 30 degrees: kept as printed.
    Range: flat footings, phi 20 to 40 degrees. From memory: ISO 19905-1 prefers an Ng of cones and
    takes 5 degrees off phi for large cans; here phi is used as given.
    Source: SNAME T&R 5-5A 6.2.2, ISO 19905-1 A.9.3.2; read.
    """
    require_positive("diameter", diameter, "B")
    phi, ratio = np.asarray(friction_angle, dtype=float), np.divide(depth, diameter)
    tan = np.tan(phi)
    Nq = np.exp(pi * tan) * np.tan(0.25 * pi + 0.5 * phi) ** 2
    Ng, sg, sq, dg = 2.0 * (Nq + 1.0) * tan, 0.6, 1.0 + tan, 1.0
    deep = np.where(ratio <= 1.0, ratio, np.arctan(ratio))
    dq = 1.0 + 2.0 * tan * (1.0 - np.sin(phi)) ** 2 * deep
    weight = 0.5 * effective_unit_weight * diameter * Ng * sg * dg
    unit = weight + effective_overburden * Nq * sq * dq
    return _bearing(unit, diameter, Nq=Nq, Ng=Ng, sq=sq, sg=sg, dq=dq, dg=dg)


def squeezing_bearing_capacity(
    undrained_shear_strength: Values,
    diameter: Values,
    depth: Values,
    effective_overburden: Values,
    thickness: Values,
    lower_unit_capacity: Values,
) -> Bearing:
    """Capacity of soft clay squeezed between the spudcan and a hard layer.

        q = (5 + 0.33 B/T + 1.2 Dp/B) su + s'v   where B >= 3.45 T (1 + 1.025 Dp/B)

    At most lower_unit_capacity (Pa, of the hard layer at its top), but never less than q of
    `clay_bearing_capacity`. thickness T (m): soft clay below Dp. Dp/B is held at 2.5.
    As printed, squeezing sets in with a step of su's part: 2 % at the mudline, 10 % at Dp = B.
    Source: ISO 19905-1 A.9.3.2, Dp/B <= 2.5 (SNAME T&R 5-5A: 1.1 for 1.025); one source. That one
    bounds q by the homogeneous value, which removes the gain; the bound here is from memory.
    """
    plain = clay_bearing_capacity(undrained_shear_strength, diameter, depth, effective_overburden)
    ratio = np.minimum(np.divide(depth, diameter), DEEP)
    # a millionth of the diameter is bounded by the hard layer as zero is
    thin = np.divide(diameter, np.maximum(thickness, np.multiply(1e-6, diameter)))
    squeezes = thin >= 3.45 * (1.0 + 1.025 * ratio)
    factor = np.where(squeezes, 5.0 + 0.33 * thin + 1.2 * ratio, plain.factors["NcScDc"])
    squeezed = factor * undrained_shear_strength + effective_overburden
    unit = np.maximum(plain.unit_capacity, np.minimum(squeezed, lower_unit_capacity))
    return _bearing(unit, diameter, squeezing_factor=factor, **plain.factors)


def two_clays_bearing_capacity(
    undrained_shear_strength: Values,
    lower_shear_strength: Values,
    diameter: Values,
    depth: Values,
    effective_overburden: Values,
    distance: Values,
) -> Bearing:
    """Capacity of firm clay above soft clay, with lower_shear_strength su,b (Pa): punch-through.

        q = 3 (H/B) su + Nc sc dc su,b + s'v,   at most q of the firm clay alone

    distance H (m) from Dp down to the soft clay, whose Nc sc dc is taken at Dp + H.
    Source: ISO 19905-1 A.9.3.2 after Brown and Meyerhof (1969); one source.
    """
    top = clay_bearing_capacity(undrained_shear_strength, diameter, depth, effective_overburden)
    factor = _clay_factor(np.add(depth, distance), diameter)
    sides = 3.0 * np.divide(distance, diameter) * undrained_shear_strength
    punch, own = sides + factor * lower_shear_strength + effective_overburden, top.unit_capacity
    return _bearing(np.minimum(punch, own), diameter, punch_through=punch, top_layer=own)


def sand_over_clay_bearing_capacity(
    friction_angle: Values,
    undrained_shear_strength: Values,
    diameter: Values,
    depth: Values,
    effective_unit_weight: Values,
    effective_overburden: Values,
    distance: Values,
    spread: Values = 5.0,
) -> Bearing:
    """Capacity of sand above clay: punch-through. The least of the sand's own Qv and of

        load spread      Fv,b(B + 2 H/n) - g' H pi (B + 2 H/n)^2/4
        projected area   Fv,b(B) - A H g' + 2 (H/B) (H g' + 2 s'v) Ks tan(phi) A
                         Ks tan(phi) = 3 su / (B g')

    Fv,b: `clay_bearing_capacity` on the clay's top as if that were the mudline (Nc sc dc = 6, the
    safe reading), under s'v + g' H. All three are in the factors, per area A. su is the clay's, g'
    the sand's; distance H (m) from Dp down to the clay, spread n (-, n down to one sideways).
    Range: n 3 to 5; 5 is the lower bound.
    Source: ISO 19905-1 A.9.3.2; one source. That the sand alone bounds both is from memory.
    """
    require_positive("sand's unit weight", effective_unit_weight, "GAMMA")
    B, su, s = diameter, undrained_shear_strength, effective_overburden
    sand = sand_bearing_capacity(friction_angle, B, depth, effective_unit_weight, s).unit_capacity
    # the sand's weight above the clay is in Fv,b and in what is taken off again: left out of both
    clay = clay_bearing_capacity(su, B, 0.0, s).unit_capacity
    slenderness = np.divide(distance, B)
    spreading = clay * (1.0 + 2.0 * slenderness / spread) ** 2
    height = distance + 2.0 * np.divide(s, effective_unit_weight)
    projected = clay + 6.0 * su * slenderness * height / B
    unit = np.minimum(np.minimum(spreading, projected), sand)
    return _bearing(unit, B, load_spread=spreading, projected_area=projected, top_layer=sand)
