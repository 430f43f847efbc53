"""Weak rock: check table 08, and what it does not reach."""

import numpy as np

from podeep.soil.weak_rock import WeakRock
from test_soil_tables import KILO, close, table


def rock(**changed):
    """pur = 2.16 MN/m, Kir = 120 GPa, yrm = 0.6 mm at the rock's surface unless changed."""
    given = {
        "depth_in_rock": 0.0,
        "diameter": 1.2,
        "compressive_strength": 3e6,
        "rock_mass_modulus": 1.2e9,
        "rock_quality_designation": 0.6,
        "strain_rm": 5e-4,
    }
    return WeakRock(**given | changed)


def test_weak_rock():
    t = table("08")
    law = WeakRock(
        depth_in_rock=t["xr"],
        diameter=t["D"],
        compressive_strength=t["qu"] * KILO,
        rock_mass_modulus=t["Eir"] * KILO,
        rock_quality_designation=t["RQD"] / 100.0,
        strain_rm=t["krm"],
    )
    close(law.ultimate_resistance, t["pur"] * KILO)
    close(law.initial_stiffness, t["Kir"] * KILO)
    close(law.derived["y_A"], t["yA"])
    close(law.force(t["y"]), t["p_ref"] * KILO)


def test_resistance_and_stiffness_grow_with_depth_up_to_three_diameters():
    xr = np.array([0.0, 1.2, 3.6, 3.7, 60.0])
    law = rock(depth_in_rock=xr)
    reduced = 0.6 * 3e6 * 1.2
    close(law.ultimate_resistance, reduced * np.array([1.0, 2.4, 5.2, 5.2, 5.2]))
    close(law.initial_stiffness, 1.2e9 * np.array([100.0, 700.0 / 3.0, 500.0, 500.0, 500.0]))


def test_fractures_take_up_to_two_thirds():
    quality = np.array([0.0, 0.5, 1.0])
    law = rock(rock_quality_designation=quality)
    close(law.ultimate_resistance, 3e6 * 1.2 * np.array([1.0, 2.0 / 3.0, 1.0 / 3.0]))


def test_derivatives_at_the_kinks_are_those_away_from_zero():
    law = rock()
    kinks = np.array([law.derived["y_A"][0], 16.0 * 6e-4])
    before, after = (law.stiffness(kinks * (1.0 + side)) for side in (-1e-9, 1e-9))
    close(before, [1.2e11, 0.25 * 2.16e6 / (16.0 * 6e-4)])
    close(after, [0.25 * 1.2e11, 0.0])
    assert law.stiffness(np.array([16.0 * 6e-4]))[0] == 0.0
    assert law.stiffness(np.array([0.0]))[0] == 1.2e11
    close(law.force(kinks), [1.2e11 * kinks[0], 2.16e6])


def test_soft_rock_follows_its_line_up_to_its_resistance():
    """yA as printed lies past 16 yrm, where its line would be at 2.5 times pur."""
    law = rock(rock_mass_modulus=1e5)
    pur, Kir = law.ultimate_resistance[0], law.initial_stiffness[0]
    printed = (pur / (2.0 * 6e-4**0.25 * Kir)) ** (4.0 / 3.0)
    assert printed > 16.0 * 6e-4
    assert Kir * printed > 2.4 * pur
    close(law.derived["y_A"], pur / Kir)
    y = np.linspace(0.0, 2.0, 2001) * pur / Kir
    close(law.force(y), np.minimum(Kir * y, pur))
    assert (np.diff(law.force(y)) >= 0.0).all()


def test_no_strength_or_no_modulus_is_no_reaction():
    law = rock(
        compressive_strength=np.array([0.0, 3e6, 0.0]),
        rock_mass_modulus=np.array([1e9, 0.0, 0.0]),
    )
    for y in (0.0, 1e-6, 1e3):
        force, stiffness = law.evaluate(np.full(3, y))
        assert (force == 0.0).all()
        assert (stiffness == 0.0).all()
    assert (law.capacity == 0.0).all()
    assert law.derived["y_A"].tolist() == [0.0, np.inf, np.inf]


def test_the_multiplier_acts_on_the_reaction_alone():
    y = np.array([1e-6, 1e-3, 1.0])
    np.testing.assert_allclose(
        rock(multiplier=0.5).evaluate(y), 0.5 * np.array(rock().evaluate(y)), rtol=1e-14
    )
