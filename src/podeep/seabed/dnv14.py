"""DNV Guideline 14: bearing capacity under the contact width, and dynamic stiffness by Hardin."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.polyline import Values
from .bearing import SELF_WEIGHT_FACTOR, BearingFactors, strength
from .law import SHALLOW, Range, SeabedLaw

_KILO = 1e3
_CLAY, _SAND = 1300.0, 1955.0  # of G in kPa


@dataclass(frozen=True, eq=False, kw_only=True)
class Dnv14(SeabedLaw):
    """DNV Guideline 14, in clay or in sand.

        W = B (g' B N_gamma/2 + su Nc + g' z Nq)

    with the contact width B. In small quick motions, vertically and sideways:

        K_d = 0.88 G / (1 - nu),   K_L = 0.76 G (1 + nu)
        G = C (2.97 - e)^2 / (1 + e) sqrt(s),   s = 0.75 g' B,   G and s in kPa
        C = 1300 in clay, 1955 in sand

    effective_unit_weight g' (N/m3); undrained_shear_strength su (Pa) makes it clay,
    friction_angle phi (rad) sand, with self_weight_factor n (-) of N_gamma (`sand_factors`).
    void_ratio e, poisson_ratio nu: without them there is no dynamic stiffness. The soil was never
    loaded more (OCR = 1), hence a plasticity index would have no effect.
    Range: z up to D/2, where B stays at D; e up to 2.
    Source: DNV Guideline 14 as an older page of DeepLines prints it. From memory: the kPa, and K_L,
    which is DNV-RP-F105's. Reconstructed: the page has s = 0.75 g' beta and does not say what beta
    is; B makes this the self-weight term of DNV's s with K0 = 0.5.
    """

    source: ClassVar[str] = "DNV Guideline 14, by an older page of DeepLines"
    no_dynamic: ClassVar[str] = "its dynamic stiffness needs the void ratio and Poisson's ratio"
    ranges: ClassVar[tuple[Range, ...]] = (
        SHALLOW,
        Range("e", 2.0, "the formula of G is for less"),
    )

    effective_unit_weight: Values
    undrained_shear_strength: Values | None = None
    friction_angle: Values | None = None
    self_weight_factor: Values = SELF_WEIGHT_FACTOR
    void_ratio: Values | None = None
    poisson_ratio: Values | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        self._strength  # noqa: B018 - tells of data that make no soil

    @cached_property
    def _strength(self) -> tuple[Values, BearingFactors]:
        return strength(self.undrained_shear_strength, self.friction_angle, self.self_weight_factor)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        """Force and derivative; in clay the latter is infinite at z = 0."""
        su, (Nq, Ngamma, Nc) = self._strength
        g, D = self.effective_unit_weight, np.asarray(self.diameter, dtype=float)
        z = np.maximum(u, 0.0)
        above = np.minimum(z, 0.5 * D)  # where the width still grows
        chord, rest = np.sqrt(above * (D - above)), D - 2.0 * above
        B = 2.0 * chord
        force = B * (0.5 * g * B * Ngamma + su * Nc + g * z * Nq)
        growth = np.full(chord.shape, np.inf)
        np.divide(rest, chord, out=growth, where=chord > 0.0)  # dB/dz
        cohesive = su * Nc * growth if np.any(su) else 0.0
        slope = 2.0 * g * Ngamma * rest + cohesive
        slope = slope + g * Nq * (B + rest * np.sqrt(above / (D - above)))
        return np.asarray(force), np.where(np.less(u, 0.0), 0.0, slope)

    def _penetration(self, weight: Values) -> Array:
        return self.bracketed(weight)

    def shear_modulus(self, penetration: Values) -> Array | None:
        """G at small strain, Pa; None without a void ratio."""
        if self.void_ratio is None:
            return None
        C = _CLAY if self.friction_angle is None else _SAND
        e = self.void_ratio
        stress = 0.75 * self.effective_unit_weight * self.contact_width(penetration)
        return np.asarray(C * (2.97 - e) ** 2 / (1.0 + e) * np.sqrt(stress / _KILO) * _KILO)

    def dynamic_stiffness(self, penetration: Values) -> Array | None:
        G, nu = self.shear_modulus(penetration), self.poisson_ratio
        return None if G is None or nu is None else 0.88 * G / (1.0 - nu)

    def lateral_dynamic_stiffness(self, penetration: Values) -> Array | None:
        G, nu = self.shear_modulus(penetration), self.poisson_ratio
        return None if G is None or nu is None else 0.76 * G * (1.0 + nu)

    def measures(self, penetration: Values) -> Mapping[str, Array]:
        measures = dict(super().measures(penetration))
        if self.void_ratio is not None:
            measures["e"] = np.asarray(self.void_ratio, dtype=float)
        return measures
