"""Combined casings: tubes that are cemented, tied at their ends, or slide in each other."""

import csv
from dataclasses import replace
from itertools import pairwise
from math import cos, pi, sin

import numpy as np
import pytest

from casings import (
    E,
    casings,
    elastic_shaft,
    elements,
    jumps,
    linear,
    no_ground,
    push,
    run,
    tube,
)
from closed_forms import DATA
from podeep.scene import Foundation, Ground, Load, Numerics, Section, Sliding, Support, Tie, Tube
from scenes import reference_pile

HEAD = np.array([-5.0])
CF32 = (tube(1, 0.0, -40.0, 0.762, 0.0254), tube(2, 0.0, -60.0, 0.508, 0.0127))
CEMENTED = (Tie(1, 2, 0.0, -40.0),)


def cf32_ground():
    lateral = {
        i: linear(i, k, d) for i, k, d in ((1, 6e6, 0.762), (2, 25e6, 0.762), (3, 15e6, 0.508))
    }
    axial = {1: elastic_shaft(1, 15e6, 0.762), 2: elastic_shaft(2, 8e6, 0.508)}
    depths = (0.0, 15.0, 15.0, 35.0, 35.0, 55.0)
    return Ground(depths, (1, 1, 2, 2, 3, 3), (1, 1, 1, 1, 2, 2), lateral, axial)


def cf32(loads, **given):
    return casings(CF32, cf32_ground(), loads, mudline=-5.0, **given)


def rows(name, **wanted):
    with (DATA / name).open(encoding="utf-8") as file:
        found = [r for r in csv.DictReader(file) if all(r[k] == v for k, v in wanted.items())]
    assert found
    return {k: np.array([float(r[k]) for r in found]) for k in found[0] if k != "load"}


@pytest.mark.parametrize("coupling", ["cemented", "sliding"])
@pytest.mark.parametrize(
    ("load", "head"),
    [("H=150 kN", push(1, 0.0, x=150e3)), ("M=300 kN*m", push(1, 0.0, turn=300e3))],
)
@pytest.mark.parametrize("normal", [0.0, 2e6])
def test_casings_of_cf32(load, head, normal, coupling):
    """Heads and profiles to 1e-5, and the share of each tube but near the end of the conductor."""
    loads = [head, push(2, 0.0, z=-normal)] if normal else [head]
    numerics = Numerics(accuracy=1e-7, second_order=normal > 0.0, axial_curves=False)
    held = (Support(2, -60.0, ("Z",)), Support(1, -40.0, ("Z",)))
    how = {"ties": CEMENTED} if coupling == "cemented" else {"slidings": (Sliding(1, 2),)}
    held = held[:1] if coupling == "cemented" else held
    results = run(cf32(loads, numerics=numerics, supports=held, **how)).results
    true = rows("CF32_lateral.csv", N_N=f"{normal}", load=load)
    depth = true["z_m"] - 5.0
    whole = coupling == "sliding" or not normal  # cement shares N, and with it what bends each
    for found, name in (
        (results.deflection(depth)[-1, 0], "y_m"),
        (results.deflection(depth, 1)[-1, 0], "theta_rad"),
    ):
        if whole:
            assert found == pytest.approx(true[name], abs=1e-5 * np.abs(true[name]).max()), name
    if not whole:
        return
    upper = depth < 34.0
    for number, name in ((0, "M_conductor_Nm"), (1, "M_inner_Nm")):
        moment = results.shear_and_moment(depth[upper], number)[1][-1, 0]
        assert moment == pytest.approx(true[name][upper], abs=1e-5 * np.abs(true[name]).max())


def test_cement_of_cf32_shares_the_axial_load():
    results = run(cf32([push(1, 0.0, z=-3e6)], ties=CEMENTED)).results
    true = rows("CF32_axial.csv")
    depth = true["z_m"] - 5.0
    assert results.settlement(HEAD)[-1, 0] == pytest.approx(0.007868014110609, rel=1e-9)
    assert results.settlement(depth)[-1] == pytest.approx(true["u_m"], rel=1e-8)
    for number, name, last in ((0, "N_conductor_N", 35.0), (1, "N_inner_N", 55.0)):
        inside = depth < last
        force = results.compression(depth[inside], number)[-1]
        assert force == pytest.approx(true[name][inside], abs=1e-8 * 3e6)


