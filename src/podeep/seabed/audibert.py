"""Bearing under a pipe with a hyperbola, in the place of Audibert's model that was not found."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..soil.polyline import Values
from .bearing import SELF_WEIGHT_FACTOR, BearingFactors, strength
from .law import Range, SeabedLaw

ULTIMATE_PENETRATION = 0.1  # of the diameter, the lower end of 0.10 to 0.15
_START, _REST = 0.07, 0.93  # of the hyperbola's two constants


@dataclass(frozen=True, eq=False, kw_only=True)
class Audibert(SeabedLaw):
    """Reconstructed, and not the formula of DeepLines, which was not found in public text.

        W = z / (A + C z),   A = 0.07 zu/qu,   C = 0.93/qu
        qu = Nc su D + Nq g' z D + N_gamma g' D^2/2

    In small quick motions K_d = 1/A, the slope that W starts with. effective_unit_weight g'
    (N/m3); undrained_shear_strength su (Pa) makes it clay, friction_angle phi (rad) sand, with
    self_weight_factor n (-) of N_gamma (`sand_factors`); ultimate_penetration zu/D (-), at which
    the hyperbola reaches qu.
    Range: z up to zu; beyond, the hyperbola goes on.
    Source: a guess at what the row "Audibert 1984" stands for: downward bearing of buried pipes in
    the guideline of 1984 of the ASCE by the same authors, from memory, with z for its depth.
    """

    source: ClassVar[str] = "ASCE 1984 for buried pipes, reconstructed; not DeepLines' Audibert"
    ranges: ClassVar[tuple[Range, ...]] = (
        Range("z/zu", 1.0, "its hyperbola ends there, at the bearing capacity"),
    )

    effective_unit_weight: Values
    undrained_shear_strength: Values | None = None
    friction_angle: Values | None = None
    self_weight_factor: Values = SELF_WEIGHT_FACTOR
    ultimate_penetration: Values = ULTIMATE_PENETRATION

    def __post_init__(self) -> None:
        super().__post_init__()
        self._strength  # noqa: B018 - tells of data that make no soil

    @cached_property
    def _strength(self) -> tuple[Values, BearingFactors]:
        return strength(self.undrained_shear_strength, self.friction_angle, self.self_weight_factor)

    @cached_property
    def _capacity(self) -> tuple[Values, Values]:
        """qu at z = 0, N/m, and its rise with z, Pa."""
        su, (Nq, Ngamma, Nc) = self._strength
        weight, D = self.effective_unit_weight * np.asarray(self.diameter), self.diameter
        return Nc * su * D + 0.5 * Ngamma * weight * D, Nq * weight

    @property
    def _softness(self) -> Values:
        """0.07 zu, m."""
        return _START * self.ultimate_penetration * self.diameter

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        base, rise = self._capacity
        z = np.maximum(u, 0.0)
        below, ultimate = self._softness + _REST * z, base + rise * z
        slope = (self._softness * ultimate / below + rise * z) / below
        return np.asarray(z * ultimate / below), np.where(np.less(u, 0.0), 0.0, slope)

    def _penetration(self, weight: Values) -> Array:
        """Positive root of rise z^2 + (base - 0.93 W) z - 0.07 zu W = 0, without cancellation."""
        base, rise = self._capacity
        half = 0.5 * (base - _REST * np.asarray(weight))
        constant = self._softness * weight
        root = np.sqrt(np.square(half) + rise * constant)
        return np.where(half > 0.0, constant / (np.abs(half) + root), (root - half) / rise)

    def measures(self, penetration: Values) -> Mapping[str, Array]:
        ultimate = self.ultimate_penetration * np.asarray(self.diameter)
        return {**super().measures(penetration), "z/zu": np.divide(penetration, ultimate)}

    def dynamic_stiffness(self, penetration: Values) -> Array | None:
        base, rise = self._capacity
        return np.asarray((base + rise * np.asarray(penetration)) / self._softness)
