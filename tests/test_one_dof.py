"""Every row of the one-degree tests: by our own methods, or by the recursion that it describes."""

import re
from collections.abc import Callable
from functools import cache
from math import pi, sqrt

import numpy as np
import pytest

from one_dof import (
    bounced,
    first_exit,
    longest_step,
    release_gain,
    rigid_growth,
    runge_kutta,
    sign_friction,
    stick_slip,
    stick_slip_exact,
)
from podeep.seabed.breakout import LimitPoint, static_pull
from podeep.solve.integrators import Weighted
from podeep.study.oscillator import history, linear, nothing, one, power
from seabeds import bridge, mudline, rows

ROWS = {row["name"]: row for row in rows("09_*.csv")}
ORDER = {"euler": 1, "rk2": 2, "rk3": 3, "rk4": 4}
SUCTION = 1.12 * 0.3 * 5000.0 / 0.3**0.18  # alpha of D = 0.3 m, Cu = 5000 Pa


def given(name: str) -> dict[str, float]:
    """The numbers in a row's name (zeta0.3, wh1, v1e-3): the last of each."""
    return {k: float(v) for k, v in re.findall(r"_([a-z]+)(\d[\d.e-]*)(?=_|$)", name)}


def damped_limit(name: str) -> float:
    c = 2.0 * given(name)["zeta"] * sqrt(500.0 * 1e6)
    return longest_step(500.0, linear(1e6), linear(c), 0.02)


def explicit(name: str) -> float:
    return first_exit(runge_kutta(ORDER[name.split("_")[1]]), given(name)["zeta"])


def pulled(load: float, h: float, steps: int, method: Weighted) -> float:
    """Velocity of 300 kg pulled from rest against suction."""
    drag = power(SUCTION, 0.18, 1e-9)
    equations = one(nothing, 300.0, drag=drag, push=lambda t: np.array([load]))
    states, _ = history(method, equations, np.zeros(1), np.zeros(1), h, steps)
    return float(states[-1].velocity[0])


def crept() -> float:
    """A load of 100 N on friction mu c v, which is none at rest: by our default method."""
    equations = one(nothing, 1.0, 0.5 * 200.0, push=lambda t: np.array([100.0]))
    states, _ = history(Weighted.hht(-0.05), equations, np.zeros(1), np.zeros(1), 0.05, 200)
    return float(states[-1].velocity[0])


def newton_factor(n: float) -> float:
    """What one of plain Newton's steps makes of v = 1 on the way to the root of |v|^n sign v."""
    force, slope = power(1.0, n, 1e-9)(np.ones(1))
    return float((1.0 - force / slope)[0])


def flipped() -> float:
    """The bound of |v| where it flips at every step."""
    v, bound = sign_friction(0.6, 9.81, 0.01)[-50:], 0.6 * 9.81 * 0.01
    assert (v[1:] * v[:-1] < 0.0).all()
    assert np.abs(v).max() < bound
    assert np.abs(v[1:] - v[:-1]) == pytest.approx(bound, rel=1e-9)
    return bound


def small_line() -> tuple[float, float, float]:
    """Mass, kg/m, damping and stiffness, per metre, of the small line on its default seabed."""
    return 0.07 + 1025.0 * pi * 0.005**2 / 4.0, 3e5 * 0.005, 3e6 * 0.005


def fast_root() -> float:
    m, c, k = small_line()
    return (c / m + sqrt((c / m) ** 2 - 4.0 * k / m)) / 2.0


def box_limit() -> float:
    """Largest resultant of separate checks over that of each, by a scan of directions."""
    angle = np.linspace(0.0, 0.5 * pi, 100001)[1:-1]
    return float((0.5 / np.maximum(np.cos(angle), np.sin(angle))).max() / 0.5)


def slips():
    return stick_slip(1.0, 100.0, 0.1, 0.6 * 9.81, 0.4 * 9.81)


@cache
def snap_back(stiffness: float) -> LimitPoint | None:
    """Where a pull of 4000 N lets go, through a spring; suction falls with 20000 N/m."""
    law, z0 = mudline(4000.0, 0.2 / 0.7)
    limits = static_pull(law, z0, stiffness, 4.0, 101).limits
    assert len(limits) <= 1
    return limits[0] if limits else None


