"""Curves that are legal but risky: a warning just outside each bound, silence just inside."""

from math import inf, pi

import pytest

from podeep.risks.curves import curve_risks
from podeep.solve.analysis import first_model
from risky import CLAY, LINE, SHAFT, SOUND, curve, scene


def told(family, law, **changed):
    return [str(risk) for risk in curve_risks(family, curve(family, law, **changed))]


@pytest.mark.parametrize(("family", "law"), SOUND)
def test_a_sound_curve_is_quiet(family, law):
    """And it can be evaluated, or the silence of checks that do so would tell nothing."""
    assert told(family, law) == []
    rows = ((9e3, 0.1),) if law == "user" else ()
    found = {family: curve(family, law, rows=rows)}
    pile = scene(found.get("p-y", CLAY), found.get("t-z", SHAFT))
    first_model(pile, pile.foundations[0])


SU, GAMMA, EPS, PHI = (
    *("undrained_shear_strength", "effective_unit_weight", "strain_50", "friction_angle"),
)
DEG = pi / 180.0
#: law, parameter, bound in SI, which side of it is risky, words of the warning.
BOUNDS = [
    ("soft_clay", SU, 100e3, "above", "CU = 100 kPa: the curves of soft clay"),
    ("soft_clay", GAMMA, 13e3, "above", "give the effective weight"),
    ("stiff_clay_free_water", SU, 50e3, "below", "of 50 to 400 kPa (OTC 2312)"),
    ("stiff_clay_free_water", SU, 400e3, "above", "of 50 to 400 kPa (OTC 2312)"),
    ("stiff_clay_free_water", GAMMA, 13e3, "above", "give the effective weight"),
    ("stiff_clay", SU, 50e3, "below", "take ITYP 1 for softer clay"),
    ("soft_clay", EPS, 0.02, "above", "EPSC = 0.02: the strain at half"),
    ("stiff_clay", EPS, 0.002, "below", "EPS50 = 0.002: the strain at half"),
    ("sand", PHI, 20 * DEG, "below", "PHI = 20 deg: the chart of C1, C2, C3"),
    ("sand", PHI, 40 * DEG, "above", "API RP 2A-WSD 6.8.6"),
    ("sand", GAMMA, 13e3, "above", "soil under water weighs 4 to 12 kN/m3"),
    ("sand", GAMMA, 3e3, "below", "soil under water weighs 4 to 12 kN/m3"),
    ("reese_sand", PHI, 40 * DEG, "above", "API RP 2A-WSD 6.8.6"),
    ("weak_rock", "compressive_strength", 0.5e6, "below", "QU = 500 kPa: the law of Reese"),
    ("weak_rock", "compressive_strength", 5e6, "above", "a user curve for harder rock"),
    ("weak_rock", "strain_rm", 5e-5, "below", "KRM = 5e-05"),
    ("weak_rock", "strain_rm", 5e-4, "above", "between 5e-5 and 5e-4"),
    ("iso_clay", "overconsolidation_ratio", 10.0, "above", "OCR = 10: the curves are given up"),
    ("iso_clay", "overconsolidation_ratio", 2.0, "above", "NOGAP with OCR = 2"),
    ("pisa_sand", "relative_density", 0.45, "below", "DR = 45 %: PISA's sand was fitted"),
    ("pisa_sand", "relative_density", 0.9, "above", "densities of 45 to 90 %"),
    ("soft_clay", "multiplier", 1.0, "above", "give PMULT of at most 1"),
    ("user", "multiplier", 1.0, "above", "give PMULT of at most 1"),
    ("cohesive", "residual", 0.9, "above", "clay keeps 0.7 to 0.9"),
    ("cohesive", "residual", 0.7, "below", "clay keeps 0.7 to 0.9"),
    ("cohesionless", "residual", 1.0, "below", "sand keeps its peak friction"),
    ("cohesionless", "bearing_factor", 50.0, "above", "F4 = 50: Nq reaches 50"),
]
#: What else a bound needs so that no other rule speaks.
BESIDE = {
    (EPS, 0.02): {SU: 10e3},
    (EPS, 0.002): {SU: 200e3},
    (PHI, 20 * DEG): {"subgrade_modulus": 5e6},
    (PHI, 40 * DEG): {"subgrade_modulus": 45e6},
    (SU, 400e3): {"subgrade_modulus": 540e6},
    ("overconsolidation_ratio", 10.0): {"options": {"no_gap": False}},
}


@pytest.mark.parametrize(("law", "key", "bound", "side", "words"), BOUNDS)
def test_a_range_ends_at_its_bound(law, key, bound, side, words):
    family = "p-y" if ("p-y", law) in SOUND else "t-z"
    beside = BESIDE.get((key, bound), {})
    assert told(family, law, **beside, **{key: bound}) == []
    step = 1e-7 if side == "above" else -1e-7
    (line,) = told(family, law, **beside, **{key: bound * (1.0 + step)})
    assert LINE.fullmatch(line)
    assert words in line


