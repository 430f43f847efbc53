"""The four reactions of a monopile by PISA: along the shaft and at its base, in clay and sand."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .law import Law
from .pisa_fits import DUNKIRK, SITES, Fits, Reaction
from .polyline import Values

_LEAST = 1e-3  # of k and Yu, where the fits are left far outside their range
_TINY = 1e-300  # far under any term it is added to; decides what 0/0 is
_NO_REACH = 1e-200  # Xu in metres or radians that is none: its reciprocal would overflow


#: Powers of D in the scales of the reaction and of the displacement.
_POWERS: Mapping[Reaction, tuple[int, int]] = MappingProxyType(
    {"p": (1, 1), "m": (2, 0), "HB": (2, 1), "MB": (3, 0)}
)


class Parameters(NamedTuple):
    """What makes a normalised conic, (n,) each."""

    k: Array
    n: Array
    Xu: Array
    Yu: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Conic(Law):
    """The conic of PISA, from slope k at rest to the ultimate (Xu, Yu). What its laws share.

        -n (Y/Yu - X/Xu)^2 + (1 - n) (Y/Yu - X k/Yu) (Y/Yu - 1) = 0 up to Xu, then Y = Yu

    With xi = X/Xu, A = (k Xu/Yu - 1) xi and B = 1 - xi the root between the secant to the
    ultimate and the initial line is Y/Yu = xi + t, which loses no digits and needs no case:

        t = 2 (1-n) A B / ( (1-n) (A+B) + sqrt((1-n)^2 (A-B)^2 + 4 n (1-n) A B) )

    n = 0 is exactly elastic, then plastic; n = 1 the straight secant. Scales, with s = su in clay
    and s'v in sand:

        p   lateral, N/m                 Y s D    against displacement X s D/G0, m
        m   distributed moment, N m/m    Y s D^2  against rotation X s/G0, rad; in sand Y |p| D
        HB  shear at the base, N         Y s D^2  against displacement X s D/G0, m
        MB  moment at the base, N m      Y s D^3  against rotation X s/G0, rad

    Inside their range the fits of the parameters are used as they stand. Outside it n is held to
    0..1, k and Yu to 1e-3 or more, and Xu to Yu/k or more, so that k >= Yu/Xu without a stiffer
    start: the initial line then runs up to Yu. Where s is 0 there is no reaction.

    diameter D (m), embedded_length L (m), initial_shear_modulus G0 (Pa, small strain); depth z
    (m) along the shaft, while s and G0 of a base are those at z = L.

    Range: D 5 to 10 m, L/D 2 to 6, monotonic loading.
    """

    diameter: Values
    embedded_length: Values
    initial_shear_modulus: Values

    reaction: ClassVar[Reaction]

    @property
    @abstractmethod
    def _fits(self) -> Fits: ...

    @property
    @abstractmethod
    def _stress(self) -> Values:
        """s, Pa."""

    @property
    def _density(self) -> Values:
        return 0.0

    @property
    def _z(self) -> Values:
        return self.embedded_length

    @cached_property
    def parameters(self) -> Parameters:
        """k, n, Xu and Yu as the curve has them."""
        z = np.atleast_1d(np.asarray(self._z, dtype=float))
        x = {"D": z / self.diameter, "L": z / self.embedded_length}
        k, n, Xu, Yu = (fit.at(x[fit.z_over], self._density) for fit in self._fits)
        k, Yu = np.maximum(k, _LEAST), np.maximum(Yu, _LEAST)
        return Parameters(k, np.clip(n, 0.0, 1.0), np.maximum(Xu, Yu / k), Yu)

    @property
    def _scale(self) -> Values:
        """Reaction at Y = 1."""
        return np.asarray(self._stress * np.power(self.diameter, _POWERS[self.reaction][0]))

    @cached_property
    def ultimate_reaction(self) -> Array:
        """Reaction from Xu on, shape (n,)."""
        ultimate = self.parameters.Yu * self._scale
        return np.broadcast_arrays(ultimate, self._rate)[0]

    @cached_property
    def _rate(self) -> Array:
        """xi of a unit displacement; 0 where there is no reaction."""
        unit = self._stress * np.power(self.diameter, _POWERS[self.reaction][1])
        reach = np.asarray(self.parameters.Xu * unit)
        G0, reach = np.broadcast_arrays(self.initial_shear_modulus, reach)
        rate = np.divide(G0, reach, out=np.zeros(reach.shape), where=reach > _NO_REACH)
        return np.asarray(rate)

    @cached_property
    def _terms(self) -> tuple[Array, ...]:
        """n, the root of 1 - n, k Xu/Yu - 1, and the slope of the secant."""
        k, n, Xu, Yu = self.parameters
        excess = np.maximum(k * Xu / Yu - 1.0, 0.0)
        return n, np.sqrt(1.0 - n), excess, np.asarray(self.ultimate_reaction * self._rate)

    @property
    def derived(self) -> Mapping[str, Array]:
        k, n, Xu, Yu = (np.broadcast_to(v, self.capacity.shape) for v in self.parameters)
        return {
            "k": k,
            "n": n,
            "x_ultimate": Xu,
            "y_ultimate": Yu,
            "ultimate_reaction": self.ultimate_reaction,
        }

    @property
    def capacity(self) -> Array:
        return self.ultimate_reaction

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        n, root, excess, secant = self._terms
        xi = np.abs(u) * self._rate
        rising = xi < 1.0
        np.minimum(xi, 1.0, out=xi)
        A, B = excess * xi, 1.0 - xi
        product, apart = A * B, root * (A - B)
        # all divided by the square root of 1 - n, which may be 0
        spread = np.sqrt(apart * apart + 4.0 * n * product)
        total = root * (A + B) + spread + _TINY
        t = 2.0 * product / total
        left = B * (spread - apart) / total  # 1 - Y/Yu
        # n decides 0/0: 0 at the corner of n = 0, 1 along the secant of n = 1
        slope = 2.0 * n * t + root * (excess + 1.0) * left + n * _TINY
        slope /= spread + _TINY
        force = self.ultimate_reaction * (xi + root * t)
        return np.copysign(force, u), secant * rising * slope


@dataclass(frozen=True, eq=False, kw_only=True)
class _Clay(Conic):
    source: ClassVar[str] = (
        "PISA: Byrne et al. 2020 (Cowden till); Burd et al. 2020, layered soils (Bothkennar clay)"
    )

    undrained_shear_strength: Values
    site: str = "COWDEN"

    def __post_init__(self) -> None:
        if self.site not in SITES:
            raise InvalidData(
                f"there is no site {self.site} of PISA clay",
                f"give one of {', '.join(SITES)}",
                "SITE",
            )

    @property
    def _fits(self) -> Fits:
        return SITES[self.site][self.reaction]

    @property
    def _stress(self) -> Values:
        return self.undrained_shear_strength


@dataclass(frozen=True, eq=False, kw_only=True)
class _Sand(Conic):
    source: ClassVar[str] = "PISA: Burd et al. 2020, marine sand (general Dunkirk sand model)"

    effective_overburden: Values
    relative_density: Values

    @property
    def _fits(self) -> Fits:
        return DUNKIRK[self.reaction]

    @property
    def _stress(self) -> Values:
        return self.effective_overburden

    @property
    def _density(self) -> Values:
        return self.relative_density


@dataclass(frozen=True, eq=False, kw_only=True)
class _Lateral(Conic):
    reaction: ClassVar[Reaction] = "p"

    depth: Values
    multiplier: Values = 1.0

    @property
    def _z(self) -> Values:
        return self.depth

    @property
    def _scale(self) -> Values:
        return self.multiplier * super()._scale


@dataclass(frozen=True, eq=False, kw_only=True)
class MomentLaw(Conic):
    """A distributed moment of PISA against the rotation of the shaft, rad."""

    #: whether `evaluate` gives the moment in multiples of the current |p| (m), not in N m/m
    follows_lateral: ClassVar[bool] = False
    reaction: ClassVar[Reaction] = "m"

    depth: Values

    @property
    def _z(self) -> Values:
        return self.depth


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaClay(_Lateral, _Clay):
    """Lateral reaction p (N/m) of clay by PISA: `Conic`, p = Y su D against y = X su D/G0.

                 k                n                     Xu      Yu
    COWDEN       10.60-1.650 z/D  0.9390-0.03345 z/D    241.4   10.70-7.101 exp(-0.3085 z/D)
    BOTHKENNAR   12.05-1.547 z/D  0.7204-0.002679 z/D   173.8   7.743-3.945 exp(-0.8456 z/D)

    depth z (m), undrained_shear_strength su (Pa), site COWDEN (stiff glacial till) or BOTHKENNAR
    (soft, normally consolidated), multiplier (-, on p at the same y).
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaSand(_Lateral, _Sand):
    """Lateral reaction p (N/m) of sand by PISA: `Conic`, p = Y s'v D against y = X s'v D/G0.

        k = 8.731 - 0.6982 R - 0.9178 z/D      n = 0.917 + 0.06193 R
        Xu = 146.1 - 92.11 R                   Yu = 0.3667 + 25.89 R + (0.3375 - 8.900 R) z/L

    depth z (m), effective_overburden s'v (Pa; integral over the layers above),
    relative_density R (-, 0.45 to 0.90), multiplier (-, on p at the same y).
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaClayMoment(MomentLaw, _Clay):
    """Distributed moment m (N m/m) in clay by PISA: `Conic`, m = Y su D^2 against X su/G0 (rad).

                 k                   n   Xu      Yu
    COWDEN       1.420-0.09643 z/D   0   Yu/k    0.2899-0.04775 z/D
    BOTHKENNAR   1.698-0.1576 z/D    0   Yu/k    0.4862-0.05674 z/D

    Fields as `PisaClay`, without a multiplier.
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaSandMoment(MomentLaw, _Sand):
    """Distributed moment in sand by PISA per current |p|, Y D (m), against X s'v/G0 (rad).

        m = |p| D Y;   k = 17.00   n = 0   Xu = Yu/k   Yu = 0.2605 + (-0.1989 + 0.2019 R) z/L

    |p| is that of `PisaSand` at the same depth and instant, its multiplier included: the caller
    multiplies. Fields as `PisaSand`, without a multiplier.
    """

    follows_lateral: ClassVar[bool] = True

    @property
    def _scale(self) -> Values:
        return self.diameter


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaClayBaseShear(_Clay):
    """Shear HB (N) at the base in clay by PISA: `Conic`, HB = Y su D^2 against y = X su D/G0.

                 k                  n                      Xu      Yu
    COWDEN       2.717-0.3575 L/D   0.8793-0.03150 L/D     235.7   0.4038+0.04812 L/D
    BOTHKENNAR   3.008-0.2701 L/D   0.3113+0.04263 L/D     291.5   0.5279+0.06864 L/D

    undrained_shear_strength su (Pa) at the base, site as `PisaClay`.
    """

    reaction: ClassVar[Reaction] = "HB"


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaSandBaseShear(_Sand):
    """Shear HB (N) at the base in sand by PISA: `Conic`, HB = Y s'v D^2 against X s'v D/G0 (m).

        k = 6.505 - 2.985 R + (-0.007969 - 0.4299 R) L/D
        n = 0.09978 + 0.7974 R + (0.004994 - 0.07005 R) L/D
        Xu = 0.5150 + 2.883 R + (0.1695 - 0.7018 R) L/D
        Yu = 0.09952 + 0.7996 R + (0.03988 - 0.1606 R) L/D

    effective_overburden s'v (Pa) at the base, relative_density R (-, 0.45 to 0.90).
    """

    reaction: ClassVar[Reaction] = "HB"


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaClayBaseMoment(_Clay):
    """Moment MB (N m) at the base in clay by PISA: `Conic`, MB = Y su D^3 against X su/G0 (rad).

                 k                    n                   Xu      Yu
    COWDEN       0.2146-0.002132 L/D  1.079-0.1087 L/D    173.1   0.8192-0.08588 L/D
    BOTHKENNAR   0.3409-0.01995 L/D   0.6990-0.1155 L/D   187.0   0.8756-0.09195 L/D

    undrained_shear_strength su (Pa) at the base, site as `PisaClay`.
    """

    reaction: ClassVar[Reaction] = "MB"


@dataclass(frozen=True, eq=False, kw_only=True)
class PisaSandBaseMoment(_Sand):
    """Moment MB (N m) at the base in sand by PISA: `Conic`, MB = Y s'v D^3 against X s'v/G0 (rad).

        k = 0.3515   n = 0.3000 + 0.4986 R   Xu = 44.89
        Yu = 0.09981 + 0.3710 R + (0.01998 - 0.09041 R) L/D

    effective_overburden s'v (Pa) at the base, relative_density R (-, 0.45 to 0.90).
    """

    reaction: ClassVar[Reaction] = "MB"
