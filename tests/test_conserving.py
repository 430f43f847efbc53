"""The method that keeps energy: on linear springs, on the seabed, with damping and given motion."""

import numpy as np
import pytest

from one_dof import bouncing
from podeep.arrays import Array
from podeep.seabed.normal import Winkler, mean_force
from podeep.solve.conserving import Conserving
from podeep.solve.integrators import Weighted
from podeep.study.oscillator import Oscillators, history, linear, nothing, one
from seabeds import SEABEDS

G, K = 9.81, 1e4


class Mean:
    """A bed as the spring of oscillators by its mean force since the last commit."""

    def __init__(self, bed: Winkler, start: Array) -> None:
        self.bed, self.at = bed, start.copy()

    def law(self, z: Array) -> tuple[Array, Array]:
        return mean_force(self.bed, self.at, z)

    def commit(self, z: Array) -> None:
        self.at = np.array(z)


def bounces(stiff: float, time: float, tolerance: float = 1e-4) -> Array:
    """Energy over that at the start of a mass of 1 kg that falls 0.1 m on 1e4 N/m; omega h."""
    start, h = np.array([-0.1]), 1e-2 * stiff
    mean = Mean(Winkler(K, tolerance), start)
    equations = one(mean.law, push=lambda t: np.array([G]), commits=mean.commit)
    states, _ = history(Conserving(), equations, start, np.zeros(1), h, round(time / h))
    z, v = (np.array([getattr(s, n)[0] for s in states]) for n in ("q", "velocity"))
    return (0.5 * v**2 - G * z + mean.bed.energy(z)) / (0.1 * G)


@pytest.mark.parametrize(("stiff", "time"), [(0.2, 4.0), (0.5, 10.0), (1.0, 20.0)])
def test_a_bouncing_mass_keeps_its_energy(stiff: float, time: float) -> None:
    energy = bounces(stiff, time)
    assert energy.max() <= 1.0 + 1e-11
    assert energy.min() >= 1.0 - 1e-11


@pytest.mark.parametrize("stiff", [5.0, 50.0])
def test_it_does_so_with_steps_that_do_not_resolve_the_contact(stiff: float) -> None:
    energy = bounces(stiff, 500 * 1e-2 * stiff)
    assert np.abs(energy - 1.0).max() < 1e-10


def test_the_trapezoidal_rule_gains_where_this_method_does_not() -> None:
    """The default does too, 1 to 3.5 times at omega h 1: see tests of the map of integrators."""
    assert bouncing(1.0, 0.1, Weighted(), 20.0) > 1.5


def test_on_a_linear_spring_it_is_the_trapezoidal_rule() -> None:
    """Whose mean force is that of the mean displacement."""
    start, speed, h = np.array([0.3]), np.array([-0.2]), 0.7
    at = start.copy()

    def mean(q):
        return 0.5 * 4.0 * (q + at), np.full_like(q, 2.0)

    def commit(q) -> None:
        at[:] = q

    push = lambda t: np.array([np.sin(t)])  # noqa: E731
    ours = one(mean, 2.0, 0.5, push=push, commits=commit)
    plain = one(linear(4.0), 2.0, 0.5, push=push)
    a, _ = history(Conserving(), ours, start, speed, h, 30)
    b, _ = history(Weighted(), plain, start, speed, h, 30)
    np.testing.assert_allclose([s.q for s in a], [s.q for s in b], atol=1e-12)
    np.testing.assert_allclose([s.velocity for s in a], [s.velocity for s in b], atol=1e-12)


def test_it_is_of_second_order() -> None:
    def end(steps: int) -> float:
        h, mean = 2.0 / steps, Mean(Winkler(3.0, 5.0), np.array([-0.5]))
        equations = one(mean.law, damping=0.1, push=lambda t: np.array([1.0 + t]))
        equations.commits = mean.commit
        states, _ = history(Conserving(), equations, mean.at, np.zeros(1), h, steps)
        return float(states[-1].q[0])

    exact = end(4096)
    errors = [abs(end(n) - exact) for n in (16, 32, 64)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.15)


def test_a_held_mass_follows_its_motion() -> None:
    """And a drag is met at the mean velocity of a step."""

    def driven(t: float):
        return np.array([t * t]), np.array([2.0 * t]), np.array([2.0])

    equations = Oscillators(
        np.ones(2), np.zeros(2), nothing, drag=lambda v: (2.0 * v, np.full_like(v, 2.0)),
        held=np.array([1]), driven=driven,
    )  # fmt: skip
    states, _ = history(Conserving(), equations, np.zeros(2), np.array([1.0, 0.0]), 0.1, 10)
    assert states[-1].q[1] == pytest.approx(1.0)
    assert states[-1].velocity[1] == pytest.approx(2.0)
    assert states[-1].velocity[0] == pytest.approx((0.9 / 1.1) ** 10)


@pytest.mark.parametrize("name", [n for n in SEABEDS if "hyperbolic" not in n])
@pytest.mark.parametrize("h", [2e-3, 0.02])
def test_bouncing_on_a_seabed_that_remembers_never_gains(name: str, h: float) -> None:
    """The force at the end of a step, which takes at least what the seabed stores."""
    law, mass, weight = SEABEDS[name](), 100.0, 500.0
    equations = Oscillators(
        np.full(3, mass), np.zeros(3), law.evaluate, lambda t: np.full(3, weight),
        commits=law.commit,
    )  # fmt: skip
    start = np.array([-0.3, -0.1, -0.02])
    states, _ = history(Conserving(), equations, start, np.zeros(3), h, 200)
    first = -weight * start
    for s in states:
        moving = 0.5 * mass * s.velocity**2 - weight * s.q
        assert (moving <= first * (1.0 + 1e-9)).all()
