"""Axial reactions: friction along a shaft (t-z) and bearing of a tip (Q-z)."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import pi
from types import MappingProxyType
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .backbone import TableLaw
from .polyline import Points, Polyline, Values

#: t-z: (w/D, t/tmax) up to the peak; the residual is reached at w/D = 0.02
_FRICTION: Points = ((0, 0), (0.0016, 0.3), (0.0031, 0.5), (0.0057, 0.75), (0.008, 0.9), (0.01, 1))
_RESIDUAL_AT = 0.02
#: t-z of sand: peak displacement, m (0.1 in)
_SAND_PEAK = 0.00254
#: Q-z: (w/D, Q/Qp)
_BEARING: Points = ((0, 0), (0.002, 0.25), (0.013, 0.5), (0.042, 0.75), (0.073, 0.9), (0.1, 1))
_ELASTIC_PLASTIC: Points = ((0, 0), (1, 1))

_SHAPES = ("EP", "API", "2GEO")


def alpha_friction(undrained_shear_strength: Values, effective_overburden: Values) -> Array:
    """Unit friction of clay, alpha su, Pa.

        psi = su / s'v,  alpha = 0.5 psi^-0.5 (psi <= 1) or 0.5 psi^-0.25 (psi > 1), alpha <= 1

    Written without psi: 0 at zero overburden. Care for psi > 3. Source: API RP 2GEO eq. 17-19.
    """
    su = np.asarray(undrained_shear_strength, dtype=float)
    mean = np.sqrt(su * effective_overburden)  # geometric mean of su and s'v
    return np.asarray(np.minimum(su, 0.5 * np.maximum(mean, np.sqrt(su * mean))))


def overburden_friction(
    effective_overburden: Values,
    earth_pressure_coefficient: Values,
    interface_friction_angle: Values,
    friction_limit: Values = np.inf,
) -> Array:
    """Unit friction of sand, K s'v tan(delta) up to its limit, Pa; beta of RP 2GEO is K tan(delta).

    Source: API RP 2A-WSD 6.4.3, API RP 2GEO eq. 21.
    """
    beta = earth_pressure_coefficient * np.tan(interface_friction_angle)
    return np.minimum(beta * effective_overburden, friction_limit)


def clay_bearing(undrained_shear_strength: Values) -> Array:
    """Unit end bearing of clay, 9 su, Pa. Source: API RP 2GEO eq. 20."""
    return np.multiply(9.0, undrained_shear_strength)


def overburden_bearing(
    effective_overburden: Values, bearing_factor: Values, end_bearing_limit: Values = np.inf
) -> Array:
    """Unit end bearing of sand, Nq s'v up to its limit, Pa. Source: API RP 2GEO eq. 22."""
    return np.minimum(np.multiply(bearing_factor, effective_overburden), end_bearing_limit)


def _check_shape(shape: str, initial_stiffness: Values) -> None:
    if shape not in _SHAPES:
        raise InvalidData(
            f"there is no shape {shape} of t-z", f"give one of {', '.join(_SHAPES)}", "SHAPE"
        )
    _check_positive("slope", "Pa/m", initial_stiffness, "IKTSO")


def _check_positive(name: str, unit: str, values: Values, field: str) -> None:
    least = float(np.min(values, initial=np.inf))
    if not least > 0.0:
        raise InvalidData(
            f"the {name} {least:g} {unit} of t-z is not positive",
            "give a positive value, or leave it out for the default",
            field,
        )


def _check_method(method: str, own: str) -> None:
    if method not in (own, "DIRECT"):
        raise InvalidData(
            f"there is no method {method} for the friction of this soil",
            f"give {own} or DIRECT",
            "METHOD",
        )


