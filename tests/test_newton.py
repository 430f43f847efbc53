"""Newton with an energy search: what it must survive, and what it may spend."""

import numpy as np
import pytest

from podeep.model.needs import Needs
from podeep.scene import Numerics
from podeep.solve.analysis import run, solve
from podeep.solve.newton import Ending, Limits, newton
from scenes import reference_pile
from test_system import model

PLANAR = Needs(0.0, 1, ())
LIMITS = Limits(1e-9)


@pytest.mark.parametrize("elements", [4, 6, 12, 48])
@pytest.mark.parametrize("force", [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 2e7])
@pytest.mark.parametrize("steps", [1, 7])
def test_cube_root_clay_never_fails(elements: int, force: float, steps: int) -> None:
    """Plain Newton maps y to -2 y on a cube root; the search must turn every one of these."""
    discrete = model(reference_pile((force, 0.0, 0.0)), PLANAR, 5, elements)
    factors = np.linspace(0.0, 1.0, steps + 1)[1:, None]
    states, failure = run(discrete, factors, LIMITS)
    assert failure is None
    assert states[-1].residual <= 1e-6
    assert sum(s.iterations for s in states) <= 16 * steps


def test_the_reference_pile_takes_few_iterations() -> None:
    solved = solve(*_with(reference_pile(numerics=Numerics(elements=13))))
    assert solved.failure is None
    assert sum(s.iterations for s in solved.states) <= 36
    one = solve(*_with(reference_pile(steps=1, numerics=Numerics(elements=13))))
    assert one.states[-1].iterations <= 12


def test_one_step_and_many_end_in_the_same_state() -> None:
    """Path independent laws: load steps are for output only."""
    one = solve(*_with(reference_pile(steps=1, numerics=Numerics(elements=13, accuracy=1e-6))))
    many = solve(*_with(reference_pile(steps=9, numerics=Numerics(elements=13, accuracy=1e-6))))
    scale = np.abs(one.states[-1].lateral).max()
    assert np.abs(one.states[-1].lateral - many.states[-1].lateral).max() < 1e-8 * scale


def test_a_linear_problem_takes_one_iteration() -> None:
    problem = model(reference_pile(), PLANAR).lateral
    system = problem.system
    for point in system.points:
        assert point.reaction.size
    q = np.zeros(system.size)
    outcome = newton(system, q, 1e-9 * problem.load(np.array([1.0])), Limits(1e-6))
    again = newton(system, outcome.q, 1e-9 * problem.load(np.array([1.0])), Limits(1e-6))
    assert again.work.iterations == 0
    assert again.ending is Ending.CONVERGED


def test_nothing_to_hold_the_tube_is_a_mechanism() -> None:
    from dataclasses import replace

    from podeep.scene import Ground

    scene = reference_pile()
    ground = scene.ground
    bare = Ground(ground.depths, (0, 0, 0, 0), ground.axial, {}, ground.axial_curves)
    solved = solve(*_with(replace(scene, ground=bare)))
    assert solved.failure is not None
    assert solved.failure.ending is Ending.MECHANISM
    assert solved.states[-1].step == 0


@pytest.mark.parametrize(("lateral", "axial"), [(80e6, 0.0), (0.0, 60e6)])
def test_above_capacity_the_steps_below_are_kept(lateral: float, axial: float) -> None:
    """Rigid-plastic lateral capacity of the reference pile is 67.54 MN, axial 47.66 MN."""
    solved = solve(*_with(reference_pile((lateral, 0.0, -axial))))
    assert solved.failure is not None
    reached = (solved.failure.step - 1 + solved.failure.reached) / 10 * max(lateral, axial)
    capacity = 67.54e6 if lateral else 47.66e6
    assert 0.98 * capacity < reached < capacity
    assert len(solved.states) == solved.failure.step


def _with(scene):
    return scene, scene.foundations[0]
