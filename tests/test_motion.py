"""Foundations in motion against closed forms, and the balance of their energy."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
from scipy.linalg import solve as dense_solve

from closed_forms import DATA
from moving_piles import MASS, elastic_pile, head_of, motion_of, start_of, swaying_pile
from podeep.arrays import Array
from podeep.beam.band import dense
from podeep.motion import Damping, Dynamics, Harmonic, Start, TimeSeries
from podeep.scene import Displacement, Load, Scene
from podeep.solve.drive import drive
from podeep.solve.integrators import Weighted
from podeep.solve.moving import Moving

PUSH = Load("PUSH", 1, 0.0, (1e6, 0.0, 0.0), (0.0, 0.0, 0.0))


def impedance(equations: Moving, frequency: float, places: list[int]) -> Array:
    """Dynamic stiffness of unknowns: the inverse of what they move by under unit forces."""
    w = 2.0 * pi * frequency
    equations.internal(np.zeros(equations.system.size), None)
    equations.system.reached = equations._weighed.system.reached
    stiffness = dense(equations.system.tangent())
    matrix = stiffness + 1j * w * dense(equations.damping) - w**2 * dense(equations.mass)
    unit = np.zeros((len(matrix), len(places)))
    unit[places, range(len(places))] = 1.0
    return np.asarray(np.linalg.inv(dense_solve(matrix, unit)[places]))


def test_cf21_dynamic_stiffness_of_a_head_across() -> None:
    """A semi-infinite beam on springs and dashpots: 1e-4 up to 20 Hz with 40 m."""
    scene = elastic_pile(40.0, 40e6, Dynamics(0.0, 1.0), (PUSH,), elements=40)
    scene = replace(scene, ground=replace(scene.ground, dashpots={1: 400e3}))
    scene = replace(scene, harmonics=(Harmonic("PUSH", 1.0),))
    moving = motion_of(scene).body.lateral
    length = moving.system.field.slope_length
    table = np.genfromtxt(DATA / "CF21_lateral.csv", delimiter=",", names=True)
    for row in table[table["f_Hz"] <= 20.0]:
        k = impedance(moving, row["f_Hz"], [0, 1])
        for name, found in (
            ("Khh", k[0, 0]),
            ("Khr", -k[0, 1] * length),
            ("Krr", k[1, 1] * length**2),
            ("Kfree", impedance(moving, row["f_Hz"], [0])[0, 0]),
        ):
            exact = row[f"{name}_re"] + 1j * row[f"{name}_im"]
            exact = exact if name != "Khr" else exact * np.sign(exact.real * found.real)
            assert abs(found - exact) < 1e-4 * abs(exact), (row["f_Hz"], name)


def test_a_rigid_tube_on_springs_swings_as_one_mass() -> None:
    """Every point at 1 m/s from rest: u = sin(w t) / w with w^2 = k / m, whatever the bending."""
    k, w = 20e6, sqrt(20e6 / MASS)
    scene = elastic_pile(30.0, k, Dynamics(0.0, 1.0), (replace(PUSH, force=(0.0, 1e-9, 0.0)),))
    motion = motion_of(replace(scene, harmonics=(Harmonic("PUSH", 1.0),)))
    field = motion.body.model.lateral.system.field
    rigid = np.zeros(field.size)
    rigid[field.dofs[:, [0, -2]]] = 1.0
    motion.lateral = replace(motion.lateral, velocity=rigid)
    period = 2.0 * pi / w
    times, head = head_of(motion, Weighted(), period / 400.0, 400)
    assert head == pytest.approx(np.sin(w * times) / w, abs=2e-3 / w)


def test_a_shaft_that_is_let_go_rings_as_a_bar() -> None:
    """A bar on soft springs, pulled at its head and let go: its first frequency is that of a bar
    on springs alone (free ends), w^2 = k / m, and the next ones ring in it."""
    start = Start(1, 0.0, "Z", -1e-3, 0.0)
    scene = elastic_pile(25.0, 20e6, Dynamics(0.0, 1.0), (PUSH,), starts=(start,))
    motion = motion_of(scene)
    assert motion.axial is not None
    assert motion.axial.q[0] == pytest.approx(1e-3)  # down is positive in it
    assert np.abs(motion.axial.velocity).max() == 0.0


def test_a_start_has_the_shape_of_statics() -> None:
    """Pulled by 10 cm at its head and let go, a pile starts as under the force that does it."""
    start = Start(1, 0.0, "X", 0.1, 2.0)
    scene = elastic_pile(30.0, 20e6, Dynamics(0.0, 1.0), (PUSH,), starts=(start,))
    motion = motion_of(scene)
    moved = motion.lateral.q
    assert moved[0] == pytest.approx(0.1, rel=1e-9)
    assert motion.lateral.velocity == pytest.approx(20.0 * moved, rel=1e-6, abs=1e-9)
    force = motion.body.lateral.internal(moved, None)
    assert np.abs(np.delete(force, 0)).max() < 1e-6 * abs(force[0])  # nothing but the pull


def test_a_head_that_is_driven_takes_the_pile_along() -> None:
    """An imposed motion of 0.2 Hz is slow: the pile follows as in statics, to the mass's share."""
    drives = Displacement("SWAY", 1, 0.0, "X", 0.05)
    scene = elastic_pile(30.0, 20e6, Dynamics(0.0, 20.0), ())
    scene = replace(
        scene,
        displacements=(drives,),
        steps=replace(scene.steps, names=("SWAY",), factors=((0.0,),)),
        harmonics=(Harmonic("SWAY", 5.0, ramp=5.0),),
    )
    motion = motion_of(scene)
    times, head = head_of(motion, Weighted(), 0.05, 400)
    late = times >= 5.0
    assert head[late] == pytest.approx(0.05 * np.sin(0.4 * pi * times[late]), abs=1e-12)
    still = start_of(
        replace(scene, starts=(Start(1, 0.0, "X", float(head[-5]), 0.0),), displacements=())
    )
    q = motion_at(scene, 396)
    assert q == pytest.approx(still.start.lateral, abs=2e-3 * np.abs(q).max())