def _yield_displacement(peak: Array, stiffness: Values) -> Array:
    """Where an elastic-plastic line reaches its peak; any length where the peak is 0."""
    return np.where(peak > 0.0, peak / stiffness, 1.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Shaft(TableLaw):
    """Friction per metre of a shaft, pi D t(w), odd in w. What every t-z law shares.

        EP      t = k w up to tmax, then constant: the original's statics
        API     clay and direct as 2GEO; sand t = tmax w / 2.54 mm, constant from there on
        2GEO    straight lines through w/D and t/tmax: (0, 0) (0.0016, 0.30) (0.0031, 0.50)
                (0.0057, 0.75) (0.008, 0.90) (0.01, 1) (0.02, r), then r

    diameter D (m, outer), initial_stiffness k (Pa/m, of EP), residual r (-, of 2GEO's points;
    None: 0.9 for clay, 1 otherwise). Reaction in N/m, tmax in Pa.

    Range: r 0.7 to 0.9 in clay, 1 in sand; the peak lies between 0.0025 and 0.02 D.
    Source: API RP 2GEO 8.4.2 and ISO 19901-4 (2GEO); API RP 2A-WSD 6.7.2 (2.54 mm).
    """

    source: ClassVar[str] = "API RP 2GEO 8.4.2, ISO 19901-4; API RP 2A-WSD 6.7.2"

    diameter: Values
    initial_stiffness: Values
    shape: str = "EP"
    residual: Values | None = None
    default_residual: ClassVar[float] = 1.0
    api_is_2geo: ClassVar[bool] = True

    def __post_init__(self) -> None:
        _check_shape(self.shape, self.initial_stiffness)
        if self.residual is not None and not self._softens:
            raise InvalidData(
                f"the t-z shape {self.shape} has no residual in this soil, but one is given",
                "leave the residual out, or choose SHAPE=2GEO",
                "RESIDUAL",
            )

    @property
    def _softens(self) -> bool:
        return self.shape == "2GEO" or (self.shape == "API" and self.api_is_2geo)

    @property
    def derived(self) -> Mapping[str, Array]:
        return {"peak_friction": np.atleast_1d(self.peak_friction)}

    @property
    @abstractmethod
    def peak_friction(self) -> Array:
        """Unit friction tmax, Pa."""

    @cached_property
    def _backbone(self) -> Polyline:
        peak = np.atleast_1d(self.peak_friction)
        force = pi * self.diameter * peak
        if self.shape == "EP":
            limit = _yield_displacement(peak, self.initial_stiffness)
            return Polyline.through(_ELASTIC_PLASTIC, force, limit)
        if not self._softens:
            return Polyline.through(_ELASTIC_PLASTIC, force, _SAND_PEAK)
        residual = self.default_residual if self.residual is None else self.residual
        nodes, ratios = np.array((*_FRICTION, (_RESIDUAL_AT, 1.0)), dtype=float).T
        values = ratios[:, None] * np.atleast_1d(force)
        values[-1] *= residual
        return Polyline(nodes, values, np.atleast_1d(self.diameter)).mirrored()


@dataclass(frozen=True, eq=False, kw_only=True)
class CohesiveShaft(Shaft):
    """Friction in clay by the alpha method: tmax = `alpha_friction`; shapes of `Shaft`.

    effective_overburden s'v (Pa), undrained_shear_strength su (Pa), method ("ALPHA"; "DIRECT": su
    is the adhesion itself, tmax = su).
    """

    effective_overburden: Values
    undrained_shear_strength: Values
    method: str = "ALPHA"
    default_residual: ClassVar[float] = 0.9

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_method(self.method, "ALPHA")

    @property
    def peak_friction(self) -> Array:
        if self.method == "DIRECT":
            return np.asarray(self.undrained_shear_strength, dtype=float)
        return alpha_friction(self.undrained_shear_strength, self.effective_overburden)


@dataclass(frozen=True, eq=False, kw_only=True)
class CohesionlessShaft(Shaft):
    """Friction in sand: tmax = `overburden_friction`; shapes of `Shaft`.

    effective_overburden s'v (Pa), earth_pressure_coefficient K (-), interface_friction_angle
    delta (rad), friction_limit (Pa, > 0), method ("BETA": beta = K tan(delta); "DIRECT": K is
    beta itself, delta has no effect).
    """

    effective_overburden: Values
    earth_pressure_coefficient: Values
    interface_friction_angle: Values
    friction_limit: Values = np.inf
    method: str = "BETA"
    api_is_2geo: ClassVar[bool] = False

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_method(self.method, "BETA")
        _check_positive("limit of friction", "Pa", self.friction_limit, "F5")

    @property
    def peak_friction(self) -> Array:
        direct = self.method == "DIRECT"
        return overburden_friction(
            self.effective_overburden,
            self.earth_pressure_coefficient,
            0.25 * pi if direct else self.interface_friction_angle,
            self.friction_limit,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class DirectShaft(Shaft):
    """Friction with a given peak: tmax = unit_friction (Pa); shapes of `Shaft`."""

    unit_friction: Values

    @property
    def peak_friction(self) -> Array:
        return np.asarray(self.unit_friction)


@dataclass(frozen=True, eq=False, kw_only=True)
class Tip(TableLaw):
    """Bearing of a tip on pi D^2/4, in compression (w > 0, down) alone. What every Q-z law shares.

        EP          q = k w up to qmax, then constant: the original's statics
        API, 2GEO   straight lines through w/D and q/qmax: (0, 0) (0.002, 0.25) (0.013, 0.50)
                    (0.042, 0.75) (0.073, 0.90) (0.1, 1), then 1

    diameter D (m, outer), initial_stiffness k (Pa/m, of EP). Reaction in N, qmax in Pa. In uplift
    reaction and stiffness are 0.

    Range: full qmax needs 2 to 3 D of penetration into the bearing layer.
    Source: API RP 2GEO 8.4.3, API RP 2A-WSD 6.7.3.
    """

    odd: ClassVar[bool] = False
    source: ClassVar[str] = "API RP 2GEO 8.4.3, API RP 2A-WSD 6.7.3"

    diameter: Values
    initial_stiffness: Values
    shape: str = "EP"

    def __post_init__(self) -> None:
        _check_shape(self.shape, self.initial_stiffness)

    @property
    def derived(self) -> Mapping[str, Array]:
        return {"peak_bearing": np.atleast_1d(self.peak_bearing)}

    @property
    @abstractmethod
    def peak_bearing(self) -> Array:
        """Unit end bearing qmax, Pa."""

    @cached_property
    def _backbone(self) -> Polyline:
        peak = np.atleast_1d(self.peak_bearing)
        force = 0.25 * pi * np.square(self.diameter) * peak
        if self.shape == "EP":
            limit = _yield_displacement(peak, self.initial_stiffness)
            return Polyline.through(_ELASTIC_PLASTIC, force, limit, odd=False)
        return Polyline.through(_BEARING, force, self.diameter, odd=False)


@dataclass(frozen=True, eq=False, kw_only=True)
class CohesiveTip(Tip):
    """Bearing on clay: qmax = `clay_bearing` of undrained_shear_strength su (Pa)."""

    undrained_shear_strength: Values

    @property
    def peak_bearing(self) -> Array:
        return clay_bearing(self.undrained_shear_strength)


@dataclass(frozen=True, eq=False, kw_only=True)
class CohesionlessTip(Tip):
    """Bearing on sand: qmax = `overburden_bearing`.

    effective_overburden s'v (Pa), bearing_factor Nq (-), end_bearing_limit (Pa, > 0).
    """

    effective_overburden: Values
    bearing_factor: Values
    end_bearing_limit: Values = np.inf

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_positive("limit of end bearing", "Pa", self.end_bearing_limit, "F6")

    @property
    def peak_bearing(self) -> Array:
        return overburden_bearing(
            self.effective_overburden, self.bearing_factor, self.end_bearing_limit
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class DirectTip(Tip):
    """Bearing with a given peak: qmax = tip_pressure (Pa; 0 is no tip)."""

    tip_pressure: Values = 0.0

    @property
    def peak_bearing(self) -> Array:
        return np.asarray(self.tip_pressure)


class AxialLaws(NamedTuple):
    """What one t-z curve describes: the friction of a shaft and the bearing of a tip."""

    shaft: type[Shaft]
    tip: type[Tip]


#: The axial laws by the name that a curve gives.
LAWS: Mapping[str, AxialLaws] = MappingProxyType(
    {
        "cohesive": AxialLaws(CohesiveShaft, CohesiveTip),
        "cohesionless": AxialLaws(CohesionlessShaft, CohesionlessTip),
        "direct": AxialLaws(DirectShaft, DirectTip),
    }
)
