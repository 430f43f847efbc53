"""Natural frequencies against closed forms and other programs; what modes have to obey."""

from collections.abc import Sequence
from dataclasses import replace
from math import atan2, degrees, pi, sqrt

import numpy as np
import pytest

from modal_cases import CF11, CF16, ENDS, NOTHING, beam, oc3, rows
from podeep.beam.band import band_times
from podeep.errors import AnalysisFailed, UserError
from podeep.scene import Ground, Load, Mass, Numerics, Scene, Spring, Steps, Support
from podeep.solve.about_state import state_of, suited
from podeep.solve.analysis import rebuilt
from podeep.solve.families import Family, families
from podeep.solve.modes import Modes, halved, modes
from scenes import reference_pile, sand, sand_shaft

FINE = Numerics(accuracy=1e-6)
RIGID = {"free-free": 2, "free-pinned": 1}


def found(scene: Scene, count: int, step: int = 0) -> Modes:
    return modes(scene, scene.foundations[0], count, step)


def lateral(result: Modes) -> np.ndarray:
    return np.array([m.frequency for m in result.modes if m.kind != "axial"])


def family(scene: Scene, halvings: int = 0) -> Family:
    """The lateral family at rest on a mesh halved so often."""
    model = suited(scene, scene.foundations[0], 0)
    for _ in range(halvings):
        model = rebuilt(scene, model, halved(model.edges), 0)
    return families(scene, model, state_of(scene, model, 0), 1e-3)[0][0]


@pytest.mark.parametrize("modulus", [0.0, 20e6])
@pytest.mark.parametrize("ends", ENDS)
def test_cf11_a_uniform_beam_on_winkler_soil(ends: str, modulus: float) -> None:
    exact = [
        float(row["f_Hz"])
        for row in rows("CF11_frequencies.csv")
        if ends in row["ends"].split("/") and float(row["k_N_per_m2"]) == modulus
    ]
    assert len(exact) == 4
    rigid = [sqrt(modulus / CF11.mass) / (2.0 * pi)] * RIGID.get(ends, 0)
    result = found(beam(CF11, ends, modulus, FINE), len(rigid + exact))
    assert lateral(result) == pytest.approx(rigid + exact, rel=1e-7)
    assert result.error <= 1e-6


def test_cf16_softness_in_shear_with_rotary_inertia() -> None:
    """Sine modes, and the motion of rotations alone, sqrt(GAs / rho I), which the table has not."""
    exact = [float(row["f_Hz"]) for row in rows("CF16_frequencies.csv")]
    turning = sqrt(4e9 / 50000.0) / (2.0 * pi)
    shear_branch = float(rows("CF16_frequencies.csv")[0]["omega_shear_branch"]) / (2.0 * pi)
    expected = sorted([*exact, turning, shear_branch])[:6]
    for components in (1, 2):
        scene = beam(CF16, "pinned-pinned", 50e6, Numerics(accuracy=1e-6, shear=True))
        supports = tuple(replace(s, dofs=(*s.dofs, "Y")) for s in scene.supports[:2])
        supports += (Support(1, -30.0, ("Z",)),)
        numerics = replace(scene.numerics, components=components)
        scene = replace(scene, supports=supports, numerics=numerics)
        result = found(scene, 6 * components)
        both = np.repeat(expected, components)
        assert lateral(result) == pytest.approx(both, rel=1e-7)
        assert np.abs(lateral(result) / both - 1.0).max() <= result.error
    plain = found(beam(CF16, "pinned-pinned", 50e6, Numerics(accuracy=1e-8)), 6)
    simple = [float(row["f_EB_Hz"]) for row in rows("CF16_frequencies.csv")]
    assert lateral(plain) == pytest.approx(simple, rel=1e-9)


FORE_AFT = [row for row in rows("PR08_frequencies.csv") if "fore-aft" in row["mode"]]


def test_pr08_a_tower_on_coupled_springs() -> None:
    result = found(oc3(12, Numerics(accuracy=1e-4, degree=3)), 4)
    own = [float(row["own_planar_Hz"]) for row in FORE_AFT]
    peer = [float(row["pyBModes_no_offset_Hz"]) for row in FORE_AFT]
    assert lateral(result) == pytest.approx(own, rel=1e-4)
    assert lateral(result) == pytest.approx(peer, rel=2e-4)


def test_pr08_gravity_lowers_the_frequencies() -> None:
    scene = oc3(12, Numerics(accuracy=1e-4, degree=3, weight=True, second_order=True))
    result = found(scene, 4)
    assert lateral(result) == pytest.approx([0.24060, 1.50374, 3.19524, 6.32659], rel=1e-4)
    assert any("P-delta" in note for note in result.notes)


