"""Orders, limits and invariants of the methods of time integration, on oscillators."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from podeep.arrays import Array
from podeep.solve.conserving import Conserving
from podeep.solve.equations import State
from podeep.solve.integrators import (
    Bathe,
    CentralDifference,
    Integrator,
    Rosenbrock,
    Weighted,
)
from podeep.solve.stage import Effort, Patience
from podeep.study.oscillator import MeanLaw, Oscillators, history, linear, one, power

METHODS = {
    "NEWMARK": Weighted(),
    "HHT": Weighted.hht(-0.05),
    "HHT -0.3": Weighted.hht(-0.3),
    "GALPHA 0.8": Weighted.generalised_alpha(0.8),
    "GALPHA 0": Weighted.generalised_alpha(0.0),
    "BATHE": Bathe(),
    "ROS2": Rosenbrock(),
    "CENTRAL": CentralDifference(),
    "CONSERVE": Conserving(),
}
every_method = pytest.mark.parametrize("name", METHODS)


def duffing() -> Oscillators:
    """A hardening spring with damping under a push that starts with a slope."""
    return one(
        lambda u: (4.0 * u + 10.0 * u**3, 4.0 + 30.0 * u**2),
        damping=0.3,
        push=lambda t: np.array([np.sin(1.7 * t) + 0.3]),
    )


def end_of(method: Integrator, steps: int) -> tuple[float, float]:
    equations, start = duffing(), np.array([0.2])
    if method.mean:
        mean = MeanLaw(equations.spring, start)
        equations.spring, equations.commits = mean, mean.commit
    states, _ = history(method, equations, start, np.array([-0.5]), 3.0 / steps, steps)
    return float(states[-1].q[0]), float(states[-1].velocity[0])


@cache
def true_end() -> Array:
    """Of the Duffing oscillator, by SciPy's method of order 8."""
    found = solve_ivp(
        lambda t, y: (
            y[1],
            np.sin(1.7 * t) + 0.3 - 0.3 * y[1] - 4.0 * y[0] - 10.0 * y[0] ** 3,
        ),
        *((0.0, 3.0), (0.2, -0.5), "DOP853"),
        rtol=1e-12,
        atol=1e-14,
    )
    return np.asarray(found.y[:, -1])


@every_method
def test_observed_order(name: str) -> None:
    method, true = METHODS[name], true_end()
    errors = [np.abs(np.array(end_of(method, n)) - true).max() for n in (200, 400, 800)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(method.order, abs=0.15)


@pytest.mark.parametrize("name", [n for n in METHODS if n != "ROS2"])
def test_a_driven_mass_moves_as_it_is_driven(name: str) -> None:
    """Two masses, the first of them driven: it has the motion that it is given."""

    def driven(t: float) -> tuple[Array, Array, Array]:
        return (
            np.array([0.1 * np.sin(2.0 * t)]),
            np.array([0.2 * np.cos(2.0 * t)]),
            np.array([-0.4 * np.sin(2.0 * t)]),
        )

    equations = Oscillators(np.ones(2), np.zeros(2), linear(9.0), held=np.array([0]), driven=driven)
    states, _ = history(METHODS[name], equations, np.zeros(2), np.zeros(2), 0.05, 40)
    times = np.array([s.time for s in states])
    assert [s.q[0] for s in states] == pytest.approx(0.1 * np.sin(2.0 * times), abs=1e-14)


@pytest.mark.parametrize("radius", [1.0, 0.8, 0.5, 0.0])
def test_generalised_alpha_has_the_radius_that_it_is_given(radius: float) -> None:
    """Of motions much faster than the step (Chung and Hulbert 1993)."""
    k, method, effort = 1e8, Weighted.generalised_alpha(radius), Effort()
    basis = np.eye(3)  # a start with displacement, velocity or acceleration alone
    equations = Oscillators(np.ones(3), np.zeros(3), linear(k))
    start = State(0.0, basis[0], basis[1], basis[2], k * basis[0])
    end = method.step(equations, start, 1.0, Patience(1e-14, 100), effort)
    grown = np.linalg.eigvals(np.array([end.q, end.velocity, end.acceleration]))
    assert np.abs(grown).max() == pytest.approx(radius, abs=2e-2)


def test_average_acceleration_keeps_the_energy_of_a_linear_spring() -> None:
    k, m = 1e6, 500.0
    states, _ = history(
        METHODS["NEWMARK"], one(linear(k), m), np.array([0.1]), np.zeros(1), 0.1, 500
    )
    energy = np.array([0.5 * (m * s.velocity[0] ** 2 + k * s.q[0] ** 2) for s in states])
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-12


@pytest.mark.parametrize(("share", "stable"), [(0.99, True), (1.01, False)])
def test_limit_of_central_differences(share: float, stable: bool) -> None:
    """E1 of the one-degree tests: 2 / omega = 0.04472135955 s for 500 kg on 1 MN/m."""
    equations, method = one(linear(1e6), 500.0), CentralDifference()
    states, _ = history(method, equations, np.array([1e-3]), np.zeros(1), 1e-4, 1)
    limit = method.limit(equations)
    assert limit == pytest.approx(0.04472135955, rel=1e-9)
    states, _ = history(method, equations, np.array([1e-3]), np.zeros(1), share * limit, 400)
    grown = max(abs(s.q[0]) for s in states) / 1e-3
    assert bool(grown < 10.0) is stable


def test_suction_of_a_power_of_velocity_from_rest() -> None:
    """300 kg pulled by 800 N against a v^0.18 come to their terminal velocity, (P / a)^(1 / n).

    Newton's step alone would multiply v by -4.6: it is the search that gets away.
    """
    alpha, n = 1.12 * 0.3 * 5000.0 / 0.3**0.18, 0.18
    drag = power(alpha, n, 1e-6)
    equations = one(
        lambda u: (0.0 * u, 0.0 * u), 300.0, drag=drag, push=lambda t: np.array([800.0])
    )
    for name in ("NEWMARK", "HHT", "GALPHA 0", "BATHE"):
        states, _ = history(METHODS[name], equations, np.zeros(1), np.zeros(1), 0.05, 60, 1e-9)
        terminal = (800.0 / alpha) ** (1.0 / n)
        assert states[-1].velocity[0] == pytest.approx(terminal, rel=1e-6), name


@pytest.mark.parametrize(
    ("gamma", "beta", "order"), [(0.5, 0.25, 2), (0.6, 0.31, 1), (1.0, 0.5, 1)]
)
def test_newmark_with_numerical_damping_is_of_order_1(
    gamma: float, beta: float, order: int
) -> None:
    method, true = Weighted(gamma, beta), true_end()
    errors = [np.abs(np.array(end_of(method, n)) - true).max() for n in (400, 800)]
    assert method.order == order
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)
