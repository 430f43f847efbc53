"""Lateral reaction (p-y) of clay by the third edition of ISO 19901-4."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar

import numpy as np

from ..arrays import Array, Index
from ..errors import InvalidData
from .backbone import TableLaw
from .polyline import Polyline, Values

_N1, _N2 = 12.0, 3.22
_LEAST_D = 14.5
_RATIOS = np.array((0.0, 0.05, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.975, 1.0))  # p/pu
_OCR = (2.0, 4.0, 10.0)

#: y/D at the ratios, by plasticity: one row of the table for each OCR
_TABLES: Mapping[str, Array] = MappingProxyType(
    {
        "HIGH": np.array(
            (
                (0, 0.0003, 0.003, 0.0053, 0.009, 0.014, 0.022, 0.032, 0.05, 0.082, 0.15, 0.25),
                (0, 0.0004, 0.004, 0.008, 0.015, 0.024, 0.036, 0.055, 0.084, 0.14, 0.23, 0.3),
                (0, 0.0005, 0.005, 0.011, 0.021, 0.034, 0.052, 0.078, 0.12, 0.19, 0.3, 0.4),
            )
        ),
        "LOW": np.array(
            (
                (0, 0.0001, 0.001, 0.0018, 0.003, 0.0048, 0.0073, 0.011, 0.017, 0.027, 0.05, 0.083),
                (0, 0.0002, 0.002, 0.004, 0.0075, 0.012, 0.018, 0.027, 0.042, 0.07, 0.11, 0.15),
                (0, 0.0003, 0.0033, 0.0073, 0.014, 0.023, 0.035, 0.052, 0.08, 0.13, 0.2, 0.27),
            )
        ),
    }
)


@dataclass(frozen=True, eq=False)
class _Fan(Polyline):
    """As `Polyline`, odd, with nodes of each point's own: (m, n), those of u >= 0 from 0 on."""

    @cached_property
    def _segments(self) -> tuple[Array, Index, Array, Array]:
        shape = np.broadcast_shapes(self.nodes.shape, self.values.shape, self.scale.shape)
        x, v = np.broadcast_to(self.nodes, shape), np.broadcast_to(self.values, shape)
        slope = np.zeros(shape)
        slope[:-1] = np.diff(v, axis=0) / np.diff(x, axis=0)
        intercept = v - slope * x
        return x, np.arange(shape[1]) - shape[1], intercept.ravel(), (slope / self.scale).ravel()

    @cached_property
    def corners(self) -> Array:
        return np.asarray(self._segments[0][1:] * self.scale)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        edges, offset, intercept, slope = self._segments
        size = np.abs(u)
        beyond = (size / self.scale)[..., None, :] >= edges
        segment = beyond.sum(axis=-2) * len(offset) + offset
        stiffness = slope.take(segment)
        force = stiffness * size
        force += intercept.take(segment)
        return np.copysign(force, u), stiffness


