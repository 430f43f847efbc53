"""Beyond a peak, against closed forms: rigid tubes whose load is an integral of the law.

A rigid tube moves every point of the soil alike, so that the whole branch, rising or falling, is
known. A tube under axial load alone is known as well: given the settlement of its tip, the rest
follows upwards by integration (an initial value problem), snap-back or not.
"""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from podeep.deck.read import read_deck
from podeep.model.needs import Needs
from podeep.model.results import Results
from podeep.scene import Scene
from podeep.soil.profile import profile_of
from podeep.solve.accuracy import unestimated
from podeep.solve.analysis import Solved, first_model, limits, run
from podeep.solve.bordered import Bordered
from podeep.solve.continuation import Walk
from podeep.solve.diagnosis import explain
from podeep.solve.loaded import Loaded
from podeep.solve.newton import Ending, Scale
from podeep.solve.path import PathEnd, follow
from podeep.solve.statics import Failure, State
from scenes import reference_pile
from test_softening import CURVES, DIAMETER, LENGTH, STIFF
from test_system import model

RIGID = 6e-4  # what is left of the bending
RIGID_MODEL = "*MODEL, PATH=ON, ELEMENTS=16"
BREAKS = CURVES["user curve that breaks"]


def scene_of(folder: Path, *lines: str) -> Scene:
    path = folder / "case.deck"
    path.write_text("\n".join((*lines, "*EXEC", "")), encoding="utf-8")
    return read_deck(path).scene


def stub(folder: Path, curve: str, load: str, *more: str, held: str = "1 0 RY") -> Scene:
    """A tube of 8 m by 1 m, rigid, whose soil is one p-y curve."""
    return scene_of(
        folder,
        f"*DEPTH\n0\n*GROUNDEPTH\n0\n{curve}*GROUNDPROP\n1 0\n*CASING\n1 PILE",
        f"0 {-LENGTH!r} {DIAMETER!r} 0.05 210e9 7850 EI={STIFF!r}",
        f"*FONDATION\n1 1\n*SUPPORT\n{held}\n1 {-LENGTH!r} Z",
        f"*LOAD\nHEAD 1 0 {load}\n*QUASISTATIC\n10",
        *more,
    )


def followed(scene: Scene) -> Solved:
    """States and path on the first mesh, without the estimate of errors."""
    discrete = first_model(scene, scene.foundations[0])
    states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
    path = follow(discrete, failure, limits(scene))
    whole = (*states, *path.states)
    unknown = (unestimated(len(whole)),) * 2
    return Solved(discrete, whole, unknown, failure, 1e-3, path)


def factors(solved: Solved) -> np.ndarray:
    return np.array([s.factors[0] for s in solved.states])


def panels(count: int = 800) -> np.ndarray:
    edges = np.linspace(0.0, LENGTH, count + 1)
    return 0.5 * (edges[1:] + edges[:-1])


@pytest.mark.parametrize("name", CURVES)
def test_a_rigid_tube_follows_the_law_beyond_its_peak(tmp_path, name):
    load = 20e6 if "stiff" in name else 2.1e6
    scene = stub(tmp_path, CURVES[name], f"{load!r} 0 0", RIGID_MODEL)
    found = followed(scene)
    z = panels()
    law = profile_of(scene, scene.foundations[0]).lateral(z, np.full(len(z), DIAMETER))

    def force(y: np.ndarray) -> np.ndarray:
        return law.evaluate(y[:, None] * np.ones(len(z)))[0].sum(axis=1) * LENGTH / len(z)

    y = found.results.deflection(np.array([0.5 * LENGTH]))[:, 0, 0]
    np.testing.assert_allclose(load * factors(found)[1:], force(y[1:]), rtol=RIGID)
    grid = np.linspace(0.5, 1.5, 401) * y[found.steps + found.path.peak]
    peak = found.path.states[found.path.peak].factors[0]
    assert load * peak == pytest.approx(force(grid).max(), rel=RIGID)
    assert found.path.end is PathEnd.FLAT
    assert load * factors(found)[-1] == pytest.approx(force(np.array([3.0]))[0], rel=RIGID)
    assert len(found.path.states) > 25


