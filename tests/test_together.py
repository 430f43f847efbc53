"""Many states at once are those one by one; straight lines side by side are those apart."""

import numpy as np
import pytest

from podeep.arrays import Array
from podeep.model.many import internal_of_many, solve_many
from podeep.scene import Numerics
from podeep.soil.polyline import Polyline
from podeep.soil.reaction import Reaction
from podeep.solve.analysis import first_model, limits, run
from podeep.solve.newton import Limits, newton
from podeep.solve.together import equilibria
from scenes import reference_pile

LIMIT = 1e-9


@pytest.mark.parametrize("components", [1, 2])
@pytest.mark.parametrize("which", ["lateral", "axial"])
def test_states_at_once_are_those_one_by_one(components: int, which: str) -> None:
    scene = reference_pile(numerics=Numerics(elements=7, components=components))
    model = first_model(scene, scene.foundations[0])
    factors = np.array(scene.steps.factors)
    states, _, _ = run(model, factors, limits(scene))
    problem = getattr(model, which)
    system = problem.system
    near = 0.97 * np.array([getattr(s, which) for s in states[1:]])
    loads = problem.load(factors)

    internal, moduli = internal_of_many(system, near)
    moves = solve_many(system, moduli, loads - internal)
    assert moves is not None
    for q, load, force, move in zip(near, loads, internal, moves, strict=True):
        alone = system.internal(q)
        assert force == pytest.approx(alone, rel=1e-12, abs=1e-9 * np.abs(alone).max())
        step = system.solve(load - alone)
        assert move == pytest.approx(step, rel=1e-7, abs=1e-9 * np.abs(step).max())

    found, settled = equilibria(system, near, loads, LIMIT)
    assert settled.any()
    for q, load, start in zip(found[settled], loads[settled], near[settled], strict=True):
        alone = newton(system, start, load, Limits(LIMIT)).q
        assert np.abs(q - alone).max() <= 1e-7 * np.abs(alone).max()


def test_what_does_not_converge_is_told() -> None:
    """From rest a cube root takes more iterations than are allowed here."""
    scene = reference_pile()
    problem = first_model(scene, scene.foundations[0]).lateral
    load = problem.load(np.array([[1.0]]))
    _, settled = equilibria(problem.system, np.zeros((1, problem.system.size)), load, LIMIT)
    assert not settled.any()


def curve(nodes: list[float], n: int, seed: int) -> Polyline:
    """An odd curve of n points with random values."""
    values = np.cumsum(np.random.default_rng(seed).uniform(0.1, 1.0, (len(nodes), n)), axis=0)
    values -= values[0]
    return Polyline(np.array(nodes), values, np.linspace(0.5, 2.0, n)).mirrored()


def test_lines_side_by_side_are_those_apart() -> None:
    one, two = curve([0.0, 0.1, 0.5, 2.0], 4, 1), curve([0.0, 0.2, 0.5], 3, 2)
    both = Polyline.joined([one, two])
    for u in np.linspace(-5.0, 5.0, 201):
        first, second = np.full(4, u), np.full(3, u)
        apart: list[Array] = [
            np.concatenate(pair)
            for pair in zip(one.evaluate(first), two.evaluate(second), strict=True)
        ]
        for got, expected in zip(both.evaluate(np.full(7, u)), apart, strict=True):
            assert got == pytest.approx(expected, rel=1e-13, abs=1e-14)


def test_reactions_of_several_parts_are_one_after_the_other() -> None:
    model = first_model(scene := reference_pile(), scene.foundations[0])
    parts = [points.reaction for points in model.axial.system.points]
    u = np.linspace(-0.01, 0.05, sum(part.size for part in parts))
    cuts = np.cumsum([part.size for part in parts])[:-1]
    apart = [part.evaluate(v) for part, v in zip(parts, np.split(u, cuts), strict=True)]
    together = Reaction.joined(parts).evaluate(u)
    for got, expected in zip(together, zip(*apart, strict=True), strict=True):
        assert got == pytest.approx(np.concatenate(expected), rel=1e-12)