def threshold() -> float:
    """The stiffness from which on nothing jumps."""
    low, high = 1e4, 3e4
    while high / low > 1.0 + 1e-10:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if snap_back(middle) is None else (middle, high)
    return low


def jump() -> LimitPoint:
    found = snap_back(2000.0)
    assert found is not None
    return found


#: By the beginning of a row's name: its value here, and how exact it is.
CHECKS: dict[str, tuple[Callable[[str], float], float]] = {
    "E1_": (lambda _: longest_step(500.0, linear(1e6), nothing, 0.04), 1e-6),
    "E2_": (damped_limit, 1e-5),
    "E3_": (explicit, 1e-9),
    "E4_": (lambda _: abs(runge_kutta(2)(0.5j)), 1e-11),
    "E5_": (lambda _: 2.0 * small_line()[0] / small_line()[1], 1e-11),
    "E5b": (lambda _: 2.0 / fast_root(), 1e-11),
    "C1_": (lambda name: release_gain(given(name)["wh"]), 1e-6),
    "C2_": (lambda n: float(bounced(given(n)["wh"], np.array([given(n)["theta"]]))[0]), 1e-11),
    "C3_trapezoid_bounce_max": (lambda _: bounced(1.0, np.linspace(0, 1, 2001)).max(), 1e-9),
    "C3_trapezoid_bounce_min": (lambda _: bounced(1.0, np.linspace(0, 1, 2001)).min(), 1e-6),
    "C4_": (lambda _: rigid_growth(100.0, 0.2, 0.01), 1e-9),
    "F1_": (lambda _: longest_step(1.0, nothing, linear(0.6 * 9.81 / 0.01), 3e-3), 1e-5),
    "F2_": (lambda _: flipped(), 1e-11),
    "F3_": (lambda _: longest_step(500.0, linear(1e6), nothing, 0.04), 1e-6),
    "F4_": (lambda _: crept(), 1e-9),
    "F4b": (lambda _: 1000.0 / 200.0, 1e-12),
    "F5_": (lambda _: slips().period, 1e-5),
    "F5b": (lambda _: slips().stuck, 1e-5),
    "F5c": (lambda _: slips().force, 1e-5),
    "F6_": (lambda _: box_limit(), 1e-4),
    "S1_": (lambda name: newton_factor(given(name)["n"]), 1e-9),
    "S2_Fmax": (lambda name: float(bridge().force(given(name)["v"])), 1e-11),
    "S2_DeltaB": (lambda name: float(bridge().reach(given(name)["v"])), 1e-11),
    "S3_": (lambda _: pulled(600.0, 0.02, 200, Weighted.hht(-0.05)), 1e-9),
    "S4_": (
        lambda _: 2.0 * 300.0 / float(power(SUCTION, 0.18, 1e-9)(np.array([1e-3]))[1][0]),
        1e-9,
    ),
    "S5_": (lambda _: pulled(800.0, 0.05, 1, Weighted(1.0, 0.5)), 1e-9),
    "B1_": (lambda _: threshold(), 1e-9),
    "B2_": (lambda _: jump().growth_rate(1500.0), 1e-11),
    "B3_": (lambda _: jump().jump, 1e-11),
    "B4_": (lambda _: jump().energy, 1e-11),
    "B5_": (lambda _: jump().peak_speed(1500.0), 1e-11),
}


@pytest.mark.parametrize("name", ROWS)
def test_row(name: str) -> None:
    (check,) = (c for start, c in CHECKS.items() if name.startswith(start))
    found, close = check[0](name), check[1]
    assert found == pytest.approx(float(ROWS[name]["value"]), rel=close, abs=1e-12)


def test_stick_slip_by_its_formula() -> None:
    exact = stick_slip_exact(1.0, 100.0, 0.1, 0.2 * 9.81)
    assert exact == pytest.approx(float(ROWS["F5_stick_slip_period"]["value"]), rel=1e-11)


def test_terminal_velocity_by_its_formula() -> None:
    row = ROWS["S3_terminal_velocity"]
    assert float(bridge().terminal_speed(600.0)) == pytest.approx(float(row["value"]), rel=1e-11)
    ratio = bridge().terminal_speed(660.0) / bridge().terminal_speed(600.0)
    assert ratio == pytest.approx(1.1 ** (1.0 / 0.18))
