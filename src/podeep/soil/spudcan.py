"""Spudcans of jack-ups by ISO 19905-1: elastic stiffness, bearing capacity, yield surface.

The standard is licensed and was not at hand. Each page says where its numbers come from: "read"
in public sources that agree, "one source", or "from memory" of the standard. Check the last two
against the standard before they carry a design. Clause numbers are from memory throughout.

Symbols of all pages: diameter B (m, of full contact), radius R = B/2 (m), area A = pi B^2/4 (m2),
depth Dp (m, of the largest bearing area below the mudline), effective_overburden s'v (Pa, at Dp),
effective_unit_weight g' (N/m3), undrained_shear_strength su (Pa), friction_angle phi (rad).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .backbone import Values

#: Dp/B and Nc sc dc of a circular footing on clay
_CLAY_FACTORS = ((0.0, 0.1, 0.25, 0.5, 1.0, 2.5), (6.0, 6.3, 6.6, 7.0, 7.7, 9.0))
_DEEP = 2.5  # Dp/B from which depth changes nothing in clay


class Moduli(NamedTuple):
    """Shear modulus of the soil for each motion of the spudcan, Pa."""

    vertical: Values
    horizontal: Values
    rotational: Values


class Stiffness(NamedTuple):
    """Springs of the spudcan: N/m, N/m, N m/rad, N m/rad."""

    vertical: Array
    horizontal: Array
    rotational: Array
    torsional: Array


class Bearing(NamedTuple):
    """Vertical capacity without backfill and buoyancy (N), per area (Pa), its factors by name."""

    capacity: Array
    unit_capacity: Array
    factors: Mapping[str, Array]


def _require_positive(name: str, values: Values, field: str) -> None:
    if not (least := float(np.min(values))) > 0.0:
        raise InvalidData(f"the {name} {least:g} is not positive", "give a positive value", field)


def elastic_stiffness(
    shear_modulus: Values | Moduli,
    poisson_ratio: Values,
    radius: Values,
    embedment_factors: tuple[Values, ...] = (1.0, 1.0, 1.0),
) -> Stiffness:
    """Elastic stiffness of a rigid circular footing.

        K1 = Kd1 4 G R / (1 - nu)               vertical
        K2 = Kd2 32 G R (1 - nu) / (7 - 8 nu)   horizontal
        K3 = Kd3 8 G R^3 / (3 (1 - nu))         rotational
        K4 = 16 G R^3 / 3                       torsional

    shear_modulus G (Pa; or one for each motion, K4 then takes the horizontal one), poisson_ratio
    nu (-), radius R (m, of the area in contact), embedment_factors Kd1, Kd2, Kd3 (-).
    Range: nu 0 to 0.5: 0.5 in undrained clay, 0.2 to 0.3 in sand.
    Source: ISO 19905-1 A.9.3.4; read. Its Kd by Dp/(2 R) and backfill are not public; 1 is low.
    """
    _require_positive("radius", radius, "B")
    if not (np.min(poisson_ratio) >= 0.0 and np.max(poisson_ratio) <= 0.5):
        raise InvalidData("Poisson's ratio is beyond 0 to 0.5", "clay: 0.5, sand: 0.2 to 0.3", "NU")
    G = shear_modulus if isinstance(shear_modulus, Moduli) else Moduli(*[shear_modulus] * 3)
    Kd1, Kd2, Kd3 = embedment_factors
    R, nu = np.asarray(radius, dtype=float), np.asarray(poisson_ratio, dtype=float)
    return Stiffness(
        np.asarray(Kd1 * (4.0 * G.vertical * R / (1.0 - nu))),
        np.asarray(Kd2 * (32.0 * G.horizontal * R * (1.0 - nu) / (7.0 - 8.0 * nu))),
        np.asarray(Kd3 * (8.0 * G.rotational * R**3 / (3.0 * (1.0 - nu)))),
        np.asarray(16.0 * G.horizontal * R**3 / 3.0),
    )


def arya_factors(poisson_ratio: Values, radius: Values, embedment: Values) -> tuple[Array, ...]:
    """Kd1, Kd2, Kd3 of a footing embedded by h (m) with its side in full contact.

        Kd1 = 1 + 0.6 (1 - nu) h/R
        Kd2 = 1 + 0.55 (2 - nu) h/R
        Kd3 = 1 + 1.2 (1 - nu) h/R + 0.2 (2 - nu) (h/R)^3

    Range: side contact. Below an open cavity they are too stiff, Kd3 grossly so when deep.
    Source: Arya, O'Neill and Pincus (1979) as used in WISDEM; one source. Not ISO 19905-1's table.
    """
    _require_positive("radius", radius, "B")
    nu, ratio = np.asarray(poisson_ratio, dtype=float), np.divide(embedment, radius)
    rocking = 1.2 * (1.0 - nu) * ratio + 0.2 * (2.0 - nu) * ratio**3
    return 1.0 + 0.6 * (1.0 - nu) * ratio, 1.0 + 0.55 * (2.0 - nu) * ratio, 1.0 + rocking


def clay_shear_modulus(undrained_shear_strength: Values, ocr: Values) -> Array:
    """G of clay, 600 su / OCR^0.25, Pa; OCR >= 1. Source: ISO 19905-1 A.9.3.4; from memory."""
    _require_positive("overconsolidation ratio", ocr, "OCR")
    return np.asarray(600.0 * undrained_shear_strength / np.power(ocr, 0.25))


def sand_shear_modulus(relative_density: Values, vertical_load: Values, area: Values) -> Array:
    """G of sand, Pa.

        G/pa = g (V/(A pa))^0.5,   g = 230 (0.9 + Dr/500),   Dr in %,   pa = 101.3 kPa

    relative_density Dr (-, 0 to 1), vertical_load V (N, still water; uplift counts as 0).
    Source: ISO 19905-1 A.9.3.4 after Cassidy et al., OMAE2002-28085; from memory.
    """
    g = 230.0 * (0.9 + np.asarray(relative_density, dtype=float) / 5.0)
    return np.asarray(g * np.sqrt(np.maximum(vertical_load, 0.0) / area * 101.3e3))


def sname_clay_shear_modulus(undrained_shear_strength: Values, ocr: Values) -> Array:
    """G of clay, Pa: 200 su for OCR < 4, 100 su from 4 to 10, 50 su for OCR > 10.

    Superseded: jack-ups at sea are stiffer. Source: SNAME T&R 5-5A 6.3.4; from memory.
    """
    index = np.where(np.less(ocr, 4.0), 200.0, np.where(np.greater(ocr, 10.0), 50.0, 100.0))
    return np.asarray(index * undrained_shear_strength)


def sname_sand_shear_moduli(_density: Values, vertical_load: Values, area: Values) -> Moduli:
    """G of sand of any density for each motion, in kPa with V/A in kPa; uplift counts as 0.

        vertical 36600 + 24.9 V/A,   horizontal 1100 + 5.6 V/A,   rotational 4100 + 11.5 V/A

    Superseded as the one of clay. Source: SNAME T&R 5-5A 6.3.4; from memory, to be doubted.
    """
    pressure = np.maximum(vertical_load, 0.0) / area
    return Moduli(36.6e6 + 24.9 * pressure, 1.1e6 + 5.6 * pressure, 4.1e6 + 11.5 * pressure)


#: The models of G by name: of clay from su and OCR, of sand from Dr, V and A.
MODELS: Mapping[str, tuple[Callable[..., Array], Callable[..., Array | Moduli]]] = {
    "ISO 19905-1": (clay_shear_modulus, sand_shear_modulus),
    "SNAME 5-5A": (sname_clay_shear_modulus, sname_sand_shear_moduli),
}


def _bearing(unit_capacity: Values, diameter: Values, **factors: Values) -> Bearing:
    unit = np.asarray(unit_capacity, dtype=float)
    named = {name: np.asarray(value, dtype=float) for name, value in factors.items()}
    return Bearing(unit * (0.25 * pi * np.square(diameter)), unit, MappingProxyType(named))


def _clay_factor(depth: Values, diameter: Values) -> Array:
    _require_positive("diameter", diameter, "B")
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
    _require_positive("diameter", diameter, "B")
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
    ratio = np.minimum(np.divide(depth, diameter), _DEEP)
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
    _require_positive("sand's unit weight", effective_unit_weight, "GAMMA")
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


@dataclass(frozen=True)
class YieldSurface:
    """Vertical, horizontal and moment loads that a preloaded spudcan can carry together.

        F = (H/QH)^2 + (M/QM)^2 - 16 (1 - a) v^2 (1 - v)^2 - 4 a v (1 - v),   v = V/QV
        rf = sqrt( ((H/QH)^2 + (M/QM)^2) / (16 (1 - a) v^2 (1 - v)^2 + 4 a v (1 - v)) )
        fr = sqrt(1 - rf) + 0.1 e^(100 (rf - 1))   up to rf = 1

    Inside F < 0 and rf < 1. The rotational stiffness becomes fr K3; K1 and K2 stay.
    vertical_capacity QV (N, preload), horizontal_capacity QH (N), moment_capacity QM (N m),
    embedment a (-). V is positive down; H and M are resultants of either sign.
    Outside 0 < V < QV nothing can be carried: rf is infinite, and v^2 (1 - v)^2, whose printed
    square would be positive again, takes the sign of v (1 - v) so that F >= 0.

    Source: ISO 19905-1 A.9.3.3, A.9.3.4, SNAME T&R 5-5A 6.3.4; all from memory, QH, QM and a too.
    ISO's hyperbolic fr of clay is not public: this one is of sand. SNAME's suction is left out.
    """

    vertical_capacity: float
    horizontal_capacity: float
    moment_capacity: float
    embedment: float = 0.0

    def __post_init__(self) -> None:
        _require_positive("vertical capacity", self.vertical_capacity, "V_PRELOAD")
        _require_positive("horizontal capacity", self.horizontal_capacity, "QH")
        _require_positive("moment capacity", self.moment_capacity, "QM")
        if not 0.0 <= self.embedment <= 1.0:
            remedy = "it is Dp/(2.5 B) in clay, at most 1, and 0 in sand"
            raise InvalidData("the embedment a is not between 0 and 1", remedy, "EMBED")

    @classmethod
    def for_sand(cls, vertical_capacity: float, diameter: float) -> "YieldSurface":
        """QH = 0.12 QV, QM = 0.075 B QV, a = 0."""
        Q = vertical_capacity
        return cls(Q, 0.12 * Q, 0.075 * diameter * Q)

    @classmethod
    def for_clay(
        cls,
        vertical_capacity: float,
        diameter: float,
        undrained_shear_strength: float,
        tip_shear_strength: float,
        lateral_area: float,
        depth: float,
        area: float | None = None,
    ) -> "YieldSurface":
        """QH = su0 A + (su0 + su1) As, QM = 0.1 B QV, a = Dp/(2.5 B), at most 1.

        su0 and su1 (Pa): undrained_shear_strength at the largest bearing area, tip_shear_strength
        at the tip; lateral_area As (m2): embedded, projected sideways; area A: None is pi B^2/4.
        """
        _require_positive("diameter", diameter, "B")
        A = 0.25 * pi * diameter**2 if area is None else area
        QH = undrained_shear_strength * (A + lateral_area) + tip_shear_strength * lateral_area
        deep = min(max(depth, 0.0) / (_DEEP * diameter), 1.0)
        return cls(vertical_capacity, QH, 0.1 * diameter * vertical_capacity, deep)

    def _room(self, V: Values) -> Array:
        """What V leaves for (H/QH)^2 + (M/QM)^2; negative outside 0 < V < QV."""
        v, a = np.divide(V, self.vertical_capacity), self.embedment
        parabola = v * (1.0 - v)
        return np.asarray(parabola * (16.0 * (1.0 - a) * np.abs(parabola) + 4.0 * a))

    def _taken(self, H: Values, M: Values) -> Array:
        shear, moment = np.divide(H, self.horizontal_capacity), np.divide(M, self.moment_capacity)
        return np.asarray(np.square(shear) + np.square(moment))

    def value(self, V: Values, H: Values, M: Values) -> Array:
        """F."""
        return np.asarray(self._taken(H, M) - self._room(V))

    def utilisation(self, V: Values, H: Values, M: Values) -> Array:
        """rf; infinite outside 0 < V < QV, whatever H and M."""
        taken, room = np.broadcast_arrays(self._taken(H, M), self._room(V))
        square = np.full(taken.shape, np.inf)
        with np.errstate(over="ignore"):  # hardly any room: infinite is the answer
            np.divide(taken, room, out=square, where=room > 0.0)
        return np.asarray(np.sqrt(square))

    @staticmethod
    def reduction(failure_ratio: Values) -> Array:
        """fr at rf up to 1, and 0 beyond.

        It falls all the way, from 1 at rf = 0 to 0.1 at rf = 1: the root's slope outweighs the
        exponential's everywhere, least at rf = 0.995 (fr = 0.131) with 1.17 times.
        """
        inside = 1.0 - np.minimum(failure_ratio, 1.0)
        reduced = np.sqrt(inside) + 0.1 * np.exp(-100.0 * inside)
        return np.where(np.less_equal(failure_ratio, 1.0), reduced, 0.0)


def target_factor(surface: YieldSurface, V: float, H: float, M: float) -> float:
    """The share of K3 that loads found with a share kappa ask for: fr, and 0 outside the surface.

    It never rises with M, nor M falls with kappa: kappa - target changes sign once in 0..1. There
    is the answer, also in the jump at rf = 1, where any share up to 0.1 keeps the loads on F = 0.
    Bracket it: putting the target in for kappa, again and again, need not converge.
    """
    return float(surface.reduction(surface.utilisation(V, H, M)))


def moment_limit(surface: YieldSurface, V: float, H: float) -> float:
    """The moment (N m) at which F = 0; 0 where V or H alone is already too much."""
    return surface.moment_capacity * float(np.sqrt(np.maximum(-surface.value(V, H, 0.0), 0.0)))
