"""Springs of deflection and slope together, and masses whose weight topples."""

from dataclasses import replace

import numpy as np
import pytest

from modal_cases import CF11, NOTHING
from podeep.scene import (
    CoupledSpring,
    Foundation,
    Load,
    Mass,
    Numerics,
    Scene,
    Steps,
    Support,
    Tube,
)
from podeep.solve.analysis import first_model, solve

#: of the OC3 monopile at the mudline (PR06), of slopes over depth
KXX, KXR, KRR = 2.5748e9, 2.25325e10, 2.629123e11


def standing(*loads: Load, **changes: object) -> Scene:
    """A tube that stands on a coupled spring at the mudline."""
    section = replace(CF11, top=30.0, bottom=0.0)
    scene = Scene(
        "",
        {1: Tube(1, "column", (section,))},
        (Foundation(1, (1,), 0.0),),
        NOTHING,
        supports=(Support(1, 0.0, ("Z",)),),
        coupled_springs=(CoupledSpring(1, 0.0, KXX, KXR, KRR),),
        loads=loads,
        steps=Steps(("L",), ((1.0,),)) if loads else Steps((), ()),
    )
    return replace(scene, **changes)


def foot(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Deflection and slope at the mudline in the last step, each by component."""
    results = solve(scene, scene.foundations[0]).results
    at = results.model.edges[-1:]
    return results.deflection(at)[-1, :, 0], results.deflection(at, 1)[-1, :, 0]


def test_the_published_stiffness_moves_as_its_inverse_says() -> None:
    shear, moment = 3.910e6, 124.385e6  # PR06: moves 22.636 mm and 2.4131 mrad
    load = Load("L", 1, 0.0, (shear, 0.0, 0.0), (0.0, moment, 0.0))
    deflection, slope = foot(standing(load))
    assert deflection[0] == pytest.approx(0.0226356049980967, rel=1e-10)
    assert -slope[0] == pytest.approx(0.00241305473201373, rel=1e-10)


def test_every_plane_has_the_same_spring() -> None:
    sideways, over = 3.0e6, 1.0e8
    one = standing(Load("L", 1, 0.0, (sideways, 0.0, 0.0), (0.0, over, 0.0)))
    other = standing(Load("L", 1, 0.0, (0.0, sideways, 0.0), (-over, 0.0, 0.0)))
    both = replace(other, numerics=Numerics(components=2))
    expected = foot(one)
    for scene, component in ((other, 0), (both, 1)):
        found = foot(scene)
        assert found[0][component] == pytest.approx(expected[0][0], rel=1e-12)
        assert found[1][component] == pytest.approx(expected[1][0], rel=1e-12)


def test_a_held_slope_leaves_the_direct_term() -> None:
    load = Load("L", 1, 0.0, (1e6, 0.0, 0.0), (0.0, 0.0, 0.0))
    held = (Support(1, 0.0, ("Z", "RY")),)
    deflection, slope = foot(standing(load, supports=held))
    assert deflection[0] == pytest.approx(1e6 / KXX, rel=1e-12)
    assert abs(slope[0]) < 1e-20


def test_tangent_and_forces_agree() -> None:
    scene = standing()
    system = first_model(scene, scene.foundations[0]).lateral.system
    q = np.random.default_rng(1).normal(size=system.size)
    inner = system.internal(q)
    assert np.allclose(system.tangent_times(q), inner, rtol=1e-12)
    assert np.allclose(system.solve(inner), q, rtol=1e-7, atol=1e-7)


def test_a_mass_on_an_arm_topples_by_its_weight() -> None:
    """A rigid column of height h under W at h + c on a spring K: M (1 + W (h + c) / K ...)."""
    section = replace(CF11, top=30.0, bottom=0.0, bending_stiffness_override=1e16)
    weight, arm, spring, moment = 2e6, 5.0, 4e8, 1e5
    scene = standing(
        Load("L", 1, 0.0, (0.0, 0.0, 0.0), (0.0, moment, 0.0)),
        tubes={1: Tube(1, "column", (replace(section, mass_override=1e-6),))},
        coupled_springs=(CoupledSpring(1, 0.0, 1e9, 0.0, spring),),
        masses=(Mass(1, 30.0 + arm, weight / 9.80665),),
        numerics=Numerics(second_order=True, weight=True),
    )
    _, slope = foot(scene)
    assert -slope[0] == pytest.approx(moment / (spring - weight * (30.0 + arm)), rel=1e-6)
    unweighted = replace(scene, numerics=Numerics(second_order=True))
    assert -foot(unweighted)[1][0] == pytest.approx(moment / spring, rel=1e-6)
