"""Particular points of the laws: limits, kinks, refusals; and the curves of a depth."""

from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.errors import InvalidData
from podeep.report import curves_report
from podeep.scene import Curve, Ground
from podeep.soil import axial
from podeep.soil.backbone import SignedUserCurve, UserCurve, sorted_points, user_law
from podeep.soil.curves import curves
from podeep.soil.profile import Profile
from podeep.soil.sand import Sand, default_subgrade_modulus
from podeep.soil.soft_clay import SoftClay
from podeep.units import parameter


def clay(**given):
    """pu = 45 kN/m and y50 = 0.25 m, unless given otherwise: exact in binary."""
    parameters = {
        "depth": 10.0,
        "diameter": 1.0,
        "effective_overburden": 1e5,
        "undrained_shear_strength": 5e3,
        "effective_unit_weight": 10e3,
        "j": 0.5,
        "strain_50": 0.1,
    }
    return SoftClay(**{**parameters, **given})


def sand(**given):
    parameters = {
        "depth": 4.0,
        "diameter": 1.0,
        "effective_overburden": 4e4,
        "friction_angle": np.radians(35.0),
        "subgrade_modulus": 2e7,
    }
    return Sand(**{**parameters, **given})


def at(law, *u):
    return law.evaluate(np.array(u))


class TestSoftClay:
    def test_transition_depth_is_at_least_two_and_a_half_diameters(self):
        # 6 D / (g' D / su + J) = 2.4 D
        law = clay(depth=2.45, effective_overburden=24.5e3, cyclic=True)
        assert law.transition_depth == 2.5
        assert at(law, 15 * 0.25)[0] == pytest.approx(0.72 * 45e3 * 2.45 / 2.5)
        assert clay(effective_unit_weight=2e3).transition_depth == pytest.approx(6 / 0.9)

    @pytest.mark.parametrize(("shape", "peak"), [("2GEO", 0.72), ("POWER", 0.5 * 3 ** (1 / 3))])
    def test_cyclic_resistance_falls_on_a_straight_line(self, shape, peak):
        law = clay(depth=1.0, effective_overburden=1e4, cyclic=True, shape=shape)
        p3 = peak * (3 * 5e3 + 1e4 + 0.5 * 5e3)
        low = 1.0 / 2.5
        force, stiffness = at(law, *(0.25 * np.array([3.0, 9.0, 15.0, 40.0])))
        np.testing.assert_allclose(force, p3 * np.array([1, 0.5 + 0.5 * low, low, low]), rtol=1e-12)
        slope = -p3 * (1 - low) / 12 / 0.25
        np.testing.assert_allclose(stiffness, [slope, slope, 0.0, 0.0], rtol=1e-12, atol=1e-9)

    @pytest.mark.parametrize(("shape", "peak"), [("WSD", 0.72), ("POWER", 0.5 * 3 ** (1 / 3))])
    def test_cyclic_resistance_is_held_from_the_transition_depth_on(self, shape, peak):
        law = clay(depth=2.5, cyclic=True, shape=shape)
        force = at(law, 0.75, 2.0, 15.0)[0]
        np.testing.assert_allclose(force, peak * law.ultimate_resistance[0], rtol=1e-12)

    def test_a_clay_without_strength_has_no_reaction(self):
        for shape in ("2GEO", "POWER"):
            law = clay(undrained_shear_strength=0.0, cyclic=True, shape=shape)
            assert (np.array(at(law, 0.1, 5.0)) == 0.0).all()

    def test_strength_at_the_mudline_is_three_su(self):
        law = clay(depth=0.0, effective_overburden=0.0)
        assert law.capacity == pytest.approx(3 * 5e3)

    def test_kinks_take_the_derivative_away_from_zero(self):
        unit = 45e3 / 0.25
        force, stiffness = at(clay(), 0.25, -0.25, 2.0, -2.0, 0.0)
        np.testing.assert_allclose(force, 45e3 * np.array([0.5, -0.5, 1, -1, 0]), rtol=1e-15)
        np.testing.assert_allclose(
            stiffness, unit * np.array([0.11, 0.11, 0, 0, 2.3]), rtol=1e-12, atol=0
        )

    def test_the_power_law_is_the_cube_root_up_to_its_plateau(self):
        law = clay(shape="POWER")
        s = np.array([1e-6, 0.01, 0.1, 1.0, 7.9])
        force, stiffness = at(law, *(0.25 * s))
        np.testing.assert_allclose(force, 22.5e3 * np.cbrt(s), rtol=4e-9)
        np.testing.assert_allclose(stiffness, 22.5e3 / 0.75 * s ** (-2 / 3), rtol=2e-8)
        plateau, flat = at(law, 2.0, 2.1, -50.0)
        np.testing.assert_allclose(plateau[0], 45e3, rtol=1e-14)
        assert plateau[1:].tolist() == [45e3, -45e3]
        assert (flat == 0.0).all()
        assert at(law, 0.0)[1] == pytest.approx(22.5e3 / 0.25 * 1e-10 ** (-2 / 3))

    def test_an_unknown_shape_is_refused(self):
        with pytest.raises(InvalidData, match="2GEO, WSD, POWER"):
            clay(shape="MATLOCK")


