"""Where the values of curves, tubes and spudcans lie as a rule, in the units of the deck.

The ranges are those of the laws' own pages, with their source; the slips tell which unit stands
behind a value that nothing has.
"""

from collections.abc import Mapping
from math import inf, pi
from typing import NamedTuple


class Range(NamedTuple):
    """Where a parameter of some laws lies as a rule; of any law where none is named."""

    laws: tuple[str, ...]
    parameter: str
    low: float
    high: float
    rule: str
    remedy: str


class Slip(NamedTuple):
    """Values that nothing has, and the units that may have been meant.

    low, high: between them a value can be. meant: units with their factor to that of the deck,
    the likeliest first. fit: between these lies the likely value.
    """

    low: float
    high: float
    fit: tuple[float, float]
    meant: Mapping[str, float]


SANDS = ("sand", "reese_sand")
CLAYS = ("soft_clay", "stiff_clay", "stiff_clay_free_water")
_FRICTIONAL = (*SANDS, "pisa_sand", "cohesionless")
_OTHERS_IN_WATER = ("soft_clay", "stiff_clay_free_water", "iso_clay", "cohesive")
BUOYANT = "soil under water weighs 4 to 12 kN/m3, in total 10 kN/m3 more"
_EFFECTIVE = "give the effective weight, without that of the water; leave it if the soil is dry"
NO_TESTS = (
    "without tests take 0.02 for CU up to 24 kPa, 0.01 to 48, 0.007 to 96, 0.005 to 192, then 0.004"
)

RANGES = (
    Range(
        ("soft_clay",),
        "undrained_shear_strength",
        0.0,
        100e3,
        "the curves of soft clay are for strengths up to about 100 kPa (API RP 2GEO 8.5.2)",
        "take ITYP 3 or 4, stiff clay with or without free water, or ITYP 6, ISO 19901-4",
    ),
    Range(
        ("stiff_clay_free_water",),
        "undrained_shear_strength",
        50e3,
        400e3,
        "the law of Reese, Cox and Koop is for clay of 50 to 400 kPa (OTC 2312)",
        "take ITYP 1 for softer clay, ITYP 5 for what is rather weak rock",
    ),
    Range(
        ("stiff_clay",),
        "undrained_shear_strength",
        50e3,
        inf,
        "the law of Reese and Welch is for stiff clay, of 50 kPa or more (ASCE GT7, 1975)",
        "take ITYP 1 for softer clay",
    ),
    Range(
        CLAYS,
        "strain_50",
        0.002,
        0.02,
        "the strain at half the strength of clay lies between 0.002 and 0.02, and is no percentage "
        "(API RP 2GEO 8.5.2)",
        NO_TESTS,
    ),
    Range(
        SANDS,
        "friction_angle",
        20.0,
        40.0,
        "the chart of C1, C2, C3 goes from 20 to 40 degrees (API RP 2A-WSD 6.8.6)",
        "give an angle within it, or back the curve by tests",
    ),
    Range(_FRICTIONAL, "effective_unit_weight", 3e3, 13e3, BUOYANT, _EFFECTIVE),
    Range(_OTHERS_IN_WATER, "effective_unit_weight", 0.0, 13e3, BUOYANT, _EFFECTIVE),
    Range(
        ("weak_rock",),
        "compressive_strength",
        0.5e6,
        5e6,
        "the law of Reese is for weak rock of 0.5 to 5 MPa, from two sites (ASCE 1997)",
        "take a law of clay for softer ground, and a user curve for harder rock",
    ),
    Range(
        ("weak_rock",),
        "strain_rm",
        5e-5,
        5e-4,
        "the strain factor of weak rock lies between 5e-5 and 5e-4 (Reese, ASCE 1997)",
        "give a value in that range; the larger is the softer",
    ),
    Range(
        ("iso_clay",),
        "overconsolidation_ratio",
        1.0,
        10.0,
        "the curves are given up to a ratio of 10 and held beyond (ISO 19901-4, third edition)",
        "compare with ITYP 3 or 4, stiff clay",
    ),
    Range(
        ("pisa_sand",),
        "relative_density",
        45.0,
        90.0,
        "PISA's sand was fitted for densities of 45 to 90 % (Burd et al., Geotechnique 70, 2020)",
        "give a density in that range, or compare with ITYP 2, API sand",
    ),
    Range(
        (),
        "multiplier",
        0.0,
        1.0,
        "a group takes from the resistance of its piles and adds nothing (FHWA GEC-9 table 7-1)",
        "give PMULT of at most 1",
    ),
    Range(
        ("cohesionless",),
        "bearing_factor",
        0.0,
        50.0,
        "Nq reaches 50 in very dense sand (API RP 2GEO table 1)",
        "give 50 at most, or back the end bearing by tests",
    ),
    Range(
        ("cohesive",),
        "residual",
        0.7,
        0.9,
        "clay keeps 0.7 to 0.9 of its friction (API RP 2GEO 8.4.2)",
        "give RESIDUAL in that range; 0.9 is the default",
    ),
    Range(
        ("cohesionless",),
        "residual",
        1.0,
        1.0,
        "sand keeps its peak friction (API RP 2GEO 8.4.2)",
        "leave RESIDUAL out, unless tests show a loss",
    ),
)

