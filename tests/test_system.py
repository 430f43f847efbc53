"""The discrete equilibrium: tangent, directions, rigid motions, held unknowns."""

from math import cos, radians, sin

import numpy as np
import pytest

from podeep.arrays import Array
from podeep.model.assemble import Model, assemble, cut
from podeep.model.mesh import edges
from podeep.model.needs import Needs
from podeep.scene import Scene
from podeep.soil.profile import Profile
from scenes import reference_pile

SPATIAL = Needs(None, 2, ())
PLANAR = Needs(0.0, 1, ())


def model(scene: Scene, wanted: Needs, degree: int = 5, elements: int = 9) -> Model:
    foundation, profile = scene.foundations[0], Profile(scene.ground)
    pieces = cut(scene, foundation, profile)
    boundaries = edges(pieces, profile, 1.0, elements)
    return assemble(scene, foundation, wanted, profile, pieces, boundaries, degree)


def dense_tangent(solve: object, size: int) -> Array:
    columns = [solve(column) for column in np.eye(size)]  # type: ignore[operator]
    return np.linalg.inv(np.array(columns).T)


@pytest.mark.parametrize("wanted", [PLANAR, SPATIAL], ids=["planar", "spatial"])
@pytest.mark.parametrize("degree", [3, 5])
def test_tangent_is_the_derivative_of_the_internal_forces(wanted: Needs, degree: int) -> None:
    system = model(reference_pile(), wanted, degree).lateral.system
    rng = np.random.default_rng(1)
    q = 0.05 * rng.standard_normal(system.size)
    system.internal(q)
    tangent = dense_tangent(system.solve, system.size)
    step = 1e-6
    numeric = np.array(
        [
            (system.internal(q + step * e) - system.internal(q - step * e)) / (2 * step)
            for e in np.eye(system.size)
        ]
    ).T
    assert np.abs(tangent - numeric).max() < 1e-6 * np.abs(numeric).max()
    np.testing.assert_allclose(tangent, tangent.T, atol=1e-9 * np.abs(tangent).max())


def test_the_tangent_at_rest_is_the_exact_limit_in_both_directions() -> None:
    scene = reference_pile(shape="2GEO")
    spatial, planar = model(scene, SPATIAL).lateral.system, model(scene, PLANAR).lateral.system
    spatial.internal(np.zeros(spatial.size))
    planar.internal(np.zeros(planar.size))
    both, one = (dense_tangent(s.solve, s.size) for s in (spatial, planar))
    np.testing.assert_allclose(both[0::2, 0::2], one, rtol=1e-9, atol=1e-9 * one.max())
    np.testing.assert_allclose(both[1::2, 1::2], one, rtol=1e-9, atol=1e-9 * one.max())
    assert np.abs(both[0::2, 1::2]).max() < 1e-9 * one.max()


@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0, 90.0, 133.0])
def test_a_spatial_reaction_does_not_depend_on_the_direction(angle: float) -> None:
    system = model(reference_pile(), SPATIAL).lateral.system
    along = np.random.default_rng(2).standard_normal(system.size // 2)
    reference = system.internal(np.stack([along, 0.0 * along], axis=1).ravel())[0::2]
    c, s = cos(radians(angle)), sin(radians(angle))
    forces = system.internal(np.stack([c * along, s * along], axis=1).ravel())
    scale = np.abs(reference).max()
    assert np.abs(c * forces[0::2] + s * forces[1::2] - reference).max() < 1e-13 * scale
    assert np.abs(-s * forces[0::2] + c * forces[1::2]).max() < 1e-13 * scale


@pytest.mark.parametrize("degree", [3, 5, 7])
def test_rigid_motions_cost_the_beam_nothing(degree: int) -> None:
    field = model(reference_pile(), PLANAR, degree).lateral.system.field
    for motion in (lambda x: 1.0 + 0.0 * x, lambda x: 0.01 * x):
        q = np.zeros(field.size)
        nodes = [*field.dofs[:, :1].ravel().tolist(), field.dofs[-1, -2]]
        slope = motion(np.ones(1))[0] - motion(np.zeros(1))[0]
        q[nodes] = motion(field.edges)
        q[np.array(nodes) + 1] = slope * field.slope_length
        x = np.linspace(field.edges[0], field.edges[-1], 57)
        np.testing.assert_allclose(field.interpolation(x) @ q, motion(x), atol=1e-12)
        np.testing.assert_allclose(field.interpolation(x, 1) @ q, slope, atol=1e-12)
        energy = np.einsum("ei,eij,ej->", q[field.dofs], field.element_stiffness, q[field.dofs])
        assert abs(energy) < 1e-10 * field.element_stiffness.max()
