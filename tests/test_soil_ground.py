"""Overburden of a ground, friction and bearing along and below a tube, and refusals."""

import numpy as np
import pytest

from podeep.errors import UserError
from podeep.scene import Curve, Ground
from podeep.soil.axial import CohesionlessTip, CohesiveShaft
from podeep.soil.profile import Profile

Z = np.array([0.0, 2.0, 5.0, 7.0, 9.0, 14.0])
ROWS = ((20e3, 0.002, 1e6, 0.01), (30e3, 0.01, 3e6, 0.1))


def weighing(id, weight):
    """A user curve that gives a unit weight, or none."""
    return Curve(id, "user", {} if weight is None else {"effective_unit_weight": weight}, {}, ROWS)


def cohesive(id, options=None, **given):
    parameters = {"undrained_shear_strength": 40e3, "effective_unit_weight": 8e3, **given}
    return Curve(id, "cohesive", parameters, options or {})


def cohesionless(id, **given):
    parameters = {
        "effective_unit_weight": 10e3,
        "earth_pressure_coefficient": 0.8,
        "interface_friction_angle": 0.5,
        "bearing_factor": 20.0,
    }
    return Curve(id, "cohesionless", {**parameters, **given})


def direct(id, **given):
    return Curve(id, "direct", {"unit_friction": 50e3, "effective_unit_weight": 8e3, **given})


def profile(depths, lateral=None, axial=None, loads=False):
    lateral, axial = (c or [None] * len(depths) for c in (lateral, axial))
    return Profile(
        Ground(
            tuple(map(float, depths)),
            tuple(c.id if c else 0 for c in lateral),
            tuple(c.id if c else 0 for c in axial),
            {c.id: c for c in lateral if c},
            {c.id: c for c in axial if c},
            friction_stiffness=2e7,
            interpolation="LOADS" if loads else "PARAMETERS",
        )
    )


class TestOverburden:
    depths = (0, 5, 5, 9)

    @pytest.mark.parametrize("loads", [False, True])
    def test_it_is_the_integral_of_linear_weights(self, loads):
        lateral = [weighing(i, w) for i, w in enumerate((6e3, 8e3, 10e3, 4e3), 1)]
        overburden = profile(self.depths, lateral, loads=loads).effective_overburden(Z)
        at5, at9 = 35e3, 35e3 + 28e3
        expected = [0.0, 12e3 + 0.2e3 * 4, at5, at5 + 20e3 - 0.75e3 * 4, at9, at9 + 5 * 4e3]
        np.testing.assert_allclose(overburden, expected, rtol=1e-14)

    def test_each_family_goes_by_its_own_weights_and_falls_back_on_the_other(self):
        lateral = [weighing(1, 6e3), weighing(2, None), None, weighing(4, 6e3)]
        axial = [weighing(1, 7e3), weighing(2, 8e3), weighing(3, 10e3), None]
        ground = profile(self.depths, lateral, axial)
        depth = np.array([5.0, 9.0, 10.0])
        py, tz = (ground.effective_overburden(depth, family) for family in ("p-y", "t-z"))
        np.testing.assert_allclose(py, [35e3, 35e3 + 32e3, 35e3 + 38e3])
        np.testing.assert_allclose(tz, [37.5e3, 37.5e3 + 32e3, 37.5e3 + 38e3])

    def test_weightless_ground_has_none(self):
        ground = profile((0,), [weighing(1, 0.0)])
        assert (ground.effective_overburden(Z) == 0.0).all()

    def test_an_unknown_weight_is_told_where_it_is_needed(self):
        ground = profile(self.depths, [weighing(i, None) for i in (1, 2, 3, 4)])
        assert ground.effective_overburden(np.zeros(1)) == 0.0
        with pytest.raises(UserError, match=r"at 0 m neither p-y curve 1 .*; give GAMMA="):
            ground.effective_overburden(Z)
        ground.lateral(Z, np.ones(6))  # user rows need no overburden

    def test_the_first_curve_without_a_weight_is_named(self):
        axial = [weighing(1, 8e3), weighing(2, None), cohesive(3), cohesive(3)]
        ground = profile(self.depths, None, axial)
        ground.shaft(np.array([1.0, 5.0]), np.ones(2))
        with pytest.raises(UserError, match=r"7 m below .* a t-z law needs.* at 5 m .*t-z curve 2"):
            ground.shaft(np.array([7.0]), np.ones(1))