@pytest.mark.parametrize("held", ["1 0 RY", "1 -8 X"], ids=["pushed", "turned about its tip"])
def test_the_load_may_turn_a_rigid_tube(tmp_path, held):
    """Held at its tip the tube turns: equilibrium is that of moments about the tip."""
    scene = stub(tmp_path, BREAKS, "2e6 0 0", RIGID_MODEL, held=held)
    found = followed(scene)
    z = panels()
    law = profile_of(scene, scene.foundations[0]).lateral(z, np.full(len(z), DIAMETER))
    head = found.results.deflection(np.zeros(1))[1:, 0, 0]
    shape = np.ones(len(z)) if "RY" in held else 1.0 - z / LENGTH
    work = (law.evaluate(head[:, None] * shape)[0] * shape).mean(axis=1) * LENGTH
    np.testing.assert_allclose(2e6 * factors(found)[1:], work, rtol=2e-3)
    assert 2e6 * factors(found)[-1] < 0.2 * work.max()


def test_the_normal_force_falls_with_the_load(tmp_path):
    """P-delta: about its tip, the moment of the soil is H L + V y of the head, both falling."""
    side, down = 1e6, 10e6
    scene = stub(
        tmp_path,
        BREAKS,
        f"{side!r} 0 {-down!r}",
        f"{RIGID_MODEL}, PDELTA",
        held="1 -8 X",
    )
    found = followed(scene)
    assert found.path.which == "lateral"
    z = panels()
    law = profile_of(scene, scene.foundations[0]).lateral(z, np.full(len(z), DIAMETER))
    head = found.results.deflection(np.zeros(1))[1:, 0, 0]
    arm = 1.0 - z / LENGTH
    moment = (law.evaluate(head[:, None] * arm)[0] * arm).mean(axis=1) * LENGTH**2
    expected = moment / (side * LENGTH + down * head)
    np.testing.assert_allclose(factors(found)[1:], expected, rtol=2e-3)
    normal = found.results.compression(np.array([0.5 * LENGTH]))[1:, 0]
    np.testing.assert_allclose(normal, down * factors(found)[1:], rtol=1e-5)
    assert expected[-1] < 0.5 * expected.max()


def test_a_column_nears_its_critical_load_along_the_path(tmp_path, monkeypatch):
    """A rigid rod with a spring at half its length: the load rises to k L/4 and never falls."""
    stiffness, side = 4e6, 1e4
    down = 1.5 * stiffness * LENGTH / 4.0
    scene = scene_of(
        tmp_path,
        "*DEPTH\n0\n*GROUNDEPTH\n0\n*PYCURVE\n1 0 0\n1e-3 1\n*GROUNDPROP\n1 0\n*CASING\n1 ROD",
        f"0 {-LENGTH!r} 1 0.05 210e9 7850 EI={STIFF!r}\n*FONDATION\n1 1",
        f"*SUPPORT\n1 {-LENGTH!r} X Z\n*SPRING\n1 {-0.5 * LENGTH!r} X {stiffness!r}",
        f"*LOAD\nHEAD 1 0 {side!r} 0 {-down!r}\n*QUASISTATIC\n10",
        f"{RIGID_MODEL}, PDELTA",
    )
    monkeypatch.setattr("podeep.solve.path._MOST", 150)
    discrete = first_model(scene, scene.foundations[0])
    states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
    assert failure.ending is Ending.BUCKLED
    path = follow(discrete, before(states[5], 0.5), limits(scene))
    head = np.array([s.lateral[0] for s in path.states])
    expected = 0.25 * stiffness * LENGTH * head / (side * LENGTH + down * head)
    factor = np.array([s.factors[0] for s in path.states])
    np.testing.assert_allclose(factor, expected, rtol=1e-4)
    assert 0.6 < factor[-1] < 1.0 / 1.5
    assert (np.diff(factor) > 0.0).all()
    assert path.end is PathEnd.LONG


