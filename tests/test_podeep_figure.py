"""Pictures: the same bytes for the same input, nothing overwritten, axes as agreed."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fields import Foundation
from podeep.errors import UserError
from podeep.figure import draw, save
from podeep.query import Origin, envelope, snapshot, spread, step_evolution

ORIGIN = Origin("run.dss", "static", "A pile", "F1", -30.0, "x")
DYNAMIC = replace(ORIGIN, database="run.dst", database_kind="dynamic")
Z = spread(0.0, 12.0, 5)


def foundation():
    fields = {"lateral_force": lambda a, z: 1000.0 * (1 + a) * (6.0 - z)}
    boundaries = np.array([0.0, 5.0, 5.0 + 1e-6, 20.0])
    return Foundation(fields, np.linspace(0, 12, 25), np.arange(13), layer_boundaries=boundaries)


@pytest.fixture
def data():
    return foundation()


def axes_of(figure):
    (axes,) = figure.axes
    return axes


def levels(lines, vertical):
    """Positions of the straight lines across the axes."""
    ends = [line.get_xdata() if vertical else line.get_ydata() for line in lines]
    across = [line.get_ydata() if vertical else line.get_xdata() for line in lines]
    return [float(e[0]) for e, a in zip(ends, across, strict=True) if list(a) == [0, 1]]


def test_a_snapshot_runs_downward_with_the_quantity_on_top(data):
    axes = axes_of(draw(snapshot(data, "lateral_force", Z, [2]), ORIGIN))
    bottom, top = axes.get_ylim()
    assert bottom > 12.0 > 0.0 > top
    assert axes.get_ylabel() == "Depth below the mudline (m)"
    assert axes.get_xlabel() == "Lateral force (kN/m)"
    assert axes.xaxis.get_label_position() == "top"
    assert axes.xaxis.get_ticks_position() == "top"
    assert axes.get_title(loc="left") == "run.dss, F1: snapshot at step 2"
    curve = axes.lines[0]
    assert curve.get_xdata().tolist() == [18.0, 9.0, 0.0, -9.0, -18.0]
    assert curve.get_ydata().tolist() == Z.tolist()


def test_mudline_layer_boundaries_and_zero_line_are_drawn(data):
    lines = axes_of(draw(snapshot(data, "lateral_force", Z, [2]), ORIGIN)).lines
    assert levels(lines, vertical=True) == [0.0]
    assert levels(lines, vertical=False) == [0.0, 5.0]  # a jump is one line, 20 m is out of range


def test_no_mudline_where_the_range_is_below_it(data):
    curves = snapshot(data, "lateral_force", spread(3.0, 12.0, 4), [2])
    assert levels(axes_of(draw(curves, ORIGIN)).lines, vertical=False) == [5.0]


def test_one_point_is_seen(data):
    axes = axes_of(draw(snapshot(data, "lateral_force", spread(3.0, 3.0, 1), [2]), ORIGIN))
    assert axes.lines[0].get_marker() == "o"
    assert axes.get_ylim() == (4.0, 2.0)


def test_ten_curves_are_told_apart_by_colour_and_line_style(data):
    curves = step_evolution(data, "lateral_force", spread(0.0, 12.0, 10))
    figure = draw(curves, ORIGIN)
    axes = axes_of(figure)
    assert len({line.get_color() for line in axes.lines[:10]}) == 10
    assert all(
        one.get_linestyle() != two.get_linestyle()
        for one, two in zip(axes.lines[:9], axes.lines[1:10], strict=True)
    )
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names[::9] == ["0.0000 m", "12.0000 m"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("Step", "Lateral force (kN/m)")
    assert levels(axes.lines, vertical=False) == [0.0]


def test_time_is_the_horizontal_axis_of_a_dynamic_step_evolution(data):
    axes = axes_of(draw(step_evolution(data, "lateral_force", Z), DYNAMIC))
    assert axes.get_xlabel() == "Time (s)"


def test_an_envelope_is_a_band_between_its_two_curves(data):
    axes = axes_of(draw(envelope(data, "lateral_force", Z), DYNAMIC))
    (band,) = axes.collections
    corners = {(x, z) for x, z in band.get_paths()[0].vertices.tolist()}
    assert {(6.0, 0.0), (78.0, 0.0), (-6.0, 12.0), (-78.0, 12.0)} <= corners
    assert [line.get_label() for line in axes.lines[:2]] == ["minimum", "maximum"]


def test_an_evolution_over_time_is_wide(data):
    curves = step_evolution(data, "lateral_force", Z)
    width, height = draw(curves, DYNAMIC).get_size_inches()
    assert width > 1.5 * height
    assert len(set(draw(curves, ORIGIN).get_size_inches())) == 1


def test_nothing_is_drawn_outside_the_picture(data):
    curves = snapshot(data, "lateral_force", Z, range(10))
    long = replace(DYNAMIC, database=f"{'long_name_' * 12}$_{{.dst")
    figure = draw(curves, long)
    figure.draw_without_rendering()
    inside = figure.get_tightbbox().get_points() / figure.get_size_inches()
    assert inside.min() >= 0.0
    assert inside.max() <= 1.0


def test_the_same_result_gives_the_same_bytes_and_a_new_name(data, tmp_path):
    curves = snapshot(data, "lateral_force", Z, [2])
    paths = [save(curves, ORIGIN, tmp_path, "run") for _ in range(3)]
    stem = "run_static_snapshot_lateral_force"
    assert [p.name for p in paths] == [f"{stem}.png", f"{stem}_2.png", f"{stem}_3.png"]
    first, *others = [p.read_bytes() for p in paths]
    assert all(other == first for other in others)
    assert b"Software" not in first


def test_the_users_settings_do_not_show(data, tmp_path):
    import matplotlib

    curves = snapshot(data, "lateral_force", Z, [2])
    with matplotlib.rc_context({"axes.facecolor": "black", "savefig.dpi": 30, "font.size": 30}):
        odd = save(curves, ORIGIN, tmp_path, "run")
    assert odd.read_bytes() == save(curves, ORIGIN, tmp_path, "run").read_bytes()


def test_a_folder_that_cannot_be_written_is_told(data, tmp_path):
    with pytest.raises(UserError, match=r"cannot be written: .*; choose a folder with -o"):
        save(snapshot(data, "lateral_force", Z, [2]), ORIGIN, tmp_path / "nowhere", "run")


def test_figures_do_without_pyplot_and_questions_without_matplotlib(tmp_path):
    script = """
import sys
from pathlib import Path
import podeep.cli.podeep
assert not {"matplotlib", "prompt_toolkit", "scipy"} & set(sys.modules)
from test_podeep_figure import ORIGIN, Z, foundation, save, snapshot
save(snapshot(foundation(), "lateral_force", Z, [2]), ORIGIN, Path(sys.argv[1]), "run")
assert "matplotlib" in sys.modules and "matplotlib.pyplot" not in sys.modules
"""
    command = [sys.executable, "-c", script, str(tmp_path)]
    subprocess.run(command, check=True, cwd=Path(__file__).parent)
    assert len(list(tmp_path.iterdir())) == 1
