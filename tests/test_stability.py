"""The map of the time integrators: its boundaries, and each known failure of a method."""

from functools import cache

import numpy as np
import pytest

from one_dof import bouncing, release_gain
from podeep.solve.integrators import CentralDifference, Integrator, Weighted, initial
from podeep.solve.stage import Effort, NoBalance, Patience, balanced
from podeep.study.limits import GAINED, Limit, limits, radius
from podeep.study.oscillator import (
    MeanLaw,
    Oscillators,
    gap,
    history,
    linear,
    nothing,
    one,
    power,
    wall,
)
from podeep.study.stability import METHODS, Boundary, Cause, Cell, Verdict, boundary, cell, judged
from podeep.study.trials import SUCTION, TRIALS, Outcome, Trial

KNOWN = limits(METHODS)
BY_NAME = {trial.name: trial for trial in TRIALS}
HHT, NEWMARK, GALPHA = METHODS["HHT"], METHODS["NEWMARK"], METHODS["GALPHA"]


@cache
def tried(trial: str, method: str, h: float) -> Cell:
    return cell(BY_NAME[trial], method, h)


def outcome(trial: str, method: str, h: float) -> Outcome:
    found = tried(trial, method, h).outcome
    assert found is not None
    return found


def found(trial: str, method: str, low: float, high: float) -> Boundary:
    """The boundary between two steps."""
    row = [tried(trial, method, h) for h in (low, high)]
    return boundary(BY_NAME[trial], row, 1.002, None)


# --- boundaries and closed forms ---------------------------


@pytest.mark.parametrize("limit", [k for k in KNOWN if k.exact], ids=lambda k: k.trial + k.method)
def test_a_boundary_lies_at_its_closed_form(limit: Limit) -> None:
    low, high = 0.7 * limit.step, 1.4 * limit.step
    assert found(limit.trial, limit.method, low, high).step == pytest.approx(limit.step, rel=0.02)


@pytest.mark.parametrize("limit", [k for k in KNOWN if not k.exact], ids=lambda k: k.trial)
def test_a_bound_from_below_holds(limit: Limit) -> None:
    for share in (0.5, 0.75, 1.0):
        assert tried(limit.trial, limit.method, share * limit.step).verdict is Verdict.STABLE


@pytest.mark.parametrize("method", [m for m in METHODS if m != "GAMMA=1"])
@pytest.mark.parametrize("h", [0.3, 1.0, 1.9, 2.2, 10.0])
def test_growth_of_free_vibrations_is_the_spectral_radius(method: str, h: float) -> None:
    start = np.array([1.0, 0.5])
    mean = MeanLaw(linear(1.0), start)
    spring = mean if METHODS[method].mean else mean.law
    equations = Oscillators(np.ones(2), np.zeros(2), spring, commits=mean.commit)
    states, _ = history(METHODS[method], equations, start, np.array([0.0, 0.7]), h, 60)
    grown = [np.hypot(s.q, s.velocity).max() for s in states[-40:]]
    line = np.polyfit(np.arange(40), np.log(np.maximum(grown, 1e-300)), 1)
    assert line[0] == pytest.approx(np.log(radius(METHODS[method], h)), abs=0.02, rel=0.02)


# --- what fails ---------------------------


@pytest.mark.parametrize("h", [0.5, 1.0])
def test_the_trapezoidal_rule_gains_at_a_release(h: float) -> None:
    """At most 1 + (omega h)^2/4, which the worst phase has."""
    most = 1.0 + 0.25 * h * h
    assert release_gain(h) == pytest.approx(most, rel=1e-6)
    assert outcome("wall", "NEWMARK", h).gain == pytest.approx(most, rel=2e-3)
    assert outcome("wall", "NEWMARK", h).gain <= most * (1.0 + 1e-9)


def test_the_default_gains_at_a_release_as_much() -> None:
    """HHT's -0.05 damps nothing within one contact; Bathe's method gains two fifths of that."""
    gains = {m: outcome("wall", m, 1.0).gain - 1.0 for m in ("NEWMARK", "HHT", "GALPHA", "BATHE")}
    assert 0.9 * gains["NEWMARK"] < gains["HHT"] < 1.2 * gains["NEWMARK"]
    assert 0.9 * gains["NEWMARK"] < gains["GALPHA"] < 1.2 * gains["NEWMARK"]
    assert gains["BATHE"] < 0.45 * gains["NEWMARK"]


def test_how_far_each_method_may_go_at_a_wall() -> None:
    reached = {m: found("wall", m, 0.3, 1.5).step for m in ("HHT", "GALPHA", "BATHE")}
    assert reached == pytest.approx({"HHT": 0.614, "GALPHA": 0.62, "BATHE": 0.978}, rel=0.01)


def bounces(h: float, method: Integrator) -> list[float]:
    """E_max/E_0 of 12 bouncing masses that differ by rounding, in 200 s."""
    assert isinstance(method, Weighted)
    return [bouncing(h, 0.1 * (1.0 + i * 1e-13), method) for i in range(12)]


