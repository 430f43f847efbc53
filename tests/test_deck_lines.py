"""What the keywords of lines become: each one's values in the scene, defaults and notes."""

from math import pi, radians
from pathlib import Path

import numpy as np
import pytest

from podeep.deck.read import Deck, read_deck
from podeep.scene import (
    NO_GROUND,
    Line,
    LineEnd,
    LineMotion,
    LineSection,
    Sea,
    SeabedContact,
    Steps,
    Suction,
    Wave,
)
from podeep.seabed.pull_out import PullOut, pull_out_of

DECKS = Path(__file__).parent / "data" / "decks"
LINE = (DECKS / "line.deck").read_text(encoding="utf-8")
PILE = (DECKS / "base.deck").read_text(encoding="utf-8")
TOP = "11 2 991 5 0 X Y Z"
CONTACT = "0 11 3 0.3 0.6 5e4"
RUN = "*DYNAMIC\n0 60\n"


def read(folder: Path, more: str = "", old: str = "", new: str = "") -> Deck:
    """The deck of a line with more keywords, and one text of it changed."""
    assert not old or LINE.count(old) == 1
    path = folder / "a.deck"
    path.write_text(LINE.replace(old, new).replace("*EXEC", f"{more}\n*EXEC"), encoding="utf-8")
    return read_deck(path)


def contact(folder: Path, line: str, more: str = "") -> SeabedContact:
    (found,) = read(folder, more, CONTACT, line).scene.seabed_contacts
    return found


def motions(folder: Path, more: str) -> tuple[LineMotion, ...]:
    return read(folder, f"{RUN}*MOTION\n{more}").scene.line_motions


def test_a_deck_of_a_line_alone(tmp_path: Path) -> None:
    deck = read(tmp_path)
    scene = deck.scene
    assert scene.lines == {
        11: Line(
            11,
            "RISER",
            (
                LineSection(1400.0, 0.3, 0.02, 200e9, 8000.0, 100),
                LineSection(
                    235.0, 0.4, 0.03, 200e9, 8000.0, added_mass_coefficient=2.0, fill_density=900.0
                ),
            ),
            (
                LineEnd(1, (-10.0, 0.0, -1000.0), direction=scene.lines[11].ends[0].direction),
                LineEnd(2, (991.0, 5.0, 0.0)),
            ),
        )
    }
    assert scene.seabed_contacts == (
        SeabedContact(11, -1000.0, 5e4, axial_friction=0.3, lateral_friction=0.6),
    )
    assert scene.sea == Sea(1000.0, 10.0)
    assert (dict(scene.tubes), scene.foundations, scene.ground) == ({}, (), NO_GROUND)
    assert (dict(scene.suctions), scene.line_motions, scene.steps) == ({}, (), Steps((), ((),)))
    assert deck.notes == ()


def test_without_lines_a_scene_has_none(tmp_path: Path) -> None:
    path = tmp_path / "a.deck"
    path.write_text(PILE, encoding="utf-8")
    scene = read_deck(path).scene
    assert (dict(scene.lines), scene.seabed_contacts) == ({}, ())
    assert (dict(scene.suctions), scene.line_motions) == ({}, ())


def test_a_line_beside_a_foundation(tmp_path: Path) -> None:
    path = tmp_path / "a.deck"
    body = LINE[LINE.index("*LINE") : LINE.index("*EXEC")].replace("-1000", "-60")
    path.write_text(PILE.replace("*EXEC", f"{body}*EXEC"), encoding="utf-8")
    scene = read_deck(path).scene
    assert list(scene.tubes) == [1]
    assert list(scene.lines) == [11]
    assert scene.seabed_contacts[0].mudline == -60.0
    assert scene.ground != NO_GROUND


def test_weight_and_stiffness_of_sections(tmp_path: Path) -> None:
    first, last = read(tmp_path).scene.lines[11].sections
    area = pi / 4.0 * (0.3**2 - 0.26**2)
    assert first.mass == pytest.approx(8000.0 * area, rel=1e-14)
    assert first.total_mass == first.mass
    assert first.axial_stiffness == pytest.approx(200e9 * area, rel=1e-14)
    assert first.bending_stiffness == pytest.approx(200e9 * pi / 64 * (0.3**4 - 0.26**4), rel=1e-14)
    outer = pi / 4.0 * 0.3**2
    weight = first.submerged_weight(1000.0, 10.0)
    assert weight == pytest.approx(10.0 * (8000.0 * area - 1000.0 * outer), rel=1e-13)
    inside = pi / 4.0 * 0.34**2
    assert last.total_mass == pytest.approx(last.mass + 900.0 * inside, rel=1e-14)
    heavier = last.submerged_weight(1000.0, 10.0) + 10.0 * 1000.0 * pi / 4.0 * 0.4**2
    assert heavier == pytest.approx(10.0 * last.total_mass, rel=1e-13)


