"""A stub 1.5 m across and 12 m long in softening soil, so stiff that all of it is mobilised."""

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
    Support,
    Tube,
)
from podeep.soil.lateral_capacity import RigidMechanism, rigid_mechanism
from podeep.soil.profile import profile_of

LENGTH, DIAMETER, ARM = 12.0, 1.5, 1.0
CLAY = {"undrained_shear_strength": 60e3, "effective_unit_weight": 8e3}
HARD = {"undrained_shear_strength": 120e3, "effective_unit_weight": 9e3, "strain_50": 0.006}
SOFTENING = {
    "cyclic soft clay": Curve(
        1, "soft_clay", {**CLAY, "j": 0.5, "strain_50": 0.01}, {"cyclic": True}
    ),
    "stiff clay in free water": Curve(1, "stiff_clay_free_water", HARD),
    "cyclic stiff clay in free water": Curve(1, "stiff_clay_free_water", HARD, {"cyclic": True}),
}


def stub(law: Curve) -> Scene:
    shaft = Curve(1, "user", {"effective_unit_weight": 9e3}, {}, ((1.0, 0.1, 0.0, 0.0),))
    section = Section(ARM, -LENGTH, DIAMETER, 0.05, 210e9, 7850.0)
    return Scene(
        "stub",
        {1: Tube(1, "STUB", (section,))},
        (Foundation(1, (1,), 0.0),),
        Ground((0.0,), (1,), (1,), {1: law}, {1: shaft}),
        supports=(Support(1, -LENGTH, ("Z",)),),
        loads=(),
    )


def mechanism(scene: Scene) -> RigidMechanism:
    profile = profile_of(scene, scene.foundations[0])
    return rigid_mechanism(profile, lambda z: np.full(len(z), DIAMETER), LENGTH, (1.0, ARM))


def pushed(scene: Scene, force: float, steps: int, elements: int, *, fixed: bool) -> Scene:
    supports = scene.supports + ((Support(1, ARM, ("RY",)),) if fixed else ())
    return replace(
        scene,
        supports=supports,
        loads=(Load("PUSH", 1, ARM, (force, 0.0, 0.0), (0.0, 0.0, 0.0)),),
        steps=Steps(("PUSH",), tuple((i / steps,) for i in range(1, steps + 1))),
        numerics=Numerics(elements=elements),
    )
