"""Mass matrices: the mass of rigid motions, lumped masses on arms, water, tubes as one."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from podeep.beam.band import band_times, without
from podeep.beam.field import Field
from podeep.model.assemble import Model
from podeep.model.inertia import mass_band
from podeep.scene import Foundation, Mass, Numerics, Scene, Section, Tie, Tube
from podeep.solve.analysis import first_model
from scenes import reference_pile


def rigid(model: Model, shift: float, turn: float, component: int = 0) -> np.ndarray:
    """Unknowns of a motion y = shift + turn x."""
    field, m = model.lateral.system.field, model.needs.components
    q = np.zeros((field.size, m))
    edges = field.edges[field.strings.edge]
    for (top, bottom), dofs in zip(field.strings.joints, field.dofs, strict=True):
        q[dofs[0], component] = shift + turn * edges[top]
        q[dofs[-2], component] = shift + turn * edges[bottom]
        q[dofs[[1, -1]], component] = turn * field.slope_length
    return q.ravel()


def twice_energy(scene: Scene, model: Model, q: np.ndarray, **options: bool) -> float:
    return float(q @ band_times(mass_band(scene, model, "lateral", **options), q))


def scene_of(*sections: Section, masses: tuple[Mass, ...] = (), **numerics: object) -> Scene:
    pile = reference_pile(numerics=Numerics(**numerics))
    return replace(pile, tubes={1: Tube(1, "pile", sections)}, masses=masses)


PLAIN = Section(10.0, -40.0, 2.0, 0.05, 210e9, 7850.0)


@pytest.mark.parametrize("degree", [3, 5, 7])
@pytest.mark.parametrize("components", [1, 2])
def test_a_rigid_motion_has_the_mass_of_the_tube(degree: int, components: int) -> None:
    lower = replace(PLAIN, top=-12.0, wall_thickness=0.03)
    scene = scene_of(replace(PLAIN, bottom=-12.0), lower, degree=degree, components=components)
    model = first_model(scene, scene.foundations[0])
    upper_mass, lower_mass = 22.0 * PLAIN.mass, 28.0 * lower.mass
    q = rigid(model, 1.0, 0.0, components - 1)
    assert twice_energy(scene, model, q) == pytest.approx(upper_mass + lower_mass, rel=1e-13)
    q = rigid(model, 0.0, 1.0, components - 1)
    about = upper_mass / 22.0 * (10.0**3 + 12.0**3) / 3
    about += lower_mass / 28.0 * (40.0**3 - 12.0**3) / 3
    assert twice_energy(scene, model, q) == pytest.approx(about, rel=1e-13)


@pytest.mark.parametrize("shear", [False, True])
def test_rotary_inertia_turns_with_the_section(shear: bool) -> None:
    scene = scene_of(PLAIN, shear=shear)
    model = first_model(scene, scene.foundations[0])
    q = rigid(model, 0.0, 1.0)
    with_it, without_it = (twice_energy(scene, model, q, rotary=r) for r in (True, False))
    assert with_it - without_it == pytest.approx(50.0 * 7850.0 * PLAIN.second_moment, rel=1e-9)
    assert twice_energy(scene, model, q) == (with_it if shear else without_it)


def test_the_matrix_is_exact_for_every_function() -> None:
    edges = np.array([0.0, 1.5, 2.0])
    amount, rotary = np.array([3.0, 5.0]), np.array([0.7, 0.2])
    soft = np.array([4.0, 9.0])
    field = Field(edges, np.array([2.0, 3.0]), 5, 1, 0.8, soft)
    matrices = field.mass(amount, rotary)
    xi, weight = np.polynomial.legendre.leggauss(24)
    for e in range(2):
        half = 0.5 * field.lengths[e]
        x = edges[e] + half * (xi + 1.0)
        motion = field.interpolation(x).toarray()[:, field.dofs[e]]
        turned = field.rotation(x).toarray()[:, field.dofs[e]]
        exact = half * (motion.T * weight * amount[e] @ motion)
        exact += half * (turned.T * weight * rotary[e] @ turned)
        assert np.allclose(matrices[e], exact, rtol=1e-11, atol=1e-12 * np.abs(exact).max())


def test_a_mass_on_an_arm_moves_with_the_top() -> None:
    mass = Mass(1, 13.0, 350e3, (2.0e7, 3.0e7, 4.0e7))
    light = replace(PLAIN, mass_override=1e-9)
    scene = scene_of(light, masses=(mass,), components=2)
    model = first_model(scene, scene.foundations[0])
    for component, about in ((0, 3.0e7), (1, 2.0e7)):
        still = rigid(model, 1.0, 0.0, component)
        assert twice_energy(scene, model, still) == pytest.approx(350e3, rel=1e-9)
        # y = 1 + x / 13: the mass, 13 m above the mudline, stands still and only turns
        turning = rigid(model, 1.0, 1.0 / 13.0, component)
        assert twice_energy(scene, model, turning) == pytest.approx(about / 169.0, rel=1e-9)
    axial = mass_band(scene, model, "axial")
    assert axial[0, 0] == pytest.approx(350e3)
    planar = replace(scene, numerics=Numerics(components=1))
    model = first_model(planar, scene.foundations[0])
    turning = rigid(model, 1.0, 1.0 / 13.0)
    assert twice_energy(planar, model, turning) == pytest.approx(3.0e7 / 169.0, rel=1e-9)


def test_water_and_filling_move_along() -> None:
    wet = replace(PLAIN, added_mass_coefficient=0.9, fill_density=1500.0)
    scene = replace(scene_of(wet), foundations=(Foundation(1, (1,), -25.0),))
    model = first_model(scene, scene.foundations[0])
    inside = pi / 4.0 * wet.inner_diameter**2 * 1500.0
    outside = 0.9 * 1025.0 * pi / 4.0 * wet.outer_diameter**2
    whole = 50.0 * (wet.mass + inside)
    sideways = twice_energy(scene, model, rigid(model, 1.0, 0.0))
    assert sideways == pytest.approx(whole + 25.0 * outside, rel=1e-13)
    field = model.axial.system.field
    down = np.zeros(field.size)
    down[field.dofs[:, [0, -1]]] = 1.0
    assert down @ band_times(mass_band(scene, model, "axial"), down) == pytest.approx(whole)


def test_cemented_tubes_add_their_masses() -> None:
    inner = Tube(2, "inner", (replace(PLAIN, outer_diameter=1.5, bottom=-30.0),))
    both = Foundation(1, (1, 2), 0.0)
    scene = replace(scene_of(PLAIN), foundations=(both,))
    scene = replace(scene, tubes={**scene.tubes, 2: inner})
    whole = 50.0 * PLAIN.mass + 40.0 * inner.sections[0].mass
    for ties in ((), (Tie(1, 2, 10.0, -30.0),), (Tie(1, 2, 0.0, -20.0),)):
        tied = replace(scene, ties=ties)
        model = first_model(tied, both)
        energy = twice_energy(tied, model, rigid(model, 1.0, 0.0))
        assert energy == pytest.approx(whole, rel=1e-13)


def test_held_unknowns_can_be_taken_out() -> None:
    scene = scene_of(PLAIN)
    model = first_model(scene, scene.foundations[0])
    band = mass_band(scene, model, "lateral")
    assert band.flags.f_contiguous
    assert band.shape == (model.lateral.system.width, model.lateral.system.size)
    held = np.array([0, 7])
    q = np.arange(1.0, model.lateral.system.size + 1.0)
    free = q.copy()
    free[held] = 0.0
    expected = band_times(band, free)
    expected[held] = 0.0
    left = without(band, held)
    assert left.flags.f_contiguous
    assert np.allclose(band_times(left, q), expected, rtol=1e-13)
