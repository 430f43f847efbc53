"""What a deck without faults becomes: each keyword's values in the scene, defaults and notes."""

from math import radians
from pathlib import Path

import pytest

from podeep.deck.read import Deck, read_deck
from podeep.scene import Displacement, Load, Newton, Numerics, Sea, Spring, Steps, Support

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")


def read(folder: Path, text: str) -> Deck:
    path = folder / "a.deck"
    path.write_bytes(text.encode())
    return read_deck(path)


def changed(old: str, new: str) -> str:
    assert BASE.count(old) == 1
    return BASE.replace(old, new)


def test_structure(tmp_path: Path) -> None:
    scene = read(tmp_path, BASE).scene
    assert scene.title == "Pile in two layers"
    (tube,) = scene.tubes.values()
    assert (tube.id, tube.name, tube.top, tube.tip) == (1, "PILE", -58.0, -110.0)
    upper, lower = tube.sections
    assert (upper.outer_diameter, upper.wall_thickness, upper.density) == (2.134, 0.07, 7850.0)
    assert (upper.poisson_ratio, upper.bending_stiffness_override) == (0.3, None)
    assert (lower.poisson_ratio, lower.bending_stiffness) == (0.29, 30e9)
    (foundation,) = scene.foundations
    assert (foundation.name, foundation.tubes, foundation.mudline) == ("F1", (1,), -60.0)


def test_actions(tmp_path: Path) -> None:
    scene = read(tmp_path, BASE).scene
    assert scene.supports == (Support(1, -58.0, ("RZ",)),)
    assert scene.springs == (Spring(1, -110.0, "Z", 5e8),)
    assert scene.loads == (
        Load("STORM", 1, -58.0, (2.2e6, 0.0, 0.0), (0.0, -4.5e6, 0.0)),
        Load("WEIGHT", 1, -58.0, (0.0, 0.0, -12e6), (0.0, 0.0, 0.0)),
    )
    assert scene.displacements == (Displacement("PUSH", 1, -60.0, "Y", 0.1),)


def test_steps_keep_the_last_factor(tmp_path: Path) -> None:
    steps = read(tmp_path, BASE).scene.steps
    assert steps == Steps(("STORM", "WEIGHT", "PUSH"), ((0, 1, 0), (0.5, 1, 1), (1, 1, 1)))


def test_number_of_steps_alone_ramps_everything(tmp_path: Path) -> None:
    rows = "1 WEIGHT 1\n2 STORM 0.5 PUSH 1\n3 STORM 1\n"
    steps = read(tmp_path, changed(rows, "4\n")).scene.steps
    assert steps.factors == tuple((i / 4,) * 3 for i in (1, 2, 3, 4))


def test_without_steps_there_is_one_in_full(tmp_path: Path) -> None:
    deck = read(tmp_path, BASE.partition("*QUASI")[0] + "*EXEC\n")
    assert deck.scene.steps.factors == ((1.0, 1.0, 1.0),)
    assert any("one step" in note for note in deck.notes)


def test_a_name_shared_in_any_case_shares_its_factor(tmp_path: Path) -> None:
    steps = read(tmp_path, changed("PUSH 1 -60", "weight 1 -60").replace(" PUSH 1", "")).scene.steps
    assert steps.names == ("STORM", "WEIGHT")


def test_numerics(tmp_path: Path) -> None:
    scene = read(tmp_path, BASE).scene
    assert scene.newton == Newton(200, 0.02, 0.01, 0.01, 0.01)
    assert scene.numerics == Numerics(1e-4, 20, 5)
    plain = read(tmp_path, BASE.partition("*NEWTON")[0] + "*EXEC\n").scene
    assert (plain.newton, plain.numerics) == (Newton(), Numerics())


def test_ground(tmp_path: Path) -> None:
    ground = read(tmp_path, BASE).scene.ground
    assert ground.depths == (0.0, 9.0, 9.0, 58.0)
    assert (ground.lateral, ground.axial) == ((1, 2, 3, 3), (1, 1, 2, 2))
    assert (ground.friction_stiffness, ground.dynamic_rule) == (1e8, 0)
    assert ground.interpolation == "PARAMETERS"


