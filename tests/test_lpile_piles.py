"""Piles in Reese's sand against LPILE's printed results: PR02 and PR03 of the validation cases.

PR02: FHWA NHI-05-039 (2005), appendix E, a micropile under 1423 kN. PR03: FHWA GEC-12 (2016),
appendix D, HP 12x74 of a north abutment, cyclic, with p-multipliers, 16 loads. Asked: 3 and 2 % of
displacement and moment, 1 and 0.5 %.
"""

import csv
from pathlib import Path

import numpy as np
import pytest

from decks import solved

with (Path(__file__).parent / "data" / "valid" / "PR03_table.csv").open() as file:
    ROWS = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
MULTIPLIERS = sorted({row["p_multiplier"] for row in ROWS})
SECOND_ORDER = "*MODEL, PDELTA\n*ACCURACY\n1e-5\n*EXEC\n"


def head(folder: Path, text: str) -> tuple[np.ndarray, np.ndarray]:
    """Head displacement and largest |moment| of every step but step 0."""
    with solved(folder, text + SECOND_ORDER) as database:
        tube = database.foundation("F1")
        y = tube.read_tube(1, "displacement_x")[1:, 0]
        moment = np.abs(tube.read_tube(1, "moment_y")[1:]).max(axis=1)
    return y, moment


def micropile(held: str, moment: float) -> str:
    return (
        "*DEPTH\n0\n*GROUNDEPTH\n0 -3.353 -3.353 -12.5\n"
        "*PYCURVE\n1 9 18.83843e3 32 24430.244e3\n*PYCURVE\n2 9 17.64407e3 30 16286.830e3\n"
        "*GROUNDPROP\n1 0 1 0 2 0 2 0\n*CASING\n1 PILE\n"
        "-0.305 -12.495 0.19685 0.0151 199.94798e9 7850 EI=8109e3 EA=1.7247e9\n*FONDATION\n1 1\n"
        f"*SUPPORT\n{held}1 -12.495 Z\n*LOAD\nHEAD 1 -0.305 44482 0 -1423431 0 {moment!r} 0\n"
        "*QUASISTATIC\n1\n"
    )


MICROPILES = {
    "fixed head": ("1 -0.305 RY\n", 0.0, 3.3e-3, 37.3e3),
    "half the moment of a fixed head": ("", -18.65e3, 8.4e-3, 27.2e3),
}


@pytest.mark.parametrize(("held", "moment", "y", "largest"), MICROPILES.values(), ids=MICROPILES)
def test_the_micropile_of_pr02(tmp_path, held, moment, y, largest):
    found = head(tmp_path, micropile(held, moment))
    np.testing.assert_allclose(found[0], y, rtol=3e-2)
    np.testing.assert_allclose(found[1], largest, rtol=2e-2)


def loads(multiplier: float) -> list[dict[str, float]]:
    """Printed rows of the abutment's piles of one multiplier."""
    return [row for row in ROWS if row["p_multiplier"] == multiplier]


def abutment(multiplier: float) -> str:
    """The deck of the abutment's piles, a step for each load."""
    rows = loads(multiplier)
    steps = "".join(f"{i} H {r['V_N'] / 1e3!r} V 1\n" for i, r in enumerate(rows, start=1))
    stiffness = 29000.0 * 6.894757e6
    curves = "".join(
        f"*PYCURVE, CYCLIC, PMULT={multiplier!r}\n{i} 9 {weight!r} {angle!r} {k!r}\n"
        for i, weight, angle, k in (
            (1, 16.49e3, 33.0, 6786e3),
            (2, 6.69e3, 33.0, 5429e3),
            (3, 7.79e3, 36.0, 16287e3),
        )
    )
    return (
        "*DEPTH\n0\n*GROUNDEPTH\n0 -3.048 -3.048 -6.096 -6.096 -13.716\n"
        f"{curves}*GROUNDPROP\n1 0 1 0 2 0 2 0 3 0 3 0\n*CASING\n1 HP\n"
        f"0 -13.716 0.310 0.155 {stiffness!r} 7850 EI={stiffness * 569 * 0.0254**4!r} "
        f"EA={stiffness * 21.8 * 0.0254**2!r}\n*FONDATION\n1 1\n*SUPPORT\n1 0 RY\n1 -13.716 Z\n"
        f"*LOAD\nH 1 0 1000 0 0\nV 1 0 0 0 -1436.8e3\n*QUASISTATIC\n{steps}"
    )


@pytest.mark.parametrize("multiplier", MULTIPLIERS)
def test_the_abutment_of_pr03(tmp_path, multiplier):
    rows, found = loads(multiplier), head(tmp_path, abutment(multiplier))
    np.testing.assert_allclose(found[0], [r["y_m_printed"] for r in rows], rtol=1e-2)
    moments = [abs(r["M_head_Nm_printed"]) for r in rows]
    np.testing.assert_allclose(found[1], moments, rtol=5e-3)
