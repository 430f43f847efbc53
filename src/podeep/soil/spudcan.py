"""Spudcans of jack-ups by ISO 19905-1: elastic stiffness and the shear moduli for it.

The standard is licensed and was not at hand. Each page says where its numbers come from: "read"
in public sources that agree, "one source", or "from memory" of the standard. Check the last two
against the standard before they carry a design. Clause numbers are from memory throughout.

Symbols of all pages: diameter B (m, of full contact), radius R = B/2 (m), area A = pi B^2/4 (m2),
depth Dp (m, of the largest bearing area below the mudline), effective_overburden s'v (Pa, at Dp),
effective_unit_weight g' (N/m3), undrained_shear_strength su (Pa), friction_angle phi (rad).
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .polyline import Values


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


def require_positive(name: str, values: Values, field: str) -> None:
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
    require_positive("radius", radius, "B")
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
    require_positive("radius", radius, "B")
    nu, ratio = np.asarray(poisson_ratio, dtype=float), np.divide(embedment, radius)
    rocking = 1.2 * (1.0 - nu) * ratio + 0.2 * (2.0 - nu) * ratio**3
    return 1.0 + 0.6 * (1.0 - nu) * ratio, 1.0 + 0.55 * (2.0 - nu) * ratio, 1.0 + rocking


def clay_shear_modulus(undrained_shear_strength: Values, ocr: Values) -> Array:
    """G of clay, 600 su / OCR^0.25, Pa; OCR >= 1. Source: ISO 19905-1 A.9.3.4; from memory."""
    require_positive("overconsolidation ratio", ocr, "OCR")
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
