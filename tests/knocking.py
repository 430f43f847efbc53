"""A conductor with a string inside it that has room to knock, and the energy of its motion."""

from dataclasses import replace
from functools import cache

import numpy as np

from casings import casings, elastic_shaft, linear, push, tube
from moving_piles import motion_of, start_of
from podeep.arrays import Array
from podeep.beam.band import dense
from podeep.model.contact import Gap
from podeep.motion import Dynamics, Mass, Start
from podeep.scene import Ground, Numerics, Scene, Sliding, Steps, Tie
from podeep.soil.energy import energy
from podeep.solve.dynamics import Motion
from podeep.solve.integrators import Integrator
from podeep.solve.moving import Moving
from podeep.solve.ready import Begun

MODULUS, ROOM = 2e7, 0.05


def knocking(step: float | None = 0.01, end: float = 2.0, planes: int = 1, **more: object) -> Scene:
    """A string of 0.5 m, cemented 15 m below the mudline, in a pipe of 1 m with 5 cm of room, on
    linear soil: its head sets off at 2 m/s, and also across that in two planes."""
    ground = Ground(
        *((0.0, 1.0), (1, 1), (1, 1)),
        *({1: linear(1, MODULUS, 1.0)}, {1: elastic_shaft(1, MODULUS, 1.0)}),
    )
    tubes = [tube(1, 10.0, -40.0, 1.0, 0.03), tube(2, 12.0, -40.0, 0.5, 0.02)]
    scene = casings(
        tubes,
        ground,
        [push(2, 12.0, x=1e5)],
        ties=[Tie(1, 2, -15.0, -40.0)],
        slidings=[Sliding(1, 2, None, ROOM)],
        numerics=Numerics(accuracy=1e-3, elements=12, components=planes, second_order=False),
    )
    across = (Start(2, 12.0, "Y", 0.03, -1.5),) if planes == 2 else ()
    scene = replace(
        scene,
        steps=Steps(("PUSH",), ((0.0,),)),
        starts=(Start(2, 12.0, "X", 0.0, 2.0), *across),
        masses=(Mass(2, 12.0, 2e3),),
        dynamics=Dynamics(0.0, end, step),
    )
    return replace(scene, **more)  # type: ignore[arg-type]


@cache
def begun_knocking(planes: int) -> tuple[Scene, Begun]:
    scene = knocking(planes=planes)
    return scene, start_of(scene)


def stored(equations: Moving, q: Array, velocity: Array) -> float:
    """Energy of motion, of bending, and of all that resists at points, J."""
    system = equations.system
    bending = dense(system.linear.reshape((system.width, system.size), order="F"))
    total = 0.5 * velocity @ equations.mass_times(velocity) + 0.5 * q @ bending @ q
    moved = np.linalg.norm(system.displacement(q), axis=1)
    for points, at in zip(system.points, system._slices, strict=True):
        law, u = points.reaction.laws[0].law if points.reaction.laws else None, moved[at]
        if isinstance(law, Gap):
            e, depth = law.tolerance, np.maximum(u - law.clearance, 0.0)
            soft, beyond = np.minimum(depth, e), np.maximum(depth - e, 0.0)
            each = law.contact_stiffness * (soft**3 / (6.0 * e) + 0.5 * beyond * (beyond + e))
        else:
            each = energy(points.reaction, u)
        total += points.weight @ each
    return float(total)


def energies(method: Integrator, motion: Motion, h: float, steps: int, share: float) -> Array:
    """Energy less the work of loads, the start among them, J."""
    lateral, motion.method = motion.body.lateral, method
    found = [stored(lateral, motion.lateral.q, motion.lateral.velocity)]
    for _ in range(steps):
        motion.step(h, motion.lateral.time + h, share, 60)
        found.append(stored(lateral, motion.lateral.q, motion.lateral.velocity) - motion.work)
    return np.array(found)


def knocked(method: Integrator, h: float, end: float, planes: int = 1) -> Array:
    """Energy over that at the start, step by step."""
    motion = motion_of(*begun_knocking(planes))
    found = energies(method, motion, h, round(end / h), 1e-9)
    return found / found[0]
