"""Pictures of curves and capacities: what stands in them, inside, the same bytes each time."""

import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pytest

from podeep.capacity import capacity
from podeep.cli.solve import main
from podeep.scene import Foundation, Ground, Load, Scene, Section, Steps, Tube
from podeep.soil.curves import curves
from podeep.soil.profile import Profile
from podeep.soil_figure import draw_capacity, draw_curves, save_capacity, save_curves
from scenes import clay, clay_shaft, reference_ground

SAMPLES = Path(__file__).parents[1] / "sample_dbs"
DOWN = ((0.0, 0.0, -4e6),)
BOTH = ((0.0, 0.0, -4e6), (0.0, 0.0, 3e6))


def found(forces=DOWN, mudline=-60.0, **options):
    """A tube of 40 m in clay over sand, under one load a step."""
    names = tuple(f"L{i}" for i in range(len(forces)))
    loads = (Load(n, 1, mudline, f, (0.0,) * 3) for n, f in zip(names, forces, strict=True))
    steps = tuple(tuple(map(float, row)) for row in np.eye(len(forces)))
    tube = Tube(1, "pile", (Section(mudline, mudline - 40.0, 2.0, 0.05, 210e9, 7850.0),))
    foundation = Foundation(1, (1,), mudline)
    scene = Scene(
        "a pile",
        {1: tube},
        (foundation,),
        reference_ground(),
        loads=tuple(loads),
        steps=Steps(names, steps),
    )
    return capacity(scene, foundation, **options)


def tables(depth=20.0, displacement=None):
    return curves(Profile(reference_ground(), 40.0), depth, 2.0, displacement)


def lines(axes):
    return {line.get_label(): line for line in axes.lines if line.get_label()[0] != "_"}


def inside(figure):
    figure.draw_without_rendering()
    box = figure.get_tightbbox().get_points() / figure.get_size_inches()
    return box.min() >= 0.0 and box.max() <= 1.0


class TestCapacity:
    def test_three_panels_share_a_depth_axis_that_runs_downward(self):
        friction, bearing, capacities = panels = draw_capacity(found(), "case").axes
        bottom, top = friction.get_ylim()
        assert bottom > 60.0 > 0.0 > top
        assert all(axes.get_ylim() == (bottom, top) for axes in panels)
        assert friction.get_ylabel() == "Depth below the mudline (m)"
        names = [axes.get_xlabel() for axes in panels]
        assert names == ["Unit friction (kPa)", "Unit end bearing (kPa)", "Axial capacity (kN)"]
        assert all(axes.xaxis.get_label_position() == "top" for axes in panels)
        assert bearing.lines[-1].get_xdata()[0] == pytest.approx(9 * 20.0)
        assert len(capacities.lines) == 13

    def test_what_stands_in_it(self):
        result = found(BOTH, safety=1.5)
        drawn = lines(draw_capacity(result, "case").axes[2])
        at = result.fine
        for name, values in (
            ("compression, governs", at.compression),
            ("tension, plugged", at.tension_plugged),
        ):
            assert drawn[name].get_xdata().tolist() == (1e-3 * values).tolist()
            assert drawn[name].get_ydata().tolist() == at.depth.tolist()
        assert list(drawn["needed: 1.5 x tension"].get_xdata()) == pytest.approx([4500.0, 4500.0])
        assert list(drawn["tip, 40 m"].get_ydata()) == [40.0, 40.0]
        assert list(drawn["mudline"].get_ydata()) == [0.0, 0.0]
        assert list(drawn["layer boundary"].get_ydata()) == [15.0, 15.0]

    @pytest.mark.parametrize(("load", "plugged"), [(1.2e6, True), (4e6, False)])
    def test_the_capacity_meets_what_is_needed_at_the_required_length(self, load, plugged):
        result = found(((0.0, 0.0, -load),))
        assert result.axial.required.capacity.plugged_in_compression[0] == plugged
        drawn = lines(draw_capacity(result, "case").axes[2])
        length = result.axial.required.length
        (shown,) = (line for name, line in drawn.items() if name.startswith("required length"))
        assert list(shown.get_ydata()) == [length, length]
        needed = drawn["needed: 2 x (compression + own weight)"]
        capacity = drawn["compression, governs"]
        known = np.isfinite(needed.get_ydata())  # a gap where the governing way changes
        assert 0 < np.count_nonzero(~known) < 5
        at = [
            np.interp(length, np.asarray(z), np.asarray(x))
            for x, z in (
                (needed.get_xdata()[known], needed.get_ydata()[known]),
                (capacity.get_xdata(), capacity.get_ydata()),
            )
        ]
        assert at[0] == pytest.approx(at[1], rel=1e-4)

    def test_no_load_no_need(self):
        drawn = lines(draw_capacity(found(((1e6, 0.0, 0.0),)), "case").axes[2])
        assert not [name for name in drawn if name.startswith(("needed", "required"))]

    def test_compression_and_tension_differ_in_colour_and_ways_in_style(self):
        drawn = lines(draw_capacity(found(BOTH), "case").axes[2])
        pens = {
            name: (line.get_color(), line.get_linestyle())
            for name, line in drawn.items()
            if name.startswith(("compression", "tension", "needed"))
        }
        assert len(set(pens.values())) == len(pens) == 8

    def test_nothing_is_drawn_outside(self):
        assert inside(draw_capacity(found(BOTH, deepest=900.0), f"{'long_name_' * 9}$_{{"))