@pytest.mark.parametrize("second_order", [False, True])
def test_two_cemented_tubes_are_one_of_summed_stiffness(second_order):
    numerics = Numerics(elements=30, second_order=second_order, accuracy=1e-8)
    whole = reference_pile(force=(2e6, 0.0, -5e6), steps=2, numerics=numerics)
    section = whole.tubes[1].sections[0]
    shares = (0.7, 0.3)
    halves = [
        Tube(
            i,
            "",
            (
                replace(
                    section,
                    bending_stiffness_override=share * section.bending_stiffness,
                    axial_stiffness_override=share * section.axial_stiffness,
                ),
            ),
        )
        for i, share in enumerate(shares, start=1)
    ]
    split = replace(
        whole,
        tubes={t.id: t for t in halves},
        foundations=(Foundation(1, (1, 2), 0.0),),
        ties=(Tie(1, 2, 10.0, -40.0),),
    )
    one, two = run(whole).results, run(split).results
    x = np.linspace(-10.0, 40.0, 301)
    assert two.deflection(x) == pytest.approx(one.deflection(x), rel=1e-9, abs=1e-12)
    assert two.settlement(x) == pytest.approx(one.settlement(x), rel=1e-9, abs=1e-12)
    moment, force = one.shear_and_moment(x)[1][-1], one.compression(x)[-1]
    for number, share in enumerate(shares):
        assert two.shear_and_moment(x, number)[1][-1] == pytest.approx(
            share * moment, rel=1e-9, abs=1e-9 * np.abs(moment).max()
        )
        assert two.compression(x, number)[-1] == pytest.approx(
            share * force, rel=1e-9, abs=1e-9 * force.max()
        )


def test_tubes_that_slide_freely_share_lateral_load_by_stiffness():
    scene = cf32([push(2, 0.0, x=150e3)], slidings=(Sliding(1, 2),))
    results = run(scene).results
    x = np.linspace(-4.9, 34.9, 200)
    outer, inner = (results.shear_and_moment(x, number) for number in (0, 1))
    ratio = CF32[0].sections[0].bending_stiffness / CF32[1].sections[0].bending_stiffness
    for one, other in zip(outer, inner, strict=True):
        assert one[-1] == pytest.approx(ratio * other[-1], rel=1e-9, abs=1e-9 * np.abs(one).max())


@pytest.mark.parametrize("second_order", [False, True])
def test_every_tube_is_in_equilibrium(second_order):
    """Five casings that slide, touch, rub and are cemented at different heights."""
    solved = run(five(second_order, count=150))
    for number in range(5):
        assert jumps(solved, number) < 1e-9
    results, model = solved.results, solved.model
    x = model.edges[-1:]
    deepest = model.pieces[-1].outermost
    shear, moment = results.shear_and_moment(x, deepest)
    most = max(np.abs(results.shear_and_moment(model.edges[:20], 0)[1]).max(), 1.0)
    assert abs(shear[-1]).max() < 1e-9 * 400e3 + 1e-9 * most
    assert abs(moment[-1]).max() < 1e-9 * most
    points = model.lateral.system.points[0]
    soil = points.weight @ results.point_forces[0][-1, 0]
    assert soil == pytest.approx(400e3, rel=1e-9)
    shaft = model.axial.system.points[0]
    u = results.settlement(shaft.x)[-1]
    friction = shaft.weight @ shaft.reaction.evaluate(u)[0] + results.tip()[1][-1]
    assert friction == pytest.approx(3e6, rel=1e-9)


def five(second_order=False, count=None):
    """A conductor and four casings in it, each cemented over the lowest third of the one around."""
    sizes = ((0.914, 0.0254, -40.0), (0.660, 0.020, -55.0), (0.473, 0.0125, -70.0))
    sizes += ((0.340, 0.012, -80.0), (0.245, 0.012, -90.0))
    tubes = [tube(i, 0.0, tip, d, t) for i, (d, t, tip) in enumerate(sizes, start=1)]
    ties, slidings = [], []
    for outer, inner in pairwise(tubes):
        bottom = outer.sections[-1].bottom
        ties += [Tie(outer.id, inner.id, bottom + 12.0, bottom)]
        ties += [Tie(outer.id, inner.id, 0.0, bottom, ends=True)]
        slidings.append(Sliding(outer.id, inner.id, None, 0.02, friction=0.3))
    pile = reference_pile()
    loads = [push(1, 0.0, x=400e3, z=-2e6), push(3, 0.0, z=-1e6)]
    numerics = Numerics(accuracy=1e-4, second_order=second_order, elements=count)
    return casings(tubes, pile.ground, loads, ties, slidings, mudline=-10.0, numerics=numerics)


