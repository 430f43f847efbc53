"""Lateral reaction (p-y) of sand by Reese, Cox and Koop."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from ..arrays import Array
from .initial_line import below_line
from .law import LayeredLaw
from .polyline import Values
from .sand import default_subgrade_modulus, failure_width

#: X/D of the charts of A and B
_NODES = (0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0)
#: (A, B) there, by whether the loading is cyclic
_CHARTS: Mapping[bool, tuple[tuple[float, ...], tuple[float, ...]]] = MappingProxyType(
    {
        False: (
            (2.85, 2.43, 2.06, 1.74, 1.44, 1.21, 1.03, 0.90, 0.88),
            (2.20, 1.85, 1.56, 1.26, 1.05, 0.88, 0.70, 0.54, 0.50),
        ),
        True: (
            (0.75, 0.91, 1.06, 1.08, 1.01, 0.97, 0.93, 0.88, 0.88),
            (0.50, 0.71, 0.84, 0.86, 0.82, 0.78, 0.69, 0.56, 0.55),
        ),
    }
)
_END = 2.25  # yu / ym
_LEAST = 1e-200  # y/ym that keeps the parabola's slope finite, far under the initial line


@dataclass(frozen=True, eq=False, kw_only=True)
class ReeseSand(LayeredLaw):
    """Sand of Reese, Cox and Koop: a line, a parabola, a line and a plateau.

        ps = min( (C1 X + C2 D) s'v , C3 D s'v )
        pm = B ps at ym = D/60 ,  pu = A ps at yu = 3 D/80
        m = (pu - pm) / (yu - ym) ,  n = pm / (m ym) ,  C = pm / ym^(1/n)
        yk = (C / (k X))^(n/(n-1))

        p = k X y up to y = yk
        p = C y^(1/n) up to y = ym, tangent there to the line that follows
        p = pm + m (y - ym) up to y = yu, then p = pu

    C1, C2, C3: `podeep.soil.sand.sand_coefficients`. A and B by X/D, straight lines between, held
    beyond 5:

        X/D         0     0.5   1     1.5   2     2.5   3     4     5
        A static    2.85  2.43  2.06  1.74  1.44  1.21  1.03  0.90  0.88
        B static    2.20  1.85  1.56  1.26  1.05  0.88  0.70  0.54  0.50
        A cyclic    0.75  0.91  1.06  1.08  1.01  0.97  0.93  0.88  0.88
        B cyclic    0.50  0.71  0.84  0.86  0.82  0.78  0.69  0.56  0.55

    Of this table n >= 1.6, so the curve from the parabola on is concave and the initial line meets
    it once: p is the smaller of the two. That is the printed law as long as yk <= ym; with a
    softer k the line is followed until it meets the second line or pu, and `y_k` in what is
    derived is where it does. At the mudline p is 0 for any y, and so is the capacity.

    depth X (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above),
    friction_angle phi (rad), subgrade_modulus k (N/m3; None:
    `podeep.soil.sand.default_subgrade_modulus`, submerged), multiplier (-, on p at the same y,
    group effects), stiffness_depth (m, in k X alone where
    layers make the depth an equivalent one; None: the depth). p in N/m.

    Range: clean siliceous sand, phi 20 to 40 degrees, slender piles up to about 2 m.
    Source: Reese, Cox and Koop, OTC 2080 (1974); A and B static as read off its chart by later
    programs, cyclic as in FHWA's COM624P.
    """

    source: ClassVar[str] = "Reese, Cox and Koop, OTC 2080 (1974)"

    depth: Values
    diameter: Values
    effective_overburden: Values
    friction_angle: Values
    subgrade_modulus: Values | None = None
    multiplier: Values = 1.0
    cyclic: bool = False
    stiffness_depth: Values | None = None

    @cached_property
    def theoretical_resistance(self) -> Array:
        """ps with the multiplier, N/m, shape (n,)."""
        width = failure_width(self.depth, self.diameter, self.friction_angle)
        return np.atleast_1d(self.multiplier * width * self.effective_overburden)

    @cached_property
    def _AB(self) -> tuple[Array, Array]:
        ratio = np.atleast_1d(np.divide(self.depth, self.diameter))
        A, B = (np.asarray(np.interp(ratio, _NODES, chart)) for chart in _CHARTS[self.cyclic])
        return A, B

    @property
    def layering_resistance(self) -> Array:
        return self.theoretical_resistance

    @property
    def ultimate_resistance(self) -> Array:
        """pu with its multiplier, N/m, shape (n,)."""
        return np.asarray(self._AB[0] * self.theoretical_resistance)

    @cached_property
    def initial_stiffness(self) -> Array:
        """k X with its multiplier, N/m2, shape (n,)."""
        k = self.subgrade_modulus
        if k is None:
            k = default_subgrade_modulus(self.friction_angle)
        z = self.depth if self.stiffness_depth is None else self.stiffness_depth
        return np.atleast_1d(np.multiply(self.multiplier, z) * k)

    @cached_property
    def _factors(self) -> tuple[Array, Array, Array, Array]:
        """ym, pm, m ym and 1/n."""
        A, B = self._AB
        ym = np.atleast_1d(np.asarray(self.diameter) / 60.0)
        ps, steps = self.theoretical_resistance, _END - 1.0
        return ym, B * ps, (A - B) * ps / steps, (A / B - 1.0) / steps

    @property
    def y_k(self) -> Array:
        """Displacement at which the initial line ends, m, shape (n,); inf where it is level."""
        ym, pm, rise, exponent = self._factors
        line, m = self.initial_stiffness, rise / ym
        infinite = np.full(np.broadcast_shapes(line.shape, pm.shape), np.inf)
        steep = np.divide(pm, line * ym, out=infinite.copy(), where=line > 0.0)
        at_plateau = np.divide(
            self.ultimate_resistance, line, out=infinite.copy(), where=line > 0.0
        )
        at_line = np.divide(pm - rise, line - m, out=infinite.copy(), where=line > m)
        at_parabola = ym * np.minimum(steep, 1.0) ** (1.0 / (1.0 - exponent))
        return np.asarray(np.where(steep <= 1.0, at_parabola, np.minimum(at_line, at_plateau)))

    @property
    def derived(self) -> Mapping[str, Array]:
        A, B = self._AB
        return {
            "A": A,
            "B": B,
            "theoretical_resistance": self.theoretical_resistance,
            "ultimate_resistance": self.ultimate_resistance,
            "initial_stiffness": self.initial_stiffness,
            "y_k": self.y_k,
        }

    @cached_property
    def capacity(self) -> Array:
        return self.ultimate_resistance * (self.initial_stiffness > 0.0)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        ym, pm, rise, exponent = self._factors
        y = np.abs(u)
        x = y / ym
        bend = np.maximum(np.minimum(x, 1.0), _LEAST)
        force = pm * bend**exponent
        slope = np.where(x < 1.0, exponent * force / bend, rise * (x < _END))
        slope /= ym
        force += rise * np.maximum(np.minimum(x, _END) - 1.0, 0.0)
        force, stiffness = below_line(y, self.initial_stiffness, force, slope)
        return np.copysign(force, u), stiffness
