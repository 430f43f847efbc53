"""What a chart varies: meshes, iterations, lumped reactions, and the lines that ask for them."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from podeep.deck.read import read_deck
from podeep.model.results import Results
from podeep.scene import Load, Numerics, Scene, Steps
from podeep.solve.analysis import first_model, limits, run, solve, suited_model
from podeep.solve.newton import Method
from podeep.study.chart import Setting
from podeep.study.measure import (
    Probe,
    asking,
    converged,
    solved_row,
    states_of,
)
from podeep.study.settings import (
    Series,
    build,
    counts,
    deck_lines,
    plan,
)
from scenes import linear_ground, reference_pile

JACKET = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"
LUMPED, SPATIAL = Series(3, "lumped"), Series(5, spatial=True)


def silent(_: str) -> None:
    """Hear nothing."""


@pytest.mark.parametrize("growth", [2.0, 2.0**0.5])
@pytest.mark.parametrize("least", [1, 6, 81])
def test_numbers_of_elements_rise_from_the_least_to_many(least, growth):
    found = counts(least, growth, lumped=False)
    assert found[0] == max(least, 4)
    assert found[-1] >= max(96, 4 * least)
    assert all(1.1 < b / a < 1.8 * growth for a, b in pairwise(found))
    assert counts(least, growth, lumped=True)[-1] == 8 * found[-1]


def test_a_quick_plan_has_fewer_settings_and_runs_of_the_same_series():
    scene = reference_pile()
    model = first_model(scene, scene.foundations[0])
    quick, full = plan(model, quick=True), plan(model, quick=False)
    assert {s.series for s in quick.settings} == {s.series for s in full.settings}
    assert len(quick.settings) < 0.7 * len(full.settings)
    assert quick.runs < full.runs
    assert quick.patience < 60.0


def test_two_components_are_an_alternative_in_a_plane_alone():
    scene = reference_pile()
    across = Load("HEAD", 1, 0.0, (0.0, 1e6, 0.0), (0.0, 0.0, 0.0))
    for loads, offered in ((scene.loads, True), ((*scene.loads, across), False)):
        model = first_model(replace(scene, loads=loads), scene.foundations[0])
        assert (SPATIAL in {s.series for s in plan(model, quick=True).settings}) is offered


@pytest.mark.parametrize(
    ("numerics", "line"),
    [
        (Numerics(), "*MODEL, ELEMENTS=12, ORDER=7"),
        (
            Numerics(second_order=True, shear=True, axial_curves=False),
            "*MODEL, PDELTA, SHEAR=ON, TZ=OFF, ELEMENTS=12, ORDER=7",
        ),
        (Numerics(components=1), "*MODEL, PLANAR, ELEMENTS=12, ORDER=7"),
        (Numerics(components=2), "*MODEL, SPATIAL, ELEMENTS=12, ORDER=7"),
    ],
)
def test_deck_lines_keep_the_other_options(tmp_path, numerics, line):
    lines = deck_lines(numerics, 1e-4, Setting(Series(7), 12))
    assert lines == f"*ACCURACY\n0.0001\n{line}"
    own = line.split(", ELEMENTS")[0].removeprefix("*MODEL")
    rest = f"\n*MODEL{own}" if own else ""
    assert deck_lines(numerics, 1e-5, None) == f"*ACCURACY\n1e-05{rest}"
    path = tmp_path / "again.deck"
    path.write_text(JACKET.read_text().replace("*EXEC", f"{lines}\n*EXEC"))
    assert read_deck(path).scene.numerics == replace(numerics, accuracy=1e-4, elements=12, degree=7)


# --- how the variants solve ---------------------------


def solved_by(scene: Scene, setting: Setting) -> Results:
    base = first_model(scene, scene.foundations[0])
    limit = replace(limits(scene), method=setting.series.method, iterations=2000)
    results, failure, _ = states_of(build(scene, base, setting), scene, limit)
    assert failure is None
    return results


@pytest.mark.parametrize("method", ["full steps", "secant"])
@pytest.mark.parametrize("spatial", [False, True])
def test_every_iteration_finds_the_same_equilibrium(method: Method, spatial: bool):
    scene = reference_pile(shape="2GEO", numerics=Numerics(accuracy=1e-5))
    usual = solved_by(scene, Setting(Series(5), 16))
    other = solved_by(scene, Setting(Series(5, method=method, spatial=spatial), 16))
    x = np.linspace(-10.0, 40.0, 101)
    expected = usual.deflection(x)
    found = other.deflection(x)
    np.testing.assert_allclose(found[:, :1], expected, atol=1e-6 * np.abs(expected).max())
    if spatial:
        assert np.abs(found[:, 1]).max() == 0.0


def test_the_line_search_saves_unloading_and_secants_are_slow():
    """Where reactions change their sign on a cube root, full steps overshoot again and again."""
    scene = reference_pile((2e6, 0.0, 0.0), steps=1)
    scene = replace(scene, steps=Steps(("HEAD",), ((1.0,), (0.01,))))
    model = build(scene, first_model(scene, scene.foundations[0]), Setting(Series(5), 8))
    last, spent = {}, {}
    methods: tuple[Method, ...] = ("line search", "full steps", "secant")
    for method in methods:
        limit = replace(limits(scene), method=method)
        states, failure, _ = run(model, np.array(scene.steps.factors), limit)
        assert failure is None
        last[method], spent[method] = states[-1], sum(s.iterations for s in states)
    assert last["line search"].step_size == last["secant"].step_size == 1.0
    assert last["full steps"].step_size < 0.1
    assert spent["line search"] < 30 < spent["secant"]
    assert spent["full steps"] > 10 * spent["line search"]


def test_lumped_reactions_are_springs_at_the_nodes_of_each_side():
    """Each has half of its element's length and the curve of its own side of the node."""
    scene = reference_pile()
    base = first_model(scene, scene.foundations[0])
    model = build(scene, base, Setting(LUMPED, 10))
    points, edges = model.lateral.system.points[0], model.edges[model.edges > -1e-9]
    half = 0.5 * np.diff(edges)
    np.testing.assert_allclose(points.weight, np.repeat(half, 2))
    nodes = np.stack([edges[:-1], edges[1:]], axis=1).ravel()
    np.testing.assert_allclose(points.x, nodes, atol=1e-7)
    above, below = np.flatnonzero(np.abs(points.x - 15.0) < 1e-6)
    names = {i: t.name for t in points.reaction.laws for i in t.at}
    assert (names[above], names[below]) == ("soft_clay", "sand")


