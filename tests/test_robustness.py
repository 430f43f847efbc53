"""Every lateral law from a light load to just below its rigid mechanism: solved, whatever the mesh.

A stub 1.5 m across and 12 m long, so stiff that its soil is mobilised all along.
"""

from dataclasses import replace
from itertools import product
from math import radians

import numpy as np
import pytest

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
from podeep.solve.analysis import first_model, limits, run

LENGTH, DIAMETER, ARM = 12.0, 1.5, 1.0
CLAY = {"undrained_shear_strength": 60e3, "effective_unit_weight": 8e3}
HARD = {"undrained_shear_strength": 120e3, "effective_unit_weight": 9e3, "strain_50": 0.006}
SAND = {"effective_unit_weight": 9e3, "friction_angle": radians(34.0)}
ROCK = {"compressive_strength": 2e6, "rock_mass_modulus": 5e8, "strain_rm": 5e-4}
LAWS = {
    "soft clay": Curve(1, "soft_clay", {**CLAY, "j": 0.5, "strain_50": 0.01}),
    "soft clay, cube root": Curve(
        1, "soft_clay", {**CLAY, "j": 0.5, "strain_50": 0.01}, {"shape": "POWER"}
    ),
    "sand": Curve(1, "sand", SAND),
    "Reese sand": Curve(1, "reese_sand", SAND),
    "stiff clay without free water": Curve(1, "stiff_clay", {**CLAY, "strain_50": 0.007}),
    "weak rock": Curve(1, "weak_rock", {**ROCK, "rock_quality_designation": 0.5}),
    "ISO clay": Curve(1, "iso_clay", {**CLAY, "overconsolidation_ratio": 2.0}),
    "PISA clay": Curve(
        1, "pisa_clay", {"undrained_shear_strength": 60e3, "initial_shear_modulus": 30e6}
    ),
    "PISA sand": Curve(
        1,
        "pisa_sand",
        {"effective_unit_weight": 9e3, "relative_density": 0.7, "initial_shear_modulus": 60e6},
    ),
}
# In weak rock on four elements, the head held, all Gauss points reach the limit of the soil before
# the point of no displacement is found: Newton creeps along a tangent without soil until one of
# them turns over, or the step is cut. No other run of the grid takes more than 50.
ITERATIONS = {"weak rock": 150}
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


def states_of(scene: Scene):
    model = first_model(scene, scene.foundations[0])
    return run(model, np.array(scene.steps.factors), limits(scene))[:2]


@pytest.mark.parametrize("name", LAWS)
def test_no_load_below_the_mechanism_fails(name):
    """96 runs of each law, none of which takes more than ITERATIONS in a step."""
    scene = stub(LAWS[name])
    capacity = mechanism(scene)
    most = 0
    for share, steps, fixed, elements in product(
        (0.1, 0.3, 0.5, 0.7, 0.8, 0.95), (1, 10), (False, True), (4, 6, 24, 48)
    ):
        force = share * (capacity.translation if fixed else capacity.lateral_load)
        states, failure = states_of(pushed(scene, force, steps, elements, fixed=fixed))
        assert failure is None, (share, steps, fixed, elements)
        assert len(states) == steps + 1
        most = max(most, *(s.iterations for s in states))
    assert most <= ITERATIONS.get(name, 25)


@pytest.mark.parametrize("name", SOFTENING)
@pytest.mark.parametrize("fixed", [False, True])
def test_a_peak_does_not_depend_on_the_steps_that_lead_to_it(name, fixed):
    """Asked for the mechanism of all peaks at once, which no softening soil reaches."""
    scene = stub(SOFTENING[name])
    capacity = mechanism(scene)
    force = 1.2 * (capacity.translation if fixed else capacity.lateral_load)
    peaks = []
    for steps in (1, 3, 10):
        _, failure = states_of(pushed(scene, force, steps, 24, fixed=fixed))
        assert failure is not None
        peaks.append((failure.step - 1 + failure.reached) / steps)
    assert max(peaks) - min(peaks) <= 2e-4 * max(peaks)
    assert 0.3 < max(peaks) < 1.0
