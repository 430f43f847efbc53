"""Tables 13 to 19 as a user meets them: podeep-solve curves, capacity, stiffness and run.

As in test_tables_through_decks.py: 1e-6, and 1e-5 for what is printed in words alone.
"""

import csv
import re
from math import pi

import numpy as np
import pytest

from podeep.database.read import open_database
from test_soil_tables import CLASSES, KILO, WSD, close, table
from test_tables_through_decks import Solver, first, near, sets

DEPTH, G, WATER = 10.0, 9.80665, 1025.0  # DEPTH of the curves, where s'v = GAMMA DEPTH
AXIAL = {"props": "0 1", "more": ""}  # of a deck that its t-z curve holds


@pytest.fixture
def solver(tmp_path, capsys):
    return Solver(tmp_path, capsys)


def sand(r, delta, K, f_limit, factor, q_limit):
    """Values of a cohesionless *TZCURVE with the overburden of a row at DEPTH; limits in kPa."""
    limits = f"{f_limit * KILO!r} {q_limit * KILO!r}"
    return f"2 {K!r} {r['sig'] * KILO / DEPTH!r} {delta!r} {factor!r} {limits}"


def clay(r, strength):
    return f"1 {r[strength] * KILO!r} {r['sig'] * KILO / DEPTH!r}"


@pytest.mark.parametrize("shape", ["API", "2GEO"])
@sets("13", "arg", "tres", soil="clay")
def test_13_friction_in_clay(solver, t, shape):
    r = first(t)
    keyword = f"*TZCURVE, SHAPE={shape}, RESIDUAL={r['tres']!r}"
    solver.deck(f"{keyword}\n1 0\n{clay(r, 'arg')}", **AXIAL, diameter=r["D"])
    close(solver.curve("tz", DEPTH, t["z"]) / (pi * r["D"]), t["t_ref"] * KILO)
    near(solver.derived("tz", DEPTH), peak_friction=r["tmax"] * KILO)


@pytest.mark.parametrize(("shape", "column"), [("API", "t_ref"), ("2GEO", "t_ref_2geo")])
@sets("13", "arg", soil="sand")
def test_13_friction_in_sand(solver, t, shape, column):
    r = first(t)
    f_limit, factor, q_limit = WSD[int(r["arg"])]
    values = sand(r, r["arg"], 0.8, f_limit, factor, q_limit)
    solver.deck(f"*TZCURVE, SHAPE={shape}\n1 0\n{values}", **AXIAL, diameter=r["D"])
    close(solver.curve("tz", DEPTH, t["z"]) / (pi * r["D"]), t[column] * KILO)
    near(solver.derived("tz", DEPTH), peak_friction=r["tmax"] * KILO)


@pytest.mark.parametrize("shape", ["API", "2GEO"])
@sets("14", "D")
def test_14_bearing_of_a_tip(solver, t, shape):
    """Q over Qp = q pi D^2/4, without any reaction where the tip rises."""
    r, q = first(t), 5e6
    solver.deck(f"*TZCURVE, SHAPE={shape}\n1 0\n0 50e3 {q!r}", **AXIAL, diameter=r["D"])
    found = solver.curve("qz", DEPTH, t["z"])
    close(found / (0.25 * pi * r["D"] ** 2 * q), t["Q_over_Qp_ref"])


