"""Scenes of tubes in tubes, and the checks of equilibrium that several tests share."""

from dataclasses import replace

import numpy as np

from podeep.scene import (
    Curve,
    Foundation,
    Ground,
    Load,
    Numerics,
    Scene,
    Section,
    Steps,
    Tube,
)
from podeep.solve.analysis import Solved, solve

E, STEEL = 210e9, 7850.0
NONE = (0.0, 0.0, 0.0)


def tube(id_, top, bottom, diameter, wall, **given):
    return Tube(id_, f"T{id_}", (Section(top, bottom, diameter, wall, E, STEEL, **given),))


def linear(id_, modulus, diameter):
    """p = modulus y (N/m) on a tube of a diameter."""
    return Curve(id_, "user", {}, {}, ((1e3 * modulus / diameter, 1e3),))


def elastic_shaft(id_, modulus, diameter):
    given = {"unit_friction": 1e12, "initial_stiffness": modulus / (np.pi * diameter)}
    return Curve(id_, "direct", given, {"shape": "EP"})


def no_ground(depth=1.0):
    return Ground((0.0, depth), (0, 0), (0, 0), {}, {})


def casings(
    tubes,
    ground,
    loads,
    ties=(),
    slidings=(),
    supports=(),
    mudline=0.0,
    numerics=None,
    steps=1,
):
    names = tuple(dict.fromkeys(load.name for load in loads))
    factors = tuple((i / steps,) * len(names) for i in range(1, steps + 1))
    return Scene(
        "casings",
        {t.id: t for t in tubes},
        (Foundation(1, tuple(t.id for t in tubes), mudline),),
        ground,
        loads=tuple(loads),
        steps=Steps(names, factors),
        ties=tuple(ties),
        slidings=tuple(slidings),
        supports=tuple(supports),
        numerics=numerics or Numerics(accuracy=1e-6),
    )


def push(tube_, elevation, x=0.0, y=0.0, z=0.0, turn=0.0):
    return Load("PUSH", tube_, elevation, (x, y, z), (0.0, turn, 0.0))


def run(scene: Scene) -> Solved:
    one = solve(scene, scene.foundations[0])
    assert one.failure is None
    return one


def elements(scene, count, degree=5):
    return replace(scene, numerics=replace(scene.numerics, elements=count, degree=degree))


def jumps(solved: Solved, tube_: int) -> float:
    """Largest jump of a tube's shear, moment and normal force from element to element, where
    nothing but neighbouring elements meets, over the largest of each in any tube."""
    results, model = solved.results, solved.model
    ends = np.array([model.pieces[0].top, *(p.bottom for p in model.pieces)])
    inner = np.array([x for x in model.edges if np.abs(ends - x).min() > 1e-6])
    tubes = range(len(model.foundation.tubes))
    size = [
        max(np.abs(values[i]).max() for values in found)
        for found in [[_forces(solved, results.along(t, inner), t) for t in tubes]]
        for i in range(3)
    ]
    own = results.along(tube_, inner)
    above, below = _forces(solved, own, tube_), _forces(solved, own + 1e-9, tube_)
    steps = [np.abs(a - b).max() for a, b in zip(above, below, strict=True)]
    return max(step / max(most, 1e-30) for step, most in zip(steps, size, strict=True))


def _forces(solved, x, tube_):
    shear, moment = solved.results.shear_and_moment(x, tube_)
    return shear[-1], moment[-1], solved.results.compression(x, tube_)[-1]
