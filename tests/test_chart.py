"""What podeep-solve chart measures is so, and what it recommends works."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.deck.read import read_deck
from podeep.errors import AnalysisFailed
from podeep.scene import Curve, Numerics, Scene
from podeep.solve.analysis import solve, suited_model
from podeep.study.chart import Chart, Setting
from podeep.study.chart_report import chart_report
from podeep.study.measure import (
    Probe,
    asking,
    converged,
    errors,
    measured,
)
from podeep.study.settings import (
    PRESETS,
    Plan,
    Series,
    deck_lines,
)
from scenes import linear_ground, reference_pile

JACKET = Path(__file__).parents[1] / "sample_dbs" / "jacket_pile.deck"
LUMPED, SPATIAL = Series(3, "lumped"), Series(5, spatial=True)


def silent(_: str) -> None:
    """Hear nothing."""


def settings(*series: Series, elements=(6, 12, 24, 48, 96)) -> tuple[Setting, ...]:
    return tuple(Setting(one, n) for one in series for n in elements)


def charted(scene: Scene, *wanted: Setting, runs: int = 1) -> Chart:
    base = suited_model(scene, scene.foundations[0])[0]
    return measured(scene, base, Plan(wanted, runs, 60.0), silent)


@pytest.fixture(scope="module")
def jacket() -> Chart:
    scene = read_deck(JACKET).scene
    series = (Series(3), Series(5), Series(5, method="secant"), SPATIAL, LUMPED)
    return charted(scene, *settings(*series))


def test_every_setting_has_a_row_with_errors_and_time(jacket: Chart):
    assert len(jacket.rows) == 25
    assert [c.accuracy for c in jacket.choices] == list(PRESETS)
    for one in (*jacket.rows, *jacket.choices):
        assert one.failure == ""
        assert one.errors
        assert one.seconds
        assert one.runs == 1
    assert all(row.evaluations > row.iterations >= jacket.steps for row in jacket.rows)


def test_the_reference_is_far_more_exact_than_the_smallest_preset(jacket: Chart):
    assert jacket.sure
    assert jacket.reference.errors.largest < 1e-7


def test_errors_fall_under_refinement(jacket: Chart):
    for rows in jacket.series().values():
        found = [row.errors.largest for row in rows if row.errors]
        assert all(fine < 1.05 * coarse for coarse, fine in pairwise(found))
        assert found[-1] < 0.03 * found[0]


def test_neither_the_iteration_nor_the_second_component_changes_the_error(jacket: Chart):
    series = jacket.series()
    for other in (Series(5, method="secant"), SPATIAL):
        for row, usual in zip(series[other], series[Series(5)], strict=True):
            assert row.errors
            assert usual.errors
            assert row.errors.largest == pytest.approx(usual.errors.largest, rel=0.03, abs=1e-7)


def fewest(chart: Chart, series: Series, error: float) -> float:
    """The fewest elements of a series within an error, as all its finer meshes are; inf: none."""
    found = np.inf
    for row in reversed(chart.series()[series]):
        if row.errors is None or row.errors.largest > error:
            break
        found = row.setting.elements
    return found


def test_springs_at_nodes_need_far_more_elements(jacket: Chart):
    assert fewest(jacket, LUMPED, 1e-3) >= 48
    assert fewest(jacket, Series(5), 1e-3) <= 12


def test_what_the_program_chooses_is_within_what_was_asked(jacket: Chart):
    for one in jacket.choices:
        assert one.errors
        assert one.estimate <= one.accuracy
        assert one.errors.largest <= 2.0 * one.estimate


def test_the_fastest_reaches_its_preset_when_its_lines_are_solved(jacket: Chart, tmp_path, capsys):
    scene = read_deck(JACKET).scene
    probe = Probe(suited_model(scene, scene.foundations[0])[0])
    finest = solve(asking(scene, 1e-5), scene.foundations[0])
    _, true = converged(scene, finest.model, probe, silent)
    for preset in PRESETS:
        row = jacket.fastest(preset, lambda series: series.in_deck)
        assert row
        lines = deck_lines(scene.numerics, preset, row.setting)
        path = tmp_path / "again.deck"
        path.write_text(JACKET.read_text().replace("*EXEC", f"{lines}\n*EXEC"))
        assert main(["check", str(path)]) == 0, capsys.readouterr().err
        again = read_deck(path).scene
        solved = solve(again, again.foundations[0])
        assert solved.model.elements == row.setting.elements
        assert solved.model.lateral.system.field.degree == row.setting.series.degree
        assert errors(probe.values(solved.results), true).largest <= preset


def test_errors_are_relative_to_the_step_and_to_the_run_where_a_step_is_at_rest():
    true = np.zeros((2, 3, 2))
    true[0] = [[1.0, 2.0], [10.0, 0.0], [1.0, 1.0]]
    values = true.copy()
    values[0, 0, 1] = 2.1
    values[0, 1, 1] = 1e-9
    found = errors(values, true)
    assert found.displacement == pytest.approx(0.05)
    assert found.reaction == pytest.approx(1e-4)
    assert found.moment == 0.0
    assert found.largest == found.displacement


# --- what fails ---------------------------


def test_a_setting_that_finds_no_equilibrium_is_a_row_with_its_reason(monkeypatch):
    import podeep.study.measure as measure

    monkeypatch.setattr(measure, "_SECANT_PATIENCE", 0)
    scene = read_deck(JACKET).scene
    found = charted(scene, Setting(Series(5), 6), Setting(Series(5, method="secant"), 6))
    good, bad = found.rows
    assert good.errors
    assert bad.errors is bad.seconds is None
    assert bad.failure == "step 1, axial: no equilibrium within the allowed iterations"
    text = chart_report(found)
    assert "degree 5, secant, 6 elements: step 1, axial: no equilibrium" in text.replace(
        "\n   ", ""
    )


def test_curves_that_allow_one_direction_alone_fail_in_two_components():
    curve = Curve(1, "user", {}, {}, ((-2e6, -1e3), (1e6, 1e3)))
    ground = replace(linear_ground(1e6, 2.0, 1e7), lateral_curves={1: curve})
    scene = replace(reference_pile((2e6, 0.0, 0.0), steps=1), ground=ground)
    found = charted(scene, Setting(SPATIAL, 6))
    assert found.rows[0].failure.startswith("F1: a p-y curve with rows of negative displacement")


def test_lumped_reactions_under_p_delta():
    numerics = Numerics(second_order=True)
    scene = reference_pile(steps=1, shape="2GEO", numerics=numerics)
    found = charted(scene, Setting(LUMPED, 30), Setting(LUMPED, 120), Setting(Series(5), 8))
    coarse, fine, _ = (row.errors for row in found.rows)
    assert coarse
    assert fine
    assert fine.largest < 0.3 * coarse.largest


def test_a_scene_beyond_its_capacity_has_no_chart(tmp_path, capsys):
    with pytest.raises(AnalysisFailed, match="every step needs an equilibrium"):
        charted(reference_pile((2e8, 0.0, 0.0)), Setting(Series(5), 8))
    path = tmp_path / "heavy.deck"
    path.write_text(JACKET.read_text().replace("2.2e6  0", "2.2e8  0"))
    assert main(["chart", str(path), "--quick"]) == 1
    assert "no chart: every step needs an equilibrium" in capsys.readouterr().err
