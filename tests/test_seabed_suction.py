"""The cycle of suction: its table, reversals, velocity, wear, and motions by every method."""

from functools import cache

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.seabed.normal import OneSided
from podeep.seabed.pull_out import PullOut, Wear, force_factor, reach_factor
from podeep.seabed.suction import Suction
from podeep.solve.conserving import Conserving
from podeep.study.oscillator import history, nothing, one, power
from podeep.study.stability import METHODS
from seabeds import SU, D, K, Power, bridge, cycle, felt, fixed, mudline, rows

CASES = {row["case"]: row for row in rows("10_*.csv") if row["z0_m"]}


def seabed(case: str) -> Suction:
    row = CASES[case]
    law = bridge(mobilised=float(row["xc1"]), released=float(row["xc2"]))
    return Suction(Power(), 1, float(row["ku_Pa"]), law, speed=float(row["v_m_per_s"]))


def at(*values: float) -> np.ndarray:
    return np.array(values)


def suction(pull_out: PullOut | None = None, **more) -> Suction:
    """Pushed in to 0.06 m already."""
    law = Suction(Power(), 1, K, pull_out or fixed(1000.0, 0.1), **more)
    law.commit(at(0.06))
    return law


# --- the table ---------------------------


@pytest.mark.parametrize("case", ["S1", "S2"])
def test_table_10_on_every_branch(case: str) -> None:
    law, seen = seabed(case), set()
    for branch, z, force in cycle(case):
        found, _ = law.evaluate(at(z))
        assert found[0] == pytest.approx(force, rel=1e-11, abs=1e-7), (branch, z)
        law.commit(at(z))
        seen.add(branch)
    assert seen == {"penetrate", "unload", "suction", "repenetrate"}


@pytest.mark.parametrize("case", ["S1", "S2"])
def test_table_10_in_one_step_each(case: str) -> None:
    """A straight way ends where it ends, however long it is."""
    for branch, z, force in cycle(case):
        law = seabed(case)
        if branch != "penetrate":
            law.commit(at(0.06))
        if branch == "repenetrate":
            law.commit(at(-1.0))
        assert law.evaluate(at(z))[0][0] == pytest.approx(force, rel=1e-11, abs=1e-7)


@pytest.mark.parametrize("case", ["S1", "S2"])
def test_the_head_of_table_10(case: str) -> None:
    row, law = CASES[case], seabed(case)
    speed = float(row["v_m_per_s"])
    law.commit(at(float(row["z_max_m"])))
    assert law.evaluate(at(0.06))[0] == pytest.approx(float(row["R_at_zmax_N_per_m"]), rel=1e-11)
    assert law.lift_off == pytest.approx(float(row["z0_m"]), rel=1e-11)
    assert law.pull_out.force(speed) == pytest.approx(float(row["Fmax_N_per_m"]), rel=1e-11)
    assert law.pull_out.reach(speed) == pytest.approx(float(row["DeltaB_m"]), rel=1e-11)
    energy = float(row["suction_energy_J_per_m"])
    assert law.pull_out.energy(speed) == pytest.approx(energy, rel=1e-10)
    law.commit(law.lift_off)
    before = law.dissipated
    law.commit(at(-1.0))
    assert law.dissipated - before == pytest.approx(energy, rel=1e-10)
    path = seabed(case)
    for _, z, _ in cycle(case):
        path.commit(at(z))
    assert path.pulled == pytest.approx(energy, rel=1e-10)


# --- the cycle ---------------------------


def test_what_is_lost_on_the_backbone_is_exact() -> None:
    law = suction()
    work = 3919.77859807 * 0.06 / 1.64
    assert law.dissipated == pytest.approx(work - 0.5 * 3919.77859807**2 / K, rel=1e-9)


def test_a_reversal_before_breakout_goes_back_along_the_unloading_slope() -> None:
    law = suction()
    z0 = float(law.lift_off[0])
    law.commit(at(z0 - 0.025))  # on the plateau
    force, slope = law.evaluate(at(z0 - 0.024))
    assert force == pytest.approx(-1000.0 + K * 0.001)
    assert slope == K
    force, slope = law.evaluate(at(z0 - 0.01))  # beyond R = 0, in the trench
    assert (force, slope) == (0.0, 0.0)
    law.commit(at(z0 - 0.01))
    assert law.evaluate(at(z0 - 0.011))[0] == pytest.approx(-K * 0.001)
    assert law.evaluate(at(z0 - 0.02))[0] == -1000.0
    assert law.evaluate(at(z0 + 0.001))[0] == pytest.approx(K * 0.001)
    assert law.evaluate(at(0.08))[0] == pytest.approx(Power().evaluate(at(0.08))[0])