def test_five_casings_that_deflect_as_one_are_a_stepped_beam():
    scene = five()
    slidings = tuple(replace(s, clearance=0.0, friction=0.0) for s in scene.slidings)
    numerics = Numerics(accuracy=1e-6, second_order=False)
    combined = run(replace(scene, slidings=slidings, numerics=numerics)).results
    tips = [t.tip for t in scene.tubes.values()]
    sections = []
    for top, bottom in zip([0.0, *tips], tips, strict=False):
        there = [t.sections[0] for t in scene.tubes.values() if t.tip <= bottom]
        bend = sum(s.bending_stiffness for s in there)
        sections.append(Section(top, bottom, *_of(there[0]), bending_stiffness_override=bend))
    beam = replace(
        scene,
        tubes={1: Tube(1, "", tuple(sections))},
        foundations=(Foundation(1, (1,), -10.0),),
        loads=(push(1, 0.0, x=400e3),),
        ties=(),
        slidings=(),
        numerics=numerics,
    )
    x = np.linspace(-10.0, 80.0, 200)
    true = run(beam).results.deflection(x)[-1]
    assert combined.deflection(x)[-1] == pytest.approx(true, abs=3e-6 * np.abs(true).max())


def _of(section):
    return section.outer_diameter, section.wall_thickness, E, 7850.0


def cantilevers(gap, force, stiffness=None, **given):
    """Two tubes fixed at their feet, the inner pushed at its top."""
    outer, inner = tube(1, 10.0, -1.0, 0.6, 0.02), tube(2, 10.0, -1.0, 0.4, 0.02)
    held = tuple(Support(i, z, ("X", "Y", "Z", "RX", "RY")) for i in (1, 2) for z in (0.0, -1.0))
    contact = Sliding(1, 2, stiffness, gap, **given)
    load = push(2, 10.0, x=force)
    return casings([outer, inner], no_ground(), [load], (), [contact], held)


def test_a_gap_that_closes_at_the_top_of_two_cantilevers():
    """Relative deflections grow towards the top, so that nothing but the tops touches."""
    gap, length = 0.05, 10.0
    outer, inner = (t.sections[0].bending_stiffness for t in cantilevers(gap, 1.0).tubes.values())
    free = 3.0 * inner * gap / length**3
    for force in (0.5 * free, 0.999 * free):
        results = run(cantilevers(gap, force)).results
        top = results.deflection(np.array([-10.0]), 0, 1)[-1, 0, 0]
        assert top == pytest.approx(force * length**3 / (3.0 * inner), rel=1e-9)
        assert results.deflection(np.array([-10.0]), 0, 0)[-1, 0, 0] == 0.0
    force = 5.0 * free
    pressed = (force / inner - free / inner) / (1.0 / inner + 1.0 / outer)  # at the tops
    solved = run(replace(cantilevers(gap, force, 1e11), numerics=Numerics(accuracy=1e-4)))
    results = solved.results
    top = results.deflection(np.array([-10.0]), 0, 0)[-1, 0, 0]
    assert top == pytest.approx(pressed * length**3 / (3.0 * outer), rel=5e-3)
    contact = results.point_forces[-1][-1, 0]
    points = solved.model.lateral.system.points[-1]
    assert points.weight @ contact == pytest.approx(pressed, rel=5e-3)
    assert points.x[contact > 0.0].max() < -9.0


