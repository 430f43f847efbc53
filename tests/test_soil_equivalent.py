"""Layering by equivalent depth, as a profile offers it."""

from math import radians

import numpy as np
import pytest

from podeep.errors import InvalidData, UserError
from podeep.scene import Curve, Ground
from podeep.soil.profile import Profile
from podeep.soil.soft_clay import SoftClay
from test_soil_tables import close, table

U = np.array([1e-3, 0.01, 0.2, -0.05])


def clay(id_: int, strength: float = 18e3, weight: float = 8e3, **options: object) -> Curve:
    given = {
        "undrained_shear_strength": strength,
        "effective_unit_weight": weight,
        "j": 0.5,
        "strain_50": 0.01,
    }
    return Curve(id_, "soft_clay", given, options)


def sand(id_: int) -> Curve:
    given = {
        "effective_unit_weight": 9.5e3,
        "friction_angle": radians(33.0),
        "subgrade_modulus": 18e6,
    }
    return Curve(id_, "sand", given, {})


def profile(depths, curves, **layering):
    ids = tuple(c.id if c else 0 for c in curves)
    known = {c.id: c for c in curves if c}
    return Profile(Ground(depths, ids, (0,) * len(ids), known, {}, **layering))


GEORGIADIS = {"layering": "GEORGIADIS"}
TWO = ((0.0, 4.0, 4.0, 30.0), [clay(1), clay(1), sand(2), sand(2)])


@pytest.mark.parametrize(("overburden", "column"), [("OWN", "pu_eq"), ("ACTUAL", "pu_eq_sig")])
def test_clay_over_sand_as_in_table_09(overburden, column):
    t = table("09")
    layered = profile(*TWO, **GEORGIADIS, layering_overburden=overburden)
    (term,) = layered.lateral(t["z"], t["D"]).laws
    close(term.law.depth, t["z_eq"])
    close(term.law.ultimate_resistance, t[column] * 1e3)
    close(term.law.stiffness_depth, t["z"])


def test_without_layering_the_depth_is_the_actual_one():
    t = table("09")
    (term,) = profile(*TWO).lateral(t["z"], t["D"]).laws
    close(term.law.ultimate_resistance, t["pu_naive"] * 1e3)


def test_the_initial_stiffness_of_sand_keeps_its_actual_depth():
    at, width = np.array([7.0]), np.ones(1)
    layered, plain = profile(*TWO, **GEORGIADIS), profile(*TWO)
    for one in (layered, plain):
        _, stiffness = one.lateral(at, width).evaluate(np.zeros(1))
        assert stiffness == pytest.approx(18e6 * 7.0)


def test_one_soil_in_two_layers_is_one_layer():
    at, width = np.array([0.5, 3.0, 6.0, 20.0]), np.array([1.0, 1.0, 2.0, 1.0])
    depths, curves = (0.0, 4.0, 4.0, 30.0), [clay(1), clay(2, 33e3), clay(2, 33e3), clay(3, 90e3)]
    straight = profile((0.0, 30.0), [clay(1), clay(3, 90e3)])
    for one in (profile((0.0, 30.0), [clay(1), clay(1)]), profile(depths, [clay(1)] * 4)):
        layered = Profile(
            Ground(
                one.ground.depths,
                one.ground.lateral,
                one.ground.axial,
                one.ground.lateral_curves,
                {},
                **GEORGIADIS,
            )
        )
        expected, found = (p.lateral(at, width).evaluate(U) for p in (one, layered))
        np.testing.assert_allclose(found, expected, rtol=1e-9)
    # strength that varies within the first layer is taken as it is there
    single = profile((0.0, 30.0), [clay(1), clay(3, 90e3)], **GEORGIADIS)
    expected, found = (p.lateral(at, width).evaluate(U) for p in (straight, single))
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    assert curves[1].parameters["undrained_shear_strength"] == 33e3
    assert depths[1] == 4.0


def test_each_diameter_has_its_own_equivalent_depth():
    layered = profile(*TWO, **GEORGIADIS)
    at = np.array([6.0, 6.0])
    both = layered.lateral(at, np.array([1.0, 2.0])).laws[0].law.depth
    alone = [layered.lateral(at[:1], np.array([d])).laws[0].law.depth[0] for d in (1.0, 2.0)]
    assert both.tolist() == alone
    assert alone[0] != pytest.approx(alone[1], rel=1e-3)


def test_a_group_factor_does_not_move_the_layers():
    half = Curve(1, "soft_clay", {**clay(1).parameters, "multiplier": 0.5}, {})
    depths, (_, _, lower, _) = TWO
    given = [Curve(1, "soft_clay", {**clay(1).parameters, "multiplier": 1.0}, {})] * 2
    full = profile(depths, [*given, lower, lower], **GEORGIADIS)
    less = profile(depths, [half, half, lower, lower], **GEORGIADIS)
    at, width = np.array([6.0]), np.ones(1)
    assert (
        full.lateral(at, width).laws[0].law.depth.tolist()
        == less.lateral(at, width).laws[0].law.depth.tolist()
    )


def test_user_curves_keep_their_depth_and_count_for_the_layers_below():
    rows = Curve(1, "user", {"effective_unit_weight": 8e3}, {}, ((88e3, 0.01),))
    depths, (_, _, lower, _) = TWO
    layered = profile(depths, [rows, rows, lower, lower], **GEORGIADIS)
    (term,) = layered.lateral(np.array([4.5]), np.ones(1)).laws
    # 88 kN/m over 4 m are the 352 kN of the clay in table 09
    assert term.law.depth[0] == pytest.approx(3.5217099, rel=1e-7)


def test_soil_without_reaction_on_top_leaves_the_layer_as_if_at_the_mudline():
    depths, (_, _, lower, _) = TWO
    layered = profile(depths, [None, None, lower, lower], **GEORGIADIS)
    (term,) = layered.lateral(np.array([5.0]), np.ones(1)).laws
    assert term.law.depth[0] == pytest.approx(1.0)
    assert term.law.effective_overburden[0] == pytest.approx(9.5e3)


def test_a_layer_between_two_laws_is_refused_with_the_remedy():
    with pytest.raises(UserError, match=r"from 0 to 4 m .* blended; give that depth twice"):
        profile((0.0, 4.0), [clay(1), sand(2)], **GEORGIADIS)


def test_loads_that_vary_between_depths_do_not_go_with_it():
    with pytest.raises(InvalidData, match="leave out LOADS or LAYERING"):
        profile((0.0,), [clay(1)], **GEORGIADIS, interpolation="LOADS")


def test_the_law_is_the_clay_itself_at_the_equivalent_depth():
    depths, curves = (0.0, 4.0, 4.0, 30.0), [sand(2), sand(2), clay(1), clay(1)]
    (term,) = profile(depths, curves, **GEORGIADIS).lateral(np.array([6.0]), np.ones(1)).laws
    law = term.law
    expected = SoftClay(law.depth, 1.0, 8e3 * law.depth, **clay(1).parameters)
    assert law.ultimate_resistance == pytest.approx(expected.ultimate_resistance)
    assert law.depth[0] > 6.0  # dense sand resists more than as much clay


def test_depths_that_do_not_add_up_in_binary_are_layers_all_the_same():
    depths = (0.0, 0.4, 0.4, 1.7, 1.7, 30.0)  # 0.4 + (1.7 - 0.4) is not 1.7
    layered = profile(depths, [clay(1)] * 6, **GEORGIADIS)
    (term,) = layered.lateral(np.array([1.0, 5.0]), np.ones(2)).laws
    assert term.law.depth == pytest.approx([1.0, 5.0], rel=1e-9)