@pytest.mark.parametrize(
    ("method", "h", "published"),
    [(NEWMARK, 0.5, 3.06), (NEWMARK, 1.0, 23.0), (GALPHA, 0.5, 1.41), (GALPHA, 1.0, 57.8)],
)
def test_a_bouncing_mass_gains_energy(method: Integrator, h: float, published: float) -> None:
    """Published factors are one draw of many: bounces are chaotic, and rounding alone makes the
    largest energy three times or twenty times another. All draws gain."""
    drawn = bounces(h, method)
    assert min(drawn) > 1.1
    assert min(drawn) < published < max(drawn)


def test_a_bouncing_mass_keeps_its_energy_with_small_steps() -> None:
    for method in (NEWMARK, HHT, GALPHA):
        assert isinstance(method, Weighted)
        assert bouncing(0.2, 0.1, method) == pytest.approx(1.0, abs=2e-3)


def test_a_bouncing_mass_with_the_default() -> None:
    """It gains 3 % in 200 s at omega h 0.5, but up to three times at 1."""
    assert max(bounces(0.5, HHT)) < 1.05
    assert 1.5 < max(bounces(1.0, HHT)) < 10.0


def test_what_never_gains_by_contact() -> None:
    """Newmark's gamma = 1, beta = 1/2: the force at the end of a step works over all of it, which
    is more than a convex spring gives back. And the discrete gradient, which is exact."""
    for h in (0.5, 1.0):
        assert bouncing(h, 0.1, Weighted(1.0, 0.5), 50.0) == pytest.approx(1.0, abs=1e-9)
        assert bouncing(h, 0.1, None, 50.0) == pytest.approx(1.0, abs=1e-9)
    for trial in ("soil", "wall", "gap"):
        for h in (0.3, 1.0, 3.0, 10.0, 30.0):
            assert outcome(trial, "GAMMA=1", h).gain <= 1.0 + 1e-8


@pytest.mark.parametrize("trial", ["linear", "wall", "gap"])
@pytest.mark.parametrize("h", [0.1, 0.5, 1.0, 2.0, 10.0, 100.0])
def test_the_method_of_means_keeps_the_energy_of_walls(trial: str, h: float) -> None:
    """Whatever the step, to rounding."""
    one = outcome(trial, "CONSERVE", h)
    assert one.gain == pytest.approx(1.0, abs=1e-8)
    assert one.kept == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize(("h", "least"), [(0.5, 1.06), (1.0, 1.25), (2.0, 1.9)])
def test_where_the_original_default_gains_at_walls(h: float, least: float) -> None:
    assert outcome("wall", "HHT", h).gain > least
    if h <= 1.0:  # between two walls, steps of 2/omega happen to fit
        assert outcome("gap", "HHT", h).gain > least


def test_the_method_of_means_in_soil() -> None:
    """Gauss points do not see all of a cube root: within a tenth with 30 steps in a cycle, bounded
    with fewer."""
    assert max(outcome("soil", "CONSERVE", h).gain for h in (0.1, 0.15, 0.2)) < GAINED
    assert max(outcome("soil", "CONSERVE", h).gain for h in (1.0, 10.0, 100.0)) < 3.0


@pytest.mark.parametrize("name", ["NEWMARK", "HHT", "GALPHA"])
def test_the_bouncing_mass_of_our_own_methods(name: str) -> None:
    """Before rounding decides, the recursion is the method."""
    method, h = METHODS[name], 5e-3
    assert isinstance(method, Weighted)
    equations = one(wall(1e4), push=lambda t: np.array([-9.81]))
    states, _ = history(method, equations, np.array([0.1]), np.zeros(1), h, 400)
    energy = [
        0.5 * s.velocity[0] ** 2 + 9.81 * s.q[0] + 5e3 * min(s.q[0], 0.0) ** 2 for s in states
    ]
    assert max(energy) / 0.981 == pytest.approx(bouncing(0.5, 0.1, method, 2.0), rel=1e-9)


def test_ros2_is_unsafe_on_a_wall_and_sticks_in_soil() -> None:
    """One tangent, from the start of the step: it misses the wall, or keeps the toe's stiffness."""
    assert outcome("wall", "ROS2", 3.0).gain > 3.0 * outcome("wall", "HHT", 3.0).gain
    assert outcome("wall", "ROS2", 30.0).gain > 100.0 * outcome("wall", "HHT", 30.0).gain
    assert outcome("soil", "ROS2", 0.1).kept < 1e-3
    assert outcome("soil", "HHT", 0.1).kept > 0.9
    assert outcome("power law", "ROS2", 0.3).error > 0.1
    assert outcome("power law", "HHT", 0.3).error < 1e-6


def test_central_differences_beyond_their_limit() -> None:
    beyond = tried("linear", "CENTRAL", 2.1)
    assert (beyond.verdict, beyond.cause) == (Verdict.FAILED, Cause.UNBOUNDED)
    assert tried("linear", "HHT", 2.1).outcome.gain == pytest.approx(1.0)  # type: ignore[union-attr]
    assert outcome("power law", "CENTRAL", 2.6).error > 1.0
    assert outcome("power law", "HHT", 2.6).error < 1e-6