@sets("15", "soil", "class", "sig", "f_ref")
def test_15_unit_friction_and_bearing(solver, t):
    """Elastic-plastic curves at a displacement at which both have yielded; also without limits."""
    r = first(t)
    if r["soil"] == "clay":
        strength, values = r["su"], [clay(r, "su")] * 2
    else:
        if r["soil"] == "WSD-delta":
            K, delta, (f_limit, *bearing) = 0.8, float(r["class"]), WSD[int(r["class"])]
        else:  # beta = K tan 45 degrees
            K, f_limit, *bearing = CLASSES[r["soil"], r["class"]]
            delta = 45.0
        values = [sand(r, delta, K, f_limit, *bearing), sand(r, delta, K, 0.0, bearing[0], 0.0)]
        strength = r["sig"]
    limited, unlimited = (f"*TZCURVE\n1 0\n{line}" for line in values)
    solver.deck(unlimited, **AXIAL, diameter=1.2)
    friction = solver.curve("tz", DEPTH, [1.0])
    close(friction / (pi * 1.2), r["alpha_or_beta"] * strength * KILO)
    solver.deck(limited, **AXIAL, diameter=1.2)
    close(solver.curve("tz", DEPTH, [1.0]) / (pi * 1.2), r["f_ref"] * KILO)
    close(solver.curve("qz", DEPTH, [1.0]) / (0.36 * pi), r["q_ref"] * KILO)


def layers(texts):
    """A deck's depths, t-z curves and *GROUNDPROP of the layers of table 16; limits or none."""
    depths, curves, props = [], [], []
    for part in texts.split("|"):
        span, soil, *values = part.split(":")
        depths += [f"-{float(z)!r}" for z in span.split("-")]
        if soil == "CLAY":
            *strengths, weight = (float(value) * KILO for value in values)
            lines = [f"1 {su!r} {weight!r}" for su in strengths]
        else:
            beta, f_limit, factor, q_limit = CLASSES["Sand", values[0]]
            given = f"2 {beta!r} {float(values[1]) * KILO!r} 45 {factor!r}"
            lines = [f"{given} {f_limit * KILO!r} {q_limit * KILO!r}"] * 2
        for line in lines:
            curves.append(f"*TZCURVE\n{len(curves) + 1} 0\n{line}")
            props.append(f"0 {len(curves)}")
    return {"curves": "\n".join(curves), "depths": " ".join(depths), "props": " ".join(props)}


@pytest.mark.parametrize("limited", [True, False], ids=["limits", "no limits"])
@sets("16", "D")
def test_16_axial_capacity(solver, t, limited):
    """The pile has the density of the table's W; the plug's weight follows from the soil's.

    So the table's Wplug, a number, stands in for it in tension.
    """
    r = first(t)
    steel = pi * (r["D"] - r["t"]) * r["t"] * r["L"]
    soil = layers(r["layers"])
    if not limited:
        soil["curves"] = re.sub(r"^(2 (?:\S+ ){3}\S+) .*", r"\1", soil["curves"], flags=re.M)
    solver.deck(
        **soil,
        diameter=r["D"],
        length=r["L"],
        wall=r["t"],
        density=WATER + r["W"] * KILO / (G * steel),
        more="",
    )
    lines = [line for line in solver("capacity", "--csv").splitlines() if line[0] != "#"]
    found = list(csv.DictReader(lines))
    (at,) = [row for row in found if float(row["depth [m]"]) == r["L"]]
    ours = {name.split(" [")[0]: value for name, value in at.items()}
    names = {"Qo": "outer_friction", "Qi": "inner_friction", "qb": "unit_bearing"}
    names |= {"Qw": "wall_bearing", "Qp": "plug_bearing", "W": "pile_weight"}
    names |= {"plugged": "compression_plugged", "unplugged": "compression_unplugged"}
    names |= {"comp": "compression", "tens_unplugged": "tension_unplugged"}
    if not limited:
        kept = ("plugged", "unplugged", "comp")
        names = {f"{column}_nolim": names[column] for column in kept}
    for column, name in names.items():
        assert float(ours[name]) == pytest.approx(r[column] * KILO, rel=1e-6), column
    if limited:
        replaced = r["Wplug"] * KILO - float(ours["plug_weight"])
        plugged = float(ours["tension_plugged"]) + replaced
        assert plugged == pytest.approx(r["tens_plugged"] * KILO, rel=1e-6)
        assert ours["tension_governed_by"] == "plugged"
        assert float(ours["tension"]) + replaced == pytest.approx(r["tens"] * KILO, rel=1e-6)