def test_what_was_released_stays_so_until_the_pipe_bears_again() -> None:
    law = suction()
    z0 = float(law.lift_off[0])
    law.commit(at(z0 - 0.065))  # half of the way from x_c2 = 0.3 to breakout
    assert law.evaluate(law.u)[0] == pytest.approx(-500.0)
    law.commit(at(z0 - 0.03))
    assert law.evaluate(at(z0 - 0.06))[0] == pytest.approx(-500.0)
    law.commit(at(z0 - 0.2))
    law.commit(at(z0))
    assert law.evaluate(at(z0 - 0.05))[0] == 0.0
    law.commit(at(z0 + 1e-6))
    assert law.evaluate(at(z0 - 0.02))[0] == -1000.0


def test_no_suction_on_a_seabed_that_was_never_touched() -> None:
    law = Suction(Power(), 1, K, fixed(1000.0, 0.1))
    for z in (-0.05, -0.01, 0.0, -0.3):
        assert law.evaluate(at(z)) == (0.0, 0.0)
        law.commit(at(z))
    assert law.dissipated == 0.0


def test_a_mobilisation_steeper_than_the_soil_follows_the_soil() -> None:
    law = suction(fixed(5000.0, 0.1, mobilised=0.01))
    z0 = float(law.lift_off[0])
    assert law.evaluate(at(z0 - 0.005)) == (pytest.approx(-K * 0.005), K)
    assert law.evaluate(at(z0 - 0.02))[0] == -5000.0


def test_a_soft_unloading_is_made_as_stiff_as_the_secant() -> None:
    """K_d of a hard soil may be a hundredth of W/z: the pipe would come up out of the ground."""
    soft = Suction(Power(), 1, 1e4, fixed(100.0, 0.1))
    soft.commit(at(0.06))
    assert soft.stiffness == pytest.approx(3919.77859807 / 0.06)
    assert soft.lift_off == pytest.approx(0.0, abs=1e-15)
    convex = Suction(Power(1e4, 1.5), 1, 1.0, fixed(100.0, 0.1))
    convex.commit(at(0.06))
    assert convex.stiffness == pytest.approx(Power(1e4, 1.5).evaluate(at(0.06))[1])


def test_a_seabed_with_a_rounded_corner() -> None:
    law = Suction(OneSided(Power(), 1e-5), 1, K, fixed(1000.0, 0.1))
    assert law.evaluate(at(0.0)) == (0.0, 0.0)
    assert law.evaluate(at(0.06))[0] == pytest.approx(Power().evaluate(at(0.06 - 5e-6))[0])


# --- velocity ---------------------------


def test_the_speed_of_a_pull_is_that_of_its_start() -> None:
    law = suction(bridge(), smoothing=0.5)
    z0, h = float(law.lift_off[0]), 0.1
    for z in np.linspace(0.06, z0 + 1e-4, 400)[1:]:
        law.commit(at(z), h)
    speed = (0.06 - z0 - 1e-4) / 399 / h
    assert law.speed == pytest.approx(speed, rel=1e-9)
    kept = law.speed.copy()
    plateau, reach = -float(bridge().force(speed)), float(bridge().reach(speed))
    assert law.evaluate(at(z0 - 0.2 * reach))[0] == pytest.approx(plateau)
    law.commit(at(z0 - 0.05 * reach), h)
    law.commit(at(z0 - 0.1 * reach), 1e-3)
    assert law.speed == kept
    assert law.evaluate(at(z0 - 0.2 * reach))[0] == pytest.approx(plateau)


def test_smoothing_is_a_low_pass() -> None:
    law = suction(bridge(), smoothing=2.0)
    for _ in range(10):
        law.commit(law.u - 1e-4, 0.1)  # 1 mm/s for 1 s
    assert law.speed == pytest.approx(1e-3 * (1.0 - np.exp(-0.5)))
    law.commit(law.u - 1e-4)  # a static step has no time
    assert law.speed == pytest.approx(1e-3 * (1.0 - np.exp(-0.5)))