def test_lumped_results_are_in_balance_with_load_and_springs():
    """Between springs the shear is even and the moment straight, down to nothing at the tip."""
    results = solved_by(reference_pile((2e6, 0.0, -5e6)), Setting(LUMPED, 20))
    system, stretch = results.model.lateral.system, results.model.axial.system
    springs = system.points[0]
    u = system.displacement(results.lateral[-1])[:, 0]
    force = springs.weight * springs.reaction.evaluate(u)[0]
    edges = results.model.edges
    x = np.sort(np.concatenate([0.5 * (edges[:-1] + edges[1:]), edges[:-1] + 1e-6, [40.0]]))
    above = np.maximum(x[:, None] - springs.x, 0.0)
    shear, moment = (part[-1, 0] for part in results.shear_and_moment(x))
    expected = 2e6 * (x + 10.0) - above @ force
    np.testing.assert_allclose(np.abs(moment), np.abs(expected), atol=1e-5 * expected.max())
    left = 2e6 - (x[:-1, None] > springs.x) @ force
    np.testing.assert_allclose(np.abs(shear[:-1]), np.abs(left), atol=20.0)
    shaft = stretch.points[0]
    down = stretch.displacement(results.axial[-1])[: len(shaft.x), 0]
    friction = shaft.weight * shaft.reaction.evaluate(down)[0]
    carried = 5e6 - (x[:-1, None] > shaft.x) @ friction
    np.testing.assert_allclose(results.compression(x[:-1])[-1], carried, atol=50.0)


def test_lumped_reactions_converge_with_second_order_to_the_integrated_ones():
    """Linear soil, for which the order shows: a quarter of the error with each halving."""
    scene = replace(
        reference_pile((2e6, 0.0, -1e6), steps=1), ground=linear_ground(2e7, 2.0, friction=1e7)
    )
    base = suited_model(scene, scene.foundations[0])[0]
    probe = Probe(base)
    _, true = converged(
        scene, solve(asking(scene, 1e-5), scene.foundations[0]).model, probe, silent
    )
    error = []
    for n in (32, 64, 128):
        row, _ = solved_row(scene, base, Setting(LUMPED, n), probe, true)
        assert row.errors
        error.append(row.errors.displacement)
    orders = np.log2(np.array(error[:-1]) / error[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.2)