#: law, parameter, value that is a slip (SI), the remedy, value that is none.
SLIPS = [
    ("soft_clay", SU, 40.0, "write 40e3 if 40 kPa is meant", 500.0),
    ("soft_clay", SU, 0.04, "write 40e3 if 0.04 MPa is meant", 500.0),
    ("soft_clay", SU, 40e6, "check it and its unit", 100e3),
    ("cohesive", SU, 40.0, "write 40e3 if 40 kPa is meant", 500.0),
    ("soft_clay", GAMMA, 8.0, "write 8000 if 8 kN/m3 is meant", 1e3),
    ("soft_clay", GAMMA, 0.8, "write 7848 if 0.8 t/m3 is meant", 1e3),
    ("soft_clay", GAMMA, 850.0, "write 8338 if 850 kg/m3 is meant", 1e3),
    ("sand", "subgrade_modulus", 22.0, "write 22e6 if 22 MN/m3 is meant", 22e6),
    ("sand", "subgrade_modulus", 22e3, "write 22e6 if 22000 kN/m3 is meant", 22e6),
    ("stiff_clay_free_water", "subgrade_modulus", 270.0, "write 270e6 if 270 MN/m3", 270e6),
    ("weak_rock", "compressive_strength", 2.0, "write 2e6 if 2 MPa is meant", 2e6),
    ("weak_rock", "compressive_strength", 2e3, "write 2e6 if 2000 kPa is meant", 2e6),
    ("weak_rock", "rock_mass_modulus", 500.0, "write 500e6 if 500 MPa is meant", 1e6),
    ("weak_rock", "rock_mass_modulus", 2.0, "write 2e9 if 2 GPa is meant", 1e6),
    ("weak_rock", "rock_quality_designation", 0.005, "write 50 if 0.5 as a share", 0.015),
    ("pisa_sand", "relative_density", 0.007, "write 70 if 0.7 as a share is meant", 0.7),
    ("pisa_sand", "initial_shear_modulus", 80.0, "write 80e6 if 80 MPa is meant", 2e5),
    ("pisa_clay", "initial_shear_modulus", 80e3, "write 80e6 if 80000 kPa is meant", 2e5),
    ("iso_clay", "mudline_strength", 5.0, "write 5000 if 5 kPa is meant", 100.0),
    ("iso_clay", "strength_gradient", 1.5, "write 1500 if 1.5 kPa/m is meant", 50.0),
    ("user", "multiplier", 80.0, "write 0.8 if 80 % is meant", 1.0),
    ("direct", "unit_friction", 50.0, "write 50e3 if 50 kPa is meant", 200.0),
    ("direct", "tip_pressure", 2e3, "write 2e6 if 2000 kPa is meant", 5e3),
    ("direct", "initial_stiffness", 100.0, "write 100e6 if 100 MPa/m is meant", 1e4),
    ("cohesionless", "friction_limit", 96.0, "write 96e3 if 96 kPa is meant", 2e3),
    ("cohesionless", "end_bearing_limit", 10.0, "write 10e6 if 10 MPa is meant", 1e5),
    (
        "cohesionless",
        "interface_friction_angle",
        0.436 * DEG,
        "write 24.98 if 0.436 rad",
        1.2 * DEG,
    ),
]


@pytest.mark.parametrize(("law", "key", "slip", "remedy", "none"), SLIPS)
def test_a_slip_of_units_tells_what_to_write(law, key, slip, remedy, none):
    family = "p-y" if ("p-y", law) in SOUND else "t-z"
    assert told(family, law, **{key: none}) == []
    line = told(family, law, **{key: slip})[0]
    assert LINE.fullmatch(line)
    assert "a slip of units (the deck takes" in line
    assert remedy in line


def test_a_zero_is_no_slip():
    assert told("p-y", "soft_clay", undrained_shear_strength=0.0, strain_50=0.02) == []
    assert told("t-z", "direct", unit_friction=0.0, tip_pressure=0.0) == []


def test_a_strain_that_clay_of_its_strength_hardly_has():
    for strain, quiet in ((0.02, True), (0.0201, False), (0.0067, True), (0.0066, False)):
        at = {"undrained_shear_strength": 20e3 if strain < 0.01 else 60e3, "strain_50": strain}
        lines = told("p-y", "soft_clay", **at)
        assert (lines == []) is quiet
    (line,) = told("p-y", "soft_clay", undrained_shear_strength=20e3, strain_50=0.0066)
    assert "EPSC = 0.0066 with CU = 20 kPa: clay of that strength has about 0.02" in line