class TestSand:
    def test_the_mudline_has_no_reaction(self):
        force, stiffness = at(sand(depth=0.0, effective_overburden=0.0), 0.0, 0.1, 1e3)
        assert (force == 0.0).all()
        assert (stiffness == 0.0).all()

    def test_initial_stiffness_and_plateau(self):
        law = sand()
        assert at(law, 0.0)[1] == 2e7 * 4.0
        force, stiffness = at(law, 1e3, -1e3)
        assert force.tolist() == [law.capacity[0], -law.capacity[0]]
        assert (stiffness == 0.0).all()

    def test_static_factor_falls_from_three_to_the_cyclic_one(self):
        for depth, factor in ((0.5, 2.6), (2.0, 1.4), (2.625, 0.9), (9.0, 0.9)):
            law = sand(depth=depth)
            assert law.capacity == pytest.approx(factor * law.ultimate_resistance)
            cyclic = sand(depth=depth, cyclic=True)
            assert cyclic.capacity == pytest.approx(0.9 * law.ultimate_resistance)

    def test_default_modulus_is_held_outside_its_table(self):
        angles = np.radians([20.0, 27.5, 40.0, 44.0])
        np.testing.assert_allclose(default_subgrade_modulus(angles), [5.4e6, 8.2e6, 45e6, 45e6])


class TestUserCurve:
    rows = ((1e4, 0.5), (3e4, 2.0))  # P, y

    def test_lines_between_rows_and_the_last_value_beyond(self):
        law = UserCurve(points=self.rows, force_scale=2.0, displacement_scale=4.0)
        force, stiffness = at(law, 1.0, 2.0, 5.0, 8.0, 100.0, -5.0)
        np.testing.assert_allclose(force, [1e4, 2e4, 4e4, 6e4, 6e4, -4e4])
        np.testing.assert_allclose(stiffness, [1e4, 2e4 / 3, 2e4 / 3, 0, 0, 2e4 / 3])
        assert law.capacity == 6e4

    def test_writing_the_origin_and_any_order_are_fine(self):
        u = np.linspace(-3.0, 3.0, 25)
        plain = UserCurve(points=self.rows, force_scale=1.0).force(u)
        full = UserCurve(points=((3e4, 2.0), (0.0, 0.0), (1e4, 0.5)), force_scale=1.0).force(u)
        assert (plain == full).all()

    def test_rows_of_negative_displacement_stand_for_themselves(self):
        law = user_law([*self.rows, (-5e3, -1.0)], 1.0, 1.0)
        assert not law.odd
        force, stiffness = at(law, -7.0, -1.0, -0.5, 0.0, 0.5)
        np.testing.assert_allclose(force, [-5e3, -5e3, -2.5e3, 0.0, 1e4])
        np.testing.assert_allclose(stiffness, [0.0, 0.0, 5e3, 2e4, 2e4 / 1.5])

    def test_a_tip_resists_compression_alone(self):
        law = user_law(self.rows, 1.0, 1.0, compression_only=True)
        assert isinstance(law, SignedUserCurve)
        force, stiffness = at(law, -1.0, 0.0, 0.25)
        assert force.tolist() == [0.0, 0.0, 5e3]
        assert stiffness.tolist() == [0.0, 2e4, 2e4]
        with pytest.raises(InvalidData, match="compression alone"):
            user_law([(-1.0, -1.0), (1.0, 1.0)], 1.0, 1.0, compression_only=True)

    def test_rows_of_no_reaction_are_no_law(self):
        assert user_law([(0.0, 0.0), (0.0, 1.0)], 1.0, 1.0) is None

    def test_impossible_rows_are_refused(self):
        with pytest.raises(InvalidData, match="two reactions, 1 and 2 Pa"):
            sorted_points([(1.0, 0.5), (2.0, 0.5)])
        with pytest.raises(InvalidData, match="two reactions, 0 and 3 Pa"):
            sorted_points([(3.0, 0.0)])
        with pytest.raises(InvalidData, match="along the displacement"):
            sorted_points([(3.0, -1.0)])


