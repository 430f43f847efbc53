"""A mass on a rough seabed in time: no creep, the explicit limit, stick-slip."""

from math import atan, pi, sqrt

import numpy as np
import pytest

from podeep.seabed.friction import Friction
from podeep.solve.integrators import CentralDifference, Weighted
from podeep.study.oscillator import history, one
from seabeds import rows

ONE_DOF = {row["name"]: float(row["value"]) for row in rows("09_*.csv")}


class Sliding:
    """A mass on the seabed as an oscillator: its friction, axial, under a steady normal force."""

    def __init__(self, law: Friction, normal: float) -> None:
        self.law, self.normal, self.at = law, normal, 0.0

    def _asked(self, q):
        return np.array([[q[0] - self.at, 0.0]]), np.array([self.normal])

    def spring(self, q):
        found = self.law.evaluate(*self._asked(q))
        return found.force[:, 0], found.by_slip[:, 0, 0]

    def commit(self, q) -> None:
        self.law.commit(*self._asked(q))
        self.at = q[0]


@pytest.mark.parametrize("kind", [{"stiffness": 1e4}, {"threshold": 0.05}])
def test_an_hour_of_steady_load_moves_nothing(kind) -> None:
    """Row F4: friction by velocity lets a line creep by 1 m/s here; this is 0 to the last bit."""
    sliding = Sliding(Friction(1, 0.5, **kind), 1000.0)
    equations = one(
        sliding.spring, 10.0, 600.0, push=lambda t: np.array([300.0]), commits=sliding.commit
    )
    start = np.array([300.0 / 1e4])
    sliding.commit(start)
    states, _ = history(Weighted.hht(-0.05), equations, start, np.zeros(1), 2.0, 1800)
    places = np.array([s.q[0] for s in states])
    assert np.abs(places - start).max() <= 1e-14 * start[0]
    assert sliding.law.dissipated == 0.0


@pytest.mark.parametrize("kind", [{"stiffness": 1e4}, {"threshold": 0.05}])
def test_a_load_that_comes_on_slides_and_then_holds_for_an_hour(kind) -> None:
    """A kick beyond the limit slides; then there is rest, and no drift."""
    sliding = Sliding(Friction(1, 0.5, **kind), 1000.0)
    equations = one(
        sliding.spring, 10.0, 600.0, push=lambda t: np.array([300.0]), commits=sliding.commit
    )
    states, _ = history(Weighted.hht(-0.05), equations, np.zeros(1), np.array([8.0]), 0.05, 400)
    slid = states[-1].q[0]
    assert slid > 0.06
    rest, _ = history(Weighted.hht(-0.05), equations, states[-1].q, states[-1].velocity, 2.0, 1800)
    assert abs(rest[-1].q[0] - slid) < 1e-12


def test_the_explicit_limit_of_elastic_slip() -> None:
    """Row F3: central differences on the friction spring, 2 sqrt(m/Kt)."""
    limit = ONE_DOF["F3_elastic_slip_dt"]
    for share, bounded in ((0.99, True), (1.01, False)):
        sliding = Sliding(Friction(1, 1.0, stiffness=1e6), 1e12)
        equations = one(sliding.spring, 500.0, commits=sliding.commit)
        states, _ = history(
            CentralDifference(), equations, np.array([1e-6]), np.zeros(1), share * limit, 300
        )
        assert bool(max(abs(s.q[0]) for s in states) < 1e-4) is bounded


def test_stick_slip_has_its_period_and_its_largest_force() -> None:
    """Rows F5: static friction once the pipe sticks, kinetic while it slides, on a stiff spring."""
    m, k, V, N, static, kinetic = 1.0, 100.0, 0.1, 9.81, 0.6, 0.4
    law = Friction(1, 1.0, stiffness=1e6)
    sliding = Sliding(law, static * N)
    # the pulling spring k moves with V from just below the first slip on
    h, early, starts, force, step = 2e-4, 0.58, [], 0.0, 0

    def spring(q):
        friction, slope = sliding.spring(q)
        return friction + k * q, slope + k

    def commit(q) -> None:
        nonlocal force, step
        before, lost = sliding.at, law.dissipated[0]
        sliding.commit(q)
        step += 1
        force = max(force, k * (V * (early + step * h) - q[0]))
        slides = law.dissipated[0] > lost and q[0] > before
        if slides and sliding.normal == static * N:
            starts.append(step * h)
        sliding.normal = (kinetic if slides else static) * N

    equations = one(spring, m, push=lambda t: np.array([k * V * (early + t)]), commits=commit)
    rest = np.array([k * V * early / (1e6 + k)])
    sliding.commit(rest)
    history(Weighted(1.0, 0.5), equations, rest, np.zeros(1), h, 4200)
    assert len(starts) == 2
    assert starts[1] - starts[0] == pytest.approx(ONE_DOF["F5_stick_slip_period"], rel=1e-3)
    assert force == pytest.approx(ONE_DOF["F5c_max_spring_force"], rel=1e-3)
    D, w = (static - kinetic) * N / k, sqrt(k / m)
    period = 2 * D / V + (2 * pi - 2 * atan(D * w / V)) / w
    assert period == pytest.approx(ONE_DOF["F5_stick_slip_period"], rel=1e-11)
