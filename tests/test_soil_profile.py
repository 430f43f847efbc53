"""Which law acts where: layers, interpolation, overburden."""

import numpy as np
import pytest

from podeep.scene import Curve, Ground
from podeep.soil.axial import alpha_friction
from podeep.soil.profile import Profile
from podeep.soil.sand import Sand
from podeep.soil.soft_clay import SoftClay
from scenes import linear_ground

U = np.array([1e-4, -2e-3, 0.03, 0.2, -1.0])
CLAY = {"undrained_shear_strength": 20e3, "effective_unit_weight": 8e3, "j": 0.5, "strain_50": 0.01}
SAND = {"friction_angle": 0.6, "effective_unit_weight": 10e3, "subgrade_modulus": 2e7}


def clay(id, options=None, **given):
    return Curve(id, "soft_clay", {**CLAY, **given}, options or {})


def sand(id, **given):
    return Curve(id, "sand", {**SAND, **given})


def user(id, *rows, diameters=False, **given):
    return Curve(id, "user", given, {}, rows, diameters)


def profile(depths, lateral=(), axial=(), loads=False):
    """A profile from curves by depth; None is no curve."""
    lateral, axial = (tuple(c) or (None,) * len(depths) for c in (lateral, axial))
    return Profile(
        Ground(
            tuple(map(float, depths)),
            tuple(c.id if c else 0 for c in lateral),
            tuple(c.id if c else 0 for c in axial),
            {c.id: c for c in lateral if c},
            {c.id: c for c in axial if c},
            interpolation="LOADS" if loads else "PARAMETERS",
        )
    )


def same(reaction, *parts):
    """A reaction is the sum of weight times law, forces and stiffnesses."""
    expected = [
        sum(np.asarray(weight) * law.evaluate(U)[i] for weight, law in parts) for i in (0, 1)
    ]
    np.testing.assert_allclose(reaction.evaluate(U), expected, rtol=1e-12)


def soft(depth, overburden, **given):
    return SoftClay(depth=depth, diameter=1.5, effective_overburden=overburden, **{**CLAY, **given})


def api_sand(depth, overburden):
    return Sand(depth, 1.5, overburden, SAND["friction_angle"], SAND["subgrade_modulus"])


D = np.full(5, 1.5)
Z = np.array([1.0, 9.0, 4.0, 0.0, 10.0])  # in no order


class TestLayers:
    ground = profile((0, 5, 5, 12), (clay(1), clay(1), sand(2), sand(2)))

    def test_boundaries_and_layers(self):
        assert self.ground.boundaries == (5.0, 12.0)
        depth = np.array([0.0, 4.9, 5.0, 5.1, 12.0, 12.1, 99.0])
        assert self.ground.layer(depth).tolist() == [0, 0, 0, 1, 1, 2, 2]

    def test_a_jump_belongs_to_the_layer_above_it(self):
        reaction = self.ground.lateral(np.array([5.0, np.nextafter(5.0, 6.0)]), D[:2])
        assert [t.name for t in reaction.laws] == ["soft_clay", "sand"]
        assert [t.at.tolist() for t in reaction.laws] == [[0], [1]]

    @pytest.mark.parametrize("loads", [False, True])
    def test_the_last_curve_goes_on(self, loads):
        ground = profile((0, 5, 5, 12), (clay(1), clay(1), sand(2), sand(2)), loads=loads)
        overburden = 5 * 8e3 + 15 * 10e3
        same(ground.lateral(np.full(5, 20.0), D), (1.0, api_sand(20.0, overburden)))

    def test_order_of_points_does_not_matter(self):
        z, u = np.linspace(0.0, 15.0, 7), np.linspace(-0.1, 0.2, 7)
        order = np.array([3, 6, 0, 5, 1, 4, 2])
        diameter = np.linspace(1.0, 2.0, 7)
        straight = self.ground.lateral(z, diameter)
        mixed = self.ground.lateral(z[order], diameter[order])
        for ours, theirs in zip(mixed.evaluate(u[order]), straight.evaluate(u), strict=True):
            np.testing.assert_array_equal(ours, theirs[order])
        np.testing.assert_array_equal(mixed.capacity, straight.capacity[order])

    def test_separate_layers_of_one_type_are_one_law(self):
        ground = profile(
            (0, 5, 5, 8, 8, 12), (clay(1), clay(1), sand(2), sand(2), clay(3), clay(3))
        )
        reaction = ground.lateral(np.linspace(0.1, 14.0, 40), np.ones(40))
        assert [t.name for t in reaction.laws] == ["soft_clay", "sand"]
        assert [t.curves for t in reaction.laws] == [(1, 3), (2,)]

    def test_stacked_displacements_are_their_rows(self):
        ground = profile((0, 10), (clay(1), sand(2)))
        reaction = ground.lateral(Z, D)
        stacked = np.stack([U, 2 * U, -U])
        for i, row in enumerate(stacked):
            for full, alone in zip(reaction.evaluate(stacked), reaction.evaluate(row), strict=True):
                np.testing.assert_array_equal(full[i], alone)

    def test_no_points_and_no_curves(self):
        assert self.ground.lateral(np.zeros(0), np.zeros(0)).evaluate(np.zeros(0))[0].size == 0
        nothing = self.ground.shaft(Z, D)
        assert nothing.laws == ()
        assert (np.array(nothing.evaluate(U)) == 0.0).all()
        assert (nothing.capacity == 0.0).all()

    def test_above_the_mudline_there_is_no_soil(self):
        with pytest.raises(ValueError, match="above the mudline"):
            self.ground.lateral(np.array([-0.1]), D[:1])


