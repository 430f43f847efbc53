"""Tables 01, 05 and 08 to 11 as a user meets them: decks of other soils than clay, layers, groups.

As in test_tables_through_decks.py: curves from the CSV to 1e-6, derived values, which the report
in words alone has with six digits, to 1e-5.
"""

import pytest

from test_soil_tables import KILO, close
from test_tables_through_decks import Solver, first, near, sets


@pytest.fixture
def solver(tmp_path, capsys):
    return Solver(tmp_path, capsys)


@sets("01", "phi")
def test_01_coefficients_of_sand(solver, t):
    """To the six digits of the report."""
    r = first(t)
    solver.deck(f"*PYCURVE\n1 2 10e3 {r['phi']!r}")
    near(solver.derived("py", 5.0), **{name: r[f"{name}_ref"] for name in ("C1", "C2", "C3")})


@pytest.mark.parametrize("modulus", ["of the table", "of the standard"])
@sets("05", "D", "X", "kind")
def test_05_sand(solver, t, modulus):
    r = first(t)
    k = r["k"] * KILO if modulus == "of the table" else 0
    keyword = "*PYCURVE, CYCLIC" if r["kind"] == "cyclic" else "*PYCURVE"
    solver.deck(f"{keyword}\n1\n2 {r['gam'] * KILO!r} {r['phi']!r} {k!r}", diameter=r["D"])
    close(solver.curve("py", r["X"], t["y"]), t["p_ref"] * KILO)
    near(solver.derived("py", r["X"]), A=r["A"], ultimate_resistance=r["pu_ref"] * KILO)


@pytest.mark.parametrize("above", [0.0, 7.0])
@sets("08", "D", "xr")
def test_08_weak_rock(solver, t, above):
    """With the rock's surface at the mudline, or under sand that does not count."""
    r = first(t)
    values = f"{r['qu'] * KILO!r} {r['Eir'] * KILO!r} {r['RQD']!r} {r['krm']!r}"
    rock, sand = f"*PYCURVE\n1\n5 {values}\n", "*PYCURVE\n2 2 10e3 35\n"
    if above:
        depths, props = f"0 {-above!r} {-above!r} -60", "2 0 2 0 1 0 1 0"
        solver.deck(rock + sand, depths=depths, props=props, diameter=r["D"])
        above *= 1.0 + 1e-12  # its surface belongs to the sand, too
    else:
        solver.deck(rock, diameter=r["D"])
    close(solver.curve("py", above + r["xr"], t["y"]), t["p_ref"] * KILO)
    near(
        solver.derived("py", above + r["xr"]),
        ultimate_resistance=r["pur"] * KILO,
        initial_stiffness=r["Kir"] * KILO,
        y_A=r["yA"],
    )


@pytest.mark.parametrize(
    ("options", "column"),
    [
        ("", "pu_naive"),
        (", LAYERING=GEORGIADIS", "pu_eq"),
        (", LAYERING=GEORGIADIS, OVERBURDEN=ACTUAL", "pu_eq_sig"),
    ],
)
@sets("09", "z")
def test_09_sand_below_clay(solver, t, options, column):
    """What a large displacement mobilises is A pu, with A = 0.9 at all of these depths."""
    r = first(t)
    solver.deck(
        "*PYCURVE\n1 1 18e3 8e3 0.5 0.01\n*PYCURVE\n2 2 9.5e3 33",
        depths="0 -4 -4 -30",
        layering=options,
        props="1 0 1 0 2 0 2 0",
        diameter=r["D"],
    )
    close(solver.curve("py", r["z"], [1e3]), 0.9 * r[column] * KILO)
    near(solver.derived("py", r["z"]), A=0.9, ultimate_resistance=r[column] * KILO)


@sets("10", "s_over_D", "row")
def test_10_group(solver, t):
    r, y = first(t), [0.001, 0.02, 1.0]
    row = {"lead": 1, "2nd": 2, "3rd": 3}[r["row"]]
    curves = []
    for options in ("", f", SPACING={r['s_over_D']!r}, ROW={row}"):
        solver.deck(f"*PYCURVE{options}\n1\n1 20e3 8e3 0.5 0.02")
        curves.append(solver.curve("py", 2.0, y))
    close(curves[1] / curves[0], r["pm_ref"])


@sets("11", "model", "z", "comp")
def test_11_pisa(solver, t):
    """Curves of the base are those of a tip standing there; su or G0 at the depth is the curve's.

    The report shows the moment along a pile in sand for |p| at its capacity; the table's is for
    0.6 of it.
    """
    r = first(t)
    name = {"p": "py", "m": "mt", "HB": "hb", "MB": "mb"}[r["comp"]]
    if r["model"] == "clay_Cowden":
        values, lateral = f"7 {r['s'] * KILO!r}", 1.0
    else:
        values = f"8 {r['s'] / r['z'] * KILO!r} {r['Dr']!r}"
        lateral = 0.6 if name == "mt" else 1.0
    solver.deck(
        f"*PYCURVE\n1\n{values} {r['G0'] * KILO!r}", diameter=r["D"], length=r["L"], wall=0.06
    )
    close(lateral * solver.curve(name, r["z"], t["x"]), t["val_ref"] * KILO)
    columns = {"k": "k", "n": "n", "x_ultimate": "xu", "y_ultimate": "yu"}
    near(solver.derived(name, r["z"]), **{n: r[column] for n, column in columns.items()})