class TestAxial:
    u = np.array([1e-4, -1e-3, 5e-3, 0.02, 0.3, -2.0])
    D = np.linspace(0.5, 1.0, 6)

    def test_friction_takes_the_ground_s_slope_unless_the_curve_has_its_own(self):
        for given, slope in (({}, 2e7), ({"initial_stiffness": 3e7}, 3e7)):
            ground = profile((0, 9), None, [direct(1, **given), direct(2, **given)])
            for reaction, area in (
                (ground.shaft(Z, self.D), np.pi * self.D),
                (
                    profile((0,), None, [direct(1, **given, tip_pressure=1e6)]).tip(3.0, 0.5),
                    np.pi / 16,
                ),
            ):
                stiffness = reaction.evaluate(np.zeros(reaction.size))[1]
                np.testing.assert_allclose(stiffness, area * slope)

    def test_clay_friction_follows_strength_and_overburden(self):
        curves = [
            cohesive(1, {"shape": "API", "residual": 0.8}),
            cohesive(2, {"shape": "API", "residual": 0.8}, undrained_shear_strength=76e3),
        ]
        reaction = profile((0, 9), None, curves).shaft(Z, self.D)
        law = CohesiveShaft(
            diameter=self.D,
            initial_stiffness=1.0,
            shape="API",
            residual=0.8,
            effective_overburden=8e3 * Z,
            undrained_shear_strength=40e3 + 4e3 * np.minimum(Z, 9.0),
        )
        np.testing.assert_allclose(reaction.evaluate(self.u), law.evaluate(self.u), rtol=1e-12)
        assert reaction.odd

    def test_a_tip_on_a_boundary_rests_in_the_layer_above(self):
        ground = profile((0, 5, 5), None, [cohesive(1), cohesive(2), cohesionless(3)])
        assert ground.tip(5.0, 2.0).capacity == pytest.approx(np.pi * 9 * 40e3)
        below = ground.tip(6.0, 2.0)
        assert below.capacity == pytest.approx(np.pi * 20.0 * (40e3 + 10e3))
        assert not below.odd
        (term,) = below.laws
        assert isinstance(term.law, CohesionlessTip)
        assert (term.name, term.curves) == ("cohesionless", (3,))
        assert term.parameters["effective_overburden"] == pytest.approx(50e3)

    def test_limits_hold(self):
        ground = profile((0,), None, [cohesionless(1, friction_limit=1e3, end_bearing_limit=2e4)])
        np.testing.assert_allclose(
            ground.shaft(Z[1:], self.D[1:]).capacity, np.pi * self.D[1:] * 1e3
        )
        assert ground.tip(9.0, 2.0).capacity == pytest.approx(np.pi * 2e4)

    def test_rows_are_the_curve_of_shaft_and_tip(self):
        curve = Curve(1, "direct", {"unit_friction": 9e9, "tip_pressure": 9e9}, {}, ROWS)
        ground = profile((0,), None, [curve])
        force = ground.shaft(Z, self.D).evaluate(np.full(6, -0.006))[0]
        np.testing.assert_allclose(force, -np.pi * self.D * 25e3)
        tip = ground.tip(9.0, 2.0)
        assert tip.evaluate(np.array([0.055]))[0] == pytest.approx(np.pi * 2e6)
        assert (np.array(tip.evaluate(np.array([-0.1]))) == 0.0).all()

    def test_a_tip_without_pressure_has_no_reaction(self):
        silent = Curve(1, "direct", {}, {}, ((20e3, 0.002, 0.0, 0.0), (30e3, 0.01, 0.0, 0.0)))
        assert profile((0,), None, [silent]).tip(3.0, 1.0).laws == ()
        tip = profile((0,), None, [direct(1)]).tip(3.0, 1.0)
        assert (np.array(tip.evaluate(np.array([0.1]))) == 0.0).all()

    def test_the_capacity_s_options_do_not_disturb_the_laws(self):
        curve = Curve(1, "cohesive", cohesive(1).parameters, {"plug": "AUTO"})
        assert profile((0,), None, [curve]).shaft(Z, self.D).laws


class TestRefusals:
    @pytest.mark.parametrize(
        ("curve", "message"),
        [
            (cohesive(5, {"residual": 0.8}), "t-z curve 5: the t-z shape EP has no residual"),
            (
                cohesive(5, {"method": "BETA"}),
                "t-z curve 5: there is no method BETA for the friction of this soil",
            ),
            (
                cohesive(5, {"colour": "grey"}),
                "t-z curve 5: the law 'cohesive' does not take colour",
            ),
            (Curve(5, "user", {}), "t-z curve 5: there is no t-z law 'user'"),
        ],
    )
    def test_a_curve_that_makes_no_law_is_named(self, curve, message):
        with pytest.raises(UserError, match=message):
            profile((0,), None, [curve]).shaft(Z, np.ones(6))
