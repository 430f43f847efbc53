"""Lateral reaction (p-y) of sand by API, and the wedge that its coefficients come from."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import radians
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .law import LayeredLaw
from .polyline import Values


@dataclass(frozen=True, eq=False)
class Sand(LayeredLaw):
    """Sand of API (O'Neill and Murchison).

        pu = min( (C1 X + C2 D) s'v , C3 D s'v )
        p = A pu tanh( k X y / (A pu) )
        A = 0.9 cyclic, max(3 - 0.8 X/D, 0.9) static

    C1, C2, C3: `sand_coefficients`. At the mudline p is 0 for any y.

    depth X (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above),
    friction_angle phi (rad), subgrade_modulus k (N/m3; None: `default_subgrade_modulus`),
    multiplier (-, on p at the same y, group effects), stiffness_depth (m, in k X alone where layers
    make X an equivalent depth; None: X). p in N/m.

    Range: clean siliceous sand, phi 20 to 40 degrees, slender piles up to about 2 m.
    Source: API RP 2GEO 8.5.6-8.5.7, API RP 2A-WSD 6.8.6-6.8.7.
    """

    source: ClassVar[str] = "API RP 2GEO 8.5.6-8.5.7, API RP 2A-WSD 6.8.6-6.8.7"

    depth: Values
    diameter: Values
    effective_overburden: Values
    friction_angle: Values
    subgrade_modulus: Values | None = None
    multiplier: Values = 1.0
    cyclic: bool = False
    stiffness_depth: Values | None = None

    @cached_property
    def ultimate_resistance(self) -> Array:
        """pu with its multiplier, before A, N/m, shape (n,)."""
        width = failure_width(self.depth, self.diameter, self.friction_angle)
        return np.atleast_1d(self.multiplier * width * self.effective_overburden)

    @cached_property
    def _A(self) -> Values:
        if self.cyclic:
            return 0.9
        return np.maximum(3.0 - 0.8 * np.divide(self.depth, self.diameter), 0.9)

    @cached_property
    def _backbone(self) -> tuple[Array, Array, Array]:
        """A pu, the initial stiffness, and their ratio (1/m; 0 where A pu is 0)."""
        peak = self._A * self.ultimate_resistance
        modulus = self.subgrade_modulus
        k = default_subgrade_modulus(self.friction_angle) if modulus is None else modulus
        z = self.depth if self.stiffness_depth is None else self.stiffness_depth
        initial = np.asarray(self.multiplier * k * z * (peak > 0.0))
        rate = np.divide(initial, peak, out=np.zeros_like(peak), where=peak > 0.0)
        return peak, initial, rate

    @property
    def derived(self) -> Mapping[str, Array]:
        C1, C2, C3 = np.atleast_2d(sand_coefficients(np.atleast_1d(self.friction_angle)))
        return {
            "C1": C1,
            "C2": C2,
            "C3": C3,
            "A": np.atleast_1d(self._A),
            "ultimate_resistance": self.ultimate_resistance,
        }

    @property
    def capacity(self) -> Array:
        return self._backbone[0]

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        peak, initial, rate = self._backbone
        ratio = u * rate
        np.tanh(ratio, out=ratio)
        force = peak * ratio
        ratio *= ratio
        ratio *= initial
        np.subtract(initial, ratio, out=ratio)
        return force, ratio


def failure_width(depth: Values, diameter: Values, friction_angle: Values) -> Array:
    """What the overburden acts on at failure: min( C1 X + C2 D , C3 D ), m, shape (n,)."""
    C1, C2, C3 = sand_coefficients(friction_angle)
    return np.asarray(np.minimum(C1 * depth + C2 * diameter, C3 * diameter))


def sand_coefficients(friction_angle: Values) -> Array:
    """C1, C2 and C3 of API's sand at friction angles (rad) of shape (n,): shape (3, n).

    The closed form behind the figure of API RP 2A-WSD 6.8.6-1: the wedge of Reese, Cox and Koop,
    OTC 2080 (1974), with alpha = phi/2, beta = 45 deg + phi/2, K0 = 0.4 and Rankine's Ka.
    """
    phi = np.asarray(friction_angle, dtype=float)
    a, b, K0 = 0.5 * phi, radians(45.0) + 0.5 * phi, 0.4
    tan_a, tan_b, tan_phi, tan_wedge = np.tan(a), np.tan(b), np.tan(phi), np.tan(b - phi)
    Ka = tan_wedge**2  # beta - phi = 45 deg - phi/2
    side = tan_phi * np.sin(b) / (np.cos(a) * tan_wedge) + tan_b * (tan_phi * np.sin(b) - tan_a)
    C1 = tan_b**2 * tan_a / tan_wedge + K0 * side
    C2 = tan_b / tan_wedge - Ka
    C3 = Ka * (tan_b**8 - 1.0) + K0 * tan_phi * tan_b**4
    return np.asarray((C1, C2, C3))


def default_subgrade_modulus(friction_angle: Values) -> Array:
    """k of sand below water (N/m3) at a friction angle (rad), in its shape.

    Table of API RP 2GEO 8.5.7: 5.4, 11, 22 and 45 MN/m3 at 25, 30, 35 and 40 degrees, straight
    lines between, held beyond.
    """
    angles = np.radians((25.0, 30.0, 35.0, 40.0))
    return np.asarray(np.interp(friction_angle, angles, (5.4e6, 11e6, 22e6, 45e6)))