def before(state: State, growth: float) -> Failure:
    """A path that starts in any state, as if the lateral problem had failed there."""
    place = (state.step + 1, 0.0, state.factors, np.array([growth]))
    return Failure(*place, "lateral", Ending.EXHAUSTED, state.lateral, state.axial, 0.0)


def pile(folder: Path, curve: str, modulus: float, load: str, *more: str) -> Scene:
    """40 m of 2 m by 50 mm in one t-z curve, without a tip, loaded down."""
    return scene_of(
        folder,
        f"*DEPTH\n0\n*GROUNDEPTH\n0\n{curve}*GROUNDPROP\n0 1\n*CASING\n1 PILE",
        f"0 -40 2 0.05 {modulus!r} 7850\n*FONDATION\n1 1\n{load}\n*QUASISTATIC\n10",
        "*MODEL, PATH=ON, ELEMENTS=80",
        *more,
    )


FALLS = "*TZCURVE\n1 0\n0 50e3\n25e3 0.002 0 0\n50e3 0.02 0 0.01\n{left} {at} 0 0.02\n"


def upwards(scene: Scene, tip: np.ndarray) -> np.ndarray:
    """Settlement of the head and load on it (m, N), from that of the tip, each of shape (n,)."""
    stiffness = scene.tubes[1].sections[0].axial_stiffness
    law = profile_of(scene, scene.foundations[0]).shaft(np.array([20.0]), np.array([2.0]))

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        settlement, force = state.reshape(2, -1)
        return np.concatenate([force / stiffness, law.evaluate(settlement[:, None])[0][:, 0]])

    start = np.concatenate([tip, np.zeros(len(tip))])
    path = solve_ivp(rates, (0.0, 40.0), start, rtol=1e-8, atol=1e-10, max_step=0.02)
    return path.y[:, -1].reshape(2, -1)


@pytest.mark.parametrize(
    ("left", "at", "modulus", "turns"),
    [(35e3, 0.04, 210e9, False), (35e3, 0.021, 10.5e9, True), (10e3, 0.0205, 10.5e9, True)],
    ids=["softening", "brittle", "very brittle"],
)
def test_the_branch_of_a_pile_is_that_of_shooting_from_its_tip(tmp_path, left, at, modulus, turns):
    """Every state, snap-back included: the tip sinks all along, whatever the head does."""
    load = "*LOAD\nHEAD 1 0 0 0 -16e6"
    scene = pile(tmp_path, FALLS.format(left=left, at=at), modulus, load)
    found = followed(scene)
    ends = found.results.settlement(np.array([0.0, 40.0]))
    head, tip = ends[found.steps :].T
    assert (np.diff(tip) > 0.0).all()
    assert (np.diff(head) < 0.0).any() == turns
    expected = upwards(scene, tip)
    np.testing.assert_allclose(head, expected[0], rtol=1e-3)
    np.testing.assert_allclose(16e6 * factors(found)[found.steps :], expected[1], rtol=1e-3)
    assert 16e6 * factors(found)[-1] == pytest.approx(2.0 * np.pi * left * 40.0, rel=1e-5)