@dataclass(frozen=True, eq=False, kw_only=True)
class IsoClay(TableLaw):
    """Clay of ISO 19901-4, third edition, monotonic.

        pu = Np su D,  Npd = 9 + 3 alpha
        Np0 = N1 - (1 - alpha) - (N1 - N2) (1 - (X/(d D))^0.6)^1.35 <= Npd,  bracket >= 0
        d = 16.8 - 2.3 log10(su0/(su1 D)) >= 14.5,  N1 = 12,  N2 = 3.22
        gap       Np = cw Np0 + s'v/su <= Npd
        no gap    Np = 2 Np0 <= Npd
        cw = 1 + (r - 1) (Npd - N)/(Npd - N(X = 0)),  N = Np0 + s'v/su <= Npd

    Straight lines through p/pu and y/D, then p = pu; y/D is linear in OCR between the columns at
    each p/pu and held outside them:

        p/pu            0.05  0.2   0.3   0.4   0.5   0.6   0.7   0.8   0.9   0.975 1
        HIGH OCR <= 2  .0003 .003  .0053 .009  .014  .022  .032  .050  .082  .15   .25
             OCR 4     .0004 .004  .008  .015  .024  .036  .055  .084  .14   .23   .30
             OCR >= 10 .0005 .005  .011  .021  .034  .052  .078  .12   .19   .30   .40
        LOW  OCR <= 2  .0001 .001  .0018 .003  .0048 .0073 .011  .017  .027  .05   .083
             OCR 4     .0002 .002  .004  .0075 .012  .018  .027  .042  .07   .11   .15
             OCR >= 10 .0003 .0033 .0073 .014  .023  .035  .052  .08   .13   .20   .27

    cw carries su over from simple shear to triaxial extension while a wedge fails; it is defined
    with a gap alone. The sum is formed as stresses, (cw Np0 su + s'v) D, so that su = 0 is no
    special case. At su0 <= 0 or su1 <= 0, where the logarithm has no value, d is 14.5; just above
    su0 = 0 the formula's d is larger and pu smaller.

    depth X (m), diameter D (m), effective_overburden s'v (Pa; integral over the layers above),
    undrained_shear_strength su (Pa, simple shear, local), mudline_strength su0 (Pa) and
    strength_gradient su1 (Pa/m) of the line that stands for su over depth, adhesion alpha (-, 0
    to 1, mean over the top 20 D), overconsolidation_ratio OCR (-), multiplier (-, on p at the
    same y, group effects), no_gap (none opens behind the pile), plasticity HIGH (index above 30) or
    LOW, strength_ratio r (-, extension to simple shear; the standard's value is 0.9; 1: no
    correction). p in N/m.

    Range: su about linear in depth. Normally consolidated clay of su > 15 kPa has no gap.
    Source: ISO 19901-4, third edition (FDIS 2024); Jeanjean et al., OTC 27466 (2017).
    """

    source: ClassVar[str] = "ISO 19901-4 third edition (FDIS 2024); Jeanjean et al. 2017"

    depth: Values
    diameter: Values
    effective_overburden: Values
    undrained_shear_strength: Values
    mudline_strength: Values
    strength_gradient: Values
    adhesion: Values
    overconsolidation_ratio: Values
    multiplier: Values = 1.0
    no_gap: bool = False
    plasticity: str = "HIGH"
    strength_ratio: Values = 1.0

    def __post_init__(self) -> None:
        if self.plasticity not in _TABLES:
            raise InvalidData(
                f"there is no plasticity {self.plasticity} of clay",
                f"give one of {', '.join(_TABLES)}",
                "PLASTICITY",
            )
        if self.no_gap and np.any(np.asarray(self.strength_ratio) != 1.0):
            raise InvalidData(
                "a strength ratio is given for clay without a gap, where it has no meaning",
                "leave the strength ratio out, or let a gap open",
                "STRENGTH_RATIO",
            )

    @cached_property
    def transition_factor(self) -> Array:
        """d, -, shape (n,)."""
        top = np.atleast_1d(np.asarray(self.mudline_strength, dtype=float))
        rise = np.multiply(self.strength_gradient, self.diameter)
        sloping = (top > 0.0) & (rise > 0.0)
        logs = np.log10(np.where(sloping, top, 10.0)) - np.log10(np.where(sloping, rise, 1.0))
        return np.asarray(np.maximum(16.8 - 2.3 * logs, _LEAST_D))

    @cached_property
    def deep_factor(self) -> Array:
        """Npd, -, shape (n,)."""
        return np.atleast_1d(9.0 + np.multiply(3.0, self.adhesion))

    @cached_property
    def wedge_factor(self) -> Array:
        """Np0, -, shape (n,)."""
        ratio = np.asarray(self.depth) / (self.transition_factor * self.diameter)
        left = np.maximum(1.0 - ratio**0.6, 0.0) ** 1.35
        factor = _N1 - (1.0 - self.adhesion) - (_N1 - _N2) * left
        return np.asarray(np.minimum(factor, self.deep_factor))

    @cached_property
    def _pressure(self) -> Array:
        """Np su, Pa."""
        su, Np0, Npd = self.undrained_shear_strength, self.wedge_factor, self.deep_factor
        limit, wedge = Npd * su, Np0 * su
        if self.no_gap:
            return np.asarray(np.minimum(2.0 * wedge, limit))
        wedge = wedge + self.effective_overburden
        mudline = _N2 - (1.0 - self.adhesion)
        short = np.maximum(limit - wedge, 0.0) / (Npd - mudline)
        wedge += (np.asarray(self.strength_ratio) - 1.0) * Np0 * short
        return np.asarray(np.minimum(wedge, limit))

    @cached_property
    def ultimate_resistance(self) -> Array:
        """pu with its multiplier, N/m, shape (n,)."""
        return np.asarray(self.multiplier * self._pressure * self.diameter)

    @cached_property
    def bearing_factor(self) -> Array:
        """Np, -, shape (n,); Npd where su is 0."""
        su, p = np.broadcast_arrays(self.undrained_shear_strength, self._pressure)
        deep = np.zeros(p.shape) + self.deep_factor
        return np.asarray(np.divide(p, su, out=deep, where=su > 0.0))

    @cached_property
    def _backbone(self) -> Polyline:
        ocr = np.atleast_1d(self.overconsolidation_ratio)
        shares = np.array([np.interp(ocr, _OCR, column) for column in np.eye(len(_OCR))])
        nodes = (_TABLES[self.plasticity][:, :, None] * shares[:, None, :]).sum(axis=0)
        nodes, values = np.broadcast_arrays(nodes, _RATIOS[:, None] * self.ultimate_resistance)
        return _Fan(nodes, values, np.atleast_1d(np.asarray(self.diameter, dtype=float)))

    @property
    def derived(self) -> Mapping[str, Array]:
        return {
            "d": self.transition_factor,
            "Npd": self.deep_factor,
            "Np0": self.wedge_factor,
            "Np": self.bearing_factor,
            "ultimate_resistance": self.ultimate_resistance,
        }