def test_values_that_replace_what_the_geometry_gives(tmp_path: Path) -> None:
    old = "235 0.4 0.03 200e9 8000 0 FILL=900 CA=2"
    new = "235 0.4 0.2 200e9 8000 EI=5e7 EA=4e9 MASS=150 FILL=900 CA=0"
    one = read(tmp_path, "", old, new).scene.lines[11].sections[1]
    assert (one.bending_stiffness, one.axial_stiffness, one.mass) == (5e7, 4e9, 150.0)
    assert (one.elements, one.added_mass_coefficient) == (None, 0.0)
    assert one.total_mass == 150.0  # a solid bar has no contents


@pytest.mark.parametrize(
    ("line", "end"),
    [
        ("11 2 991 5 0 FREE", LineEnd(2, (991.0, 5.0, 0.0), ())),
        ("11 2 991 5 0 z x z", LineEnd(2, (991.0, 5.0, 0.0), ("X", "Z"))),
        (
            "11 2 991 5 0 Z RX RY RZ DX=3 DZ=-4",
            LineEnd(2, (991.0, 5.0, 0.0), ("Z",), (3.0, 0.0, -4.0)),
        ),
    ],
)
def test_ends(tmp_path: Path, line: str, end: LineEnd) -> None:
    assert read(tmp_path, "", TOP, line).scene.lines[11].ends[1] == end


def test_a_held_end_points_horizontally_to_the_other(tmp_path: Path) -> None:
    one, other = read(tmp_path, "", TOP, f"{TOP} RX RY RZ").scene.lines[11].ends
    assert one.tangent is not None
    assert other.tangent is not None
    way = np.array([1001.0, 5.0, 0.0])
    np.testing.assert_allclose(one.tangent, way / np.linalg.norm(way), rtol=1e-14)
    np.testing.assert_allclose(other.tangent, -np.array(one.tangent), rtol=1e-14)
    assert one.holds("RY")
    assert one.holds("Z")


def test_a_direction_of_any_length_is_one_of_length_1() -> None:
    end = LineEnd(1, (0.0, 0.0, 0.0), direction=(3.0, 0.0, -4.0))
    assert end.tangent == pytest.approx((0.6, 0.0, -0.8), rel=1e-14)
    free = LineEnd(1, (0.0, 0.0, 0.0), ("X",))
    assert free.tangent is None
    assert not free.holds("RX")
    assert not free.holds("Y")


def test_length_and_distance(tmp_path: Path) -> None:
    line = read(tmp_path).scene.lines[11]
    assert line.length == 1635.0
    assert line.distance == pytest.approx((1001.0**2 + 5.0**2 + 1000.0**2) ** 0.5, rel=1e-14)


@pytest.mark.parametrize(
    ("line", "changed"),
    [
        ("0 11 3 0.3 0.6 5e4", {}),
        (
            "0 11 3 0.3 0.6 5e4 0 0 1 10 0 0 0 0 0 0.2 0 0 0 0 0 0 SURFACE=box FORM=integrated",
            {},
        ),
        ("0 11 3 0.3 0.6 2.5e4 DENSITY=2", {}),
        ("0 11 3 0.3 0.6 5e4 0.02", {"axial_threshold": 0.02}),
        ("0 11 3 0.3 0.6 5e4 0 0.05", {"lateral_threshold": 0.05}),
        ("0 11 3 0.3 0.6 5e4 SURFACE=Ellipse", {"surface": "ellipse"}),
        ("0 11 3 0.3 0.6 5e4 FORM=NODAL", {"form": "nodal"}),
    ],
)
def test_contacts(tmp_path: Path, line: str, changed: dict[str, float]) -> None:
    basis = {"axial_friction": 0.3, "lateral_friction": 0.6}
    assert contact(tmp_path, line) == SeabedContact(11, -1000.0, 5e4, **{**basis, **changed})


def test_contacts_share_what_contact_gives(tmp_path: Path) -> None:
    shared = "*CONTACT\n20 5 2 1e8 1e-3 0 0 4e4 5"
    assert contact(tmp_path, "0 11 3 DENSITY=0.5", shared) == SeabedContact(
        11, -1000.0, 2e4, tolerance=1e-3
    )
    assert contact(tmp_path, CONTACT, shared).stiffness == 5e4