def motion_at(scene: Scene, steps: int) -> Array:
    motion = motion_of(scene)
    head_of(motion, Weighted(), 0.05, steps)
    return motion.lateral.q


@pytest.mark.parametrize("hysteresis", ["ELASTIC", "MASING"])
def test_energy_is_balanced(hysteresis: str) -> None:
    """Work of the load against what moves, bends, is stored or lost in soil and damping: 1e-6.

    What the soil takes is what its forces do along the way, the mean of those at a step's ends.
    """
    scene = swaying_pile(2e6, end=8.0, step=0.02, hysteresis=hysteresis)
    motion = motion_of(scene)
    moving = motion.body.lateral
    system = moving.system

    def soil(q: Array) -> Array:
        remembered = moving.remembered(q)
        if remembered is not None:
            return remembered
        return system.react(system.displacement(q)[:, 0])[0]

    motion.method = Weighted()
    taken = damped = 0.0
    bending = dense(system.linear.reshape((system.width, system.size), order="F"))
    for _ in range(400):
        before, force = motion.lateral, soil(motion.lateral.q)
        motion.step(0.02, motion.lateral.time + 0.02, 1e-9, 60)
        after = motion.lateral
        moved = after.q - before.q
        felt = system.displacement(moved)[:, 0]
        taken += system.weight @ (0.5 * (force + soil(after.q)) * felt)
        damped += 0.5 * moving.damping_times(before.velocity + after.velocity) @ moved
    q, v = motion.lateral.q, motion.lateral.velocity
    kinetic = 0.5 * v @ moving.mass_times(v)
    strain = 0.5 * q @ bending @ q
    assert kinetic + strain + taken + damped == pytest.approx(motion.work, rel=1e-6)
    if hysteresis == "MASING":
        assert 0.0 < moving.dissipated() < taken


def test_factors_and_their_derivatives() -> None:
    """By differences: of a wave with a ramp and a phase, and of straight lines."""
    scene = replace(
        swaying_pile(),
        harmonics=(),
        series=(TimeSeries("HEAD", (0.0, 1.0, 3.0), (0.5, 2.0, -1.0)),),
    )
    waves = replace(scene, series=(), harmonics=(Harmonic("HEAD", 3.0, 0.4, 5.0),))
    for one in (scene, waves):
        factors = drive(one, 0.0)
        for t in (0.3, 0.99, 1.7, 4.2, 6.1):
            d = 1e-4
            value, rate, second = (float(f[0]) for f in factors(t))
            near = [float(factors(t + s * d)[0][0]) for s in (-1.0, 1.0)]
            assert rate == pytest.approx((near[1] - near[0]) / (2.0 * d), abs=1e-6)
            assert second == pytest.approx((near[0] - 2.0 * value + near[1]) / d**2, abs=1e-5)
    held = drive(scene, 0.0)
    assert held(-1.0)[0][0] == 0.5
    assert held(9.0)[0][0] == -1.0
    assert held(2.0)[0][0] == pytest.approx(0.5)


def test_more_damping_moves_less() -> None:
    lightly, heavily = (
        np.abs(head_of(motion_of(scene), Weighted(), 0.05, 160)[1]).max()
        for scene in (
            swaying_pile(step=0.05),
            replace(swaying_pile(step=0.05), damping=Damping(3.0, 0.01)),
        )
    )
    assert heavily < 0.95 * lightly
