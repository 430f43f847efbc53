"""Decks of combined casings: what they say, what they leave to custom, and their faults."""

from pathlib import Path

import numpy as np
import pytest

from decks import solved
from podeep.cli.solve import main
from podeep.deck.read import Deck, read_deck
from podeep.errors import UserError

BASE = """*DEPTH
-100
*GROUNDEPTH
0 -60
*PYCURVE
1 1 40e3 8e3 0.5 0.01
*TZCURVE
1 0
1 40e3 8e3
*GROUNDPROP
1 1 1 1
*CASING
1 CONDUCTOR
-98 -140 0.762 0.0254 210e9 7850
*CASING
2 SURFACE
-97 -150 0.508 0.0127 210e9 7850
*CASING
3 INNER
-96 -155 0.244 0.012 210e9 7850
*FONDATION
1 1 2 3
{ties}
*LOAD
PUSH 2 -97 200e3 0 -1e6
{extra}*EXEC
"""


def read(tmp_path: Path, ties: str, extra: str = "") -> Deck:
    path = tmp_path / "case.deck"
    path.write_text(BASE.format(ties=ties, extra=extra), encoding="utf-8")
    return read_deck(path)


def test_without_slaves_tubes_are_cemented_to_the_outermost_at_each_level(tmp_path):
    deck = read(tmp_path, "")
    ties = [(t.outer, t.inner, t.top, t.bottom, t.ends) for t in deck.scene.ties]
    assert ties == [
        (1, 2, -98.0, -140.0, False),
        (2, 3, -97.0, -98.0, False),
        (1, 3, -98.0, -140.0, False),
        (2, 3, -140.0, -150.0, False),
    ]
    assert sum("cemented" in note for note in deck.notes) == 4


def test_slaves_and_contacts_as_they_are_given(tmp_path):
    ties = (
        "*SLAVE\n1 2 CEMENTED -120 -140\n2 3 ENDS\n"
        "*CONTACT\n20 5 2 1e6 1e-3\n*TYPCONTACT\n1 2 2 0 0 0 GAP=0.01\n"
        "2 3 2 0.25 0 2e7 0.002 0 0.5 GAP=-1"
    )
    scene = read(tmp_path, ties).scene
    cemented, ends = scene.ties
    assert (cemented.top, cemented.bottom, cemented.ends) == (-120.0, -140.0, False)
    assert (ends.top, ends.bottom, ends.ends) == (-97.0, -150.0, True)
    one, other = scene.slidings
    assert (one.stiffness, one.clearance, one.tolerance) == (1e6, 0.01, 1e-3)
    assert (other.stiffness, other.clearance) == (1e7, None)
    assert (other.friction, other.threshold) == (0.25, 0.002)


def test_where_cement_ends_tubes_slide_without_room(tmp_path):
    deck = read(tmp_path, "*SLAVE\n1 2 CEMENTED -120 -140\n2 3 CEMENTED")
    (one,) = deck.scene.slidings
    assert (one.outer, one.inner, one.stiffness, one.clearance) == (1, 2, None, 0.0)
    assert any("slides in tube 1 without room" in note for note in deck.notes)


@pytest.mark.parametrize(
    ("ties", "told"),
    [
        ("*SLAVE\n1 2 ENDS", ("tied at their ends alone", "*TYPCONTACT with the line 1 2 2")),
        ("*SLAVE\n2 1 CEMENTED", ("tube 2 stands inside tube 1", "outer tube first: 1 2")),
        ("*SLAVE\n1 9 CEMENTED", ("no tube 9", "*CASING")),
        ("*SLAVE\n1 2 CEMENTED -90 -140", ("ZTOP is -90 m", "-98 to -140 m")),
        ("*SLAVE\n1 2 CEMENTED -130 -120", ("ZTOP -130 m is not above ZBOT -120 m",)),
        ("*SLAVE\n1 2 GLUED", ("CEMENTED", "ENDS")),
        ("*TYPCONTACT\n1 2 3", ("ITYP12", "2")),
        ("*TYPCONTACT\n1 1 2", ("not two tubes of one foundation",)),
    ],
)
def test_faults_of_ties(tmp_path, ties, told):
    with pytest.raises(UserError) as caught:
        read(tmp_path, ties)
    text = str(caught.value)
    assert text.count("case.deck:") == 1
    for words in told:
        assert words in text


LOOSE = {"-97 -150 0.508": "-97 -130 0.508", "1 1 2 3": "1 1 2"}


