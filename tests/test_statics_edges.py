"""Statics where methods fail: rest, slivers, stubs, held and sprung ends, estimates too small."""

from dataclasses import replace

import numpy as np
import pytest

from podeep.deck.read import read_deck
from podeep.model.grid import output_depths
from podeep.model.needs import needs
from podeep.model.results import Results
from podeep.scene import (
    Curve,
    Displacement,
    Foundation,
    Load,
    Numerics,
    Scene,
    Section,
    Spring,
    Steps,
    Support,
    Tube,
)
from podeep.solve.analysis import solve
from scenes import reference_pile
from test_newton import solved


def with_factors(scene: Scene, *factors: float) -> Scene:
    return replace(scene, steps=Steps(("HEAD",), tuple((f,) for f in factors)))


@pytest.mark.parametrize("shape", ["POWER", "2GEO"])
@pytest.mark.parametrize("factors", [(1.0, 0.0), (1.0, 6e-17, 1.0), (0.5, 0.0, -0.5, 0.0)])
def test_a_tube_returns_to_rest(shape: str, factors: tuple[float, ...]) -> None:
    found = solved(with_factors(reference_pile(shape=shape), *factors))
    assert found.failure is None
    assert found.error <= 1e-3
    head = found.results.deflection(np.array([-10.0]))[:, 0, 0]
    largest = np.abs(head).max()
    for factor, y in zip((0.0, *factors), head, strict=True):
        if abs(factor) < 1e-9:
            assert abs(y) < 1e-6 * largest
        else:
            assert y * factor > 0.01 * largest


def test_an_imposed_displacement_returns_to_zero() -> None:
    scene = reference_pile((0.0, 0.0, -5e6))
    push = Displacement("PUSH", 1, 10.0, "X", 0.2)
    steps = Steps(("HEAD", "PUSH"), ((1.0, 1.0), (1.0, 0.0)))
    found = solved(replace(scene, displacements=(push,), steps=steps))
    assert found.failure is None
    assert np.abs(found.results.deflection(np.array([0.0]))[-1]).max() < 1e-6


@pytest.mark.parametrize("gap", [1e-6, 1e-4, 1e-3, 2e-3, 5e-3])
def test_loads_and_layers_close_to_each_other_are_solved(gap: float) -> None:
    """A sliver must neither fail nor move the answer by more than its own size does."""
    scene = reference_pile((1e6, 0.0, -5e6), numerics=Numerics(second_order=False))
    more = Load("HEAD", 1, 10.0 - gap, (1e6, 0.0, 0.0), (0.0, 0.0, 0.0))
    ground = replace(scene.ground, depths=(0.0, 15.0, 15.0 + gap, 40.0))
    found = solved(replace(scene, loads=(*scene.loads, more), ground=ground))
    assert found.failure is None
    head = found.results.deflection(np.array([-10.0]))[-1, 0, 0]
    assert head == pytest.approx(0.35697907, rel=1e-3)


@pytest.mark.parametrize("accuracy", [1e-5, 1e-7])
def test_a_stub_is_solved_as_far_as_the_arithmetic_goes(accuracy: float) -> None:
    """8 m across and 3 m deep: refinement ends where elements get too short, not in a failure."""
    tube = Tube(1, "stub", (Section(0.0, -3.0, 8.0, 0.08, 210e9, 7850.0),))
    load = Load("HEAD", 1, 0.0, (2.9e5, 0.0, -1e5), (0.0, 0.0, 0.0))
    numerics = Numerics(accuracy=accuracy)
    scene = replace(reference_pile(steps=1, numerics=numerics), tubes={1: tube}, loads=(load,))
    found = solved(scene)
    assert found.failure is None
    assert len(found.states) == 2
    assert found.error < 1e-3


def test_a_tube_below_the_mudline_has_results_where_it_is() -> None:
    tube = Tube(1, "cut", (Section(-5.0, -40.0, 2.0, 0.05, 210e9, 7850.0),))
    load = Load("HEAD", 1, -5.0, (1e6, 0.0, -1e6), (0.0, 0.0, 0.0))
    found = solved(replace(reference_pile(), tubes={1: tube}, loads=(load,)))
    depth = output_depths(found.results, 1e-3)
    assert depth[0] == 5.0
    cells = np.linspace(5.0, 40.0, 70_001)
    middle = 0.5 * (cells[1:] + cells[:-1])
    total = found.results.lateral_reaction(middle)[-1, 0].sum() * (cells[1] - cells[0])
    assert total == pytest.approx(1e6, rel=3e-3)


def test_a_held_end_is_not_a_spring_of_one() -> None:
    scene = replace(
        reference_pile((1e6, 1e6, 0.0)),
        supports=(Support(1, 0.0, ("X",)),),
        springs=(Spring(1, 0.0, "Y", 1.0),),
    )
    assert needs(scene, scene.foundations[0]).components == 2


def test_springs_hold_in_any_direction_alike() -> None:
    """A head on springs in X and Y of 20 MN/m: the same along x and at 30 degrees."""
    springs = tuple(Spring(1, 10.0, dof, 2e7) for dof in ("X", "Y"))
    numerics = Numerics(elements=13)
    along = replace(reference_pile((2e6, 0.0, 0.0), numerics=numerics), springs=springs)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    aside = replace(reference_pile((2e6 * c, 2e6 * s, 0.0), numerics=numerics), springs=springs)
    head = np.array([-10.0])
    y = [solved(scene).results.deflection(head)[-1, 0, 0] for scene in (along, aside)]
    assert y[1] == pytest.approx(y[0], rel=1e-10)
    assert y[0] < 0.12