def test_soil_and_suction_by_their_ids(tmp_path: Path) -> None:
    more = "*SOILSTIFF\n3 DIRECT 1e5 4e5\n4 DIRECT 1e5 4e5\n*SUCTION\n2 CU=5e3\n5 CU=5e3"
    deck = read(tmp_path, more, CONTACT, f"{CONTACT} ID1=3 ID2=2 CRIT_PROX=7")
    (found,) = deck.scene.seabed_contacts
    assert (found.stiffness, found.soil_stiffness, found.suction) == (None, 3, 2)
    assert set(deck.notes) == {
        "KN has no effect on line 11: its seabed is soil stiffness 3",
        "CRIT_PROX has no effect on line 11: all of it is looked at",
        "soil stiffness 4 under no line: podeep-solve stiffness shows it under a pipe",
        "suction 5 under no line",
    }


def test_suctions(tmp_path: Path) -> None:
    more = (
        "*SUCTION\n1 CU=5e3\n2 0 0.2 0 0.3 0.1 0.5 CU=4e3\n"
        "*SUCTION\n3 900 ALPHAD=0.4 V=0.1 SMOOTH=2 REMAIN=0.3 TRAVEL=4"
    )
    suctions = read(tmp_path, more).scene.suctions
    assert suctions == {
        1: Suction(1, undrained_shear_strength=5e3),
        2: Suction(2, None, 0.2, None, 0.3, 0.1, 0.5, 4e3),
        3: Suction(
            *(3, 900.0),
            reach_factor=0.4,
            speed=0.1,
            smoothing=2.0,
            remaining=0.3,
            travel_95=4.0,
        ),
    }


def test_the_law_of_a_suction() -> None:
    """By the numbers of the theory page's law: D = 0.3 m, 5 kPa, 0.1 m/s."""
    law = pull_out_of(Suction(1, undrained_shear_strength=5e3), 0.3)
    assert float(law.force(0.1)) == pytest.approx(1378.57, abs=5e-3)
    assert float(law.reach(0.1)) == pytest.approx(0.16157, abs=5e-6)
    other = pull_out_of(Suction(1, force_exponent=0.3, undrained_shear_strength=5e3), 0.3)
    assert float(other.force(0.3)) == pytest.approx(1.12 * 0.3 * 5e3, rel=1e-14)  # v/D is 1 1/s
    given = pull_out_of(Suction(1, 900.0, 0.2, 0.4, 0.3, 0.1, 0.5), 0.3)
    assert float(given.force(0.1)) == pytest.approx(900.0 * 0.1**0.2, rel=1e-14)
    assert float(given.reach(0.1)) == pytest.approx(0.4 * 0.1**0.3, rel=1e-14)
    assert (given.mobilised, given.released) == (0.1, 0.5)


def test_defaults_of_a_suction_are_those_of_its_law() -> None:
    law, default = PullOut(force_factor=1.0, reach_factor=1.0), Suction(1, 1.0)
    for name in ("force_exponent", "reach_exponent", "mobilised", "released"):
        assert getattr(default, name) == getattr(law, name)


def test_a_displacement_of_the_steps(tmp_path: Path) -> None:
    deck = read(tmp_path, "*MOTION\n11 2\nX 5\nz -2\n*MOTION 11 1 NAME=Turn\nRY 3\n*QUASISTATIC\n2")
    assert deck.scene.line_motions == (
        LineMotion(11, 2, "X", "L11E2", 5.0),
        LineMotion(11, 2, "Z", "L11E2", -2.0),
        LineMotion(11, 1, "RY", "Turn", radians(3.0)),
    )
    assert deck.scene.steps == Steps(("L11E2", "Turn"), ((0.5, 0.5), (1.0, 1.0)))


def test_displacements_by_steps_and_histories(tmp_path: Path) -> None:
    more = "*MOTION\n11 2 NAME=LIFT\nZ 5\n*QUASISTATIC\n1 lift 1\n2 LIFT -1\n"
    deck = read(tmp_path, f"{more}{RUN}*HARMONIC\nLIFT 12 0")
    assert deck.scene.steps == Steps(("LIFT",), ((1.0,), (-1.0,)))
    assert [h.name for h in deck.scene.harmonics] == ["LIFT"]
    assert deck.notes == ()