class TestCurves:
    def test_a_panel_a_curve_with_units(self):
        figure = draw_curves(tables(), "case, F1")
        labels = [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]
        assert labels == [
            ("Lateral displacement (m)", "Reaction (kN/m)"),
            ("Axial displacement (m)", "Reaction (kN/m)"),
            ("Axial displacement (m)", "Reaction (kN)"),
        ]
        assert figure.axes[0].get_title(loc="left") == "py: lateral resistance\nsand (3)"

    def test_a_curve_is_that_of_the_law_and_its_table(self):
        (shaft,) = (table for table in tables() if table.name == "tz")
        drawn = lines(draw_curves((shaft,), "").axes[0])
        law, dots = drawn["law"], drawn["points of the table"]
        u = np.asarray(law.get_xdata())
        np.testing.assert_allclose(law.get_ydata(), 1e-3 * shaft.at(u), rtol=1e-12)
        shown = np.asarray(dots.get_xdata())
        assert set(shown) <= set(shaft.displacement)
        # full friction at 0.01 D = 0.02 m: two points beyond the next one, 0.04 m, are shown
        assert shown.max() == pytest.approx(0.06)
        capacity = drawn["capacity"].get_ydata()
        assert capacity[0] == pytest.approx(1e-3 * shaft.capacity)

    def test_displacements_that_were_asked_for_are_all_shown(self):
        asked = np.array([-0.5, 0.0, 1e-3, 0.9, 1.0, 2.0, 3.0])
        for table in tables(displacement=asked):
            drawn = lines(draw_curves((table,), "", whole=True).axes[0])
            assert list(drawn["points of the table"].get_xdata()) == asked.tolist()
            assert (min(drawn["law"].get_xdata()), max(drawn["law"].get_xdata())) == (-0.5, 3.0)

    def test_a_curve_that_is_still_zero_and_a_single_point(self):
        zero = curves(Profile(Ground((0.0,), (0,), (1,), {}, {1: clay_shaft(1, 0.0)})), 1.0, 2.0)
        assert draw_curves(zero, "").axes
        assert inside(draw_curves(tables(displacement=np.zeros(1)), "", whole=True))

    @pytest.mark.parametrize("count", [1, 3, 4, 6])
    def test_nothing_is_drawn_outside(self, count):
        panels = (*tables(3.0), *tables(20.0))[:count]
        figure = draw_curves(panels, "a title: 100 % $x_{")
        assert inside(figure)
        assert sum(axes.get_visible() for axes in figure.axes) == count


class TestFiles:
    def test_the_same_bytes_whatever_the_users_settings(self, tmp_path):
        def drawn():
            title = "case, F1"
            return [
                save_capacity(found(), tmp_path, "case").read_bytes(),
                save_curves(tables(), title, tmp_path, "case_F1_curves_20m").read_bytes(),
            ]

        first = drawn()
        with matplotlib.rc_context({"axes.facecolor": "black", "savefig.dpi": 30, "font.size": 30}):
            odd = drawn()
        assert odd == first
        names = ("case_F1_capacity", "case_F1_curves_20m")
        expected = {f"{name}{number}.png" for name in names for number in ("", "_2")}
        assert {path.name for path in tmp_path.iterdir()} == expected

    def test_without_pyplot(self, tmp_path):
        script = """
import sys
from pathlib import Path
from test_soil_figure import save_curves, tables
save_curves(tables(), "", Path(sys.argv[1]), "a")
assert "matplotlib" in sys.modules and "matplotlib.pyplot" not in sys.modules
"""
        command = [sys.executable, "-c", script, str(tmp_path)]
        subprocess.run(command, check=True, cwd=Path(__file__).parent)


class TestCommands:
    @pytest.mark.parametrize(
        ("arguments", "name"),
        [
            (["capacity"], "capacity"),
            (["curves", "--depth", "4.5"], "curves_4.5m"),
            (["curves", "--depth", "0", "--at", "0,0.01"], "curves_0m"),
        ],
    )
    def test_a_new_name_each_time_and_no_data_in_it(self, tmp_path, capsys, arguments, name):
        command, *options = arguments
        folder = tmp_path / "new" / "folder"
        asked = [command, str(SAMPLES / "jacket_pile.deck"), *options, "-o", str(folder)]
        assert main(asked) == 0
        first, second = (folder / f"jacket_pile_F1_{name}{n}.png" for n in ("", "_2"))
        assert capsys.readouterr().out.endswith(f"written: {first}\n")
        assert main([*asked, "--csv"]) == 0
        told = capsys.readouterr()
        assert told.err.endswith(f"written: {second}\n")
        assert "written" not in told.out
        assert first.read_bytes() == second.read_bytes()

    def test_none_without_axial_capacity(self, tmp_path, capsys):
        assert main(["capacity", str(SAMPLES / "opensees_pile.deck"), "-o", str(tmp_path)]) == 0
        assert not list(tmp_path.iterdir())
        assert "no picture: there is no axial capacity to draw" in capsys.readouterr().err

    def test_a_folder_that_cannot_be_is_told(self, tmp_path, capsys):
        (tmp_path / "file").write_text("")
        place = str(tmp_path / "file" / "folder")
        assert main(["capacity", str(SAMPLES / "jacket_pile.deck"), "-o", place]) == 2
        assert "choose another with -o" in capsys.readouterr().err


def test_a_clay_without_curves_of_its_own_side_is_left_out():
    ground = Ground((0.0,), (1,), (0,), {1: clay(1, 20e3)}, {})
    (table,) = curves(Profile(ground), 3.0, 2.0)
    assert table.name == "py"