class TestInterpolation:
    def test_parameters_vary_linearly_and_the_law_stands_at_the_true_depth(self):
        below = clay(2, undrained_shear_strength=60e3, effective_unit_weight=10e3, strain_50=0.02)
        reaction = profile((0, 10), (clay(1), below)).lateral(Z, D)
        share = Z / 10
        law = soft(
            Z,
            8e3 * Z + 0.5 * 2e3 / 10 * Z**2,
            undrained_shear_strength=20e3 + 40e3 * share,
            effective_unit_weight=8e3 + 2e3 * share,
            strain_50=0.01 + 0.01 * share,
        )
        same(reaction, (1.0, law))
        assert reaction.laws[0].curves == (1, 2)
        np.testing.assert_allclose(
            reaction.laws[0].parameters["undrained_shear_strength"], 20e3 + 40e3 * share
        )

    def test_loads_vary_linearly_on_request(self):
        below = clay(2, undrained_shear_strength=60e3)
        reaction = profile((0, 10), (clay(1), below), loads=True).lateral(Z, D)
        lower = soft(10.0, 80e3, undrained_shear_strength=60e3)
        same(reaction, (1 - Z / 10, soft(0.0, 0.0)), (Z / 10, lower))
        capacity = (1 - Z / 10) * soft(0.0, 0.0).capacity + Z / 10 * lower.capacity
        np.testing.assert_allclose(reaction.capacity, capacity)

    @pytest.mark.parametrize(
        "below",
        [clay(2, {"cyclic": True}), clay(2, multiplier=0.5)],
        ids=["option", "optional parameter"],
    )
    def test_loads_vary_linearly_between_unlike_curves(self, below):
        reaction = profile((0, 10), (clay(1), below)).lateral(Z, D)
        multiplier = below.parameters.get("multiplier", 1.0)
        lower = soft(10.0, 80e3, multiplier=multiplier, **below.options)
        same(reaction, (1 - Z / 10, soft(0.0, 0.0)), (Z / 10, lower))

    def test_loads_vary_linearly_between_two_laws(self):
        reaction = profile((0, 2, 10), (clay(1), clay(1), sand(2))).lateral(Z + 2.0, D)
        w = np.clip(Z / 8, 0.0, 1.0)
        overburden = 2 * 8e3 + 8 * 9e3
        deep = api_sand(np.maximum(Z + 2.0, 10.0), overburden + 10e3 * np.maximum(Z - 8.0, 0.0))
        same(reaction, (1 - w, soft(2.0, 16e3)), (w, deep))

    def test_a_curve_fades_to_no_curve(self):
        weight = user(9, (0.0, 1.0), effective_unit_weight=10e3)
        reaction = profile((0, 10, 20), (None, sand(2), None), (weight,) * 3).lateral(Z + 6.0, D)
        share = 1.0 - np.abs(Z - 4.0) / 10
        assert [t.curves for t in reaction.laws] == [(2,), (2,)]
        same(reaction, (share, api_sand(10.0, 100e3)))

    def test_user_curves_blend_and_one_curve_does_not(self):
        one, two = user(1, (1e4, 0.01)), user(2, (2e4, 0.01), (5e4, 0.5), diameters=True)
        u = np.full(5, 0.3)
        blend = profile((0, 10), (one, two)).lateral(Z, D).evaluate(u)[0]
        second = 1.5 * (2e4 + 3e4 * (0.2 - 0.01) / 0.49)
        np.testing.assert_allclose(blend, (1 - Z / 10) * 1.5e4 + Z / 10 * second)
        single = profile((0, 10), (one, one), loads=True).lateral(Z, D)
        assert [t.weight for t in single.laws] == [None]
        np.testing.assert_allclose(single.evaluate(u)[0], 1.5e4)


