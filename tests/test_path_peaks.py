"""Peaks, residual branches and snap-back of the reference pile, where other programs stop.

OpenSees 3.7.1 on the same pile without a tip, t-z by points of 2GEO that soften to 0.7: LoadControl
stops at 15.75 MN of 15.95, DisplacementControl on the flat residual branch, ArcLength turns back
and unloads to -8.8 MN where the friction drops within 0.0005 D of a soft pile.
"""

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest

from podeep.model.assemble import Model
from podeep.scene import Curve, Numerics, Scene
from podeep.soil.profile import profile_of
from podeep.solve.analysis import Solved, first_model, limits, run, solve
from podeep.solve.continuation import Walk
from podeep.solve.loaded import Loaded
from podeep.solve.newton import Limits, Scale, largest
from podeep.solve.path import STRIDE, PathEnd, follow
from podeep.solve.statics import Failure, State
from scenes import reference_pile
from stubs import SOFTENING, mechanism, pushed, stub

LOAD = 16e6
RISE = ((0.0016, 0.3), (0.0031, 0.5), (0.0057, 0.75), (0.008, 0.9), (0.01, 1.0))  # w/D, t/tmax
PROBES = (0.0, 5.0, 10.0, 15.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0)


def friction_pile(elements: int | None = None, steps: int = 10) -> Scene:
    """The reference pile under 16 MN on its shaft alone, which keeps 0.7 of the peak friction."""
    numerics = Numerics(elements=elements, follow_path=True)
    scene = reference_pile((0.0, 0.0, -LOAD), steps=steps, numerics=numerics)
    curves = {}
    for id_, curve in scene.ground.axial_curves.items():
        parameters = dict(curve.parameters)
        if curve.law == "cohesionless":
            parameters["bearing_factor"] = 0.0
        curves[id_] = replace(
            curve, parameters=parameters, options={**curve.options, "residual": 0.7}
        )
    return replace(scene, ground=replace(scene.ground, axial_curves=curves))


def brittle_pile(
    drop: float, softer: float, elements: int | None = None, left: float = 0.7
) -> Scene:
    """The same with a friction that falls to `left` within `drop` diameters, `softer` times EA."""
    scene = friction_pile(elements)
    depth = np.array(PROBES) + 1e-6 * np.array([1, 0, 0, -1, 1, 0, 0, 0, 0, -1])
    profile = profile_of(scene, scene.foundations[0])
    peak = profile.shaft(depth, np.full(len(depth), 2.0)).capacity / (2.0 * np.pi)
    ratios = (*RISE, (0.01 + drop, left))
    curves = {
        i: Curve(i, "user", {}, {}, tuple((t * r, 2.0 * w, 0.0, 0.0) for w, r in ratios))
        for i, t in enumerate(peak.tolist(), start=1)
    }
    ground = replace(
        scene.ground,
        depths=PROBES,
        lateral=(1, 1, 1, 2, 3, 3, 3, 3, 3, 3),
        axial=tuple(curves),
        axial_curves=curves,
    )
    tube = scene.tubes[1]
    section = replace(tube.sections[0], youngs_modulus=softer * tube.sections[0].youngs_modulus)
    return replace(scene, ground=ground, tubes={1: replace(tube, sections=(section,))})


def solved(scene: Scene) -> Solved:
    return solve(scene, scene.foundations[0])


def shaft(found: Solved) -> float:
    """Peak friction over the shaft, N."""
    points = found.model.axial.system.points[0]
    return float(points.weight @ points.reaction.capacity)


def loads(found: Solved) -> np.ndarray:
    return LOAD * np.array([s.factors[0] for s in found.path.states])


def test_peers_failure_5_the_peak_of_progressive_failure():
    """Friction softens from the head down: 15.95 MN, less than the 16.23 MN of all peaks."""
    found = solved(friction_pile())
    peak = loads(found).max()
    assert peak == pytest.approx(15.95e6, rel=1e-3)
    assert peak < 0.985 * shaft(found)
    assert found.failure.factors[0] * LOAD == pytest.approx(peak, rel=1e-4)
    assert found.error < 1e-3


def test_peers_failure_6_the_flat_residual_branch():
    found = solved(friction_pile())
    force = loads(found)
    residual = force[-1]
    assert residual == pytest.approx(0.7 * shaft(found), rel=1e-6)
    assert residual == pytest.approx(11.38e6, rel=2e-3)
    assert found.path.end is PathEnd.FLAT
    assert (np.diff(force[found.path.peak :]) <= 1e-5 * residual).all()
    head = found.results.settlement(np.array([-10.0]))[:, 0]
    assert head[-1] > 2.0 * head[found.steps]


def test_peers_failure_7_a_snap_back_is_followed_and_not_turned_back():
    found = solved(brittle_pile(drop=0.0005, softer=0.05))
    force = loads(found)
    head, tip = found.results.settlement(np.array([-10.0, 40.0]))[found.steps :].T
    assert (np.diff(tip) > 0.0).all()
    back = np.flatnonzero(np.diff(head) < 0.0)
    assert len(back) > 0
    assert (force[back + 1] < force[back]).all()
    assert force.min() >= 0.7 * shaft(found) * (1.0 - 1e-6)
    assert force[-1] == pytest.approx(0.7 * shaft(found), rel=1e-6)
    assert found.path.end is PathEnd.FLAT


def fine_peak(scene: Scene, stride: float = STRIDE / 10.0) -> tuple[float, float]:
    """Peak by load steps, and by a fine path from the step before on; factors of the load."""
    discrete = first_model(scene, scene.foundations[0])
    states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
    return float(failure.factors[0]), walked(discrete, states[-1], failure, stride)


