"""Piles in motion that several tests share."""

from dataclasses import replace
from math import pi

import numpy as np

from podeep.arrays import Array
from podeep.motion import Damping, Dynamics, Harmonic, Mass
from podeep.scene import Foundation, Load, Numerics, Scene, Section, Steps, Tube
from podeep.solve.dynamics import Motion
from podeep.solve.integrators import Integrator
from podeep.solve.ready import Begun, begun
from scenes import linear_ground, reference_pile

EI, MASS = 1.2e9, 2500.0


def elastic_tube(length: float, ei: float = EI, mass: float = MASS, ea: float = 8e9) -> Tube:
    """A tube below the mudline with the stiffness and mass per metre that are given."""
    section = Section(
        *(0.0, -length, 1.0, 0.05, 210e9, 7850.0, 0.3),
        bending_stiffness_override=ei,
        axial_stiffness_override=ea,
        mass_override=mass,
    )
    return Tube(1, "tube", (section,))


def elastic_pile(
    length: float,
    modulus: float,
    dynamics: Dynamics,
    loads: tuple[Load, ...] = (),
    elements: int = 20,
    **more: object,
) -> Scene:
    """A tube on linear springs, `modulus` N/m2, that starts at rest without loads in statics."""
    names = tuple(load.name for load in loads)
    return Scene(
        "",
        {1: elastic_tube(length)},
        (Foundation(1, (1,), 0.0),),
        linear_ground(modulus, 1.0),
        loads=loads,
        steps=Steps(names, ((0.0,) * len(names),)),
        numerics=Numerics(elements=elements, second_order=False, components=1),
        dynamics=dynamics,
        **more,  # type: ignore[arg-type]
    )


def swaying_pile(
    force: float = 1e6,
    accuracy: float = 1e-3,
    end: float = 12.0,
    step: float | None = None,
    hysteresis: str = "ELASTIC",
    damped: bool = True,
    **more: object,
) -> Scene:
    """The reference pile with 200 t on its head under a force of 4 s period, from rest."""
    numerics = Numerics(accuracy=accuracy, components=1, hysteresis=hysteresis)  # type: ignore[arg-type]
    scene = reference_pile((force, 0.0, 0.0), steps=1, numerics=numerics)
    name = scene.steps.names[0]
    w = 2.0 * pi * np.array([0.25, 5.0])
    a, b = np.linalg.solve(np.stack([1.0 / w, w], axis=1), np.full(2, 0.04)).tolist()
    return replace(
        scene,
        steps=Steps((name,), ((0.0,),)),
        harmonics=(Harmonic(name, 4.0),),
        masses=(Mass(1, 10.0, 200e3),),
        damping=Damping(a, b) if damped else None,
        dynamics=Dynamics(0.0, end, step),
        **more,  # type: ignore[arg-type]
    )


def start_of(scene: Scene) -> Begun:
    return begun(scene, scene.foundations[0])


def motion_of(scene: Scene, one: Begun | None = None) -> Motion:
    """A motion at its start."""
    assert scene.dynamics is not None
    return (one or start_of(scene)).set_off(scene, scene.dynamics)


def head_of(
    motion: Motion, method: Integrator, h: float, steps: int, share: float = 1e-8
) -> tuple[Array, Array]:
    """Times and displacements of the head, the start among them."""
    motion.method = method
    times, head = [motion.lateral.time], [motion.lateral.q[0]]
    for _ in range(steps):
        motion.step(h, motion.lateral.time + h, share, 60)
        times.append(motion.lateral.time)
        head.append(motion.lateral.q[0])
    return np.array(times), np.array(head)
