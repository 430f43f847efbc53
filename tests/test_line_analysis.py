"""Lines of a deck: meshes that suit them, planes, ends, soils, steps, and their errors."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lines_on_seabed import numbers, table
from podeep.arrays import Array
from podeep.deck.read import read_deck
from podeep.line.analysis import SolvedLine, solve_line, stages
from podeep.line.assemble import assemble, mesh, plane_of
from podeep.scene import Scene

RISER = """\
*TITLE
The riser of table 05
*DEPTH
-1000
*SEA
1000 10
*LINE
1 SCR
1635 0.4 0.02 200e9 7850 EI=55.3e6 EA=4.93e9 MASS={mass}
*END
1 1 0 0 {bottom} X Y Z RX RY RZ
1 2 {top} X Y Z
*TYPCONTACT
0 1 3 {friction} 0 {soil}
{more}
*ACCURACY
{accuracy}
*EXEC
"""
ROWS = {row["case"]: numbers(row) for row in table("05", "1")}
MASS = 145.0 + 1000.0 * np.pi / 4.0 * 0.4**2  # 1450 N/m in water


def scene(folder: Path, **more: object) -> Scene:
    """The deck of the riser, changed."""
    values: dict[str, object] = {
        "mass": MASS,
        "bottom": -1000.029,
        "top": "991 0 0",
        "friction": 0,
        "soil": "5e4",
        "more": "",
        "accuracy": 1e-3,
    }
    path = folder / "riser.deck"
    path.write_text(RISER.format(**(values | more)), encoding="utf-8")
    return read_deck(path).scene


def solved(scene: Scene) -> SolvedLine:
    return solve_line(scene, scene.lines[1])


def moments(found: SolvedLine) -> Array:
    """Largest in each state."""
    s = np.linspace(0.0, 1635.0, 20001)
    return np.asarray(np.abs(found.results.moment(s)).max(axis=1))


def test_a_deck_of_the_riser_is_the_table(tmp_path):
    found = solved(scene(tmp_path))
    row = ROWS["B_k50kPa"]
    assert found.accurate
    assert not found.failure
    assert np.hypot(*found.states[0].forces[-2:]) == pytest.approx(row["T_top_N"], rel=1e-5)
    assert moments(found)[0] == pytest.approx(row["M_max_Nm"], rel=1e-3)
    assert found.results.touchdown()[0] == pytest.approx(row["S_td_m"], abs=0.05)
    s = np.array([0.0, 1635.0])
    assert found.results.tension(s)[0] == pytest.approx(
        [row["H_anchor_end_N"], row["T_top_N"]], rel=1e-5
    )


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_the_error_is_within_the_accuracy(tmp_path, accuracy):
    found = solved(scene(tmp_path, accuracy=accuracy))
    row = ROWS["B_k50kPa"]
    places = [numbers(r) for r in table("05", "2") if r["case"] == "B_k50kPa"]
    s = row["S_td_m"] + np.array([at["s_m"] for at in places])
    told = np.array([at["M_Nm"] for at in places])
    assert np.abs(found.results.moment(s)[0] - told).max() <= 2 * accuracy * row["M_max_Nm"]


def test_the_mesh_is_fine_where_the_line_touches_down(tmp_path):
    one = scene(tmp_path)
    edges = mesh(one, one.lines[1], one.seabed_contacts[0], 0)
    sizes, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    assert np.abs(middle[sizes.argmin()] - ROWS["B_k50kPa"]["S_td_m"]) < 30.0 or sizes.argmin() in (
        0,
        len(sizes) - 1,
    )
    assert sizes.max() > 4.0 * sizes.min()
    halved = mesh(one, one.lines[1], one.seabed_contacts[0], 1)
    np.testing.assert_allclose(halved[::2], edges)
    given = replace(one.lines[1].sections[0], elements=12)
    line = replace(one.lines[1], sections=(given,))
    np.testing.assert_allclose(mesh(one, line, None, 0), np.linspace(0.0, 1635.0, 13))


def test_it_does_not_matter_where_the_plane_of_a_line_points(tmp_path):
    """Turned by 30 degrees about z: the same forces in its plane."""
    turned = f"{991 * np.cos(np.pi / 6):.12g} {991 * np.sin(np.pi / 6):.12g} 0"
    first, second = (solved(scene(tmp_path, top=top)) for top in ("991 0 0", turned))
    assert second.model.plane.components == 2
    np.testing.assert_allclose(second.states[0].forces, first.states[0].forces, rtol=1e-9, atol=1)
    top = np.array([1635.0])
    places = second.model.plane.outside(second.results.position(top))
    np.testing.assert_allclose(places[0, 0], [float(x) for x in turned.split()], atol=1e-6)


def test_steps_move_the_end(tmp_path):
    """20 m away in two steps: as the line that is laid there, as nothing rubs."""
    more = "*MOTION\n1 2\nX 20\n*QUASISTATIC\n1 L1E2 0.5\n2 L1E2 1"
    found = solved(scene(tmp_path, more=more))
    assert not found.failure
    assert len(found.states) == 3
    there = solved(scene(tmp_path, top="1011 0 0"))
    np.testing.assert_allclose(found.states[2].forces, there.states[0].forces, rtol=1e-4, atol=20)
    touchdown = found.results.touchdown()
    assert (np.diff(touchdown) < 0.0).all()


def test_a_motion_out_of_the_plane_is_followed_in_space(tmp_path):
    more = "*MOTION\n1 2\nY 10\n*QUASISTATIC\n1 L1E2 1"
    one = scene(tmp_path, more=more, friction="0.3", accuracy=1e-2)
    assert plane_of(one.lines[1], one.line_motions).components == 3
    found = solved(one)
    assert not found.failure
    last = found.results.position(np.array([1635.0]))[1, 0]
    np.testing.assert_allclose(last, [991.0, 10.0, 0.0], atol=1e-6)
    held = found.states[1].forces
    assert 0.0 < held[-2] < 0.05 * held[-1]


def test_a_soil_model_takes_the_place_of_a_stiffness(tmp_path):
    """Penetration far from the touchdown is that of the model under the line's weight."""
    soil = "0 0 0 1 0 0 3"
    more = "*SOILSTIFF\n3 DUNLAP 5e3"
    found = solved(scene(tmp_path, soil=soil, more=more, accuracy=1e-2))
    assert not found.failure
    expected = 0.4 * (1450.0 / (7.32 * 0.4 * 5e3)) ** (1.0 / 0.64)
    assert found.results.penetration(np.array([150.0]))[0, 0] == pytest.approx(expected, rel=1e-2)


