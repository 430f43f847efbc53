"""What a chart of motion measures is so, by counted work and by errors."""

from dataclasses import replace
from itertools import pairwise
from math import inf
from pathlib import Path

import pytest

from moving_piles import swaying_pile
from podeep.deck.read import read_deck
from podeep.errors import AnalysisFailed
from podeep.motion import TimeSeries
from podeep.scene import Displacement, Scene
from podeep.study import motion_measure
from podeep.study.motion_chart import TENTH, MotionChart, MotionErrors
from podeep.study.motion_measure import charted_motion, unsuited
from podeep.study.motion_report import motion_report
from podeep.study.motion_settings import (
    FULL,
    QUICK,
    MotionPlan,
    enough,
    motion_lines,
    rates,
)

DECK = Path(__file__).parents[1] / "sample_dbs" / "swaying_pile.deck"
FEW = MotionPlan(
    ("NEWMARK", "HHT", "BATHE", "ROS2"),
    *(10, 320, 2.0),
    finest=1280,
    periods=1,
    runs=1,
    accuracies=(1e-2, 1e-3),
)


def silent(_: str) -> None:
    """Hear nothing."""


def charted(scene: Scene, plan: MotionPlan = FEW) -> MotionChart:
    return charted_motion(scene, scene.foundations[0], plan, silent)


@pytest.fixture(scope="module")
def swaying() -> MotionChart:
    return charted(swaying_pile(end=5.0))


def test_the_deck_of_the_manual_is_the_pile_of_the_tests():
    deck, scene = read_deck(DECK).scene, swaying_pile(end=60.0)
    assert deck.tubes[1].sections == scene.tubes[1].sections
    for name in ("loads", "masses", "damping", "harmonics", "dynamics", "steps"):
        assert getattr(deck, name) == getattr(scene, name), name
    for number, curve in scene.ground.lateral_curves.items():
        found = deck.ground.lateral_curves[number]
        assert found.law == curve.law
        assert curve.parameters.items() <= found.parameters.items()


def test_steps_in_a_period_rise_from_few_to_many():
    assert rates(FEW) == [10, 20, 40, 80, 160, 320]
    for plan in (FULL, QUICK):
        found = rates(plan)
        assert found[0] == 10
        assert found[-1] >= 1280
        assert all(1.3 < b / a < 2.1 for a, b in pairwise(found))


def test_the_work_of_a_setting_is_that_of_its_steps(swaying: MotionChart):
    assert swaying.span == swaying.period == 4.0
    for row in swaying.rows:
        assert row.failure == ""
        assert row.errors
        assert row.seconds
        assert row.runs == 1
        assert row.steps == swaying.rate(row) == pytest.approx(4.0 / row.setting.step)
        if row.setting.series.method == "ROS2":
            assert row.iterations == row.evaluations - 1 == 2 * row.steps
        else:
            assert row.evaluations > row.iterations >= row.steps


def test_two_stages_take_more_iterations_and_err_less(swaying: MotionChart):
    by = {(r.setting.series.method, r.setting.series.accuracy, r.steps): r for r in swaying.rows}
    one, two = by["NEWMARK", 1e-2, 40], by["BATHE", 1e-2, 40]
    assert one.errors
    assert two.errors
    assert one.iterations < two.iterations
    assert two.errors.largest < 0.6 * one.errors.largest


def test_errors_fall_with_the_square_of_the_step_until_they_suffice(swaying: MotionChart):
    for series, rows in swaying.series().items():
        found = [row.errors.largest for row in rows if row.errors]
        asymptotic = [e for e in found if e < 0.1]
        if series.method != "ROS2":  # meets the cube root of the clay without iteration
            assert found[-1] <= series.accuracy
            assert all(2.0 < a / b < 9.0 for a, b in pairwise(asymptotic))
        assert all(e > 0.3 * series.accuracy for e in found[:-1])


def test_each_accuracy_goes_on_where_the_last_was_reached(swaying: MotionChart):
    every = swaying.series()
    for method in swaying.methods():
        first, then = (rows for series, rows in every.items() if series.method == method)
        reached = [r.steps for r in first if r.errors and r.errors.largest <= 1e-2]
        assert then[0].steps == reached[0]
        assert first[0].steps == 10


def test_the_reference_is_exact_and_its_mesh_is_told(swaying: MotionChart):
    assert [one.accuracy for one in swaying.references] == [1e-2, 1e-3]
    for one in swaying.references:
        assert one.sure
        assert one.error <= TENTH * one.accuracy
        assert one.mesh_error
        assert 0.0 < one.mesh_error.largest < one.accuracy


def test_the_program_keeps_its_accuracy(swaying: MotionChart):
    for one in swaying.choices:
        assert one.errors
        assert one.seconds
        assert one.row
        assert one.row.seconds
        assert one.seconds > one.row.seconds
        assert one.estimate <= one.accuracy
        assert one.errors.largest <= one.accuracy


