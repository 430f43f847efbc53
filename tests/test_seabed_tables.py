"""A pipe at rest and the models of the soil under it against check tables 01 and 02.

The tables (tests/data/seabed) were computed to 40 digits by others; each header tells how.
"""

import csv
from functools import cache
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.seabed import bearing
from podeep.seabed.at_rest import node_forces, penetration_at_rest
from podeep.seabed.dnv14 import Dnv14
from podeep.seabed.models import MODELS
from podeep.seabed.normal import Winkler
from podeep.seabed.stiffness import pipe_stiffness

DATA = Path(__file__).parent / "data" / "seabed"


@cache
def table(number):
    (path,) = DATA.glob(f"{number}_*.csv")
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def exactly(value):
    return pytest.approx(value, rel=1e-9, abs=0.0)


# --- table 01: a pipe at rest -----------------------------------------------------------------


@pytest.mark.parametrize("row", table("01"), ids=lambda row: row["case"])
def test_01_node_at_rest(row):
    at = {name: float(text) for name, text in row.items() if name != "case"}
    k, eps = at["Kn_N_per_m"], at["eps_m"]
    forces = node_forces(at["w0_N_per_m"], at["L0_m"])
    for name, force in zip(("end", "int"), forces, strict=True):
        d = penetration_at_rest(force, k, eps)
        back, tangent = Winkler(k, eps).evaluate(d)
        assert float(force) == exactly(at[f"F_{name}_N"])
        assert float(d) == exactly(at[f"d_{name}_m"])
        assert float(back) == exactly(float(force))
        assert float(tangent) == exactly(at[f"tangent_K_{name}_N_per_m"])
    assert float(forces.end) / k == exactly(at["seed_formula_d_end_m"])  # without a tolerance


def test_the_normal_force_and_its_slope_do_not_jump():
    k, eps = 2e5, 0.01
    places = np.array([0.0, eps])
    (below, slope_below), (above, slope_above) = (
        Winkler(k, eps).evaluate(places + side) for side in (-1e-12, 1e-12)
    )
    np.testing.assert_allclose(below, above, atol=1e-6 * k * eps)
    np.testing.assert_allclose(slope_below, slope_above, atol=1e-9 * k)
    assert Winkler(k, eps).evaluate(np.array(-1.0)) == (0.0, 0.0)
    # a stiffness per metre times the length of pipe: all nodes of a pipe sink alike
    w, length = 1450.0, 5.0
    sunk = [
        float(penetration_at_rest(f, 3e5 * part, 1e-4))
        for f, part in zip(node_forces(w, length), (0.5 * length, length), strict=True)
    ]
    assert sunk == pytest.approx([w / 3e5 + 0.5e-4] * 2, rel=1e-14)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ((1.0, 0.0, 0.1), "the contact's stiffness 0 is not positive"),
        ((1.0, 1.0, -0.1), "the contact's tolerance -0.1 is not positive"),
        ((-1.0, 1.0, 0.1), "a force of -1 N does not press"),
        ((np.nan, 1.0, 0.1), "a force of nan N does not press"),
    ],
)
def test_what_cannot_rest(values, told):
    with pytest.raises(InvalidData, match=told):
        penetration_at_rest(*values)


# --- table 02: models -------------------------------------------------------------------------

NAMES = {
    ("DNVG14", "clay"): "DNV14CLAY",
    ("DNVG14", "sand"): "DNV14SAND",
    ("DUNLAP", "clay"): "DUNLAP",
    ("VL95", "clay"): "VERLEYLUND",
    ("VL95LIN", "clay"): "VERLEYLUNDLINEAR",
    ("VS94", "sand"): "VERLEYSOTBERG",
    ("F114M2", "clay"): "F114",
    ("NGIDR", "sand"): "NGIDRAINED",
}
COLUMNS = {
    "undrained_shear_strength": "cu_Pa",
    "effective_unit_weight": "gam_N_per_m3",
    "friction_angle": "phi_deg",
    "self_weight_factor": "ng",
    "verley_lund_unit_weight": "gam_vl_N_per_m3",
    "void_ratio": "e",
    "poisson_ratio": "nu",
}