def test_a_held_direction_is_kept(tmp_path):
    """A riser whose upper end is built in at 10 degrees from the vertical."""
    lean = np.radians(10.0)
    direction = f"{-np.sin(lean):.12g} 0 {-np.cos(lean):.12g}"
    one = scene(tmp_path)
    line = one.lines[1]
    end = replace(line.ends[1], direction=tuple(float(x) for x in direction.split()))
    one = replace(one, lines={1: replace(line, ends=(line.ends[0], end))})
    found = solved(one)
    assert not found.failure
    slope = found.results.position(np.array([1635.0]), 1)[0, 0]
    assert np.arctan2(slope[0], slope[1]) == pytest.approx(lean, abs=1e-4)
    moment = found.results.moment(np.array([1634.999]))[0, 0]
    assert abs(moment) > 1e3


def test_a_line_that_hangs_free_needs_no_seabed(tmp_path):
    one = scene(tmp_path, bottom=-700.0)
    found = solved(replace(one, seabed_contacts=()))
    assert not found.failure
    assert found.results.touchdown()[0] == 0.0
    weight = 1450.0 * 1635.0
    up = found.states[0].forces
    assert up[1] + up[-1] == pytest.approx(weight, rel=1e-6)
    assert up[0] + up[-2] == pytest.approx(0.0, abs=1e-3 * weight)


def test_stages_are_those_of_the_steps(tmp_path):
    more = "*MOTION\n1 2\nX 20\nZ -5\n*QUASISTATIC\n1 L1E2 0.5\n2 L1E2 1"
    one = scene(tmp_path, more=more)
    line = one.lines[1]
    model = assemble(one, line, mesh(one, line, one.seabed_contacts[0], 0))
    first, second = stages(one, model)
    np.testing.assert_allclose((second.held - first.held)[-2:], [10.0, -2.5])
    np.testing.assert_allclose((first.held - model.start[model.system.held])[-2:], [10.0, -2.5])


def test_a_line_too_short_is_stretched_to_its_ends(tmp_path):
    """1635 m between ends 1803 m apart: the forces are those of the strain, not of the weight."""
    found = solved(scene(tmp_path, top="1500 0 0", accuracy=1e-2))
    assert not found.failure
    strain = np.hypot(1500.0, 1000.029) / 1635.0 - 1.0
    tension = found.results.tension(np.array([800.0]))[0, 0]
    assert tension == pytest.approx(4.93e9 * strain, rel=0.01)