@pytest.mark.parametrize("end", [" 2e8 3\n", "\n2e8\n3\n", " IDRE=3 IKTSO=2e8\n"])
def test_ends_of_groundprop(tmp_path: Path, end: str) -> None:
    ground = read(tmp_path, changed("3 2 3 2\n", "3 2 3 2" + end)).scene.ground
    assert (ground.friction_stiffness, ground.dynamic_rule) == (2e8, 3)


def test_slope_alone(tmp_path: Path) -> None:
    ground = read(tmp_path, changed("3 2 3 2\n", "3 2 3 2 2e8\n")).scene.ground
    assert (ground.friction_stiffness, ground.dynamic_rule) == (2e8, 0)


@pytest.mark.parametrize("keyword", ["*GROUNDDEPTH, LOADS", "*groundepth ,loads"])
def test_loads_vary_between_depths(tmp_path: Path, keyword: str) -> None:
    ground = read(tmp_path, changed("*GROUNDEPTH", keyword)).scene.ground
    assert ground.interpolation == "LOADS"


@pytest.mark.parametrize(
    ("line", "mudline"), [("7 1 -62.5", -62.5), ("7 1", -60.0), ("7 1 Z=-61", -61.0)]
)
def test_mudline_of_a_foundation(tmp_path: Path, line: str, mudline: float) -> None:
    (foundation,) = read(
        tmp_path, changed("*FONDATION\n1 1", f"*FOUNDATION\n{line}")
    ).scene.foundations
    assert (foundation.id, foundation.mudline) == (7, mudline)


def test_end_of_deck_says_what_to_do(tmp_path: Path) -> None:
    assert read(tmp_path, BASE).solve
    assert not read(tmp_path, changed("*EXEC", "*stop")).solve


def test_notes_tell_what_is_left_out(tmp_path: Path) -> None:
    more = "*CASING\n5\n0 -1 1 0.1 1e9 0\n*PYCURVE\n8 2 1e4 30 1e6\n*LOAD\nIDLE 1 -60 1 0 0\n*EXEC"
    notes = read(tmp_path, changed("*EXEC", more)).notes
    assert notes == (
        "p-y curve 8 at no depth",
        "tube 5 stands in no *FONDATION and is left out",
        "IDLE has the factor 0 in all steps",
    )


def test_a_load_that_reads_as_a_comment_is_noted(tmp_path: Path) -> None:
    (note,) = read(tmp_path, changed("WEIGHT 1 -58", "CRANE 1 -58 0 0 1\nWEIGHT 1 -58")).notes
    assert "starts with C" in note
    assert "CRANE" in note


def test_angles_become_radians(tmp_path: Path) -> None:
    ground = read(tmp_path, BASE).scene.ground
    assert ground.lateral_curves[3].parameters["friction_angle"] == radians(34.0)
    assert ground.axial_curves[2].parameters["interface_friction_angle"] == radians(25.0)


def test_tz_off_leaves_a_support_at_the_tip_alone(tmp_path: Path) -> None:
    free = changed("*SPRING\n1 -110 Z 5e8\n", "")
    deck = read(tmp_path, free.replace("ORDER=5", "ORDER=5 TZ=off"))
    assert not deck.scene.numerics.axial_curves
    assert Support(1, -110.0, ("Z",)) in deck.scene.supports
    assert "TZ=OFF: tube 1 is held along z at its tip, -110 m, alone" in deck.notes
    sprung = read(tmp_path, changed("ORDER=5", "ORDER=5 TZ=OFF"))
    assert Support(1, -110.0, ("Z",)) not in sprung.scene.supports
    assert read(tmp_path, changed("ORDER=5", "ORDER=5 TZ=ON")).scene.numerics.axial_curves


def test_the_sea(tmp_path: Path) -> None:
    assert read(tmp_path, BASE).scene.sea == Sea(1025.0, 9.80665)
    assert read(tmp_path, changed("*EXEC", "*SEA\n1000\n*EXEC")).scene.sea == Sea(1000.0)
