"""Whole piles of tables 23 to 26 through decks, the solver and the database (asked: 0.5 %).

Table 23: Hetenyi's closed form and a finite element solution. 24: cubic elements, OpenSees and
others on soft clay. 25: sand. 26: shooting from the tip on t-z curves with a residual, past the
peak.
"""

from pathlib import Path

import numpy as np
import pytest

from decks import linear_curve, solved
from test_soil_tables import table

ASKED = 5e-3
BASE = "*DEPTH\n0\n*GROUNDEPTH\n0 -50\n{curves}*GROUNDPROP\n{pairs}\n*CASING\n1 PILE\n"


def rows(number: str):
    columns = {name: values.tolist() for name, values in table(number).items()}
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values())]  # noqa: B905


def lateral_deck(curve: str, row, section: str) -> str:
    head = "*SUPPORT\n1 0 RY\n" if row.get("fixed") else ""
    length = row["L"]
    moment = row["M"] * 1e3
    return (
        BASE.format(curves=curve, pairs="1 0 1 0")
        + f"0 {-length!r} {section}\n*FONDATION\n1 1\n{head}*SUPPORT\n1 {-length!r} Z\n"
        f"*LOAD\nHEAD 1 0 {row['H'] * 1e3!r} 0 0 0 {moment!r} 0\n*QUASISTATIC\n4\n*EXEC\n"
    )


def head_and_moment(folder: Path, text: str) -> tuple[float, float]:
    """Head displacement (m) and largest |moment| (kN m) of the last step."""
    with solved(folder, text) as database:
        foundation = database.foundation("F1")
        head = foundation.read_tube(1, "displacement_x", -1)[0, 0]
        moment = foundation.read_tube(1, "moment_y", -1)[0]
    return float(head), float(np.abs(moment).max()) * 1e-3


@pytest.mark.parametrize("row", rows("23"), ids=lambda r: f"H {r['H']:g} M {r['M']:g}")
def test_hetenyi_of_table_23(tmp_path, row):
    curve = linear_curve(1, row["k"] * 1e3)
    text = lateral_deck(curve, row, f"1 0.05 210e9 7850 EI={row['EI'] * 1e3!r}")
    y, moment = head_and_moment(tmp_path, text)
    np.testing.assert_allclose(y, row["y0_closed"], rtol=1e-6)
    np.testing.assert_allclose(moment, row["Mmax_closed"], rtol=ASKED)


@pytest.mark.parametrize("shape", ["power", "2geo"])
@pytest.mark.parametrize(
    "row", rows("24"), ids=lambda r: f"{r['kind']} H {r['H']:g} fixed {r['fixed']:g}"
)
def test_soft_clay_of_table_24(tmp_path, row, shape):
    option = ", CYCLIC" if row["kind"] == "cyclic" else ""
    curve = (
        f"*PYCURVE, SHAPE={shape.upper()}{option}\n1 1 {row['su'] * 1e3!r} {row['gam'] * 1e3!r} "
        f"{row['J']!r} {row['eps50']!r}\n"
    )
    y, moment = head_and_moment(tmp_path, lateral_deck(curve, row, section(row)))
    np.testing.assert_allclose(y, row[f"y0_ref_{shape}"], rtol=ASKED)
    np.testing.assert_allclose(moment, row[f"Mmax_ref_{shape}"], rtol=ASKED)


@pytest.mark.parametrize("row", rows("25"), ids=lambda r: f"{r['kind']} H {r['H']:g}")
def test_sand_of_table_25(tmp_path, row):
    option = ", CYCLIC" if row["kind"] == "cyclic" else ""
    weight, k = row["gam"] * 1e3, row["k"] * 1e3
    curve = f"*PYCURVE{option}\n1 2 {weight!r} {row['phi']!r} {k!r}\n"
    y, moment = head_and_moment(tmp_path, lateral_deck(curve, row, section(row)))
    np.testing.assert_allclose(y, row["y0_ref"], rtol=ASKED)
    np.testing.assert_allclose(moment, row["Mmax_ref"], rtol=ASKED)


def section(row) -> str:
    return f"{row['D']!r} {row['t']!r} 210e9 7850 EI={row['EI'] * 1e3!r}"


def test_friction_past_its_peak_of_table_26(tmp_path):
    """The head is pushed down; the load on it falls from 5604 to 4851 kN and rises again."""
    t = table("26")
    first = rows("26")[0]
    curve = (
        f"*TZCURVE, SHAPE=2GEO, RESIDUAL={first['tres']!r}\n1 1 {first['su'] * 1e3!r} "
        f"{first['gam'] * 1e3!r}\n"
    )
    pushes = "".join(f"{i} PUSH {w!r}\n" for i, w in enumerate((-t["w_head"]).tolist(), start=1))
    text = (
        BASE.format(curves=curve, pairs="0 1 0 1")
        + f"0 {-first['L']!r} {first['D']!r} {first['wt']!r} 210e9 7850\n*FONDATION\n1 1\n"
        f"*DISPLACE\nPUSH 1 0 Z 1\n*QUASISTATIC\n{pushes}*EXEC\n"
    )
    with solved(tmp_path, text) as database:
        foundation = database.foundation("F1")
        tip = -foundation.read_tube(1, "displacement_z")[1:, -1]
        force = foundation.read_tube(1, "normal_force")[1:, 0]
    np.testing.assert_allclose(force, t["P_ref"] * 1e3, rtol=1e-3)
    np.testing.assert_allclose(tip, t["w_tip_ref"], rtol=ASKED)
