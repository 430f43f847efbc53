"""Touchdown of a tensioned beam on a Winkler seabed, small slopes: the exact boundary layer.

    EI y'''' - T y'' + w + k y [y < 0] = 0,   x > 0 suspended,   l = sqrt(EI/T),   K = k EI/T^2

y is up, x counts from where the line leaves the seabed. The slope there does not depend on EI.
Sources: derived, from the matching of both sides; Pesce, Aranha and Martins, OMAE (1998) use the
same K.
"""

from cmath import sqrt as csqrt
from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np

from ..arrays import Array
from ..errors import InvalidData


@dataclass(frozen=True)
class BoundaryLayer:
    """bending_stiffness EI, N m2; tension T, N; weight w, N/m; stiffness k, N/m2: all above 0."""

    bending_stiffness: float
    tension: float
    weight: float
    stiffness: float

    def __post_init__(self) -> None:
        for name in ("bending_stiffness", "tension", "weight", "stiffness"):
            if not getattr(self, name) > 0.0:
                words = name.replace("_", " ")
                raise InvalidData(f"a {words} of {getattr(self, name):g}", "give more than 0")

    @property
    def length(self) -> float:
        """l, over which bending fades where the line hangs, m."""
        return sqrt(self.bending_stiffness / self.tension)

    @property
    def relative_stiffness(self) -> float:
        """K, -."""
        return self.stiffness * self.bending_stiffness / self.tension**2

    @property
    def slope(self) -> float:
        """At the touchdown, rad."""
        return self.weight / sqrt(self.stiffness * self.tension)

    @property
    def curvature(self) -> float:
        """At the touchdown, 1/m."""
        root = sqrt(self.relative_stiffness)
        return self.weight / self.tension * (sqrt(1.0 + 2.0 * root) - 1.0) / root

    @property
    def moment(self) -> float:
        """At the touchdown, N m."""
        return self.bending_stiffness * self.curvature

    @property
    def shear(self) -> float:
        """EI y''' at the touchdown, N."""
        return self.weight * self.length * (1.0 - self.curvature * self.tension / self.weight)

    @property
    def vertex(self) -> tuple[float, float]:
        """Where the far catenary has its lowest point: x from the touchdown, and y, m."""
        K = self.relative_stiffness
        x = -self.length * (sqrt(1.0 + 2.0 * sqrt(K)) / sqrt(K) - 1.0)
        return x, 0.5 * self._scale * (1.0 - 1.0 / K)

    @property
    def _scale(self) -> float:
        return self.weight * self.length**2 / self.tension

    @cached_property
    def _rates(self) -> tuple[complex, complex]:
        """Both rates with which the line in contact fades, over l."""
        inner = csqrt(1.0 - 4.0 * self.relative_stiffness)
        return csqrt(0.5 * (1.0 + inner)), csqrt(0.5 * (1.0 - inner))

    def profile(self, x: Array, derivative: int = 0) -> Array:
        """y at x, (n,), or a derivative of it up to the fourth, from the touchdown, m."""
        xi = np.asarray(x, dtype=float) / self.length
        hangs = xi >= 0.0
        c2 = self.curvature * self.tension / self.weight - 1.0
        c1 = -self.vertex[0] / self.length
        fading = c2 * (-1.0) ** derivative * np.exp(-np.where(hangs, xi, 0.0))
        polynomial = np.polynomial.Polynomial([-c2, c1, 0.5]).deriv(derivative)
        above = polynomial(xi) + fading
        one, other = self._rates
        # y = 0 and the slope of the other side at the touchdown
        slope = self.slope * self.length / self._scale
        first = (slope - other / self.relative_stiffness) / (one - other)
        second = 1.0 / self.relative_stiffness - first
        inside = np.where(hangs, 0.0, xi)
        below = first * one**derivative * np.exp(one * inside)
        below = below + second * other**derivative * np.exp(other * inside)
        lowered = below.real - (1.0 / self.relative_stiffness if derivative == 0 else 0.0)
        return np.asarray(np.where(hangs, above, lowered) * self._scale / self.length**derivative)
