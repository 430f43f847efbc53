"""Observed orders of convergence on meshes aligned with mudline and layers."""

import numpy as np
import pytest

from podeep.arrays import Array
from podeep.beam.field import Field
from podeep.model.around import quadrature
from podeep.model.assemble import assemble, cut
from podeep.model.needs import Needs
from podeep.model.points import Points
from podeep.model.system import System
from podeep.soil.profile import Profile
from podeep.solve.newton import Limits, newton
from scenes import linear_ground, reference_pile

PLANAR = Needs(0.0, 1, ())


def head(elements: int, degree: int) -> float:
    """Head displacement of the reference pile at 2 MN in one step, layers divided evenly."""
    scene = reference_pile((2e6, 0.0, 0.0))
    profile = Profile(scene.ground)
    pieces = cut(scene, scene.foundations[0], profile)
    clay, sand = max(elements * 15 // 40, 1), elements - max(elements * 15 // 40, 1)
    boundaries = np.concatenate(
        [[-10.0], np.linspace(0.0, 15.0, clay + 1), np.linspace(15.0, 40.0, sand + 1)[1:]]
    )
    built = assemble(scene, scene.foundations[0], PLANAR, profile, pieces, boundaries, degree)
    system = built.lateral.system
    found = newton(
        system, np.zeros(system.size), built.lateral.load(np.array([1.0])), Limits(1e-11)
    )
    return float(found.q[0])


def orders(errors: list[float]) -> Array:
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


def test_cubic_elements_on_cube_root_clay_and_sand_are_of_order_four() -> None:
    exact = head(40, 7)
    errors = [abs(head(n, 3) / exact - 1.0) for n in (16, 32, 64)]
    assert orders(errors).min() >= 3.8
    assert errors[-1] < 1e-6


def test_the_reference_head_displacement_is_that_of_two_independent_methods() -> None:
    """0.35697907 m by collocation and by quintic elements, given to eight digits."""
    assert head(40, 7) == pytest.approx(0.35697907, abs=1e-8)


@pytest.mark.parametrize(("degree", "order", "coarsest"), [(3, 4, 12), (5, 8, 6)])
def test_order_on_linear_soil_is_twice_the_degree_less_two(
    degree: int, order: int, coarsest: int
) -> None:
    """Semi-infinite beam on springs, y0 = 2 H b / k (Hetenyi 1946); nodes are superconvergent."""
    stiffness, modulus = 7.38e6, 14e6
    beta = (modulus / (4.0 * stiffness)) ** 0.25
    profile = Profile(linear_ground(modulus, 1.0))
    errors = []
    for elements in (coarsest, 2 * coarsest, 4 * coarsest):
        boundaries = np.linspace(0.0, 24.0 / beta / 2.0, elements + 1)
        field = Field(boundaries, np.full(elements, stiffness), degree, 1, 1.0)
        x, weight = quadrature(boundaries, np.arange(elements), degree)
        points = Points(x, weight, profile.lateral(x, np.ones(len(x))))
        system = System(field, 1, [points], [], np.zeros(0, dtype=np.intp))
        load = np.zeros(system.size)
        load[0] = 1e5
        found = newton(system, np.zeros(system.size), load, Limits(1e-13))
        errors.append(abs(found.q[0] / (2e5 * beta / modulus) - 1.0))
    assert orders(errors).min() >= order - 0.5