def on_spudcan(solver, values, more=""):
    """A deck of a tube on a spudcan, in soil that does not react beside it."""
    solver.deck("", props="0 0", length=3.0, more=f"*SPUDCAN\n1 {values}\n{more}")


@sets("17", "G", "h")
def test_17_stiffness_of_a_spudcan(solver, t):
    r = first(t)
    on_spudcan(solver, f"{2.0 * r['R']!r} {r['h']!r} {r['G'] * KILO!r} {r['nu']!r}")
    rows = list(csv.DictReader(solver("stiffness", "--csv").splitlines()))
    for model, suffix in (("deck: G, KD", ""), ("deck: G, KD of Arya", "_arya")):
        (row,) = [row for row in rows if row["model"] == model]
        for name, column in (
            ("vertical [N m-1]", f"K1{suffix}"),
            ("horizontal [N m-1]", f"K2{suffix}"),
            ("rotational [N m rad-1]", f"K3{suffix}"),
            ("torsional [N m rad-1]", "K4"),
        ):
            assert float(row[name]) == pytest.approx(r[column] * KILO, rel=1e-6), (model, name)


@sets("18", "soil", "B")
def test_18_bearing_of_a_spudcan(solver, t):
    """To the six digits of the report."""
    r = first(t)
    soil = f"SOIL={r['soil'].upper()} GAMMA={r['gam'] * KILO!r}"
    own = f"SU={r['su'] * KILO!r}" if r["soil"] == "clay" else f"PHI={r['phi']!r}"
    on_spudcan(solver, f"{r['B']!r} {r['Dep']!r} 40e6 0.5 {soil} {own}")
    (found,) = re.findall(rf"capacity in {r['soil']} (\S+) N", solver("stiffness"))
    assert float(found) == pytest.approx(r["Qv"] * KILO, rel=1e-5)


@sets("19", "soil", "V", "a")
def test_19_yield_surface_of_a_spudcan(solver, t):
    """QH, QM and a in words; rf by how much of the rotational spring the loads leave.

    The table has rf and fr where a = 0; elsewhere they follow from its F, with
    F = (H/QH)^2 + (M/QM)^2 - room and rf^2 = ((H/QH)^2 + (M/QM)^2) / room.
    """
    r = first(t)
    V, H, M, QV, QH, QM = (r[name] * KILO for name in ("V", "H", "M", "QV", "QH", "QM"))
    strength = f"SU={QH / (0.25 * pi * r['B'] ** 2)!r}" if r["soil"] == "clay" else ""
    embed = r["a"] * 2.5 * r["B"]
    on_spudcan(
        solver,
        f"{r['B']!r} {embed!r} 40e6 0.5 {QV!r} SOIL={r['soil'].upper()} {strength}",
        f"*LOAD\nALL 1 0 {H!r} 0 {-V!r} 0 {M - 3.0 * H!r} 0\n"  # at the head, 3 m up
        "*MODEL, SMALL\n",
    )
    words = " ".join(solver("stiffness").split())
    numbers = [float(x) for x in re.findall(r"(?:Q[VHM]|, a) (\S+)", words)]
    np.testing.assert_allclose(numbers, [QV, QH, QM, r["a"]], rtol=1e-5)

    taken = (H / QH) ** 2 + (M / QM) ** 2
    rf = np.sqrt(taken / (taken - r["F"]))
    fr = np.sqrt(1.0 - rf) + 0.1 * np.exp(100.0 * (rf - 1.0))
    if r["a"] == 0.0:
        close((rf, fr), (r["rf"], r["fr"]))
    assert solver("run", "-o", str(solver.path.parent), "-q") == ""
    with open_database(solver.path.with_suffix(".dss")) as database:
        turned = database.foundation("F1").read_tube(1, "rotation_y", -1)[..., -1].item()
    rotational = first(table("17"))["K3"] * KILO  # of the same B, G and nu
    close(abs(turned) * rotational * fr, M)