def test_the_lines_of_the_fastest_ask_for_it(swaying: MotionChart, tmp_path):
    text = DECK.read_text(encoding="utf-8")
    before, after = text.split("*DYNAMIC\n")
    for preset in (1e-2, 1e-3):
        row = swaying.fastest(preset)
        assert row
        series, step = row.setting.series, row.setting.step
        lines = motion_lines(swaying.dynamics, preset, series.method, step)
        path = tmp_path / "again.deck"
        path.write_text(f"{before}{lines}\n*EXEC\n", encoding="utf-8")
        assert "*ACCURACY" in after
        scene = read_deck(path).scene
        assert scene.numerics.accuracy == preset
        assert scene.dynamics == replace(swaying.dynamics, method=series.method, step=step)
    free = motion_lines(swaying.dynamics, 1e-3, None, None)
    assert free == "*ACCURACY\n0.001\n*DYNAMIC\n0 5"


COARSE = replace(FEW, least=10, most=10, finest=160, accuracies=(1e-2,))


def test_a_method_that_goes_astray_is_a_failure_in_words():
    """Explicit differences with steps far beyond their limit."""
    found = charted(swaying_pile(end=4.0), replace(COARSE, methods=("CENTRAL",)))
    (row,) = found.rows
    assert row.errors is None
    assert row.seconds is None
    assert "the foundation is lost" in row.failure or "no equilibrium" in row.failure
    assert f"failed\n  CENTRAL, steps of 400 ms: {row.failure[:20]}" in motion_report(found)
    assert found.front() == []


def test_an_error_above_one_is_a_failure_in_words(monkeypatch):
    monkeypatch.setattr(motion_measure, "errors_of", lambda *_: MotionErrors(2.0, 0.5))
    found = charted(swaying_pile(end=4.0), replace(COARSE, methods=("ROS2",)))
    assert [row.failure for row in found.rows] == ["an error of 2"]
    assert [row.errors for row in found.rows] == [None]
    assert [one.failure for one in found.choices] == ["an error of 2"]


def test_without_equilibrium_there_is_no_chart():
    scene = swaying_pile(end=4.0)
    assert scene.dynamics
    hasty = replace(scene, dynamics=replace(scene.dynamics, iterations=0, step=0.1))
    with pytest.raises(AnalysisFailed, match="no chart: the motion itself ends at 0 s"):
        charted(hasty, replace(FEW, accuracies=(1e-2,)))


def test_what_a_method_cannot_follow_is_told():
    scene = swaying_pile()
    assert unsuited(scene, "ROS2") == ""
    name = scene.steps.names[0]
    driven = replace(scene, loads=(), displacements=(Displacement(name, 1, 10.0, "X", 0.1),))
    assert "takes no imposed motion" in unsuited(driven, "ROS2")
    assert unsuited(driven, "BATHE") == ""


def test_where_there_is_no_time_it_is_told():
    found = charted(swaying_pile(end=8.0), replace(FEW, seconds=0.0, finest=160))
    assert found.rows == ()
    assert len(found.cut) == 8
    assert [one.failure for one in found.choices] == ["left out, for time"] * 2
    text = motion_report(found)
    assert "  1e-03: NEWMARK, HHT, BATHE, ROS2" in text
    assert "1e-02: no method and step that were measured reach it" in text


def test_a_time_series_has_steps_from_the_accuracy():
    scene = swaying_pile(end=1.0)
    name = scene.steps.names[0]
    pulse = TimeSeries(name, (0.0, 0.5, 1.0), (0.0, 1.0, 0.0))
    plan = replace(FEW, methods=("NEWMARK",), finest=160, accuracies=(1e-2,))
    found = charted(replace(scene, harmonics=(), series=(pulse,)), plan)
    assert found.period is None
    assert found.span <= 1.0
    assert [found.rate(row) for row in found.rows] == [row.steps for row in found.rows]
    assert "steps in all" in motion_report(found)


def test_shorter_steps_end_where_they_tell_no_more():
    assert enough([2e-3], 1e-2)
    assert not enough([5e-3], 1e-2)
    assert not enough([inf, inf, inf], 1e-2)
    assert enough([9e-3, 8e-3, 8.5e-3], 1e-2)
    assert not enough([9e-3, 8e-3, 4e-3], 1e-2)
    assert not enough([0.6, 0.6, 0.6], 1e-2)


def test_the_limit_of_explicit_steps_is_told():
    found = charted(swaying_pile(end=4.0), replace(COARSE, methods=()))
    assert found.rows == ()
    assert found.limit < 1e-4
    text = motion_report(found)
    assert f"CENTRAL is stable with steps up to {1e3 * found.limit:.3g} ms alone" in text


def test_explicit_steps_are_measured_where_their_limit_is_long_enough(monkeypatch):
    monkeypatch.setattr(motion_measure, "stable", lambda _: 0.3)
    found = charted(swaying_pile(end=4.0), replace(COARSE, methods=(), most=20))
    assert [(r.setting.series.method, r.steps) for r in found.rows] == [("CENTRAL", 20)]