def test_a_speed_of_zero_or_downwards_has_the_floor() -> None:
    for speed in (0.0, -3.0):
        assert bridge().force(speed) == bridge().force(1e-6)
        assert bridge().reach(speed) == bridge().reach(1e-6)
    law = suction(bridge())
    plateau = law.lift_off - 0.2 * bridge().reach(0.0)
    assert law.evaluate(plateau)[0] == pytest.approx(-173.551134055)


def test_units_of_the_velocity_laws() -> None:
    """mm/s for m/s would make the force 3.47, the reach 6.03 times as large."""
    assert bridge().force(1.0) / bridge().force(1e-3) == pytest.approx(3.467, abs=1e-3)
    assert bridge().reach(1.0) / bridge().reach(1e-3) == pytest.approx(6.026, abs=1e-3)
    assert force_factor(D, SU) == pytest.approx(1.12 * D * SU / D**0.18)
    assert reach_factor(D) == pytest.approx(0.98 * D)


# --- wear ---------------------------


def test_wear_takes_from_the_suction_as_the_pipe_works_the_soil() -> None:
    wear = Wear(diameter=D, remaining=0.4, travel_95=2.0)
    assert wear.left(np.zeros(1)) == 1.0
    assert wear.left(at(2.0 * D)) == pytest.approx(0.4 + 0.6 * np.exp(-3.0))
    law, pulls, way = suction(wear=wear), [], 0.0
    for _ in range(5):
        z0 = float(law.lift_off[0])
        way = float(law.travel[0] + law.u[0] - z0)
        law.commit(at(z0 - 0.02))
        pulls.append(-float(law.evaluate(law.u)[0][0]))
        assert pulls[-1] == pytest.approx(1000.0 * float(wear.left(at(way))[0]))
        law.commit(at(-0.5))  # what it moves above the mudline does not count
        law.commit(at(0.06))
    assert (np.diff(pulls) < 0.0).all()
    assert law.travel == pytest.approx(0.06 + 5 * 0.12)


# --- what makes no suction ---------------------------


@pytest.mark.parametrize(
    ("more", "words", "field"),
    [
        ({"released": 0.96}, "cut-off x_c2 of 0.96; give 1e-06 to 0.95", "XC2"),
        ({"released": 0.1}, "cut-off x_c1 of 0.12", "XC1"),
        ({"mobilised": 0.0}, "cut-off x_c1 of 0;", "XC1"),
        ({"force_factor": -1.0}, "force factor of suction of -1", "ALPHAF"),
        ({"force_factor": np.inf}, "force factor of suction of inf; give 0 or more", "ALPHAF"),
        ({"force_factor": np.nan}, "force factor of suction of nan", "ALPHAF"),
        ({"reach_factor": 0.0}, "reach factor of suction of 0; give more than 0", "ALPHAD"),
        ({"force_exponent": 1.5}, "exponent of the force of suction of 1.5; give 0 to 1", "NF"),
        ({"reach_exponent": -0.1}, "exponent of the reach of suction of -0.1", "ND"),
        ({"least_speed": 0.0}, "least velocity of pull-out, m/s, of 0", ""),
    ],
)
def test_what_makes_no_pull_out(more, words: str, field: str) -> None:
    with pytest.raises(InvalidData, match=words) as caught:
        PullOut(**{"force_factor": 1e3, "reach_factor": 0.3, **more})
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (lambda: Suction(Power(), 1, 0.0, bridge()), "unloading stiffness of 0"),
        (lambda: Suction(Power(), 1, np.inf, bridge()), "unloading stiffness of inf"),
        (
            lambda: Suction(Power(), 1, K, bridge(), speed=np.nan),
            "velocity of pull-out, m/s, of nan",
        ),
        (
            lambda: Suction(Power(), 1, K, bridge(), smoothing=0.0),
            "smoothing time of the velocity, s, of 0",
        ),
        (lambda: Suction(OneSided(Power(), 0.05), 1, 1e4, bridge()), "stiffens to a slope of"),
        (lambda: Wear(diameter=0.0, remaining=0.5, travel_95=1.0), "a diameter, m, of 0"),
        (lambda: Wear(diameter=D, remaining=0.5, travel_95=0.0), "travel to 95 % of wear"),
        (
            lambda: Wear(diameter=D, remaining=1.5, travel_95=1.0),
            "suction that remains of 1.5; give 0 to 1",
        ),
    ],
)
def test_what_makes_no_seabed(made, words: str) -> None:
    with pytest.raises(InvalidData, match=words):
        made()