class TestAxial:
    def test_elastic_plastic_friction_and_bearing_share_their_slope(self):
        shaft = axial.DirectShaft(diameter=2.0, initial_stiffness=1e6, unit_friction=5e3)
        force, stiffness = at(shaft, 1e-3, 5e-3, 1.0, -1.0)
        np.testing.assert_allclose(force, np.pi * 2 * np.array([1e3, 5e3, 5e3, -5e3]))
        np.testing.assert_allclose(stiffness, np.pi * 2 * np.array([1e6, 0, 0, 0]))
        tip = axial.DirectTip(diameter=2.0, initial_stiffness=1e6, tip_pressure=5e3)
        force, stiffness = at(tip, 0.0, 1e-3, 1.0, -1.0)
        np.testing.assert_allclose(force, np.pi * np.array([0, 1e3, 5e3, 0]))
        np.testing.assert_allclose(stiffness, np.pi * np.array([1e6, 1e6, 0, 0]))

    def test_residuals_by_default(self):
        given = {"diameter": 1.0, "initial_stiffness": 1e8, "effective_overburden": 1e5}
        clay = {**given, "undrained_shear_strength": 4e4}
        sand = {**given, "earth_pressure_coefficient": 0.8, "interface_friction_angle": 0.4}
        direct = {"diameter": 1.0, "initial_stiffness": 1e8, "unit_friction": 1e4}
        for kind, parameters, residual in (
            (axial.CohesiveShaft, clay, 0.9),
            (axial.CohesionlessShaft, sand, 1.0),
            (axial.DirectShaft, direct, 1.0),
        ):
            for shape in ("API", "2GEO"):
                law = kind(**parameters, shape=shape)
                assert at(law, 0.5)[0] == pytest.approx(residual * law.capacity)

    def test_no_friction_at_zero_overburden_and_alpha_at_most_one(self):
        su = np.array([0.0, 2e4, 2e4])
        friction = axial.alpha_friction(su, np.array([0.0, 0.0, 1e6]))
        assert friction.tolist() == [0.0, 0.0, 2e4]

    @pytest.mark.parametrize(
        ("given", "message"),
        [
            ({"shape": "WSD"}, "no shape WSD"),
            ({"residual": 0.8}, "shape EP has no residual"),
            ({"shape": "API", "residual": 0.8}, "shape API has no residual in this soil"),
            ({"friction_limit": 0.0}, "limit of friction 0 Pa"),
            ({"initial_stiffness": 0.0}, "slope 0 Pa/m"),
        ],
    )
    def test_what_would_do_nothing_is_refused(self, given, message):
        parameters = {
            "diameter": 1.0,
            "initial_stiffness": 1e8,
            "effective_overburden": 1e5,
            "earth_pressure_coefficient": 0.8,
            "interface_friction_angle": 0.4,
        }
        with pytest.raises(InvalidData, match=message):
            axial.CohesionlessShaft(**{**parameters, **given})


PISA_CLAY = Curve(
    1,
    "pisa_clay",
    {"undrained_shear_strength": 60e3, "initial_shear_modulus": 60e6, "effective_unit_weight": 8e3},
    {"site": "COWDEN"},
)
PISA_SAND = Curve(
    2,
    "pisa_sand",
    {"effective_unit_weight": 10e3, "relative_density": 0.75, "initial_shear_modulus": 100e6},
)