def test_central_differences_on_a_cube_root_turn_at_every_step() -> None:
    """From where the secant has omega h = 2; smaller motions grow up to that one."""
    spring = power(1.0, 1.0 / 3.0, 1e-10)
    states, _ = history(CentralDifference(), one(spring), np.ones(1), np.zeros(1), 2.0, 10)
    assert [s.q[0] for s in states] == pytest.approx([(-1.0) ** i for i in range(11)])
    states, _ = history(CentralDifference(), one(spring), np.full(1, 1e-3), np.zeros(1), 2.0, 200)
    assert max(abs(s.q[0]) for s in states) > 0.5


def test_plain_newton_and_the_search_on_a_power_of_velocity() -> None:
    """Newton multiplies v by 1 - 1/n = -4.56 and never ends; the search along the energy does."""
    law, v, passed = power(1.0, SUCTION, 1e-9), np.ones(1), []
    for _ in range(5):
        force, slope = law(v)
        passed.append(float(v[0]))
        v = v - force / slope
    assert np.array(passed[1:]) / passed[:-1] == pytest.approx(1.0 - 1.0 / SUCTION, rel=1e-6)
    equations = one(law)
    equations.weigh(0.0, 0.0, 0.0)
    effort = Effort()
    end = balanced(equations, np.zeros(1), np.ones(1), lambda q: q, Patience(1e-9), effort)
    assert abs(end[0]) < 1e-9
    assert effort.iterations < 30


def test_the_end_of_a_pull_with_very_long_steps() -> None:
    """The trapezoidal rule keeps swinging around the terminal velocity; HHT does not."""
    assert outcome("power law", "NEWMARK", 100.0).error > 0.1
    assert outcome("power law", "CONSERVE", 100.0).error > 0.1
    for method in ("HHT", "GALPHA", "BATHE"):
        assert outcome("power law", method, 100.0).error < 0.01


@pytest.mark.parametrize("trial", BY_NAME)
@pytest.mark.parametrize("method", ["NEWMARK", "HHT", "GALPHA", "BATHE", "CONSERVE", "GAMMA=1"])
def test_implicit_methods_always_find_a_balance(trial: str, method: str) -> None:
    for h in (0.1, 1.0, 10.0, 100.0):
        assert tried(trial, method, h).verdict is not Verdict.FAILED


# --- trials and verdicts ---------------------------


def test_masses_side_by_side_move_as_each_alone() -> None:
    for law, start in ((wall(1.0), 0.3), (gap(1.0, 2.0), 1.9)):
        q, v = np.array([start, 0.1, 1.0]), np.array([-1.0, 1.0, -0.5])
        states, _ = history(HHT, Oscillators(np.ones(3), np.zeros(3), law), q, v, 0.7, 30)
        for i in range(3):
            alone, _ = history(HHT, one(law), q[i : i + 1], v[i : i + 1], 0.7, 30)
            assert [s.q[i] for s in states] == pytest.approx([s.q[0] for s in alone], abs=1e-10)


@pytest.mark.parametrize("law", [linear(2.0), wall(3.0), gap(2.0, 0.5), power(2.0, 1 / 3, 1e-2)])
def test_the_derivative_of_a_law(law) -> None:
    u = np.array([-2.0, -0.7, -0.1, 0.2, 0.6, 3.0])
    change = (law(u + 1e-6)[0] - law(u - 1e-6)[0]) / 2e-6
    assert law(u)[1] == pytest.approx(change, rel=1e-6, abs=1e-9)


def test_verdicts_in_words() -> None:
    for what, verdict, cause, words in (
        (Outcome(), Verdict.STABLE, Cause.NONE, ""),
        (Outcome(gain=3.06), Verdict.WRONG, Cause.GAINED, "energy grew 3.06 times"),
        (Outcome(kept=0.3), Verdict.WRONG, Cause.LOST, "kept 0.3 of its energy"),
        (Outcome(error=0.34), Verdict.WRONG, Cause.OFF, "its end is 0.34 of the exact one away"),
        (Outcome(gain=np.inf), Verdict.FAILED, Cause.UNBOUNDED, "grew without bound"),
        (Outcome(error=np.nan), Verdict.FAILED, Cause.UNBOUNDED, "grew without bound"),
    ):
        assert judged(what) == (verdict, cause, words)
    assert judged(Outcome(gain=GAINED))[0] is Verdict.STABLE


def test_a_stage_without_equilibrium_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(self: Trial, method: Integrator, h: float) -> Outcome:
        raise NoBalance

    monkeypatch.setattr(Trial, "outcome", none)
    told = cell(TRIALS[0], "HHT", 1.0)
    assert (told.verdict, told.words) == (Verdict.FAILED, "no equilibrium in a stage")
    assert told.outcome is None


def test_a_start_is_in_balance() -> None:
    start = initial(one(wall(4.0)), 0.0, np.array([-0.5]), np.zeros(1), Effort())
    assert start.acceleration[0] == 2.0
    assert not nothing(np.ones(1))[0].any()