def test_a_head_pushed_down_goes_the_same_way(tmp_path):
    """An imposed settlement turns back where it is largest; load control would jump across."""
    scene = pile(
        tmp_path, FALLS.format(left=10e3, at=0.0205), 10.5e9, "*DISPLACE\nHEAD 1 0 Z -0.05"
    )
    discrete = first_model(scene, scene.foundations[0])
    states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
    assert failure is None
    last, problem = states[-1], discrete.axial
    loaded = Loaded(problem, last.factors, np.ones(1))
    walk = Walk.start(loaded, last.axial, limits(scene), Scale(1e6, 0.05))
    points = [walk.point]
    for _ in range(120):
        points += walk.stride(0.02)
    found = Results(discrete, np.zeros((len(points), 0)), np.array([p.q for p in points]))
    head, tip = found.settlement(np.array([0.0, 40.0])).T
    np.testing.assert_allclose(head, [0.05 * (1.0 + p.factor) for p in points], rtol=1e-12)
    assert (np.diff(tip) > 0.0).all()
    assert (np.diff(head) < 0.0).any()
    expected = upwards(scene, tip)
    np.testing.assert_allclose(head, expected[0], rtol=1e-3)
    np.testing.assert_allclose(found.compression(np.zeros(1))[:, 0], expected[1], rtol=1e-3)


@pytest.mark.parametrize("times", [1.01, 40.0])
def test_a_plastic_plateau_is_walked_along(tmp_path, times):
    """Friction of 50 kPa on 20 m of 1 m, 2 MPa under the tip: nothing but inertia is left."""
    capacity = np.pi * 50e3 * 20.0 + 0.25 * np.pi * 2e6
    scene = scene_of(
        tmp_path,
        "*DEPTH\n0\n*GROUNDEPTH\n0\n*TZCURVE\n1 0 50e3 2e6\n*GROUNDPROP\n0 1\n*CASING\n1 P",
        "0 -20 1 0.05 210e9 7850\n*FONDATION\n1 1",
        f"*LOAD\nDOWN 1 0 0 0 {-times * capacity!r}\n*QUASISTATIC\n1\n*MODEL, PATH=ON",
    )
    found = followed(scene)
    assert found.path.end is PathEnd.FLAT
    np.testing.assert_allclose(times * factors(found)[1:], 1.0, rtol=1e-5)
    settlement = found.results.settlement(np.zeros(1))[1:, 0]
    assert settlement[-1] > 1.4 * settlement[0]
    assert sum(s.iterations for s in found.path.states) < 6 * len(found.path.states)


@pytest.mark.parametrize(
    ("name", "value", "end", "states"),
    [("continuation._ITERATIONS", 0, PathEnd.LOST, 1), ("path._MOST", 7, PathEnd.LONG, 7)],
)
def test_a_path_that_cannot_or_may_not_go_on_says_so(
    tmp_path, monkeypatch, name, value, end, states
):
    scene = stub(tmp_path, BREAKS, "2.1e6 0 0", RIGID_MODEL)
    monkeypatch.setattr(f"podeep.solve.{name}", value)
    found = followed(scene)
    assert (found.path.end, len(found.path.states)) == (end, states)
    told = explain(found, found.failure, ("HEAD",))
    assert end.value in told
    peak = found.path.states[found.path.peak].factors[0]
    assert f"HEAD {peak:.4g}" in told


@pytest.mark.parametrize("components", [1, 2])
def test_the_bordered_matrix_is_solved_where_the_tangent_is_indefinite(components):
    """Against a dense matrix: the step, the sign of the determinant, the band's full width."""
    wanted = Needs(0.0 if components == 1 else None, components, ())
    system = model(reference_pile(), wanted).lateral.system
    rng = np.random.default_rng(1)
    n, signs = system.size, set()
    for _ in range(6):
        system.internal(0.05 * rng.standard_normal(n))
        modulus = system.reached[3]  # turned in place: a law that softens where it is told
        modulus *= rng.choice([1.0, -3e3], size=modulus.shape)
        lower = system.tangent()
        dense = sum(np.diag(lower[d, : n - d], -d) for d in range(len(lower)))
        dense = dense + np.tril(dense, -1).T
        pull, row, corner = 1e6 * rng.standard_normal(n), rng.standard_normal(n), 0.3
        whole = np.block([[dense, -pull[:, None]], [row[None], np.array([[corner]])]])
        bordered = Bordered(system, pull, row, corner)
        right = rng.standard_normal(n)
        expected = np.linalg.solve(whole, np.append(right, 0.7))
        step, change = bordered.solve(right, 0.7)
        np.testing.assert_allclose(
            np.append(step, change), expected, atol=1e-6 * abs(expected).max()
        )
        assert bordered.sign == np.linalg.slogdet(whole)[0]
        signs.add(bordered.sign)
        move = rng.standard_normal(n)
        np.testing.assert_allclose(system.tangent_times(move), dense @ move, rtol=1e-9, atol=1e-3)
    assert signs == {-1.0, 1.0}