def test_waves(tmp_path: Path) -> None:
    more = "11 2\nZ 2.5 12 90 20\nZ 1 6\nX AMPLITUDE=0.5 PERIOD=9\n*MOTION\n11 1\nRX 2 5 -90"
    assert motions(tmp_path, more) == (
        LineMotion(11, 2, "Z", waves=(Wave(2.5, 12.0, radians(90.0), 20.0), Wave(1.0, 6.0))),
        LineMotion(11, 2, "X", waves=(Wave(0.5, 9.0),)),
        LineMotion(11, 1, "RX", waves=(Wave(radians(2.0), 5.0, radians(-90.0)),)),
    )


@pytest.mark.parametrize("inline", [True, False])
def test_records(tmp_path: Path, inline: bool) -> None:
    rows = "0 0 1\n2.5 1D0 2\n"
    (tmp_path / "m.txt").write_text(f"C a record\n{rows}", encoding="utf-8")
    more = f"11 1 X RZ\n{rows}" if inline else "11 1 X RZ, file=m.txt"
    assert motions(tmp_path, more) == (
        LineMotion(11, 1, "X", times=(0.0, 2.5), values=(0.0, 1.0)),
        LineMotion(11, 1, "RZ", times=(0.0, 2.5), values=(radians(1.0), radians(2.0))),
    )


def test_the_text_of_a_deck_holds_the_rows_of_its_record(tmp_path: Path) -> None:
    (tmp_path / "m.txt").write_text("0 1\n9 2\n", encoding="utf-8")
    deck = read(tmp_path, f"{RUN}*MOTION 11 2 Z, file=m.txt")
    (tmp_path / "m.txt").unlink()
    path = tmp_path / "b.deck"
    path.write_text(deck.text, encoding="utf-8")
    assert read_deck(path).scene == deck.scene


def test_all_that_moves_one_degree_of_freedom_is_one_motion(tmp_path: Path) -> None:
    more = "11 2\nZ 5\nZ 2.5 12\n*MOTION\n11 2 Z\n0 1\n9 2"
    assert motions(tmp_path, more) == (
        LineMotion(11, 2, "Z", "L11E2", 5.0, (Wave(2.5, 12.0),), (0.0, 9.0), (1.0, 2.0)),
    )
    assert motions(tmp_path, more)[0].moves_in_time
    assert not LineMotion(11, 2, "Z", "L11E2", 5.0).moves_in_time


@pytest.mark.parametrize(
    ("more", "note"),
    [
        (
            "*MOTION\n11 2 X\n0 1",
            "waves and records of *MOTION have no effect without *DYNAMIC",
        ),
        (
            "*MOTION\n11 2\nZ 1 12",
            "waves and records of *MOTION have no effect without *DYNAMIC",
        ),
        (
            "*MOTION\n11 2\nZ 1",
            "without *QUASISTATIC there is one step with all loads at factor 1",
        ),
        (
            RUN,
            "no history and no start: in motion the loads stay as the steps leave them",
        ),
    ],
)
def test_what_is_assumed_is_noted(tmp_path: Path, more: str, note: str) -> None:
    assert read(tmp_path, more).notes == (note,)


def test_a_line_without_a_seabed_is_noted(tmp_path: Path) -> None:
    deck = read(tmp_path, "", f"*TYPCONTACT\n{CONTACT}\n", "")
    assert deck.scene.seabed_contacts == ()
    assert deck.notes == ("line 11 hangs free of the seabed: no *TYPCONTACT names it",)
    assert read(tmp_path, f"{RUN}*MOTION\n11 2\nZ 1 12").notes == ()


def test_tubes_and_lines_share_a_typcontact(tmp_path: Path) -> None:
    """One keyword with a line of each kind, in either order: each goes where it belongs."""
    body = LINE[LINE.index("*LINE") : LINE.index("*TYPCONTACT")].replace("-1000", "-60")
    second = "*CASING\n2 INSERT\n-58 -100 1.6 0.04 210e9 7850\n"
    piles = PILE.replace("*FONDATION\n1 1", f"{second}*FONDATION\n1 1 2")
    for lines in (("1 2 2 0.1 0 1e8", CONTACT), (CONTACT, "1 2 2 0.1 0 1e8")):
        more = "{}*SLAVE\n1 2 ENDS\n*TYPCONTACT\n{}\n{}\n*EXEC".format(body, *lines)
        path = tmp_path / "a.deck"
        path.write_text(piles.replace("*EXEC", more), encoding="utf-8")
        scene = read_deck(path).scene
        assert [(one.outer, one.inner, one.stiffness) for one in scene.slidings] == [(1, 2, 1e8)]
        assert [one.line for one in scene.seabed_contacts] == [11]