_PRESSURE = {"kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
_WEIGHT = {"kN/m3": 1e3, "t/m3": 9.81e3, "kg/m3": 9.81}
_SHARE = {"%": 0.01}
#: By parameter of a curve, a spudcan or the seabed; zero is none.
SLIPS: Mapping[str, Slip] = {
    "undrained_shear_strength": Slip(500.0, 1e7, (1e3, 1e6), _PRESSURE),
    "tip_shear_strength": Slip(500.0, 1e7, (1e3, 1e6), _PRESSURE),
    "mudline_strength": Slip(100.0, 1e6, (500.0, 2e5), _PRESSURE),
    "strength_gradient": Slip(50.0, 1e5, (300.0, 5e4), {"kPa/m": 1e3}),
    "effective_unit_weight": Slip(1e3, 30e3, (3e3, 26e3), _WEIGHT),
    "weight": Slip(5.0, 1e5, (20.0, 5e4), {"kN/m": 1e3}),
    "verley_lund_unit_weight": Slip(1e3, 30e3, (3e3, 26e3), _WEIGHT),
    "given_static_stiffness": Slip(1e3, 1e10, (1e4, 1e9), _PRESSURE),
    "given_dynamic_stiffness": Slip(1e3, 1e10, (1e4, 1e9), _PRESSURE),
    "subgrade_modulus": Slip(1e5, 1e10, (1e6, 2e9), {"kN/m3": 1e3, "MN/m3": 1e6}),
    "initial_shear_modulus": Slip(2e5, 1e11, (1e6, 1e10), _PRESSURE),
    "shear_modulus": Slip(2e5, 1e11, (1e6, 1e10), _PRESSURE),
    "compressive_strength": Slip(2e4, 5e8, (2e5, 3e8), _PRESSURE),
    "rock_mass_modulus": Slip(1e6, 5e11, (1e7, 1e11), _PRESSURE),
    "unit_friction": Slip(200.0, 5e6, (1e3, 1e6), _PRESSURE),
    "tip_pressure": Slip(5e3, 1e9, (1e5, 1e8), _PRESSURE),
    "friction_limit": Slip(2e3, 1e6, (2e4, 5e5), _PRESSURE),
    "end_bearing_limit": Slip(1e5, 1e9, (1e6, 5e7), _PRESSURE),
    "initial_stiffness": Slip(1e4, 1e13, (1e6, 1e11), {"kPa/m": 1e3, "MPa/m": 1e6}),
    "interface_friction_angle": Slip(1.2, inf, (5.0, 50.0), {"rad": 180.0 / pi}),
    "relative_density": Slip(1.5, inf, (20.0, 100.0), {"as a share": 100.0}),
    "rock_quality_designation": Slip(1.5, inf, (5.0, 100.0), {"as a share": 100.0}),
    "multiplier": Slip(0.0, 5.0, (0.05, 1.0), _SHARE),
}
#: Of a line on the seabed: attribute, name in the deck, unit.
CONTACT_SLIPS = (
    ("axial_friction", "MU2", "-", Slip(0.0, 3.0, (0.05, 3.0), _SHARE)),
    ("lateral_friction", "MU3", "-", Slip(0.0, 3.0, (0.05, 3.0), _SHARE)),
    (
        "stiffness",
        "KN DENSITY",
        "N/m2",
        Slip(500.0, 1e10, (1e3, 1e9), {"kN/m2": 1e3, "MN/m2": 1e6}),
    ),
    ("axial_threshold", "XSEUIL2", "m", Slip(0.0, 2.0, (1e-4, 1.0), {"mm": 1e-3})),
    ("lateral_threshold", "XSEUIL3", "m", Slip(0.0, 2.0, (1e-4, 1.0), {"mm": 1e-3})),
    ("tolerance", "DISCON", "m", Slip(0.0, 0.5, (1e-6, 0.5), {"mm": 1e-3})),
)
_LENGTHS = {"mm": 1e-3, "in": 0.0254}
_DENSITIES = {"t/m3": 1e3, "kN/m3": 1e3 / 9.81, "N/m3": 1.0 / 9.81}
#: Of a section of a tube: attribute, name in the deck, unit.
TUBE_SLIPS = (
    ("outer_diameter", "OD", "m", Slip(0.0, 20.0, (0.1, 15.0), _LENGTHS)),
    ("youngs_modulus", "E", "Pa", Slip(1e9, 1e12, (5e9, 5e11), _PRESSURE)),
    ("density", "RHO", "kg/m3", Slip(100.0, 30e3, (1e3, 20e3), _DENSITIES)),
)
