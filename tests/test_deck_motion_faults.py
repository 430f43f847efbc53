"""Faults of the keywords of motion: each alone, in words, where it stands, with a remedy."""

from pathlib import Path

import pytest

from podeep.deck.read import read_deck
from podeep.errors import Fault, UserError

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
LAST = BASE.count("\n")  # lines above what is added before *EXEC, and one

# what is added, the line of it and the text that is to blame (empty: behind its end), the message
FAULTS = [
    ("*MASS\n1 -120 5", 2, "-120", "Z is -120 m, but tube 1 ends at -110 m"),
    ("*MASS\n1 -50 -5", 2, "-5", "M is -5, but must be at least 0"),
    ("*MASS\n1 -50 5 0 -1 0", 2, "-1", "JYY is -1, but must be at least 0"),
    ("*MASS\n1 -50", 2, "", "*MASS lacks M"),
    ("*MASS\n4 -50 5", 2, "4", "there is no tube 4"),
    ("*MASS", 1, "*MASS", "*MASS has no data"),
    ("*STIFFNESS\n1 -60 4 7 9", 2, "7", "a spring of 4 N/m and 9 N m/rad cannot have a coupling"),
    ("*STIFFNESS\n1 -60 4 1e300 9", 2, "1e300", "a spring of 4 N/m and 9 N m/rad cannot have a"),
    ("*STIFFNESS\n1 -60 -4 0 9", 2, "-4", "KXX is -4, but must be at least 0"),
    ("*STIFFNESS\n1 -60 4 0 -9", 2, "-9", "KRR is -9, but must be at least 0"),
    ("*STIFFNESS\n1 -50 4 0 9", 2, "-50", "Z is -50 m, but tube 1 stands from -110 to -58 m"),
    ("*STIFFNESS\n1 -60 4 0", 2, "", "*STIFFNESS lacks KRR"),
    ("*RADIATION\n9 4e5", 2, "9", "there is no p-y curve 9"),
    ("*RADIATION\n1 -4e5", 2, "-4e5", "C is -4e5, but must be at least 0"),
    (
        "*RADIATION\n1 4e5\n1 5e5",
        3,
        "1",
        f"p-y curve 1 has a dashpot already, at a.deck:{LAST + 1}",
    ),
    ("*INITIAL\n1 -58 X 0.05", 2, "", "*INITIAL lacks VELOCITY"),
    ("*INITIAL\n1 -58 RW 0 0", 2, "RW", "DOF 'RW' is unknown"),
    ("*INITIAL\n1 -50 X 0 0", 2, "-50", "Z is -50 m, but tube 1 stands from -110 to -58 m"),
    ("*INITIAL\n1 -58 X 0 1\n1 -58 x 1 0", 3, "x", "X of tube 1 at -58 m starts twice, first at"),
    ("*INITIAL\n1 -58 RZ 0 1", 2, "RZ", "RZ of tube 1 at -58 m is held by *SUPPORT at"),
    ("*INITIAL\n1 -60 Y 0 1", 2, "Y", "Y of tube 1 at -60 m is moved by *DISPLACE at"),
    ("*HARMONIC\nSTORM 0 90", 2, "0", "PERIOD is 0, but must be above 0"),
    ("*HARMONIC\nSTORM 9 90 -1", 2, "-1", "RAMP is -1, but must be at least 0"),
    ("*HARMONIC\nSTORM 9", 2, "", "*HARMONIC lacks PHASE"),
    ("*HARMONIC\nSTROM 9 90", 2, "STROM", "there is no load or displacement named STROM"),
    ("*HARMONIC\nPUSH 9 90\npush 8 0", 3, "push", "push has a history already, at a.deck"),
    ("*HARMONIC, STORM\nPUSH 9 0", 1, "STORM", "*HARMONIC has no option 'STORM'"),
    ("*DAMPING\n0.01 0.2", 2, "", "*DAMPING lacks F2"),
    ("*DAMPING\n2 1 2", 2, "2", "RATIO is 2, but must be 0 to 1"),
    ("*DAMPING\n0.01 0 2", 2, "0", "F1 is 0, but must be 1e-06 to 1e+06"),
    ("*DAMPING\n0.01 1 2 BETA=1", 2, "BETA=1", "BETA has no effect here (a ratio at two"),
    ("*DAMPING ALPHA=-1", 1, "ALPHA=-1", "ALPHA is -1, but must be at least 0"),
    ("*DAMPING ALPHA=1 GAMMA=2", 1, "GAMMA=2", "*DAMPING has no GAMMA here"),
    ("*DAMPING", 1, "*DAMPING", "*DAMPING has no data"),
    ("*DYNAMIC\n0", 2, "", "*DYNAMIC lacks TFIN"),
    ("*DYNAMIC\n-1 60", 2, "-1", "TINI is -1, but must be at least 0"),
    ("*DYNAMIC\n60 60", 2, "60", "motion from 60 to 60 s does not go forward"),
    ("*DYNAMIC\n0 60 61", 2, "61", "a step of 61 s does not fit in 60 s"),
    ("*DYNAMIC\n0 60 -1", 2, "-1", "DT is -1, but must be at least 0"),
    ("*DYNAMIC\n0 60 0 3", 2, "3", "INTEG is 3, but must be 7"),
    ("*DYNAMIC\n0 60 0 7 5", 2, "5", "IOPDYN is 5, but must be one of 0, 1, 2, 3, 4"),
    ("*DYNAMIC\n0 60 METHOD=HTT", 2, "METHOD=HTT", "METHOD 'HTT' is unknown"),
    ("*DYNIMP\n0", 2, "0", "ITEMAX is 0, but must be 1 to 100000"),
    ("*DYNIMP\n30 0.4", 2, "0.4", "DELTA is 0.4, but must be 0.5 to 1"),
    ("*DYNIMP\n30 0.5 0", 2, "0", "ALPHA is 0, but must be above 0 and at most 1"),
    ("*DYNIMP\n30 0.5 0.25 2", 2, "2", "IOPTDT is 2, but must be one of 0, 1"),
    ("*DYNIMP\n30 0.5 0.25 1 0", 2, "0", "ITMIN is 0, but must be 1 to 100000"),
    ("*NEWTONDYN\n30 0", 2, "0", "PMAXD1 is 0, but must be above 0 and at most 1"),
    ("*NEWTONDYN\n30 1 1 1 1 2", 2, "2", "IKRIG is 2, but must be one of -1, 0"),
    ("*NEWTONDYN\n30 1 1 1 1 0 -2", 2, "-2", "IKDIV is -2, but must be 0 to 100000"),
    ("*NEWTONDYN\nIKDIV=2", 2, "", "*NEWTONDYN lacks ITEMAX"),
    ("*DTREC\n0", 2, "0", "DT is 0, but must be above 0"),
    ("*DTREC\n1\n*DTREC\n1", 3, "*DTREC", "*DTREC stands twice, first at"),
    ("*DTREC\n1\n2", 3, "2", "*DTREC takes one line"),
]


