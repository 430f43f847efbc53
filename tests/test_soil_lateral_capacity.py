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


def monopile(load, clay_above=False):
    """A pile of 7.5 m by 30 m in PISA's soil: with moments along it, base shear and base moment."""
    stiff = {"initial_shear_modulus": 60e6}
    clay = Curve(1, "pisa_clay", {"undrained_shear_strength": 60e3, **stiff}, {})
    given = {"effective_unit_weight": 10e3, "relative_density": 0.75, **stiff}
    sand = Curve(2, "pisa_sand", given, {})
    weight = Curve(3, "user", {"effective_unit_weight": 9e3}, {}, ((1.0, 0.0, 0.0, 0.0),))
    depths, ids = ((0.0, 8.0, 8.0, 30.0), (1, 1, 2, 2)) if clay_above else ((0.0,), (2,))
    axial = tuple(3 for _ in ids)
    ground = Ground(depths, ids, axial, {1: clay, 2: sand}, {3: weight})
    return rigid_mechanism(Profile(ground, 30.0), lambda z: np.full(len(z), 7.5), 30.0, load)


def test_loads_of_every_ratio_have_a_mechanism_and_it_is_continuous():
    """From a moment to a force below the tip: H rises to the shift and past it turns the pile."""
    arms = np.linspace(60.0, -60.0, 121)
    found = [monopile((1.0, arm)) for arm in arms]
    forces = np.array([m.lateral_load for m in found])
    for arm, one in zip(arms, found, strict=True):
        assert one.moment == pytest.approx(arm * one.lateral_load, rel=1e-9, abs=1.0)
        assert 0.0 < one.lateral_load <= one.translation * (1.0 + 1e-12)
    top = int(forces.argmax())
    assert found[top].pivot is None
    assert found[top].lateral_load == pytest.approx(found[top].translation)
    assert (np.diff(forces[: top + 1]) >= -1e-6).all()
    assert (np.diff(forces[top:]) <= 1e-6).all()
    last = max(i for i in range(top) if found[i].pivot)  # before it shifts
    between = [monopile((1.0, arm)) for arm in np.linspace(arms[last], arms[last + 1], 41)]
    assert any(m.pivot == 30.0 for m in between)  # about the tip, with a part of its shear


def test_moments_of_clay_above_sand_do_not_follow_the_sands_rule():
    mixed, sand = monopile((1.0, 30.0), clay_above=True), monopile((1.0, 30.0))
    assert mixed.pivot is not None
    assert 0.3 * sand.lateral_load < mixed.lateral_load < 2.0 * sand.lateral_load