@pytest.mark.parametrize(
    ("changes", "ties", "told"),
    [
        (LOOSE, "*TYPCONTACT\n1 2 2", "nothing holds it along z"),
        ({"-96 -155 0.244": "-151 -155 0.244"}, "", "leave a gap from -150 to -151 m"),
        ({"1 1 2 3": "1 1 2 2"}, "", "tube 2 already stands in foundation 1"),
    ],
    ids=["loose", "gap", "twice"],
)
def test_faults_of_the_tubes_of_a_foundation(tmp_path, changes, ties, told):
    text = BASE
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "case.deck"
    path.write_text(text.format(ties=ties, extra=""), encoding="utf-8")
    with pytest.raises(UserError, match=told):
        read_deck(path)


def test_the_database_of_combined_casings(tmp_path):
    """Each tube has its forces and stresses; depth by depth the outermost one is named."""
    ties = "*SLAVE\n1 2 CEMENTED -120 -140\n2 3 CEMENTED\n*TYPCONTACT\n1 2 2 0 0 0 GAP=0.02"
    database = solved(tmp_path, BASE.format(ties=ties, extra=""))
    data = database.foundation("F1")
    at = np.searchsorted(data.depth, [39.0, 39.9999995, 41.0, 49.0, 51.0, 55.0])
    assert data.tube[at].tolist() == [1, 1, 2, 2, 3, 3]
    assert {1e-6, 2e-6} & set(np.round(np.diff(data.depth), 9))  # both sides of a step
    assert data.tubes == (1, 2, 3)
    for igr, top, tip in ((1, -98.0, -140.0), (2, -97.0, -150.0), (3, -96.0, -155.0)):
        z = data.elevations[igr]
        assert (z[0], z[-1]) == (top, tip)
        force = data.read_tube(igr, "normal_force", -1)[0]
        moment = np.abs(data.read_tube(igr, "moment_y", -1)[0])
        stress = data.read_tube(igr, "stress", -1)[0]
        diameter, wall = {1: (0.762, 0.0254), 2: (0.508, 0.0127), 3: (0.244, 0.012)}[igr]
        inner = diameter - 2.0 * wall
        area = np.pi / 4.0 * (diameter**2 - inner**2)
        second = np.pi / 64.0 * (diameter**4 - inner**4)
        true = np.abs(force) / area + moment * diameter / 2.0 / second
        assert stress == pytest.approx(true, rel=1e-9)
    below_the_head = [
        np.interp(97.5, -data.elevations[igr], data.read_tube(igr, "shear_x", -1)[0])
        for igr in (2, 3)
    ]
    assert sum(below_the_head) == pytest.approx(200e3, rel=1e-6)


def test_curves_are_those_of_the_outermost_tube_at_the_depth(tmp_path, capsys):
    path = tmp_path / "case.deck"
    path.write_text(BASE.format(ties="", extra=""), encoding="utf-8")
    capacities = []
    for depth in ("39", "45", "54"):
        assert main(["curves", str(path), "--depth", depth, "--at", "10", "--csv"]) == 0
        rows = [row.split(",") for row in capsys.readouterr().out.splitlines()]
        capacities.append(float(next(row[2] for row in rows if row[0] == "py")))
    diameters = np.array([0.762, 0.508, 0.244])
    assert capacities == pytest.approx(9.0 * 40e3 * diameters, rel=1e-6)  # 9 su D at depth


def test_a_spudcan_stands_under_the_deepest_tube(tmp_path, capsys):
    path = tmp_path / "case.deck"
    for igr, code in (("1", 2), ("3", 0)):
        can = f"*SPUDCAN\n{igr} 4 0 40e6 0.5\n"
        path.write_text(BASE.format(ties="", extra=can), encoding="utf-8")
        assert main(["run", str(path), "-o", str(tmp_path), "--force"]) == code
    told = capsys.readouterr().err
    assert "the spudcan stands under tube 1, but another tube reaches deeper" in told


def test_tubes_that_do_not_fit_have_no_room_by_their_diameters(tmp_path, capsys):
    path = tmp_path / "case.deck"
    ties = "*SLAVE\n1 2 ENDS\n2 3 CEMENTED\n*TYPCONTACT\n1 2 2 GAP=-1"
    text = BASE.replace("0.762 0.0254", "0.52 0.0254").format(ties=ties, extra="")
    path.write_text(text, encoding="utf-8")
    assert main(["run", str(path), "-o", str(tmp_path)]) == 2
    assert "tube 2 of 0.508 m does not fit into tube 1, 0.4692 m inside" in capsys.readouterr().err