@pytest.mark.parametrize("elements", [8, 13, 26])
def test_the_moment_estimates_are_those_of_the_reported_moment(elements: int) -> None:
    """Of the largest moment and of that at any depth, within a factor of three of the errors
    against elements of degree 7, in the last step; below 1e-9 errors are as good as none."""
    scene = reference_pile(numerics=Numerics(elements=elements))
    found = solved(scene)
    exact = solved(reference_pile(numerics=Numerics(elements=90, degree=7))).results
    x = np.linspace(-10.0, 40.0, 5001)

    def moments(results: Results) -> np.ndarray:
        return results.shear_and_moment(x)[1][-1, 0]

    one, other = moments(found.results), moments(exact)
    size, estimate = np.abs(other).max(), found.estimates[0]
    anywhere, largest = np.abs(one - other).max() / size, abs(np.abs(one).max() / size - 1.0)
    assert 0.3 * anywhere <= estimate.anywhere[-1] <= 3.0 * anywhere
    assert 0.3 * largest - 1e-9 <= estimate.moment[-1] <= 3.0 * largest + 1e-9


def test_every_estimate_moves_with_the_error() -> None:
    """Halving the elements of a coarse mesh lowers all of them, and none is zero.

    The largest normal force is that of the load on the head, and exact.
    """
    names = (
        ("displacement", "reaction", "moment", "anywhere", "force"),
        ("displacement", "reaction", "anywhere", "force"),
    )
    coarse, fine = (
        solved(reference_pile(numerics=Numerics(elements=n, degree=3))) for n in (6, 24)
    )
    for part in (0, 1):
        for name in names[part]:
            before = getattr(coarse.estimates[part], name)[-1]
            after = getattr(fine.estimates[part], name)[-1]
            assert 0.0 < after < before < 1.0


def test_softening_soil_is_solved_up_to_its_peak() -> None:
    """Cyclic clay loses resistance beyond 3 y50; below the peak many steps and one agree."""
    scene = reference_pile((6e6, 0.0, 0.0), steps=1)
    curves = {
        id_: replace(curve, options={**curve.options, "cyclic": True})
        for id_, curve in scene.ground.lateral_curves.items()
    }
    ground = replace(scene.ground, lateral_curves=curves)
    one = solved(replace(scene, ground=ground))
    many = solved(replace(reference_pile((6e6, 0.0, 0.0), steps=12), ground=ground))
    head = np.array([-10.0])
    y = [s.results.deflection(head)[-1, 0, 0] for s in (one, many)]
    assert one.failure is None
    assert many.failure is None
    assert y[1] == pytest.approx(y[0], rel=2e-3)
    plain = solved(scene).results.deflection(head)[-1, 0, 0]
    assert y[0] > 1.05 * plain


def test_foundations_are_solved_apart() -> None:
    scene = reference_pile()
    second = Tube(2, "other", scene.tubes[1].sections)
    both = replace(
        scene,
        tubes={**scene.tubes, 2: second},
        foundations=(*scene.foundations, Foundation(2, (2,), -1.0)),
    )
    alone = solved(scene).states[-1].lateral
    assert np.array_equal(solved(both).states[-1].lateral, alone)


def test_a_gap_around_the_tube_closes() -> None:
    """A user curve without resistance up to 20 mm: the pile goes there before the soil acts."""
    curve = Curve(1, "user", {}, {}, ((0.0, 0.02), (1e5, 0.03)))
    scene = reference_pile((5e5, 0.0, -5e6), steps=4)
    ground = replace(scene.ground, lateral=(1, 1, 1, 1), lateral_curves={1: curve})
    x = np.linspace(0.0, 40.0, 401)
    spring = Spring(1, 10.0, "Y", 1e-3)  # makes the scene spatial and changes nothing
    aside = Load("HEAD", 1, 10.0, (0.0, 1e-3, 0.0), (0.0, 0.0, 0.0))
    spatial = replace(scene, ground=ground, springs=(spring,), loads=(*scene.loads, aside))
    for one in (replace(scene, ground=ground), spatial):
        found = solved(one)
        assert found.failure is None
        y = found.results.deflection(x)[-1, 0]
        assert y.max() > 0.02
        assert y.min() < -0.02
    assert found.model.needs.components == 2


@pytest.mark.parametrize("times", [1.01, 1.5, 40.0])
def test_the_peak_is_the_capacity_whatever_the_step(times, tmp_path):
    """Friction of 50 kPa on 20 m of a pile of 1 m, 2 MPa under its tip, both elastic-plastic."""
    capacity = np.pi * 50e3 * 20.0 + 0.25 * np.pi * 2e6
    path = tmp_path / "a.deck"
    path.write_text(
        "*DEPTH\n0\n*GROUNDEPTH\n0\n*TZCURVE\n1 0 50e3 2e6\n*GROUNDPROP\n0 1\n*CASING\n1 P\n"
        f"0 -20 1 0.05 210e9 7850\n*FONDATION\n1 1\n*LOAD\nDOWN 1 0 0 0 {-times * capacity!r}\n"
        "*QUASISTATIC\n1\n*EXEC\n"
    )
    scene = read_deck(path).scene
    failure = solve(scene, scene.foundations[0]).failure
    assert failure is not None
    # parts of 2^-16 of the step
    assert 1.0 - 2.0**-15 * times <= failure.reached * times <= 1.0 + 1e-6