def test_pr08_rotary_inertia_of_the_sections() -> None:
    """Without softness in shear it is no choice of a scene: a stiffness in shear without end."""
    scene = oc3(8, Numerics(accuracy=1e-3, degree=3, shear=True))
    tube = scene.tubes[1]
    stiff = tuple(replace(s, shear_stiffness_override=1e16) for s in tube.sections)
    result = found(replace(scene, tubes={1: replace(tube, sections=stiff)}), 4)
    assert lateral(result) == pytest.approx([0.24643, 1.50975, 3.19544, 6.30833], rel=1e-4)


def test_a_normal_force_lowers_a_frequency_to_nothing() -> None:
    critical = pi**2 * CF11.bending_stiffness / 30.0**2
    scene = beam(CF11, "pinned-pinned", 0.0, replace(FINE, second_order=True))
    push = Load("PUSH", 1, 0.0, (0.0, 0.0, -critical), (0.0, 0.0, 0.0))
    shares = (-1.0, 0.3, 0.99)
    scene = replace(scene, loads=(push,), steps=Steps(("PUSH",), tuple((s,) for s in shares)))
    free = lateral(found(scene, 1))[0]
    for step, share in enumerate(shares, start=1):
        result = found(scene, 1, step)
        assert lateral(result)[0] == pytest.approx(free * sqrt(1.0 - share), rel=1e-6)
    beyond = replace(scene, steps=Steps(("PUSH",), ((1.01,),)))
    with pytest.raises(AnalysisFailed, match=r"not stable|buckles"):
        found(beyond, 1, 1)


def test_shear_with_rotary_inertia_converges_by_twice_the_degree_less_two() -> None:
    exact = (2.0 * pi * float(rows("CF16_frequencies.csv")[3]["f_Hz"])) ** 2
    scene = beam(CF16, "pinned-pinned", 50e6, replace(FINE, shear=True, elements=6))
    errors = [family(scene, h).solved(4)[0][3] / exact - 1.0 for h in (0, 1, 2)]
    assert np.log2(errors[1] / errors[2]) == pytest.approx(6.0, abs=0.3)


@pytest.mark.parametrize("load", [(1e6, 0.0, -4e6), (6e5, 8e5, -4e6)])
def test_rotations_inside_mix_with_two_planes(load: tuple[float, float, float]) -> None:
    """About a loaded state in two planes, coupled or not, elements of two degrees agree."""
    smooth = Ground((0.0,), (1,), (1,), {1: sand(1)}, {1: sand_shaft(1)})
    pile = reference_pile(load, numerics=Numerics(shear=True, accuracy=1e-4))
    pile = replace(pile, ground=smooth)
    other = replace(pile, numerics=replace(pile.numerics, degree=7))
    one, two = (found(scene, 5, 6) for scene in (pile, other))
    kinds = {m.kind for m in one.modes} - {"axial"}
    angle = degrees(atan2(load[1], load[0]))
    names = {f"lateral {a:.0f} deg" for a in (angle, angle + 90.0)} if angle else None
    assert kinds == (names or {"lateral x", "lateral y"})
    assert lateral(one) == pytest.approx(lateral(two), rel=1e-4)


def test_modes_are_orthogonal_to_mass_and_stiffness() -> None:
    scene = reference_pile()
    scene = replace(scene, masses=(Mass(1, 12.0, 80e3, (1e5, 1e5, 1e5)),))
    one = family(scene)
    squares, states, _ = one.solved(8)
    heavy = np.array([[a @ band_times(one.mass, b) for a in states] for b in states])
    stiff = np.array([[a @ one.system.tangent_times(b) for a in states] for b in states])
    scale = np.sqrt(np.outer(heavy.diagonal(), heavy.diagonal()))
    assert np.allclose(heavy / scale, np.eye(8), atol=1e-10)
    assert np.allclose(stiff / scale, np.diag(squares), atol=1e-10 * squares.max())


@pytest.mark.parametrize(("degree", "halvings"), [(3, (2, 3, 4)), (5, (1, 2, 3))])
def test_frequencies_converge_by_twice_the_degree_less_one(
    degree: int, halvings: Sequence[int]
) -> None:
    exact = (2.0 * pi * float(rows("CF11_frequencies.csv")[6]["f_Hz"])) ** 2  # 4th, no soil
    numerics = replace(FINE, degree=degree, elements=2)
    scene = beam(CF11, "pinned-pinned", 0.0, numerics)
    errors = [family(scene, h).solved(4)[0][3] / exact - 1.0 for h in halvings]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert min(errors) > 1e-10  # above rounding
    assert orders[-1] == pytest.approx(2 * (degree - 1), abs=0.35)


