"""Closed forms of lines in motion: added mass, towing, and a load that friction holds."""

import numpy as np
import pytest

from lines_on_seabed import straight, system_of
from moving_lines import moving_line
from podeep.scene import Damping
from podeep.seabed.normal import Winkler


def pushed(system, force):
    """Load the line with a force per length, (m,), N/m, beside its weight."""
    every = np.broadcast_to(np.array(force), (len(system.element), 1, len(force)))
    system.load = system.load + system.forces(every, 0)


@pytest.mark.parametrize("components", [2, 3])
def test_water_moves_with_a_line_across_it_alone(components):
    """a = f/m along, f/(m + ma) across, of a pipe that nothing holds."""
    mass, added, force = 100.0, 60.0, (30.0, -20.0, 40.0)[3 - components :]
    system = system_of(
        np.linspace(0.0, 10.0, 3), 5, (1e8, 1e4, 0.0), None, held={}, components=components
    )
    pushed(system, force)
    line = moving_line(system, straight(system), mass, added=added)
    for _ in range(20):
        line.step(0.05, line.time + 0.05, 1e-12, 60)
    inertia = np.array([mass, *(components - 1) * [mass + added]])
    assert line.now.velocity[:components] == pytest.approx(force / inertia, rel=1e-8)


def test_a_towed_line_hangs_at_the_critical_angle():
    """w cos a = rho/2 CD D V^2 sin^2 a, a from the horizontal: straight, at any length."""
    length, w, drag, speed = 40.0, 300.0, 80.0, 2.0
    share = w / (drag * speed**2)
    slope = np.arccos(0.5 * (np.sqrt(share**2 + 4.0) - share))
    system = system_of(np.linspace(0.0, length, 5), 7, (1e10, 1e4, w), None, held={length: "xz"})
    towards = np.array([np.cos(slope), np.sin(slope)])  # the towed end goes ahead, and is above
    q, velocity = np.zeros((2, system.field.size, 2))
    for at in system.field.edges:
        node = system.field.node(float(at))
        q[node], q[node + 1] = at * towards, towards * system.field.slope_length
        velocity[node, 0] = speed
    start = q.ravel()[system.held]

    def path(time):
        return start + np.array([speed * time, 0.0])

    line = moving_line(
        system, q.ravel(), 80.0, added=40.0, drag=drag, velocity=velocity.ravel(), path=path
    )
    for _ in range(100):
        line.step(0.1, line.time + 0.1, 1e-10, 60)
    way = (line.now.q[system.held] - line.now.q[:2]) / length
    assert np.arctan2(way[1], way[0]) == pytest.approx(slope, abs=1e-5)
    assert np.hypot(*way) == pytest.approx(1.0, abs=1e-5)  # straight


def test_friction_holds_a_steady_load_for_an_hour():
    """It creeps nowhere in steps of 20 s, where a friction by velocity would."""
    w, mu, threshold = 600.0, 0.5, 1e-3
    system = system_of(
        *(np.linspace(0.0, 10.0, 3), 5, (1e9, 1e5, w), Winkler(1e5, 1e-9)),
        held={},
        friction=mu,
        threshold=threshold,
    )
    pushed(system, (0.8 * mu * w, 0.0))
    q = straight(system)
    for at in system.field.edges:
        q[2 * system.field.node(float(at)) + 1] = -w / 1e5
    line = moving_line(system, q, 100.0, damping=Damping(5.0, 0.0))
    for _ in range(150):
        line.step(0.04, line.time + 0.04, 1e-9, 60)
    held = line.now.q[0]
    assert 0.8 * threshold < held < 2.0 * threshold
    for _ in range(180):
        line.step(20.0, line.time + 20.0, 1e-9, 60)
    assert line.now.q[0] == pytest.approx(held, abs=1e-7)
