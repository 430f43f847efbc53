"""Lines in motion: closed forms, energy, order of the error, drag, contact and friction."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import jn_zeros

from lines_on_seabed import LIMITS, hung, straight, system_of
from moving_lines import go, moving_line, stored
from podeep.line.rod import strained
from podeep.line.rod_step import material, mean_strained
from podeep.line.statics import laid
from podeep.scene import Damping
from podeep.seabed.normal import Winkler
from podeep.solve.conserving import Conserving
from podeep.solve.integrators import Bathe, CentralDifference, Rosenbrock, Weighted
from podeep.solve.newton import largest
from podeep.solve.stage import NoBalance

EA, EI = 5e6, 700.0
numbers = st.floats(-2.0, 2.0).map(lambda x: round(x, 6))


def moved(system, component, way):
    """Unknowns of a way of the whole line along x (0) or z (1)."""
    found = np.zeros((system.field.size, 2))
    for at in system.field.edges:
        found[system.field.node(float(at)), component] = way
    return found.ravel()


def energy(a, b):
    A, B, C = (np.einsum("ni,ni->n", x, y) for x, y in ((a, a), (b, b), (a, b)))
    return 0.5 * EA * (np.sqrt(A) - 1.0) ** 2 + 0.5 * EI * (B / A - (C / A) ** 2)


def step_of(seed, m, n=6):
    """A step of a rod at n points that are hardly stretched: (a0, b0), (a1, b1)."""
    random = np.random.default_rng(seed)
    a0, a1 = random.normal(size=(2, n, m))
    a0, a1 = (a / np.linalg.norm(a, axis=1)[:, None] for a in (a0, a0 + 0.7 * a1))
    stretch = 1.0 + 1e-3 * random.normal(size=(2, n, 1))
    return (a0 * stretch[0], random.normal(size=(n, m))), (
        a1 * stretch[1],
        random.normal(size=(n, m)),
    )


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10_000), m=st.sampled_from([2, 3]))
def test_the_mean_force_of_a_step_does_the_work_that_the_rod_stores(seed, m):
    start, end = step_of(seed, m)
    each = np.full(len(start[0]), 1.0)
    found = mean_strained(start, end, EA * each, EI * each).gradient
    way = np.stack(end, axis=1) - np.stack(start, axis=1)
    stored = energy(*end) - energy(*start)
    work = np.einsum("nki,nki->n", found, way)
    assert work == pytest.approx(stored, abs=1e-13 * np.abs(found * way).sum())


@pytest.mark.parametrize("m", [2, 3])
def test_its_derivatives_are_those_of_the_force(m):
    start, end = step_of(3, m)
    each = np.full(len(start[0]), 1.0)

    def force(x):
        return mean_strained(start, (x[:, 0], x[:, 1]), EA * each, EI * each).gradient

    x, d = np.stack(end, axis=1), 1e-6
    slopes = np.zeros((len(x), 2, m, 2, m))
    for k in range(2):
        for i in range(m):
            move = np.zeros_like(x)
            move[:, k, i] = d
            slopes[..., k, i] = (force(x + move) - force(x - move)) / (2.0 * d)
    found = mean_strained(start, end, EA * each, EI * each).hessian
    assert found == pytest.approx(slopes, abs=1e-8 * np.abs(slopes).max())


def test_on_no_way_it_is_the_force_of_the_rod_and_half_its_derivative():
    start, _ = step_of(1, 3)
    each = np.full(len(start[0]), 1.0)
    found = mean_strained(start, start, EA * each, EI * each)
    rod = strained(*start, EA * each, EI * each)
    assert found.gradient == pytest.approx(rod.gradient, rel=1e-12, abs=1e-9)
    assert 2.0 * found.hessian == pytest.approx(rod.hessian, rel=1e-11, abs=1e-6)


@pytest.mark.parametrize("m", [2, 3])
def test_turning_a_rod_meets_no_material_stiffness(m):
    (a, b), _ = step_of(2, m)
    random, each = np.random.default_rng(0), np.full(len(a), 1.0)
    if m == 2:
        turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
        turned = np.stack([a @ turn, b @ turn], axis=1)
    else:
        w = random.normal(size=a.shape)
        w -= a * np.einsum("ni,ni->n", a, w)[:, None] / np.einsum("ni,ni->n", a, a)[:, None]
        turned = np.stack([np.cross(w, a), np.cross(w, b)], axis=1)
    found = material(a, b, EA * each, EI * each)
    assert np.einsum("naibj,nbj->nai", found, turned) == pytest.approx(0.0, abs=1e-6)
    assert np.einsum("naibj,nbj->nai", found, np.stack([a, b], axis=1))[:, 0] == pytest.approx(
        EA * a, rel=1e-9
    )


# --- closed forms ---------------------------------------------------------------------------------


def period_of(times, values):
    """Of a swing, by the first and last time that it passes its mean upwards."""
    values = values - values.mean()
    up = np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0))
    at = times[up] - values[up] * np.diff(times)[up] / np.diff(values)[up]
    return (at[-1] - at[0]) / (len(at) - 1)


def test_a_hanging_chain_swings_as_bessel_says():
    """omega = j01/2 sqrt(g/L), the first mode of a heavy chain that hangs from one end."""
    length, mass, g = 20.0, 50.0, 9.81
    system = system_of(
        np.linspace(0.0, length, 6), 7, (1e9, 1e-3, mass * g), None, held={length: "xz"}
    )
    s = system.field.edges
    q, velocity = np.zeros((2, system.field.size, 2))
    for at in s:
        node = system.field.node(float(at))
        q[node, 1], q[node + 1, 1] = at - length, system.field.slope_length
    start = laid(system, q.ravel(), LIMITS).q
    shape = 1.0 - s / length  # near the mode: another one's share has another period
    for at, value in zip(s, shape, strict=True):
        node = system.field.node(float(at))
        velocity[node, 0], velocity[node + 1, 0] = value, -system.field.slope_length / length
    line = moving_line(system, start, mass, velocity=0.01 * velocity.ravel())
    end, times, h = [], [], 0.02
    for _ in range(1500):
        line.step(h, line.time + h, 1e-8, 60)
        times.append(line.time)
        end.append(line.now.q[0])
    spectrum = 2.0 * np.pi / period_of(np.array(times), np.array(end))
    assert spectrum == pytest.approx(0.5 * jn_zeros(0, 1)[0] * np.sqrt(g / length), rel=3e-3)


@pytest.mark.parametrize(("number", "EI"), [(1, 1e-3), (2, 1e-3), (1, 5e6)])
def test_a_taut_line_swings_as_a_string_or_a_beam(number, EI):
    """omega^2 = (n pi/L)^2 (T + EI (n pi/L)^2)/(m + ma) of a beam between hinges, under tension."""
    length, mass, added, T, EA = 30.0, 80.0, 40.0, 4e5, 1e9
    system = system_of(
        np.linspace(0.0, length, 7), 7, (EA, EI, 0.0), None, held={0.0: "xz", length: "xz"}
    )
    stretch = 1.0 + T / EA
    q = straight(system) * stretch
    k, velocity = number * np.pi / length, np.zeros((system.field.size, 2))
    for at in system.field.edges:
        node = system.field.node(float(at))
        velocity[node, 1] = np.sin(k * at)
        velocity[node + 1, 1] = k * np.cos(k * at) * system.field.slope_length
    omega = k * np.sqrt((T / stretch + EI / stretch**2 * k**2) / (mass + added))
    h = 2.0 * np.pi / omega / 100.0
    amplitude = 1e-4
    line = moving_line(system, q, mass, added=added, velocity=amplitude * omega * velocity.ravel())
    middle = 2 * (system.field.node(length / 6.0)) + 1
    height = []
    for _ in range(300):
        line.step(h, line.time + h, 1e-9, 60)
        height.append(line.now.q[middle])
    found = 2.0 * np.pi / period_of(h * np.arange(300), np.array(height))
    # the trapezoidal rule lengthens the period by (omega h)^2/12
    assert found == pytest.approx(omega * (1.0 - (omega * h) ** 2 / 12.0), rel=2e-5)


def test_a_pipe_that_nothing_holds_sinks_at_its_terminal_speed():
    """w = rho/2 CD D v^2, and v = vt tanh(w t/(vt (m + ma))) from rest."""
    w, mass, added, drag = 300.0, 100.0, 60.0, 90.0
    system = system_of(np.linspace(0.0, 10.0, 3), 5, (1e8, 1e4, w), None, held={})
    line = moving_line(system, straight(system), mass, added=added, drag=drag)
    speed, h = np.sqrt(w / drag), 0.01
    for _ in range(100):
        line.step(h, line.time + h, 1e-10, 60)
        expected = -speed * np.tanh(w * line.time / (speed * (mass + added)))
        assert line.now.velocity[1] == pytest.approx(expected, rel=2e-4)


# --- energy ---------------------------------------------------------------------------------------


def pendulum(method=None, components=2):
    """A pipe that falls from the horizontal, hinged at one end, in steps that turn it far."""
    system = system_of(
        np.linspace(0.0, 10.0, 4),
        5,
        (2e8, 3e4, 800.0),
        None,
        held={0.0: "xz" if components == 2 else "xyz"},
        components=components,
    )
    q = straight(system)
    velocity = np.zeros_like(q)
    if components == 3:
        for at in system.field.edges:
            node = 3 * system.field.node(float(at))
            velocity[node + 1] = 0.5 * at
            velocity[node + 4] = 0.5 * system.field.slope_length
    return moving_line(system, q, 100.0, velocity=velocity, method=method)


@pytest.mark.parametrize("components", [2, 3])
def test_large_rotations_keep_their_energy(components):
    line = pendulum(components=components)
    begin = stored(line)
    swing = 800.0 * 10.0 * 5.0  # weight over the height that the middle falls, J
    found = np.array(go(line, 0.05, 400, 1e-10))
    assert np.abs(found - begin).max() < 1e-7 * swing
    assert line.reach > 10.0
    assert line.imbalance() < 1e-7


@pytest.mark.parametrize(
    "method", [Rosenbrock(), Bathe(), Weighted.hht(-0.05), Weighted.generalised_alpha(0.8)]
)
def test_every_method_follows_the_same_fall(method):
    one, other = pendulum(), pendulum(method)
    for line in (one, other):
        go(line, 0.01, 40)
    assert largest(one.now.q - one.begin) > 0.5
    assert other.now.q == pytest.approx(one.now.q, abs=4e-3)
    assert other.work == pytest.approx(one.work, rel=2e-3)
    assert other.now.q[other.equations.held] == pytest.approx(0.0, abs=1e-12)


def test_a_step_beyond_stability_finds_no_balance():
    """It is given up before its numbers overflow."""
    line = pendulum(CentralDifference())
    with pytest.raises(NoBalance):
        go(line, 5.0, 5)
    assert largest(line.now.q) < 1e4


def test_the_trapezoidal_rule_does_not():
    """Why the mean force of a step is the default: at this step plain Newmark gains or fails."""
    line = pendulum(Weighted())
    begin, swing = stored(line), 800.0 * 10.0 * 5.0
    found = np.array(go(line, 0.05, 100, 1e-8))
    assert np.abs(found - begin).max() > 1e-3 * swing


def dropped(method):
    """A pipe dropped on a stiff seabed from 0.5 m, 20 s of bouncing in coarse steps."""
    bed = Winkler(2e5, 1e-3)
    system = system_of(np.linspace(0.0, 12.0, 4), 5, (1e8, 1e5, 600.0), bed, held={})
    q = straight(system) + moved(system, 1, 0.5)
    system.bed.level = 0.0
    line = moving_line(system, q, 80.0, method=method)
    return stored(line), np.array(go(line, 0.02, 1000, 1e-10))


def test_bouncing_gains_no_energy_with_the_default():
    begin, found = dropped(Conserving())
    assert np.abs(found - begin).max() < 1e-6 * begin


def test_bouncing_gains_energy_with_the_trapezoidal_rule():
    begin, found = dropped(Weighted())
    assert found.max() > 1.2 * begin


@pytest.mark.parametrize("method", [Conserving(), Weighted.hht(-0.05)])
def test_the_error_falls_with_the_square_of_the_step(method):
    """A catenary whose end is moved evenly, with drag and damping."""
    system = system_of(
        np.linspace(0.0, 60.0, 7), 5, (1e8, 1e4, 400.0), None, held={0.0: "xz", 60.0: "xz"}
    )
    start = laid(system, hung(system, 50.0, 20.0), LIMITS).q
    held = start[system.held]

    def path(time):
        return held + np.array([0.0, 0.0, 0.0, 0.5]) * (1.0 - np.cos(1.5 * time)) ** 2

    def at_end(count):
        damping = Damping(0.02, 1e-3)
        line = moving_line(
            system, start, 50.0, added=30.0, drag=100.0, method=method, damping=damping, path=path
        )
        h = 4.0 / count
        for _ in range(count):
            line.step(h, line.time + h, 1e-10, 60)
        return line.now.q

    ends = [at_end(count) for count in (80, 160, 320)]
    order = np.log2(np.abs(ends[0] - ends[1]).max() / np.abs(ends[1] - ends[2]).max())
    assert order == pytest.approx(2.0, abs=0.1)


def test_damping_and_drag_take_what_is_missing():
    line = pendulum()
    line.equations.damping = Damping(0.0, 1e-3)
    line.equations.commit(line.now.q, 1.0)
    found = go(line, 0.02, 200)
    assert np.all(np.diff(found) <= 1e-9 * abs(found[0]))


def test_a_pipe_pushed_along_the_seabed_stops_where_friction_has_taken_its_energy():
    """v^2/(2 mu g) on the way, whatever the step."""
    mass, w, mu, speed = 100.0, 600.0, 0.5, 1.0
    bed = Winkler(1e5, 1e-9)
    system = system_of(
        np.linspace(0.0, 10.0, 3), 5, (1e9, 1e5, w), bed, held={}, friction=mu, threshold=1e-5
    )
    q = straight(system)
    q += moved(system, 1, -w / 1e5)
    line = moving_line(system, q, mass, velocity=moved(system, 0, speed))
    for _ in range(400):
        line.step(0.005, line.time + 0.005, 1e-8, 60)
    way = speed**2 * mass / (2.0 * mu * w)
    assert line.now.q[0] == pytest.approx(way, rel=2e-3)
    assert line.dissipated() == pytest.approx(0.5 * mass * 10.0 * speed**2, rel=2e-3)