def test_adhesion_is_the_mean_over_the_clay_of_twenty_diameters():
    """ISO's clay of 20 kPa over 5 m, then 60 kPa: alpha of API by a fine sum."""
    given = {"effective_unit_weight": 8e3, "overconsolidation_ratio": 2.0}
    soft, firm = (
        Curve(i, "iso_clay", {"undrained_shear_strength": su, **given}, {})
        for i, su in ((1, 20e3), (2, 60e3))
    )
    (term,) = profile((0, 5, 5, 60), (soft, soft, firm, firm)).lateral(Z[:1], D[:1]).laws
    z = 30.0 * (np.arange(300_000) + 0.5) / 300_000
    su = np.where(z < 5.0, 20e3, 60e3)
    alpha = alpha_friction(su, 8e3 * z) / su
    assert term.law.adhesion[0] == pytest.approx(alpha.mean(), rel=1e-5)


class TestMotion:
    """User rows `Ps Ys Pd Yd`: which pair reacts at rest and in motion; radiation dashpots."""

    APART = user(1, (1e4, 0.01, 3e4, 0.02))
    ALIKE = user(2, (5e4, 0.01))
    SHAFT = user(1, (2e4, 0.01, 7e6, 0.1))

    def forces(self, dynamic, rule):
        """p at 1 m of D = 1.5 m, under u = 1 m, in a layer of each curve; friction; bearing."""
        curves = {c.id: c for c in (self.APART, self.ALIKE)}
        ids = (1, 1, 2, 2)
        ground = Ground(
            (0.0, 5.0, 5.0, 9.0),
            ids,
            (1,) * 4,
            curves,
            {1: self.SHAFT},
            dynamic_rule=rule,
        )
        soil = Profile(ground, dynamic=dynamic)
        one, z = np.ones(2), np.array([1.0, 7.0])
        shaft, tip = soil.shaft(z, D[:2]), soil.tip(9.0, 1.5)
        return (
            *(soil.lateral(z, D[:2]).evaluate(one)[0] / 1.5),
            shaft.evaluate(one)[0][0] / (np.pi * 1.5),
            tip.evaluate(one[:1])[0][0] / (0.25 * np.pi * 1.5**2),
        )

    @pytest.mark.parametrize(
        ("dynamic", "rule", "apart"),
        [
            *((False, rule, 1e4) for rule in (0, 1, 2)),
            *((True, rule, 3e4) for rule in (0, 1)),
            (True, 2, 1e4),
            (False, 3, 3e4),
            (True, 3, 3e4),
        ],
    )
    def test_which_rows_react(self, dynamic, rule, apart):
        assert self.forces(dynamic, rule) == pytest.approx((apart, 5e4, 2e4, 7e6))

    def test_layers_above_count_by_the_rows_that_react(self):
        """Clay under a user curve: its equivalent depth is that of the rows in force."""

        def resistance(row, dynamic):
            rows = user(1, row, effective_unit_weight=8e3)
            ids, curves = (1, 1, 2, 2), {1: rows, 2: clay(2)}
            ground = Ground((0.0, 3.0, 3.0, 9.0), ids, (0,) * 4, curves, {}, layering="GEORGIADIS")
            soil = Profile(ground, dynamic=dynamic)
            return soil.lateral(np.array([4.0]), D[:1]).evaluate(np.array([1.0]))[0][0]

        apart = (20e3, 0.01, 40e3, 0.01)
        assert resistance(apart, False) == resistance((20e3, 0.01), False)
        assert resistance(apart, True) == resistance((40e3, 0.01), False)
        assert resistance(apart, True) > 1.1 * resistance(apart, False)

    def test_dashpots_vary_linearly_between_depths(self):
        curves = {i: user(i, (1e4, 0.01)) for i in (1, 2, 3)}
        ids = (1, 2, 3, 0, 2)
        ground = Ground(
            (0.0, 4.0, 4.0, 6.0, 8.0), ids, (0,) * 5, curves, {}, dashpots={1: 100.0, 2: 300.0}
        )
        depth = np.array([0.0, 1.0, 4.0, 5.0, 6.0, 7.0, 8.0, 50.0])
        found = Profile(ground).dashpot(depth, np.full(8, 2.0))
        np.testing.assert_allclose(found, 2.0 * np.array([100, 150, 300, 0, 0, 150, 300, 300]))
        assert (Profile(linear_ground(1e6, 1.0)).dashpot(depth, np.full(8, 2.0)) == 0.0).all()

    def test_no_dashpot_stands_above_the_mudline(self):
        with pytest.raises(ValueError, match="above the mudline"):
            Profile(linear_ground(1e6, 1.0)).dashpot(np.array([-1.0]), D[:1])
