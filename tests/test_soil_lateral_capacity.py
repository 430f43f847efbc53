"""The rigid mechanism of a pile against CF09 of the validation cases (statics, exact)."""

import csv
from pathlib import Path

import numpy as np
import pytest

from podeep.scene import Curve, Ground
from podeep.soil.lateral_capacity import rigid_mechanism
from podeep.soil.profile import Profile

DATA = Path(__file__).parent / "data" / "valid" / "CF09_ultimate.csv"
with DATA.open() as file:
    ROWS = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
LENGTH = 5.0


def plastic(id_: int, resistance: float) -> Curve:
    return Curve(id_, "user", {}, {}, ((resistance, 1e-3),))


def ground(*layers: tuple[float, float]) -> Profile:
    """Ultimate resistance (N/m of a pile of 1 m) at depths, linear between."""
    curves = {i: plastic(i, p) for i, (_, p) in enumerate(layers, start=1) if p}
    ids = tuple(i if i in curves else 0 for i, _ in enumerate(layers, start=1))
    return Profile(Ground(tuple(z for z, _ in layers), ids, (0,) * len(ids), curves, {}))


def one(z):
    return np.ones(len(z))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"e {row['e_m']:g}")
@pytest.mark.parametrize(
    ("profile", "kind", "cuts"),
    [
        (ground((0.0, 200e3)), "uniform_pu", ()),
        (ground((0.0, 0.0), (LENGTH, 80e3 * LENGTH)), "linear_pu", ()),
    ],
    ids=["uniform", "linear"],
)
def test_free_head_as_in_cf09(row, profile, kind, cuts):
    name = kind.removesuffix("_pu")
    found = rigid_mechanism(profile, one, LENGTH, (1.0, row["e_m"]), cuts)
    assert found.lateral_load == pytest.approx(row[f"Hu_{kind}_N"], rel=1e-9)
    assert found.pivot == pytest.approx(row[f"pivot_{name}_m"], rel=1e-9)
    assert found.moment == pytest.approx(found.lateral_load * row["e_m"], rel=1e-9, abs=1e-3)


def test_clay_of_broms_starts_below_one_and_a_half_diameters():
    """9 su d from 1.5 d on (su 50 kPa, d 0.5 m): a jump inside the pile."""
    profile = ground((0.0, 0.0), (0.75, 0.0), (0.75, 225e3), (LENGTH, 225e3))
    for row in ROWS:
        found = rigid_mechanism(profile, one, LENGTH, (1.0, row["e_m"]))
        assert found.lateral_load == pytest.approx(row["Hu_broms_clay_N"], rel=1e-9)


def test_a_pure_moment_has_no_lateral_load():
    found = rigid_mechanism(ground((0.0, 200e3)), one, LENGTH, (0.0, 1.0))
    assert found.pivot == pytest.approx(LENGTH / 2.0)
    assert found.lateral_load == pytest.approx(0.0, abs=1e-6)
    assert found.moment == pytest.approx(200e3 * LENGTH**2 / 4.0)


def test_a_pile_that_cannot_turn_shifts():
    found = rigid_mechanism(ground((0.0, 200e3)), one, LENGTH, (1.0, 0.0))
    assert found.translation == pytest.approx(200e3 * LENGTH)
    held = rigid_mechanism(ground((0.0, 200e3)), one, LENGTH, (1.0, -0.5 * LENGTH))
    assert held.lateral_load == pytest.approx(found.translation)


def test_a_load_below_the_middle_turns_the_pile_the_other_way():
    """Mirrored about the middle: as a load at the mudline."""
    upright = rigid_mechanism(ground((0.0, 200e3)), one, LENGTH, (1.0, 0.0))
    low = rigid_mechanism(ground((0.0, 200e3)), one, LENGTH, (1.0, -LENGTH))
    assert low.lateral_load == pytest.approx(upright.lateral_load)
    assert low.pivot == pytest.approx(LENGTH - upright.pivot)
    assert low.moment == pytest.approx(-LENGTH * low.lateral_load)


def test_diameters_count():
    def stepped(z):
        return np.where(z < 2.0, 2.0, 1.0)

    found = rigid_mechanism(ground((0.0, 200e3)), stepped, LENGTH, (1.0, 0.0), (2.0,))
    assert found.translation == pytest.approx(200e3 * (LENGTH + 2.0))