def faults_of(folder: Path, text: str) -> tuple[Fault, ...]:
    path = folder / "a.deck"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UserError) as caught:
        read_deck(path)
    return caught.value.faults


@pytest.mark.parametrize(("more", "line", "blamed", "message"), FAULTS, ids=lambda v: str(v)[:40])
def test_one_fault_alone(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    more: str,
    line: int,
    blamed: str,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (found,) = faults_of(Path(), BASE.replace("*EXEC", f"{more}\n*EXEC"))
    assert found.message.startswith(message)
    assert found.remedy
    place = found.place
    assert place is not None
    assert place.line == LAST - 1 + line
    start = place.column - 1
    if blamed:
        assert place.text[start : start + place.width].upper() == blamed.upper()
    else:
        assert start == len(place.text)


def test_a_fault_of_model(tmp_path: Path) -> None:
    (found,) = faults_of(tmp_path, BASE.replace("ELEMENTS=20", "HYSTERESIS=MASSING"))
    assert found.message == "HYSTERESIS 'MASSING' is unknown"
    assert found.remedy == "did you mean MASING?"


def test_what_only_follows_from_a_fault_is_not_told(tmp_path: Path) -> None:
    """A load at fault still has its name; a tube at fault still takes its mass; no run, no note."""
    text = BASE.replace("STORM 1 -58 2.2e6", "STORM 1 -58 x2.2e6").replace("2.134 0.070", "2 1.1")
    more = "*HARMONIC\nSTORM 12 0\n*MASS\n1 -50 5\n*DYNAMIC\n0 x\n*DTREC\n1\n*EXEC"
    first, second, third = faults_of(tmp_path, text.replace("*EXEC", more))
    assert "a wall of 1.1 m does not fit" in first.message
    assert "FX is 'x2.2e6'" in second.message
    assert "TFIN is 'x'" in third.message


def test_a_name_that_cannot_be_read_makes_no_other_unknown(tmp_path: Path) -> None:
    text = BASE.replace("PUSH 1 -60", "5 1 -60").replace(" PUSH 1", "")
    (found,) = faults_of(tmp_path, text.replace("*EXEC", "*HARMONIC\nPUSH 12 0\n*EXEC"))
    assert "NAME is '5'" in found.message


def test_nothing_stands_on_a_tube_without_foundation(tmp_path: Path) -> None:
    more = "*CASING\n2\n0 -100 1 0.1 1e9 0\n*MASS\n2 0 5\n*STIFFNESS\n2 0 1 0 1\n*EXEC"
    found = faults_of(tmp_path, BASE.replace("*EXEC", more))
    assert [f.message for f in found] == ["tube 2 stands in no *FONDATION"] * 2


def test_a_mass_or_a_spring_at_fault_hides_no_lack_of_axial_support(tmp_path: Path) -> None:
    text = BASE.replace("1 1 2 1 3 2 3 2", "1 0 2 0 3 0 3 0").replace("1 -110 Z", "1 -110 X")
    more = "*MASS\n1 -120 1\n*STIFFNESS\n1 -60 1 2 1\n*EXEC"
    messages = [f.message for f in faults_of(tmp_path, text.replace("*EXEC", more))]
    assert len(messages) == 3
    assert any("nothing holds foundation 1 along z" in m for m in messages)
