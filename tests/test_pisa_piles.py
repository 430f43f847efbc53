"""Example monopiles D1 and D2 of Byrne et al., Geotechnique 70 (2020), in Cowden till: PR13.

PR13_own.csv holds ground displacements of a converged solution of the same springs, with
half the area in shear (Cowper: 0.53 of it), G0 and su as read off the paper. Asked: 2 % in load.
"""

import csv
from pathlib import Path

import numpy as np
import pytest

from decks import solved

with (Path(__file__).parent / "data" / "valid" / "PR13_own.csv").open() as file:
    ROWS = list(csv.DictReader(file))
PILES = {"D1": (7.5, 22.5, 0.068, 37.5), "D2": (8.75, 35.0, 0.091, 87.5)}


def given(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Loads (N) and displacements of the ground (m) of a pile."""
    rows = [row for row in ROWS if row["pile"] == name]
    loads, y = (np.array([float(r[n]) for r in rows]) for n in ("H_N", "y_ground_m"))
    return loads, y


def monopile(name: str) -> str:
    """The deck of a pile, a step for each load."""
    diameter, length, wall, arm = PILES[name]
    loads = (given(name)[0] / 1e6).tolist()
    steps = "".join(f"{i} HEAD {h!r}\n" for i, h in enumerate(loads, start=1))
    return (
        "*DEPTH\n0\n*GROUNDEPTH\n0 -11 -35\n*PYCURVE\n1 7 80e3 20e6\n*PYCURVE\n2 7 140e3 200e6\n"
        "*PYCURVE\n3 7 200e3 400e6\n*GROUNDPROP\n1 0 2 0 3 0\n*CASING\n1 PILE\n"
        f"0 {-length!r} {diameter!r} {wall!r} 210e9 7850\n*FONDATION\n1 1\n"
        f"*SUPPORT\n1 {-length!r} Z\n*LOAD\nHEAD 1 0 1e6 0 0 0 {arm * 1e6!r}\n"
        f"*QUASISTATIC\n{steps}*MODEL, SHEAR=ON\n*EXEC\n"
    )


@pytest.mark.parametrize("name", PILES)
def test_ground_displacement_of_pr13(tmp_path, name):
    loads, exact = given(name)
    with solved(tmp_path, monopile(name)) as database:
        found = database.foundation("F1").read("lateral_displacement")[1:, 0]
    load_at = np.interp(exact, found, loads)  # of the displacement, as the paper compares
    np.testing.assert_allclose(load_at, loads, rtol=2e-2)
    np.testing.assert_allclose(found, exact, rtol=1e-2)