def of_row(row):
    """The law of a row."""
    values = {key: float(row[name]) for key, name in COLUMNS.items() if row[name]}
    if "friction_angle" in values:
        values["friction_angle"] = radians(values["friction_angle"])
    return MODELS[NAMES[row["model"], row["soil"]]].at(float(row["D_m"]), values)


def test_the_table_of_models_is_whole():
    assert {(row["model"], row["soil"]) for row in table("02")} == set(NAMES)
    assert len(table("02")) == 45
    assert set(MODELS) - set(NAMES.values()) == {"AUDIBERTCLAY", "AUDIBERTSAND", "DIRECT"}


@pytest.mark.parametrize("row", table("02"), ids=lambda r: f"{r['model']}-{r['W_N_per_m']}")
def test_02_models(row):
    law, weight = of_row(row), float(row["W_N_per_m"])
    found = pipe_stiffness(law, weight)
    ours = {
        "z_m": found.penetration,
        "z_over_D": found.penetration / law.diameter,
        "Ks_Pa": found.static,
    }
    if row["B_m"]:
        assert isinstance(law, Dnv14)
        _, factors = law._strength
        ours |= dict(zip(("Nq", "Ngam", "Nc"), map(float, factors), strict=True))
        ours |= {"B_m": found.contact_width, "Kd_Pa": found.dynamic, "KL_Pa": found.lateral}
        ours["sig_Pa"] = 0.75 * law.effective_unit_weight * found.contact_width
        ours["G_Pa"] = float(law.shear_modulus(found.penetration))
    else:
        assert found.dynamic is None
        assert found.lateral is None
    for name, value in ours.items():
        assert value == exactly(float(row[name])), name
    inputs = {"model", "soil", "D_m", "W_N_per_m", "in_range", *COLUMNS.values()}
    assert {name for name, text in row.items() if text} <= inputs | set(ours)
    assert float(law.force(np.array(found.penetration))) == exactly(weight)
    beyond = [w for w in found.warnings if "is above" in w]
    assert bool(beyond) == (row["in_range"] == "0")
    stiffer = any("Kd is below Ks" in w for w in found.warnings)
    assert stiffer == (found.dynamic is not None and found.dynamic < found.static)


def test_numbers_of_the_reference():
    """Nq by API; the misprinted formula gives another; the trap of a small dynamic stiffness."""
    angles = np.radians((30.0, 35.0, 40.0))
    Nq, Ngamma, Nc = bearing.sand_factors(angles)
    np.testing.assert_allclose(Nq, (18.4011, 33.2961, 64.1952), rtol=3e-6)
    printed = np.exp(np.arctan(angles)) * np.tan(pi / 4 + angles / 2) ** 2
    np.testing.assert_allclose(printed, (4.8596, 6.3856, 8.4595), rtol=1e-5)
    np.testing.assert_allclose(Ngamma, 1.8 * (Nq - 1.0) * np.tan(angles))
    np.testing.assert_allclose(bearing.sand_factors(angles, 1.5)[1], Ngamma * 1.5 / 1.8)
    np.testing.assert_allclose(Nc, (Nq - 1.0) / np.tan(angles))
    assert bearing.CLAY == (1.0, 0.0, 5.14)
    hard = {"undrained_shear_strength": 17e3, "effective_unit_weight": 5.4e3}
    hard |= {"void_ratio": 1.8, "poisson_ratio": 0.45}
    found = pipe_stiffness(MODELS["DNV14CLAY"].at(0.273, hard), 600.0)
    assert found.static == pytest.approx(13.9e6, rel=4e-3)
    assert found.dynamic == pytest.approx(0.17e6, rel=4e-3)
    (warning,) = found.warnings
    assert "Kd is below Ks" in warning
    lund = {"undrained_shear_strength": 5e3}
    light, bulk = (
        float(MODELS["VERLEYLUND"].at(0.3, lund | {"verley_lund_unit_weight": g}).penetration(800))
        for g in (5e3, 18e3)
    )
    assert light / bulk == pytest.approx(1.355, abs=1e-3)
