"""Newton with an energy search: what it must survive, and what it may spend."""

from dataclasses import replace

import numpy as np
import pytest

from podeep.arrays import Array
from podeep.errors import UserError
from podeep.model.needs import Needs
from podeep.scene import Ground, Numerics, Scene
from podeep.solve.analysis import Solved, run, solve
from podeep.solve.newton import Ending, Limits, newton, search
from podeep.solve.statics import same_increment
from scenes import linear_ground, reference_pile
from test_system import model

PLANAR = Needs(0.0, 1, ())
LIMITS = Limits(1e-9)


def solved(scene: Scene) -> Solved:
    return solve(scene, scene.foundations[0])


@pytest.mark.parametrize("elements", [4, 6, 12, 48])
@pytest.mark.parametrize("force", [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 2e7])
@pytest.mark.parametrize("steps", [1, 7])
def test_cube_root_clay_never_fails(elements: int, force: float, steps: int) -> None:
    """Plain Newton maps y to -2 y on a cube root; the search must turn every one of these."""
    discrete = model(reference_pile((force, 0.0, 0.0)), PLANAR, 5, elements)
    factors = np.linspace(0.0, 1.0, steps + 1)[1:, None]
    states, failure, _ = run(discrete, factors, LIMITS)
    assert failure is None
    assert all(s.residual <= 1e-6 and s.step_size == 1.0 for s in states)
    assert sum(s.iterations for s in states) <= 16 * steps


def test_the_search_cuts_a_step_that_overshoots() -> None:
    """The energy of c y |y|^(-2/3): from y = 1 Newton goes to -2, beyond the minimum at 0."""

    def evaluate(q: Array) -> tuple[Array, Array]:
        force = np.cbrt(q)
        return force, -force

    start, step = np.array([1.0]), np.array([-3.0])
    found, _, residual = search(evaluate, start, step, float(step @ -np.cbrt(start)))
    assert abs(found[0]) < 0.3
    assert abs(float(step @ residual)) <= 0.5 * 3.0


def test_the_search_lengthens_a_step_that_is_short() -> None:
    """The energy of y^2 / 2 - y: a hundredth of the way to the minimum at 1 is no step."""

    def evaluate(q: Array) -> tuple[Array, Array]:
        return q, 1.0 - q

    step = np.array([0.01])
    found, _, residual = search(evaluate, np.zeros(1), step, 0.01)
    assert 0.5 <= found[0] <= 1.5
    assert abs(float(step @ residual)) <= 0.5 * 0.01


def test_the_reference_pile_takes_few_iterations() -> None:
    """Ten steps of both problems: 21 iterations and 41 evaluations when this was written."""
    ten = solved(reference_pile(numerics=Numerics(elements=13)))
    assert ten.failure is None
    assert sum(s.iterations for s in ten.states) <= 23
    assert sum(s.evaluations for s in ten.states) <= 43
    one = solved(reference_pile(steps=1, numerics=Numerics(elements=13)))
    assert one.states[-1].iterations <= 7


def test_one_step_and_many_end_in_the_same_state() -> None:
    """Path independent laws: load steps are for output only."""
    numerics = Numerics(elements=13, accuracy=1e-6)
    one = solved(reference_pile(steps=1, numerics=numerics))
    many = solved(reference_pile(steps=9, numerics=numerics))
    scale = np.abs(one.states[-1].lateral).max()
    assert np.abs(one.states[-1].lateral - many.states[-1].lateral).max() < 1e-8 * scale


def test_a_linear_problem_takes_one_iteration_and_its_solution_none() -> None:
    scene = replace(reference_pile(), ground=linear_ground(20e6, 2.0))
    problem = model(scene, PLANAR).lateral
    load = problem.load(np.array([1.0]))
    first = newton(problem.system, np.zeros(problem.system.size), load, Limits(1e-10))
    assert (first.ending, first.work.iterations) == (Ending.CONVERGED, 1)
    again = newton(problem.system, first.q, load, Limits(1e-10))
    assert (again.ending, again.work.iterations) == (Ending.CONVERGED, 0)


def test_nothing_to_hold_the_tube_is_told_before_it_is_solved() -> None:
    scene = reference_pile()
    ground = scene.ground
    bare = Ground(ground.depths, (0, 0, 0, 0), ground.axial, {}, ground.axial_curves)
    with pytest.raises(UserError, match="nothing holds the tube against its lateral loads"):
        solved(replace(scene, ground=bare))


@pytest.mark.parametrize(
    ("lateral", "axial", "capacity"), [(80e6, 0.0, 67.54e6), (0.0, 60e6, 47.66e6)]
)
def test_above_capacity_the_steps_below_are_kept(
    lateral: float, axial: float, capacity: float
) -> None:
    """Rigid-plastic lateral capacity of the reference pile; shaft and tip of the axial one."""
    stopped = solved(reference_pile((lateral, 0.0, -axial)))
    assert stopped.failure is not None
    reached = (stopped.failure.step - 1 + stopped.failure.reached) / 10 * max(lateral, axial)
    assert 0.98 * capacity < reached < capacity
    assert len(stopped.states) == stopped.failure.step


def test_energy_is_the_work_of_the_load() -> None:
    """Linear soil: half of load times displacement, in one step or in five."""
    for steps in (1, 5):
        scene = reference_pile((1e5, 0.0, 0.0), steps=steps, numerics=Numerics(elements=13))
        linear = solved(replace(scene, ground=linear_ground(20e6, 2.0)))
        head = linear.results.deflection(np.array([-10.0]))[-1, 0, 0]
        assert linear.states[-1].energy == pytest.approx(0.5 * 1e5 * head, rel=1e-6)


def test_equal_growth_is_seen() -> None:
    factors = np.array([[0.5, 0.0], [1.0, 0.0], [1.0, 0.5], [1.0, 1.0], [0.8, 1.0]])
    assert same_increment(factors) == [False, True, False, True, False]
    assert same_increment(np.array([[1.0]])) == [False]


def test_a_limit_of_the_increment_asks_for_more_iterations() -> None:
    """A loose residual is met early; the increment goes on until the unknowns stand still."""
    problem = model(reference_pile(), PLANAR).lateral
    load, rest = problem.load(np.array([1.0])), np.zeros(problem.system.size)
    loose = newton(problem.system, rest, load, Limits(1e-1))
    still = newton(problem.system, rest, load, Limits(1e-1, increment=1e-6))
    assert loose.ending is still.ending is Ending.CONVERGED
    assert still.work.iterations > loose.work.iterations
    assert still.residual < 1e-6