def walked(discrete: Model, before: State, failure: Failure, stride: float) -> float:
    """Largest factor on the path from a state before the peak on."""
    problem, q = getattr(discrete, failure.which), getattr(before, failure.which)
    scale = Scale(largest(problem.system.internal(q)), largest(q))
    loaded = Loaded(problem, before.factors, failure.growth)
    walk = Walk.start(loaded, q, Limits(1e-6), scale)
    highest, since = 0.0, 0
    while since < 20:
        top = max(p.factor for p in walk.stride(stride))
        since = since + 1 if top <= highest else 0
        highest = max(highest, top)
    return float(loaded.factors(highest)[0])


@pytest.mark.parametrize("name", SOFTENING)
@pytest.mark.parametrize("fixed", [False, True], ids=["free", "fixed"])
def test_the_reported_peak_of_a_softening_clay_is_that_of_the_path(name, fixed):
    scene = stub(SOFTENING[name])
    capacity = mechanism(scene)
    force = 1.2 * (capacity.translation if fixed else capacity.lateral_load)
    reported, fine = fine_peak(pushed(scene, force, 10, 24, fixed=fixed))
    assert reported == pytest.approx(fine, rel=1e-3)


@pytest.mark.parametrize("fixed", [False, True], ids=["free", "fixed"])
def test_the_reported_peak_of_a_breaking_curve_is_that_of_the_path(fixed):
    rows = ((150e3, 0.01), (200e3, 0.02), (40e3, 0.022))
    scene = stub(Curve(1, "user", {}, {}, rows))
    reported, fine = fine_peak(pushed(scene, 3e6, 10, 24, fixed=fixed))
    assert reported == pytest.approx(fine, rel=1e-3)


def test_the_reported_peak_of_softening_friction_is_that_of_the_path():
    reported, fine = fine_peak(friction_pile(24))
    assert reported == pytest.approx(fine, rel=1e-3)


SET = tuple(product((0.01, 0.0005), (1.0, 0.2, 0.05), (0.7, 0.1)))


def test_snap_backs_are_followed_or_told_and_none_is_wrong():
    """Every scene of the set, whose states must lie on the one branch: the tip sinks all along.

    A state off the branch would be told by its tip, one that turned back by its load as well: the
    residual friction bounds it from below. 12 scenes, of which all are followed to the end.
    """
    ends = Counter()
    for drop, softer, left in SET:
        scene = brittle_pile(drop, softer, 24, left)
        discrete = first_model(scene, scene.foundations[0])
        states, failure, _ = run(discrete, np.array(scene.steps.factors), limits(scene))
        path = follow(discrete, failure, limits(scene))
        force = LOAD * np.array([s.factors[0] for s in path.states])
        tip = [s.axial[-1] for s in path.states]
        points = discrete.axial.system.points[0]
        residual = left * float(points.weight @ points.reaction.capacity)
        case = (drop, softer, left)
        assert (np.diff(tip) > 0.0).all(), case
        assert force.min() >= residual * (1.0 - 1e-5), case
        if path.end is PathEnd.FLAT:
            assert force[-1] == pytest.approx(residual, rel=1e-5), case
        fine = walked(discrete, states[-1], failure, STRIDE / 4.0)
        assert failure.factors[0] == pytest.approx(fine, rel=1e-3), case
        assert force.max() == pytest.approx(LOAD * fine, rel=1e-3), case
        ends[path.end] += 1
    assert ends == {PathEnd.FLAT: 12}


@cache
def branch(elements: int, degree: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Settlement of the tip, load and estimated error of the normal force along a path."""
    scene = friction_pile(elements)
    found = solved(replace(scene, numerics=replace(scene.numerics, degree=degree)))
    tip = found.results.settlement(np.array([40.0]))[found.steps :, 0]
    return tip, loads(found), found.estimates[1].moment[found.steps :]


@pytest.mark.parametrize(("elements", "degree"), [(6, 3), (4, 5), (8, 5)])
def test_the_estimate_on_the_path_is_the_error_of_its_load(elements, degree):
    """Against 160 elements at the same settlement of the tip, within a factor of three."""
    tip, force, estimated = branch(elements, degree)
    falling = force > 1.1 * force[-1]  # beyond it the curve has a bend, and lines cut it,
    falling[:3] = False  # as they do at the peak
    error = np.abs(force - np.interp(tip, *branch(160, 5)[:2])) / force
    assert 1.0 / 3.0 < error[falling].max() / estimated[falling].max() < 3.0


def test_a_spatial_path_is_that_of_the_plane():
    """At 30 degrees, both components solved: the same factors in the same states."""
    c, s = np.cos(np.pi / 6.0), np.sin(np.pi / 6.0)
    scene = stub(SOFTENING["cyclic soft clay"])
    scene = pushed(scene, 1.2 * mechanism(scene).lateral_load, 10, 8, fixed=False)
    numerics = replace(scene.numerics, follow_path=True)
    force = scene.loads[0].force[0]
    aside = replace(scene.loads[0], force=(c * force, s * force, 0.0))
    plane = solved(replace(scene, numerics=numerics))
    space = solved(
        replace(scene, loads=(aside,), numerics=replace(numerics, components=2)),
    )
    assert space.model.needs.components == 2
    one, other = (np.array([s.factors[0] for s in f.path.states]) for f in (plane, space))
    np.testing.assert_allclose(other, one, rtol=1e-5)
    head = np.array([-1.0])
    y = [np.linalg.norm(f.results.deflection(head)[:, :, 0], axis=1) for f in (plane, space)]
    np.testing.assert_allclose(y[1], y[0], rtol=1e-4)
    assert one[-1] < 0.97 * one.max()