def test_a_gap_closes_and_opens_along_the_string():
    """A stiff string hung in a conductor that soil bends: contact here and there, nowhere else."""
    scene = cf32(
        [push(1, 0.0, x=400e3)],
        ties=(Tie(1, 2, 0.0, -40.0, ends=True),),
        slidings=(Sliding(1, 2, 1e9, 0.004),),
        numerics=Numerics(accuracy=1e-4),
    )
    solved = run(scene)
    results, points = solved.results, solved.model.lateral.system.points[-1]
    apart = results.deflection(points.x, 0, 1) - results.deflection(points.x, 0, 0)
    force, apart = results.point_forces[-1][-1, 0], apart[-1, 0]
    closed = np.abs(apart) > 0.004
    assert 0 < closed.sum() < len(closed)
    assert (force[~closed] == 0.0).all()
    assert (force[closed] * apart[closed] > 0.0).all()
    order = np.argsort(points.x)
    assert (np.diff(closed[order].astype(int)) != 0).sum() >= 2  # it closes and opens again
    for number in (0, 1):
        assert jumps(solved, number) < 1e-9
    finer = run(elements(scene, 4 * solved.model.elements)).results
    x = np.linspace(-5.0, 55.0, 200)
    exact = finer.deflection(x)[-1]
    assert results.deflection(x)[-1] == pytest.approx(exact, abs=2e-4 * np.abs(exact).max())


@pytest.mark.parametrize("second_order", [False, True])
def test_friction_is_a_share_of_what_presses_where_tubes_slip(second_order):
    mu = 0.4
    contact = Sliding(1, 2, 1e9, 0.0, friction=mu, threshold=1e-7)
    scene = cf32(
        [push(1, 0.0, x=400e3, z=-1e6)],
        slidings=(contact,),
        numerics=Numerics(elements=40, second_order=second_order),
    )
    results = run(scene).results
    edges = np.array([-5.0 + 1e-9, 35.0])
    normal = results.model.lateral.system.points[-1]
    limit = mu * (normal.weight @ np.abs(results.point_forces[-1][-1, 0]))
    force = results.compression(edges, 1)[-1]
    slip = results.settlement(normal.x, 0, 0) - results.settlement(normal.x, 0, 1)
    assert (slip[-1] > 1e-7).all()
    assert force[1] - force[0] == pytest.approx(limit, rel=1e-9)
    assert limit > 1e4


def test_soil_acts_on_the_outermost_tube_at_each_level(tmp_path):
    results = run(cf32([push(1, 0.0, x=150e3)], ties=CEMENTED)).results
    x = np.array([1.0, 34.9, 35.1, 50.0])
    assert results.outermost(x).tolist() == [0, 0, 1, 1]
    assert results.diameter(x).tolist() == [0.762, 0.762, 0.508, 0.508]


@pytest.mark.parametrize("ratio", [1e-6, 1e6])
def test_tubes_whose_stiffness_differs_by_a_million(ratio):
    outer = tube(1, 0.0, -40.0, 0.762, 0.0254)
    soft = Section(
        *(0.0, -40.0, 0.508, 0.0127, E, 7850.0),
        bending_stiffness_override=ratio * outer.sections[0].bending_stiffness,
        axial_stiffness_override=ratio * outer.sections[0].axial_stiffness,
    )
    scene = casings(
        [outer, Tube(2, "", (soft,))],
        cf32_ground(),
        [push(1, 0.0, x=400e3, z=-1e6)],
        [Tie(1, 2, 0.0, -40.0, ends=True)],
        [Sliding(1, 2, None, 0.005)],
        mudline=-5.0,
        numerics=Numerics(accuracy=1e-4),
    )
    solved = run(scene)
    assert solved.accurate
    assert max(s.iterations for s in solved.states) <= 60
    for number in (0, 1):
        assert jumps(solved, number) < 1e-6  # of the stiff one's forces: rounding


@pytest.mark.parametrize("degrees", [22.5, 45.0, 71.3])
def test_a_gap_is_the_same_in_every_direction(degrees):
    turn = degrees * pi / 180.0
    found = []
    for x, y, components in ((400e3, 0.0, 1), (400e3 * cos(turn), 400e3 * sin(turn), 2)):
        scene = cf32(
            [Load("PUSH", 1, 0.0, (x, y, 0.0), (0.0, 0.0, 0.0))],
            ties=(Tie(1, 2, 0.0, -40.0, ends=True),),
            slidings=(Sliding(1, 2, 1e9, 0.004),),
            numerics=Numerics(elements=40, components=components, accuracy=1e-9),
        )
        depth = np.linspace(-5.0, 55.0, 61)
        found.append(np.linalg.norm(run(scene).results.deflection(depth)[-1], axis=0))
    assert found[1] == pytest.approx(found[0], abs=1e-10 * found[0].max())
