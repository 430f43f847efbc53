"""The soil laws against independently computed check tables (tests/data/soil, units kN and m).

Each file's header states its inputs and who computed it. Columns named *wrong* are other programs'
faults and no targets.
"""

import csv
from pathlib import Path

import numpy as np
import pytest

from podeep.soil import axial
from podeep.soil.sand import Sand, default_subgrade_modulus, sand_coefficients
from podeep.soil.soft_clay import SoftClay

DATA = Path(__file__).parent / "data" / "soil"
KILO = 1e3


def table(number, **equal):
    """Columns of a table where the given columns hold the given text: numbers where they can be."""
    (path,) = DATA.glob(f"{number}_*.csv")
    with path.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [row for row in rows if all(row[name] == text for name, text in equal.items())]
    assert rows
    return {name: column([row[name] for row in rows]) for name in rows[0]}


def column(texts):
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def close(ours, reference):
    np.testing.assert_allclose(ours, reference, rtol=1e-6, atol=0.0)


def soft_clay(t, **options):
    overburden = t["gam"] * t["X"]
    return SoftClay(
        depth=t["X"],
        diameter=t["D"],
        effective_overburden=overburden * KILO,
        undrained_shear_strength=t["su"] * KILO,
        effective_unit_weight=t["gam"] * KILO,
        j=t["J"],
        strain_50=t["eps50"],
        **options,
    )


@pytest.mark.parametrize("name", ["C1", "C2", "C3"])
def test_sand_coefficients_are_the_closed_form_behind_the_figure(name):
    t = table("01")
    ours = sand_coefficients(np.radians(t["phi"]))[int(name[1]) - 1]
    close(ours, t[f"{name}_ref"])


@pytest.mark.parametrize("shape", ["POWER", "WSD", "2GEO"])
def test_soft_clay_static(shape):
    t = table("02")
    law = soft_clay(t, shape=shape)
    close(law.ultimate_resistance, t["pu_ref"] * KILO)
    close(law.y50, t["y50_ref"])
    close(law.force(t["y"]), t[f"p_ref_{shape.lower()}"] * KILO)


@pytest.mark.parametrize("shape", ["POWER", "2GEO"])
def test_soft_clay_cyclic(shape):
    t = table("03")
    law = soft_clay(t, shape=shape, cyclic=True)
    close(law.ultimate_resistance, t["pu_ref"] * KILO)
    close(law.transition_depth, t["XR_api"])
    close(law.force(t["y"]), t[f"p_ref_{shape.lower()}"] * KILO)


@pytest.mark.parametrize("kind", ["static", "cyclic"])
def test_sand(kind):
    t = table("05", kind=kind)
    phi, overburden = np.radians(t["phi"]), t["gam"] * t["X"] * KILO
    law = Sand(t["X"], t["D"], overburden, phi, t["k"] * KILO, cyclic=kind == "cyclic")
    close(law.ultimate_resistance, t["pu_ref"] * KILO)
    close(law.capacity, t["A"] * t["pu_ref"] * KILO)
    close(law.force(t["y"]), t["p_ref"] * KILO)
    close(default_subgrade_modulus(phi), t["k"] * KILO)
    close(Sand(t["X"], t["D"], overburden, phi, cyclic=law.cyclic).force(t["y"]), law.force(t["y"]))


@pytest.mark.parametrize("residual", [0.7, 0.9])
@pytest.mark.parametrize("shape", ["API", "2GEO"])
def test_friction_in_clay(shape, residual):
    t = table("13", soil="clay", tres=str(residual))
    law = axial.CohesiveShaft(
        diameter=t["D"],
        initial_stiffness=1e8,
        shape=shape,
        residual=residual,
        effective_overburden=t["sig"] * KILO,
        undrained_shear_strength=t["arg"] * KILO,
    )
    close(law.peak_friction, t["tmax"] * KILO)
    close(law.force(t["z"]), np.pi * t["D"] * t["t_ref"] * KILO)


#: Limits of unit friction and end bearing (kPa) and bearing factor by delta, API RP 2A-WSD 6.4.3.
WSD = {15: (47.8, 8, 1900), 20: (67.0, 12, 2900), 25: (81.3, 20, 4800), 30: (95.7, 40, 9600)}
WSD[35] = (114.8, 50, 12000)
#: beta, limit of friction (kPa), bearing factor and limit of end bearing, API RP 2GEO table 1.
MEDIUM_SILT, MEDIUM, DENSE, VERY_DENSE = (
    (0.29, 67, 12, 3000),
    (0.37, 81, 20, 5000),
    (0.46, 96, 40, 10000),
    (0.56, 115, 50, 12000),
)
CLASSES = {
    ("Sand-silt", "Medium dense"): MEDIUM_SILT,
    ("Sand", "Medium dense"): MEDIUM,
    ("Sand-silt", "Dense"): MEDIUM,
    ("Sand", "Dense"): DENSE,
    ("Sand-silt", "Very dense"): DENSE,
    ("Sand", "Very dense"): VERY_DENSE,
}


@pytest.mark.parametrize(("shape", "reference"), [("API", "t_ref"), ("2GEO", "t_ref_2geo")])
def test_friction_in_sand(shape, reference):
    t = table("13", soil="sand")
    law = axial.CohesionlessShaft(
        diameter=t["D"],
        initial_stiffness=1e8,
        shape=shape,
        effective_overburden=t["sig"] * KILO,
        earth_pressure_coefficient=0.8,
        interface_friction_angle=np.radians(t["arg"]),
        friction_limit=np.array([WSD[int(delta)][0] for delta in t["arg"]]) * KILO,
    )
    # the table's limits are single precision: 95.699997 for 95.7
    np.testing.assert_allclose(law.peak_friction, t["tmax"] * KILO, rtol=1e-6)
    close(law.force(t["z"]), np.pi * t["D"] * t[reference] * KILO)


@pytest.mark.parametrize("shape", ["API", "2GEO"])
def test_bearing_of_a_tip(shape):
    t = table("14")
    law = axial.DirectTip(
        diameter=t["D"], initial_stiffness=1e8, shape=shape, tip_pressure=4.0 / np.pi / t["D"] ** 2
    )
    close(law.force(t["z"]), t["Q_over_Qp_ref"])


def test_unit_values_of_clay():
    t = table("15", soil="clay")
    su, overburden = t["su"] * KILO, t["sig"] * KILO
    close(axial.alpha_friction(su, overburden), t["f_ref"] * KILO)
    close(axial.alpha_friction(su, overburden) / su, t["alpha_or_beta"])
    close(axial.clay_bearing(su), t["q_ref"] * KILO)


@pytest.mark.parametrize("soil", ["Sand", "Sand-silt", "WSD-delta"])
def test_unit_values_of_sand(soil):
    t = table("15", soil=soil)
    for name, overburden, beta, f, q in zip(
        *(t[n] for n in ("class", "sig", "alpha_or_beta", "f_ref", "q_ref")), strict=True
    ):
        if soil == "WSD-delta":
            (f_limit, factor, q_limit), K, delta = WSD[int(name)], 0.8, np.radians(name)
        else:
            K, f_limit, factor, q_limit = CLASSES[soil, name]
            delta = np.pi / 4.0
        close(K * np.tan(delta), beta)
        friction = axial.overburden_friction(overburden * KILO, K, delta, f_limit * KILO)
        bearing = axial.overburden_bearing(overburden * KILO, factor, q_limit * KILO)
        close((friction, bearing), (f * KILO, q * KILO))
