"""Piles on soil that remembers, moved in two planes: beside one plane, turned, and their energy."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import shaken
from moving_piles import motion_of, start_of, swaying_pile
from podeep.arrays import Array
from podeep.beam.band import dense
from podeep.database.read import open_database
from podeep.motion import Harmonic
from podeep.run import run_deck
from podeep.scene import Load, Scene, Steps
from podeep.soil.iwan import Iwan
from podeep.solve.dynamics import Motion
from podeep.solve.integrators import Weighted

PERIOD = 4.0


def along(azimuth: float, *sizes: tuple[str, float, float]) -> tuple[Load, ...]:
    """Forces of the head by name: along a direction, degrees from x, and across it, N."""
    c, s = np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))
    return tuple(
        Load(name, 1, 10.0, (float(c * f - s * g), float(s * f + c * g), 0.0), (0.0, 0.0, 0.0))
        for name, f, g in sizes
    )


def swaying(azimuth: float, force: float = 4e6) -> Scene:
    """The swaying pile in space, its loads in one plane."""
    scene = swaying_pile(force, end=4.0, step=0.05, hysteresis="MASING")
    loads = along(azimuth, (scene.steps.names[0], force, 0.0))
    return replace(scene, loads=loads, numerics=replace(scene.numerics, components=2))


def led_round(azimuth: float = 0.0, force: float = 4e6) -> Scene:
    """The same pile led round: a second load across, a quarter of a period ahead."""
    scene = replace(swaying(azimuth), numerics=replace(swaying(0.0).numerics, components=None))
    names = (scene.steps.names[0], "ACROSS")
    return replace(
        scene,
        loads=along(azimuth, (names[0], force, 0.0), ("ACROSS", 0.0, force)),
        steps=Steps(names, ((0.0, 0.0),)),
        harmonics=(
            Harmonic(names[0], PERIOD, 0.0, PERIOD),
            Harmonic("ACROSS", PERIOD, np.pi / 2, PERIOD),
        ),
    )


def head(motion: Motion, steps: int, h: float = 0.05, share: float = 1e-8) -> Array:
    """Displacements of the head, (steps, components)."""
    motion.method, found = Weighted(), []
    for _ in range(steps):
        motion.step(h, motion.lateral.time + h, share, 60)
        found.append(motion.lateral.q[: motion.body.lateral.system.components])
    return np.array(found)


def test_in_space_as_in_one_plane() -> None:
    """At 0 and 30 degrees: the head within 2e-4 of its largest displacement, loss within 1e-3."""
    planar = motion_of(swaying_pile(4e6, end=4.0, step=0.05, hysteresis="MASING"))
    expected = head(planar, 80)[:, 0]
    size, lost = np.abs(expected).max(), planar.body.lateral.dissipated()
    for azimuth in (0.0, 30.0):
        motion = motion_of(swaying(azimuth))
        found, angle = head(motion, 80), np.radians(azimuth)
        assert isinstance(motion.body.lateral.memory, Iwan)
        assert found @ [np.cos(angle), np.sin(angle)] == pytest.approx(expected, abs=2e-4 * size)
        assert np.abs(found @ [-np.sin(angle), np.cos(angle)]).max() < 1e-9 * size
        assert motion.body.lateral.dissipated() == pytest.approx(lost, rel=1e-3)


def test_turned_loads_turn_the_motion() -> None:
    one, other = (head(motion_of(led_round(a)), 60) for a in (0.0, 50.0))
    c, s = np.cos(np.radians(50.0)), np.sin(np.radians(50.0))
    assert one @ [[c, s], [-s, c]] == pytest.approx(other, abs=1e-6 * np.abs(one).max())
    assert np.abs(one).max(axis=0).min() > 0.02


def test_energy_is_balanced_round_and_round() -> None:
    """Work of the loads against what moves, bends, is damped and what the soil takes: 1e-6. What
    the soil takes, added up by the means of steps, is what it has lost and holds, within 1 %."""
    motion = motion_of(led_round())
    moving = motion.body.lateral
    system, memory = moving.system, moving.memory
    assert isinstance(memory, Iwan)
    bending = dense(system.linear.reshape((system.width, system.size), order="F"))

    def soil(q: Array) -> Array:
        found = moving.remembered(q)
        assert found is not None
        return found.T

    motion.method = Weighted()
    taken = damped = 0.0
    for _ in range(240):
        before, force = motion.lateral, soil(motion.lateral.q)
        motion.step(0.025, motion.lateral.time + 0.025, 1e-9, 60)
        after = motion.lateral
        moved = after.q - before.q
        felt = system.displacement(moved)
        taken += float(system.weight @ (0.5 * (force + soil(after.q)) * felt).sum(axis=1))
        damped += 0.5 * moving.damping_times(before.velocity + after.velocity) @ moved
    q, v = motion.lateral.q, motion.lateral.velocity
    kinetic, strain = 0.5 * v @ moving.mass_times(v), 0.5 * q @ bending @ q
    assert kinetic + strain + taken + damped == pytest.approx(motion.work, rel=1e-6)
    held = float(system.weight @ memory.stored)
    assert 0.0 < held < moving.dissipated()
    assert moving.dissipated() + held == pytest.approx(taken, rel=1e-2)


def test_shorter_steps_change_little() -> None:
    """Led round by 40 and 80 steps a period, beside 320: as the manual tells, and twins see."""
    begun = start_of(led_round())
    fine, long, short = (
        head(motion_of(led_round(), begun), 60 * k, 0.1 / k, 1e-6)[k - 1 :: k] for k in (8, 1, 2)
    )
    size = np.abs(fine).max()
    errors = [float(np.abs(one - fine).max() / size) for one in (long, short)]
    assert errors == pytest.approx([7e-3, 2.7e-3], rel=0.1)
    assert float(np.abs(short - long).max() / size / 3.0) == pytest.approx(errors[1] / 2, rel=0.3)


def test_a_step_taken_anew_is_the_same_to_the_last_bit() -> None:
    motion = motion_of(led_round())
    head(motion, 20)
    stood = motion.standing()
    first = head(motion, 3), motion.body.lateral.dissipated()
    motion.stand(stood)
    again = head(motion, 3), motion.body.lateral.dissipated()
    assert (first[0] == again[0]).all()
    assert first[1] == again[1]


def test_records_in_space_as_in_one_plane(tmp_path: Path) -> None:
    """At every time and depth, and so on one mesh: on curves of straight lines, which springs
    meet exactly, to what iteration leaves."""
    found: list[tuple[Array, Array]] = []
    for model in ("PLANAR", "SPATIAL"):
        more = f"*MODEL, {model}, HYSTERESIS=MASING, ELEMENTS=10\n"
        deck = shaken.deck(tmp_path / model, end=0.5, across=40e3, more=more)
        deck.write_text(deck.read_text().replace("SHAPE=POWER", "SHAPE=2GEO"))
        run_deck(deck, tmp_path / model, force=False)
        with open_database(tmp_path / model / "shaken.dst") as database:
            data = database.foundation("F1")
            depth = np.linspace(0.0, 20.0, 101)
            rows = (data.read(name) for name in ("lateral_displacement", "lateral_force"))
            moved, pushed = (np.array([np.interp(depth, data.depth, r) for r in q]) for q in rows)
            found.append((moved, pushed))
    for planar, spatial in zip(*found, strict=True):
        assert spatial == pytest.approx(planar, abs=1e-6 * np.abs(planar).max())
