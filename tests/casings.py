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
    Sliding,
    Steps,
    Support,
    Tie,
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
    """Largest jump of a tube's shear, moment and normal force from element to element where
    nothing but neighbouring elements meets, over the largest of each in the last step."""
    results, model = solved.results, solved.model
    edges = results.along(tube_, model.edges)
    ends = {round(p.bottom, 9) for p in model.pieces} | {round(model.pieces[0].top, 9)}
    inner = np.array([x for x in edges[1:-1] if round(float(x), 9) not in ends])
    if not inner.size:
        return 0.0
    close = 1e-9
    worst = 0.0
    for above, below in zip(
        _forces(solved, inner, tube_), _forces(solved, inner + close, tube_), strict=True
    ):
        size = max(np.abs(f).max() for f in (above, below, 1e-30))
        worst = max(worst, float(np.abs(above - below).max() / size))
    return worst


def _forces(solved, x, tube_):
    shear, moment = solved.results.shear_and_moment(x, tube_)
    return shear[-1], moment[-1], solved.results.compression(x, tube_)[-1]


__all__ = [
    "Sliding",
    "Support",
    "Tie",
]