@pytest.mark.parametrize(
    ("law", "beside", "table"),
    [
        ("sand", {PHI: 30 * DEG}, 11e6),
        ("reese_sand", {PHI: 38 * DEG}, 35.8e6),
        ("stiff_clay_free_water", {SU: 60e3, EPS: 0.007}, 135e6),
        ("stiff_clay_free_water", {SU: 60e3, EPS: 0.007, "options": {"cyclic": True}}, 55e6),
    ],
)
def test_a_modulus_is_held_against_its_table(law, beside, table):
    for k in (table / 2.999, table, 2.999 * table):
        assert told("p-y", law, subgrade_modulus=k, **beside) == []
    for k in (table / 3.001, 3.001 * table):
        (line,) = told("p-y", law, subgrade_modulus=k, **beside)
        assert f"the table has {table / 1e6:g} MN/m3 (" in line
        assert "leave K out" in line


def test_a_modulus_that_stands_in_below_its_table():
    assert told("p-y", "sand", subgrade_modulus=None, friction_angle=25 * DEG) == []
    (line,) = told("p-y", "sand", subgrade_modulus=None, friction_angle=24 * DEG)
    assert "PHI = 24 deg without K: the table that stands in starts at 25 degrees" in line


@pytest.mark.parametrize(
    ("method", "given", "limits"),
    [
        ("BETA", {"friction_limit": inf, "end_bearing_limit": inf}, "F5=81e3 and F6=5e6"),
        ("BETA", {"friction_limit": None}, "F5=81e3 (Pa)"),
        ("BETA", {"end_bearing_limit": None}, "F6=5e6 (Pa)"),
        ("DIRECT", {"earth_pressure_coefficient": 0.29, "friction_limit": None}, "F5=67e3"),
        ("DIRECT", {"earth_pressure_coefficient": 0.46, "friction_limit": None}, "F5=96e3"),
        ("DIRECT", {"earth_pressure_coefficient": 0.56, "friction_limit": None}, "F5=115e3"),
    ],
)
def test_friction_of_sand_wants_limits(method, given, limits):
    (line,) = told("t-z", "cohesionless", options={"method": method}, **given)
    assert "without bound (limits: API RP 2GEO table 1); give " + limits in line


def test_sand_without_friction_or_without_a_tip_wants_no_limit_of_it():
    frictionless = {"earth_pressure_coefficient": 0.0, "friction_limit": None}
    assert told("t-z", "cohesionless", **frictionless) == []
    assert told("t-z", "cohesionless", bearing_factor=0.0, end_bearing_limit=None) == []


def test_beta_of_sand_has_a_largest_value():
    at = {"earth_pressure_coefficient": 1.0, "interface_friction_angle": 35 * DEG}
    assert told("t-z", "cohesionless", **at) == []
    (line,) = told("t-z", "cohesionless", **(at | {"earth_pressure_coefficient": 1.01}))
    assert "F1 = 1.01 with F3 = 35 deg, beta = 0.707: very dense sand has 0.56" in line
    direct = {"earth_pressure_coefficient": 0.7, "options": {"method": "DIRECT"}}
    assert told("t-z", "cohesionless", **direct) == []
    (line,) = told("t-z", "cohesionless", **(direct | {"earth_pressure_coefficient": 0.71}))
    assert "beta = F1 = 0.71" in line


@pytest.mark.parametrize(
    ("family", "law", "rows", "words"),
    [
        ("p-y", "user", ((60e3, 0.01), (90e3, 0.03), (90e3, 0.1)), None),
        ("p-y", "user", ((60e3, 0.01), (90e3, 0.03), (70e3, 0.1)), "P falls from its peak, 90 kPa"),
        ("p-y", "user", ((-5e3, -0.2), (-9e3, -0.1), (9e3, 0.1)), "at Y = -0.1 m, to 5 kPa"),
        ("p-y", "user", ((-9e3, -0.2), (-5e3, -0.1), (9e3, 0.1)), None),
        ("p-y", "user", ((9e3, 0.1, 9e3, 0.1), (9e3, 0.2, 5e3, 0.2)), None),
        ("t-z", "direct", ((5e4, 0.01, 1e5, 0.01), (5e4, 0.1, 2e5, 0.1)), None),
        ("t-z", "direct", ((5e4, 0.01, 1e5, 0.01), (4e4, 0.1, 2e5, 0.1)), "Tz falls"),
        ("t-z", "direct", ((5e4, 0.01, 1e5, 0.01), (5e4, 0.1, 9e4, 0.1)), "Qz falls"),
    ],
)
def test_rows_that_fall_behind_a_peak_are_noted(family, law, rows, words):
    lines = told(family, law, rows=rows)
    assert len(lines) == (words is not None)
    assert all(words in line and LINE.fullmatch(line) for line in lines)


def test_values_that_rows_replace_are_not_judged():
    rows = ((5e4, 0.01, 1e5, 0.01),)
    assert told("t-z", "cohesionless", rows=rows, friction_limit=None, bearing_factor=90.0) == []
    assert told("t-z", "cohesionless", rows=rows, effective_unit_weight=8.0)
