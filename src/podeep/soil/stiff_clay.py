"""Lateral reaction (p-y) of stiff clay, with and without free water."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from math import sqrt
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .initial_line import Falling, below_line
from .law import LayeredLaw
from .polyline import Values

_TINY = 1e-150  # keeps a quotient finite where its divisor is 0
_LEAST_DEPTH = 0.1  # of a diameter, in k z
_TOE = 1e-10  # y/y50 that rounds off the fourth root's infinite slope
_PLATEAU = 16.0  # y/y50 from which the fourth root's law is constant

#: Bounds between the classes of strength (Pa), and k of each class (N/m3).
_CLASSES = (100e3, 200e3)
_STATIC_K = np.array((135e6, 270e6, 540e6))
_CYCLIC_K = np.array((55e6, 110e6, 217e6))


def _static(pc: Array, As: Array, y50: Array) -> Falling:
    """Static law over x = y / (As y50). The top is at x^2 (x - 1) = (40/11)^4 As^2: Cardano."""
    root = np.sqrt(As)
    half = 1.0 / 27.0 + 0.5 * (40.0 / 11.0) ** 4 * As**2
    c = np.cbrt(half + np.sqrt(half**2 - 1.0 / 729.0))
    top, loss = 0.5 * sqrt(6.0) * root - 0.411, 0.0625 * As
    residual = 1.225 * root - 0.75 * As - 0.411
    return Falling(
        hump=partial(_static_hump, 0.5 * pc * root, 0.055 * pc),
        unit=As * y50,
        peak=c + 1.0 / (9.0 * c) + 1.0 / 3.0,
        first=6.0,
        last=np.where(residual > 0.0, 18.0, 6.0 + top / loss),
        top=pc * top,
        loss=pc * loss,
        residual=pc * np.maximum(residual, 0.0),
    )


def _static_hump(half: Array, drop: Array, x: Array) -> tuple[Array, Array]:
    root, beyond = np.sqrt(x), np.maximum(x - 1.0, 0.0)
    lost = drop * np.sqrt(np.sqrt(beyond))
    force = half * root
    force -= lost * beyond
    slope = half / np.maximum(root, _TINY)
    lost *= 2.5
    slope -= lost
    slope *= 0.5
    return force, slope


def _cyclic(pc: Array, Ac: Array, y50: Array) -> Falling:
    """Cyclic law over x = y / (0.45 yp)."""
    level, ratio = Ac * pc, 4.1  # ratio of yp to Ac y50
    return Falling(
        hump=partial(_cyclic_hump, level),
        unit=0.45 * ratio * Ac * y50,
        peak=np.ones_like(Ac),
        first=0.6 / 0.45,
        last=np.full_like(Ac, 1.8 / 0.45),
        top=0.936 * level,
        loss=0.085 * 0.45 * ratio * level,
        residual=(0.936 - 0.102 * ratio) * level,
    )


def _cyclic_hump(level: Array, x: Array) -> tuple[Array, Array]:
    """1 - s^2.5, s = |1 - x|, as (1 - s^5) / (1 + s^2.5): exact also at small x."""
    s = np.abs(1.0 - x)
    power = s * np.sqrt(s)
    ratio = (1.0 + s * (1.0 + s * (1.0 + s * (1.0 + s)))) / (1.0 + s * power)
    return level * np.minimum(x, 2.0 - x) * ratio, np.copysign(2.5 * level * power, 1.0 - x)


@dataclass(frozen=True, eq=False, kw_only=True)
class StiffClayFreeWater(LayeredLaw):
    """Stiff clay with free water, of Reese, Cox and Koop.

        pc = min( 2 ca D + s'v D + 2.83 ca z , 11 c D )
        y50 = eps50 D
        As = 0.2 + 0.4 tanh(0.62 z/D) ,  Ac = 0.2 + 0.1 tanh(1.5 z/D)
        p = min( k z y , law )              z >= 0.1 D in k z alone

    Static law, r = y/y50:

        r <= As     0.5 pc r^0.5
        r < 6 As    0.5 pc r^0.5 - 0.055 pc ((r - As)/As)^1.25
        r < 18 As   0.5 pc (6 As)^0.5 - 0.411 pc - 0.0625 pc (r - 6 As)
        beyond      pc (1.225 As^0.5 - 0.75 As - 0.411)

    Cyclic law, yp = 4.1 Ac y50:

        y < 0.6 yp  Ac pc (1 - |(y - 0.45 yp) / (0.45 yp)|^2.5)
        y < 1.8 yp  0.936 Ac pc - 0.085 (pc/y50) (y - 0.6 yp)
        beyond      0.936 Ac pc - 0.102 (pc/y50) yp

    The published figures are rounded, so that the law jumps up by some 2e-4 pc at 6 As, 18 As and
    0.6 yp. They are kept: a breakpoint belongs to the branch beyond it, reaction and derivative.
    Where As < 0.2226 (z < 0.091 D) the static residual is negative: there the fall ends at 0 and
    p stays 0. The cyclic residual is 0.518 Ac pc. Without the least z in k z a pile would have no
    resistance at the mudline, though pc is not 0 there. Ac, not As, stands in yp, as in most
    programs. Where k z is small the line is followed past the law's peak down to where they meet;
    `capacity` is the largest p of the two together.

    depth z (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above),
    undrained_shear_strength c (Pa, local), mean_undrained_shear_strength ca (Pa, from the mudline
    to z), strain_50 eps50 (-), subgrade_modulus k (N/m3; None: `default_subgrade_modulus` of c),
    multiplier (-, on p at the same y, group effects), stiffness_depth (m, in k z alone where
    layers make the depth an equivalent one; None: the depth). p in N/m.

    Range: c 50 to 400 kPa, below water; eps50 0.007, 0.005, 0.004 for c up to 100, 200, 400 kPa.
    Source: Reese, Cox and Koop, OTC 2312 (1975); As, Ac: fits of its chart.
    """

    source: ClassVar[str] = "Reese, Cox and Koop, OTC 2312 (1975)"

    depth: Values
    diameter: Values
    effective_overburden: Values
    undrained_shear_strength: Values
    mean_undrained_shear_strength: Values
    strain_50: Values
    subgrade_modulus: Values | None = None
    multiplier: Values = 1.0
    cyclic: bool = False
    stiffness_depth: Values | None = None

    @cached_property
    def ultimate_resistance(self) -> Array:
        """pc with its multiplier, N/m, shape (n,)."""
        c, ca, D = self.undrained_shear_strength, self.mean_undrained_shear_strength, self.diameter
        wedge = (2.0 * ca + self.effective_overburden) * D + 2.83 * ca * self.depth
        return np.atleast_1d(self.multiplier * np.minimum(wedge, 11.0 * c * D))

    @cached_property
    def y50(self) -> Array:
        """eps50 D, m, shape (n,)."""
        return np.atleast_1d(np.multiply(self.strain_50, self.diameter))

    @cached_property
    def _A(self) -> Array:
        ratio = np.atleast_1d(np.divide(self.depth, self.diameter))
        if self.cyclic:
            return np.asarray(0.2 + 0.1 * np.tanh(1.5 * ratio))
        return np.asarray(0.2 + 0.4 * np.tanh(0.62 * ratio))

    @cached_property
    def initial_stiffness(self) -> Array:
        """k z with its multiplier, N/m2, shape (n,)."""
        k = self.subgrade_modulus
        if k is None:
            k = default_subgrade_modulus(self.undrained_shear_strength, self.cyclic)
        z = self.depth if self.stiffness_depth is None else self.stiffness_depth
        z = np.maximum(z, _LEAST_DEPTH * np.asarray(self.diameter))
        return np.atleast_1d(self.multiplier * k * z)

    @cached_property
    def _law(self) -> Falling:
        law = _cyclic if self.cyclic else _static
        return law(self.ultimate_resistance, self._A, self.y50)

    @property
    def derived(self) -> Mapping[str, Array]:
        return {
            "ultimate_resistance": self.ultimate_resistance,
            "y50": self.y50,
            "A": self._A,
            "initial_stiffness": self.initial_stiffness,
            "residual_resistance": self._law.residual,
        }

    @cached_property
    def capacity(self) -> Array:
        return self._law.largest_below(self.initial_stiffness)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        y = np.abs(u)
        force, stiffness = below_line(y, self.initial_stiffness, *self._law.evaluate(y))
        np.minimum(force, self.capacity, out=force)  # at the peak but for rounding
        return np.copysign(force, u), stiffness


@dataclass(frozen=True, eq=False, kw_only=True)
class StiffClay(LayeredLaw):
    """Stiff clay without free water, of Reese and Welch.

        pu = min( (3 ca + s'v) D + J ca X , 9 c D )
        y50 = 2.5 eps50 D
        p = 0.5 pu (y/y50)^(1/4) up to y = 16 y50, then p = pu

    Cyclic: after N cycles the same p needs more displacement,

        yN = y + y50 9.6 (p/pu)^4 log10(N)

    Since (p/pu)^4 = y / (16 y50) up to the plateau, yN = y (1 + 0.6 log10 N): the static law with
    y50 times that factor, its plateau from 16 y50 (1 + 0.6 log10 N) on. No strength is lost.

    The fourth root has an infinite slope at rest. It is rounded to s / (s^2 + d^2)^(3/8),
    s = y/y50, with d = 1e-10, which takes 4e-9 of p at s = 1e-6 and nothing at s = 0.01; p never
    exceeds pu.

    depth X (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above,
    of the total unit weight above water), undrained_shear_strength c (Pa, local),
    mean_undrained_shear_strength ca (Pa, from the mudline to X), strain_50 eps50 (-), j J (-),
    cycles N (-, at least 1, of cyclic loading alone), multiplier (-, on p at the same y, group
    effects). p in N/m.

    Range: stiff clay above water.
    Source: Reese and Welch, J. Geotech. Eng. Div. ASCE 101 GT7 (1975).
    """

    source: ClassVar[str] = "Reese and Welch, J. Geotech. Eng. Div. ASCE 101 GT7 (1975)"

    depth: Values
    diameter: Values
    effective_overburden: Values
    undrained_shear_strength: Values
    mean_undrained_shear_strength: Values
    strain_50: Values
    j: Values = 0.5
    multiplier: Values = 1.0
    cyclic: bool = False
    cycles: Values = 100.0

    def __post_init__(self) -> None:
        fewest = float(np.min(np.asarray(self.cycles, dtype=float), initial=np.inf))
        if not fewest >= 1.0:
            raise InvalidData(
                f"{fewest:g} cycles of loading are less than one",
                "give 1 or more, or leave them out for 100",
                "CYCLES",
            )

    @cached_property
    def ultimate_resistance(self) -> Array:
        """pu with its multiplier, N/m, shape (n,)."""
        c, ca, D = self.undrained_shear_strength, self.mean_undrained_shear_strength, self.diameter
        wedge = (3.0 * ca + self.effective_overburden) * D + self.j * ca * self.depth
        return np.atleast_1d(self.multiplier * np.minimum(wedge, 9.0 * c * D))

    @cached_property
    def y50(self) -> Array:
        """Displacement at half the resistance, after N cycles if cyclic, m, shape (n,)."""
        static = np.atleast_1d(2.5 * np.multiply(self.strain_50, self.diameter))
        return static * (1.0 + 0.6 * np.log10(self.cycles)) if self.cyclic else static

    @property
    def derived(self) -> Mapping[str, Array]:
        return {"ultimate_resistance": self.ultimate_resistance, "y50": self.y50}

    @property
    def capacity(self) -> Array:
        return self.ultimate_resistance

    @cached_property
    def _factors(self) -> tuple[Array, Array, Array]:
        """The most negative reaction, half the largest one, and a quarter of that by y50."""
        half = 0.5 * self.ultimate_resistance
        return -self.ultimate_resistance, half, 0.25 * half / self.y50

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        lower, half, quarter = self._factors
        s = u / self.y50
        square = s * s
        square += _TOE**2
        fourth = np.sqrt(np.sqrt(square))
        root = fourth * np.sqrt(fourth)
        force = s
        force /= root
        force *= half
        np.minimum(force, self.ultimate_resistance, out=force)
        np.maximum(force, lower, out=force)
        root *= square
        stiffness = square + 3.0 * _TOE**2
        stiffness /= root
        stiffness *= quarter
        stiffness *= square < _PLATEAU**2 + _TOE**2
        return force, stiffness


def default_subgrade_modulus(undrained_shear_strength: Values, cyclic: bool = False) -> Array:
    """k of stiff clay with free water (N/m3) at a strength (Pa), in its shape.

    135, 270 and 540 MN/m3 for c up to 100, up to 200 and above 200 kPa; cyclic 55, 110 and 217.
    Steps, held outside 50 to 400 kPa; a bound belongs to the softer class. Source: FHWA GEC-9
    (500, 1000, 2000 and 200, 400, 800 lb/in3; 540 for the last is a known misprint).
    """
    k = _CYCLIC_K if cyclic else _STATIC_K
    return np.asarray(k[np.searchsorted(_CLASSES, undrained_shear_strength, side="left")])