@pytest.mark.parametrize("at", [0.03, 0.021, 0.0201])
def test_a_spring_above_a_rigid_pile_turns_the_curve_round(tmp_path, at):
    """A soft free length on a rigid embedded one: P = F(w) and the head moves by P L / EA more.

    Where the friction drops at once, the head goes back almost as it came; the pile sinks on.
    """
    friction, left, free, soft = 50e3, 10e3, 10.0, 2e9
    scene = scene_of(
        tmp_path,
        f"*DEPTH\n0\n*GROUNDEPTH\n0\n{FALLS.format(left=left, at=at)}*GROUNDPROP\n0 1",
        f"*CASING\n1 PILE\n{free!r} 0 2 0.05 210e9 7850 EA={soft!r}",
        "0 -40 2 0.05 210e9 7850 EA=1e15\n*FONDATION\n1 1",
        f"*LOAD\nHEAD 1 {free!r} 0 0 -16e6\n*QUASISTATIC\n10\n*MODEL, PATH=ON, ELEMENTS=8",
    )
    found = followed(scene)
    head, sunk = found.results.settlement(np.array([-free, 20.0]))[1:].T
    force = 16e6 * factors(found)[1:]
    around = 2.0 * np.pi * 40.0
    expected = around * np.interp(sunk, (0.0, 0.002, 0.02, at), (0.0, 25e3, friction, left))
    np.testing.assert_allclose(force, expected, rtol=2e-3)
    np.testing.assert_allclose(head, sunk + force * free / soft, rtol=1e-5)
    assert (np.diff(sunk) > 0.0).all()
    assert force.max() == pytest.approx(around * friction, rel=1e-3)
    assert force[-1] == pytest.approx(around * left, rel=1e-6)
    assert found.path.end is PathEnd.FLAT
    beyond = found.path.states[1:]
    assert any(around * left * 1.05 < 16e6 * s.factors[0] < 0.95 * force.max() for s in beyond)


def test_a_path_ends_where_the_loads_are_reached_again(tmp_path):
    """A law that drops and hardens: load steps jump across, the path goes down and up again."""
    curve = "*PYCURVE\n1 0 0\n200e3 0.01\n60e3 0.03\n60e3 0.035\n400e3 0.6\n"
    scene = stub(tmp_path, curve, "2.5e6 0 0", RIGID_MODEL)
    discrete = first_model(scene, scene.foundations[0])
    states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
    assert failure is None  # the jump
    path = follow(discrete, before(states[5], 0.5), limits(scene))
    force = 2.5e6 * np.array([s.factors[0] for s in path.states])
    y = np.array([np.abs(s.lateral[0]) for s in path.states])
    law = LENGTH * np.interp(y, (0.0, 0.01, 0.03, 0.035, 0.6), (0.0, 200e3, 60e3, 60e3, 400e3))
    np.testing.assert_allclose(force, law, rtol=RIGID)
    assert path.end is PathEnd.RISEN
    assert force.min() == pytest.approx(60e3 * LENGTH, rel=1e-3)
    assert force[-1] == pytest.approx(2.5e6, rel=1e-9)
    assert any(f == pytest.approx(200e3 * LENGTH, rel=1e-3) for f in force)