def test_large_problems_are_solved_as_small_ones_are(monkeypatch: pytest.MonkeyPatch) -> None:
    one = family(reference_pile(), 1)
    whole = one.solved(8)[0]
    monkeypatch.setattr("podeep.solve.eigen._WHOLE", 10)
    by_lanczos = one.solved(8)[0]
    assert by_lanczos == pytest.approx(whole, rel=1e-9)


def test_all_mass_takes_part_in_all_modes() -> None:
    scene = beam(CF11, "free-free", 20e6, Numerics(accuracy=1e-3))
    result = found(scene, 6)
    taking = sum(m.participating for m in result.modes if m.kind != "axial")
    assert result.lateral_mass == pytest.approx(75000.0)
    assert taking == pytest.approx(75000.0, rel=1e-9)  # all of it in the rigid translation
    assert all(max(np.abs(m.shape[0])) <= 1.0 + 1e-6 for m in result.modes)
    assert all(max(np.abs(m.shape[0])) > 0.98 for m in result.modes)


def test_axial_modes_of_a_bar() -> None:
    bar = replace(CF11, bending_stiffness_override=1e16, axial_stiffness_override=5e9)
    result = found(beam(bar, "clamped-free", 0.0, FINE), 3)
    wave = sqrt(5e9 / 2500.0) / (4.0 * 30.0)
    assert [m.kind for m in result.modes] == ["axial"] * 3
    assert [m.frequency for m in result.modes] == pytest.approx(
        [wave, 3.0 * wave, 5.0 * wave], rel=1e-6
    )


def test_planes_that_differ_have_their_own_modes() -> None:
    scene = beam(CF11, "free-free", 20e6, Numerics(accuracy=1e-4))
    scene = replace(scene, numerics=Numerics(accuracy=1e-4))
    assert [m.kind for m in found(scene, 2).modes] == ["lateral"] * 2
    stiffer = replace(scene, springs=(Spring(1, 0.0, "Y", 1e8),))
    kinds = [m.kind for m in found(stiffer, 4).modes]
    # three without the spring's part: two of them along x, one about its end along y
    assert sorted(kinds[:3]) == ["lateral x", "lateral x", "lateral y"]
    turned = Load("L", 1, 0.0, (1e5, 1e5 * 3.0**0.5, 0.0), (0.0, 0.0, 0.0))
    pile = replace(reference_pile(shape="2GEO"), loads=(turned,))
    pile = replace(pile, loads=(replace(turned, name="HEAD", force=(1e6, 1e6 * 3**0.5, 0.0)),))
    first, second = found(pile, 2, 5).modes
    assert (first.kind, second.kind) == ("lateral 60 deg", "lateral 150 deg")  # soft along the load
    assert first.frequency < second.frequency


def test_an_infinite_slope_at_rest_is_told() -> None:
    pile = reference_pile(shape="POWER")
    result = found(pile, 2)
    assert any("infinite slope at rest" in note and "0.001 m" in note for note in result.notes)
    softer = modes(pile, pile.foundations[0], 2, 0, 0.05)
    assert softer.modes[0].frequency < result.modes[0].frequency
    assert not any("infinite" in n for n in found(reference_pile(shape="2GEO"), 2).notes)


def test_a_mesh_that_is_given_is_kept() -> None:
    scene = beam(CF11, "pinned-pinned", 0.0, Numerics(elements=2, degree=3))
    result = found(scene, 2)
    exact = float(rows("CF11_frequencies.csv")[2]["f_Hz"])
    assert result.elements == 2
    missed = lateral(result)[1] / exact - 1.0
    assert 0.5 * missed < result.modes[1].error < missed


def test_what_cannot_be_solved_is_told() -> None:
    scene = reference_pile()
    with pytest.raises(UserError, match="no step 11; the deck has steps 0 to 10"):
        found(scene, 2, 11)
    empty = beam(replace(CF11, mass_override=0.0), "clamped-free", 0.0, FINE)
    with pytest.raises(UserError, match="F1 has no mass"):
        found(empty, 2)
    heavy = replace(scene, loads=(replace(scene.loads[0], force=(1e9, 0.0, 0.0)),))
    with pytest.raises(AnalysisFailed, match="step"):
        found(heavy, 2, 10)


def test_a_tube_that_nothing_holds_drifts() -> None:
    scene = replace(beam(CF11, "free-free", 0.0, Numerics()), supports=())
    assert scene.ground is NOTHING
    result = found(scene, 4)
    assert [m.frequency for m in result.modes[:3]] == [0.0] * 3
    assert result.modes[0].period == float("inf")
    held = replace(scene, supports=(Support(1, 0.0, ("X", "Z")),))
    assert [m.frequency == 0.0 for m in found(held, 2).modes] == [True, False]
