"""One mass on a spring that yields, rubs, or has a gap: published and exact histories.

CF17 (elastic, then plastic; ANSYS VM80 after Biggs), CF19 (Coulomb's decay; ANSYS VM73, code_aster
SDND100), CF24 (two stiffnesses, and a gap).
"""

from math import pi, sqrt

import numpy as np
import pytest

from closed_forms import DATA
from podeep.arrays import Array
from podeep.scene import Dynamics
from podeep.soil.masing import Masing
from podeep.soil.polyline import Polyline
from podeep.solve.dynamics import integrator
from podeep.solve.integrators import Bathe, Integrator, Weighted
from podeep.study.oscillator import Law, Oscillators, history

METHODS = {"default": integrator(Dynamics(0.0, 1.0)), "NEWMARK": Weighted(), "BATHE": Bathe()}
every_method = pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)


def rows(name: str, case: str = "") -> dict[str, Array]:
    data = np.genfromtxt(
        DATA / f"{name}.csv", delimiter=",", names=True, dtype=None, encoding="utf-8"
    )
    if case:
        data = data[data["case"] == case]
    return {field: data[field] for field in data.dtype.names or ()}


def yielding(stiffness: float, limit: float) -> Masing:
    """Elastic, then plastic, both ways."""
    points = ((0.0, 0.0), (1.0, 1.0))
    return Masing(Polyline.through(points, limit, limit / stiffness), 1)


def on_memory(
    memory: Masing, mass: float, push: float = 0.0, spring: Law | None = None
) -> Oscillators:
    def force(u: Array) -> tuple[Array, Array]:
        found, slope = memory.evaluate(u)
        if spring is None:
            return found, slope
        more, steeper = spring(u)
        return found + more, slope + steeper

    return Oscillators(
        np.array([mass]),
        np.zeros(1),
        force,
        push=lambda t: np.array([push]),
        commits=memory.commit,
    )


def path(
    method: Integrator, equations: Oscillators, start: tuple[float, float], h: float, end: float
) -> tuple[Array, Array]:
    """Times and displacements."""
    q, v = (np.array([x]) for x in start)
    states, _ = history(method, equations, q, v, h, round(end / h), 1e-9)
    return np.array([s.time for s in states]), np.array([s.q[0] for s in states])


@every_method
def test_cf17_a_force_that_is_put_on_suddenly(method: Integrator) -> None:
    """VM80: 1e-3 of the largest displacement with steps of a hundredth of the period."""
    k, fy, m, force = 14605.5780596, 201.443053713, 4.53578503288, 133.446648458
    exact = rows("CF17_step_history")
    h = 2.0 * pi * sqrt(m / k) / 100.0
    t, u = path(method, on_memory(yielding(k, fy), m, force), (0.0, 0.0), h, exact["t_s"][-1])
    found = np.interp(exact["t_s"], t, u)
    within = exact["t_s"] <= t[-1]
    # the history at other times: steps of T/100 are read linearly, which takes 5e-4, and their
    # period is 3e-4 too long
    miss = np.abs(found - exact["u_m"])[within].max() / exact["u_m"].max()
    assert u.max() == pytest.approx(0.804333536131 * 0.0254, rel=1e-3)
    assert miss < 4e-3


@every_method
@pytest.mark.parametrize("row", range(3))
def test_cf17_ductility(method: Integrator, row: int) -> None:
    """Period 1 s, unit mass: ductility under a step of force, and from a velocity."""
    k, uy = (2.0 * pi) ** 2, 1.0
    table = rows("CF17_step")
    share, mu = table["F_over_Fy"][row], table["mu"][row]
    _, u = path(method, on_memory(yielding(k, k * uy), 1.0, share * k), (0.0, 0.0), 0.01, 1.5)
    assert u.max() == pytest.approx(mu, rel=1e-3)
    table = rows("CF17_velocity")
    v, mu = table["v0_over_omega_uy"][row] * 2.0 * pi, table["mu"][row]
    _, u = path(method, on_memory(yielding(k, k * uy), 1.0), (0.0, v), 0.01, 1.5)
    assert u.max() == pytest.approx(mu, rel=1e-3)


@every_method
@pytest.mark.parametrize("case", ["VM73", "SDND100"])
def test_cf19_coulomb_decay(method: Integrator, case: str) -> None:
    """Amplitudes fall by 2 F / k each half cycle; the mass stops where the spring cannot move it.

    Friction slips elastically over a thousandth of its way, which is what a spring in its place
    costs.
    """
    if case == "VM73":
        m, k, friction, start, scale = 4.53696464369, 5253.80505739, 8.34041552861, -0.0254, 0.0254
        peaks = rows("CF19_peaks")["u_in"] * scale
    else:
        m, k, friction, start = 1.0, 1e4, 1.0, 0.85e-3
        peaks = rows("CF19_code_aster_SDND100")["displacement_m"]
    rubbing = yielding(1e3 * k, friction)
    equations = on_memory(rubbing, m, spring=lambda u: (k * u, np.full_like(u, k)))
    half = pi * sqrt(m / k)
    rubbing.commit(np.array([start]))  # it starts slipping, as it was pulled there
    rubbing.commit(np.array([start]) * (1.0 - 1e-3))
    h = half / 400.0
    t, u = path(method, equations, (start, 0.0), h, half * (len(peaks) - 0.5))
    for number, peak in enumerate(peaks[1:-1], start=1):
        near = np.abs(t - number * half) < 0.3 * half
        found = u[near][np.abs(u[near]).argmax()]
        assert found == pytest.approx(peak, abs=2e-3 * abs(start)), number


@every_method
@pytest.mark.parametrize("case", ["bilinear", "gap"])
def test_cf24_two_stiffnesses_and_a_gap(method: Integrator, case: str) -> None:
    exact = rows("CF24_history", case)
    m = 1000.0

    def bilinear(u: Array) -> tuple[Array, Array]:
        k = np.where(u > 0.0, 400e3, 100e3)
        return k * u, k

    def gap(u: Array) -> tuple[Array, Array]:
        beyond = np.maximum(np.abs(u) - 0.02, 0.0)
        return 400e3 * np.copysign(beyond, u), np.where(beyond > 0.0, 400e3, 0.0)

    equations = Oscillators(np.array([m]), np.zeros(1), bilinear if case == "bilinear" else gap)
    end = float(exact["t_s"][-1])
    t, u = path(method, equations, (0.0, 0.5), end / 4000.0, end)
    miss = np.abs(np.interp(exact["t_s"], t, u) - exact["u_m"]).max()
    assert miss < 1e-3 * np.abs(exact["u_m"]).max()