# --- motions ---------------------------

EVERY = {**METHODS, "CONSERVING": Conserving()}


def pulled_out(method, h: float, load: float, time: float) -> list:
    """A pipe of 300 kg/m at rest under 3919 N/m at 0.06 m, pulled up by a load from then on."""
    law = suction(bridge(), speed=0.0)
    weight = float(law.evaluate(law.u)[0][0])
    spring, commits = felt(law, h)
    equations = one(spring, 300.0, push=lambda t: np.array([weight - load]), commits=commits)
    states, _ = history(method, equations, at(0.06), np.zeros(1), h, round(time / h), 1e-10)
    return states


@cache
def broken_out() -> float:
    return float(pulled_out(METHODS["NEWMARK"], 5e-4, 6000.0, 0.4)[-1].q[0])


@pytest.mark.parametrize("name", EVERY)
def test_a_pull_from_rest_finds_its_balance_with_every_method(name: str) -> None:
    """Suction has a finite slope at v = 0 for all, 30 steps in a cycle of the soil: the pipe breaks
    out, and at the same time."""
    exact = broken_out()
    assert exact < -0.2
    for h, close in ((2e-3, 0.03), (5e-3, 0.1)):
        end = pulled_out(EVERY[name], h, 6000.0, 0.4)[-1].q[0]
        assert end == pytest.approx(exact, abs=close)


@pytest.mark.parametrize("name", [n for n in EVERY if n not in ("CENTRAL", "ROS2")])
def test_very_long_steps_find_a_balance_too(name: str) -> None:
    for h in (0.1, 1.0, 10.0):
        states = pulled_out(EVERY[name], h, 6000.0, 20.0 * h)
        assert np.isfinite([s.q[0] for s in states]).all()
        assert states[-1].q[0] < -1.0


@pytest.mark.parametrize("name", [n for n in EVERY if n not in ("CENTRAL", "ROS2")])
def test_suction_by_the_velocity_of_the_moment_from_rest(name: str) -> None:
    """F = alpha v^0.18, whose slope at rest is infinite but for a floor of 1 nm/s: the search along
    the energy finds every step where Newton alone multiplies the error by -4.6."""
    alpha = float(force_factor(D, SU))
    equations = one(nothing, 300.0, drag=power(alpha, 0.18, 1e-9), push=lambda t: np.array([800.0]))
    states, _ = history(EVERY[name], equations, np.zeros(1), np.zeros(1), 0.02, 200)
    end = float(bridge().terminal_speed(800.0))
    assert np.mean([s.velocity[0] for s in states[-2:]]) == pytest.approx(end, rel=1e-3)


def test_the_jump_in_time_has_the_rate_and_the_speed_of_the_formulas() -> None:
    """Rows B2 and B5: beyond the limit point a mass of 1500 kg on a spring of 2000 N/m."""
    law, z0 = mudline(4000.0, 0.2 / 0.7)
    limit, start, h = z0 - 0.3 * 0.2 / 0.7, 1e-3, 2e-3
    lift, stiffness = 0.3 * 0.2 / 0.7 + 2.0, 2000.0

    def spring(z):
        force, slope = law.evaluate(z)
        return force + stiffness * (lift - (z0 - z)), slope + stiffness

    law.commit(at(limit))
    equations = one(spring, 1500.0, commits=law.commit)
    states, _ = history(METHODS["NEWMARK"], equations, at(limit - start), np.zeros(1), h, 1600)
    up = np.array([limit - s.q[0] for s in states])
    speed = np.array([-s.velocity[0] for s in states])
    early = up < 0.05
    time = h * np.flatnonzero(early)
    np.testing.assert_allclose(up[early], start * np.cosh(3.46410161514 * time), rtol=1e-4)
    assert speed.max() == pytest.approx(2.19089023002, rel=1e-3)
    assert up[speed.argmax()] == pytest.approx(2.0, abs=0.01)