class TestTables:
    """What `podeep-solve curves` shows of a depth."""

    def profile(self, blend=False):
        """PISA clay over PISA sand from 12 m on, or loads that go from one to the other."""
        ids, depths = ((1, 2), (0.0, 24.0)) if blend else ((1, 1, 2, 2), (0.0, 12.0, 12.0, 40.0))
        return Profile(Ground(depths, ids, (0,) * len(ids), {1: PISA_CLAY, 2: PISA_SAND}, {}), 30.0)

    def monopile(self, depth, displacement=None, blend=False):
        found = curves(self.profile(blend), depth, 8.0, displacement)
        return {table.name: table for table in found}

    def test_a_monopile_has_four_lateral_curves_in_their_units(self):
        tables = self.monopile(5.0)
        assert list(tables) == ["py", "mt", "hb", "mb"]
        units = {n: (t.kind.unit, t.kind.displacement_unit) for n, t in tables.items()}
        assert units == {
            "py": ("N/m", "m"),
            "mt": ("N m/m", "rad"),
            "hb": ("N", "m"),
            "mb": ("N m", "rad"),
        }
        assert tables["py"].displacement[-1] == pytest.approx(0.3 * 8.0)
        assert tables["mt"].displacement[:3].tolist() == [0.0, 1e-5, 2e-5]
        assert tables["mt"].displacement[-1] == tables["mb"].displacement[-1] == 0.3

    def test_the_moment_of_clay_is_its_own(self):
        """m = su D^2 (0.2899 - 0.04775 z/D) at large rotations, whatever p."""
        table = self.monopile(5.0, np.array([0.0, 0.1]))["mt"]
        assert not table.follows_lateral
        exact = 60e3 * 64.0 * (0.2899 - 0.04775 * 5.0 / 8.0)
        assert table.reaction.tolist() == pytest.approx([0.0, exact])
        assert table.capacity == pytest.approx(exact)

    def test_the_moment_of_sand_is_that_under_the_capacity_of_p_y(self):
        """m = |p| D (0.2605 - 0.0475 z/L) at large rotations, in sand of 75 %."""
        tables = self.monopile(20.0, np.array([0.0, 0.1]))
        table = tables["mt"]
        assert table.follows_lateral
        yu = 0.2605 + (-0.1989 + 0.2019 * 0.75) * 20.0 / 30.0
        exact = tables["py"].capacity * 8.0 * yu
        assert table.lateral == tables["py"].capacity
        assert table.reaction.tolist() == pytest.approx([0.0, exact])
        assert table.capacity == pytest.approx(exact)

    def test_moments_that_follow_p_and_others_add_up(self):
        """Halfway between clay's and sand's loads, each by half."""
        tables = self.monopile(12.0, np.array([0.0, 0.1]), blend=True)
        own, following = (
            next(t for t in tables["mt"].source.laws if t.law.follows_lateral is f)
            for f in (False, True)
        )
        assert own.weight == following.weight == pytest.approx(0.5)
        exact = 0.5 * own.law.capacity[0]
        exact += 0.5 * following.law.capacity[0] * tables["py"].capacity
        assert tables["mt"].capacity == pytest.approx(exact)
        assert tables["mt"].reaction[-1] == pytest.approx(exact)

    def test_base_curves_are_those_of_the_profile(self):
        u = np.array([1e-3, -1e-3])
        tables = self.monopile(30.0, u)
        for name, base in zip(("hb", "mb"), self.profile().base(30.0, 8.0), strict=True):
            exact = base.evaluate(u[:, None])[0][:, 0]
            assert tables[name].reaction.tolist() == exact.tolist()
            assert exact[0] > 0.0

    def test_a_report_names_source_parameters_and_what_they_come_to(self):
        tables = self.monopile(20.0)
        text = curves_report(tuple(tables.values()), 20.0)
        assert max(len(line) for line in text.splitlines()) <= 80
        assert "source: PISA: Burd et al. 2020, marine sand" in text
        words = " ".join(text.split())
        assert "shown for |p| at the capacity of py, 2.19074e+07 N/m" in words
        assert "relative density 75 %" in words
        assert "initial shear modulus 1e+08 Pa" in words
        assert "embedded length 30 m" in words
        derived = [line for line in text.splitlines() if "ultimate reaction" in line]
        units = [line.rsplit(" ", 1)[1] for line in derived]
        assert units == ["N/m", "m", "N", "m"]  # the last one is N m
        assert derived[-1].endswith(" N m")
        for heading in ("rotation (rad)", "reaction (N m/m)", "reaction (N m)", "reaction (N)"):
            assert heading in text

    def test_the_jacket_pile(self, capsys):
        deck = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"
        assert main(["curves", str(deck), "--depth", "4.5"]) == 0
        text = capsys.readouterr().out
        assert max(len(line) for line in text.splitlines()) <= 80
        words = " ".join(text.split())
        for source in (SoftClay.source, axial.CohesiveShaft.source, axial.CohesiveTip.source):
            assert f"source: {source} with" in words
        assert "undrained shear strength 17000 Pa" in words
        assert "derived ultimate resistance" in words
        assert "y50 0.080025 m, transition depth 9.7299" in words
        assert "derived peak friction" in words
        assert "derived peak bearing 153000 Pa" in words

    def test_parameters_without_bound_are_told_as_none(self):
        assert parameter("friction_limit", np.array([np.inf])) == "no friction limit"
        assert parameter("rock_quality_designation", 0.4) == "rock quality designation 40 %"
        assert parameter("friction_angle", np.radians(35.0)) == "friction angle 35 deg"
        assert parameter("cyclic", False) == "not cyclic"
        assert parameter("strain_50", 0.02) == "strain 50 0.02"
        assert parameter("initial_stiffness", 3.0, "Pa") == "initial stiffness 3 Pa"
