"""Faults of the keywords of lines: each alone, in words, where it stands, with a remedy."""

from pathlib import Path

import pytest

from podeep.deck.read import read_deck
from podeep.errors import Fault, UserError

DECKS = Path(__file__).parent / "data" / "decks"
LINE = (DECKS / "line.deck").read_text(encoding="utf-8")
PILE = (DECKS / "base.deck").read_text(encoding="utf-8")
LAST = LINE.count("\n")  # lines above what is added before *EXEC, and one

FIRST = "1400 0.3 0.02 200e9 8000 100"
FOOT = "11 1 -10 0 -1000 X Y Z RX RY RZ"
TOP = "11 2 991 5 0 X Y Z"
CONTACT = "0 11 3 0.3 0.6 5e4"

# a line of the deck, what stands in its place, the text of it that is to blame, the message
CHANGED = [
    (FIRST, "1400 0.3 0.2 200e9 8000", "0.2", "a wall of 0.2 m does not fit in an outer diameter"),
    (FIRST, "0 0.3 0.02 200e9 8000", "0", "LENGTH is 0, but must be 0.001 to 1e+08"),
    (FIRST, "1400 0.3 0.02 -200e9 8000", "-200e9", "E is -200e9, but must be 1 to 1e+15"),
    (FIRST, "1400 0.3 0.02 200e9", "", "*LINE lacks RHO"),
    (FIRST, f"{FIRST[:-3]}2.7", "2.7", "NEL is 2.7, but must be a whole number"),
    (FIRST, f"{FIRST[:-3]}-3", "-3", "NEL is -3, but must be 0 to 100000"),
    (FIRST, f"{FIRST} 7", "7", "a value too many for *LINE"),
    (FIRST, f"{FIRST} EI=0", "EI=0", "EI is 0, but must be 1e-09 to 1e+25"),
    (FIRST, f"{FIRST} FILL=-1", "FILL=-1", "FILL is -1, but must be 0 to 1e+06"),
    (FIRST, f"{FIRST} GAS=1", "GAS=1", "*LINE has no GAS here"),
    ("*LINE", "*LINE, EI=3", "EI=3", "*LINE has no options"),
    ("11 RISER", "0 RISER", "0", "IGR is 0, but must be 1 to 999999"),
    (TOP, "11 3 991 5 0 X Y Z", "3", "END is 3, but must be one of 1, 2"),
    (TOP, "11 2 991 5 0", "", "*END lacks DOF"),
    (TOP, "11 2 991 5 X Y Z", "X", "Z is 'X', not a number"),
    (TOP, "11 2 991 5 0 X Y W", "W", "DOF 'W' is unknown"),
    (TOP, "12 2 991 5 0 X Y Z", "12", "there is no line 12"),
    (TOP, "11 1 991 5 0 X Y Z", "1", "end 1 of line 11 is given twice, first at a.deck:13"),
    (TOP, f"{TOP} RX", "RX", "RX of a line's end is held alone"),
    (TOP, f"{TOP} RZ RY", "RZ", "RZ RY of a line's end are held alone"),
    (TOP, f"{TOP} FREE", "FREE", "FREE stands beside what is held"),
    (TOP, f"{TOP} DY=1", "DY=1", "DY has no effect on an end whose direction is not held"),
    (TOP, f"{TOP} RX RY RZ DY=0", "DY=0", "a direction of length 0"),
    (FOOT, FOOT.replace("-10 0 ", "991 5 "), "RX", "the ends stand above each other"),
    (FOOT, FOOT.replace(" -1000", ""), "X", "Z is 'X', not a number"),
    (CONTACT, "0 12 3 0.3 0.6 5e4", "12", "there is no line 12"),
    (CONTACT, "1 11 3 0.3 0.6 5e4", "1", "IGR1 is 1, but must be 0"),
    (CONTACT, "0 11 1 0.3 0.6 5e4", "1", "ITYP12 is 1: lines on lines are not read"),
    (CONTACT, "0 11 7 0.3 0.6 5e4", "7", "ITYP12 is 7: such a contact is not read"),
    (CONTACT, "0 11 ITYP12=0", "ITYP12=0", "ITYP12 is 0: such a contact is not read"),
    (CONTACT, "0 11 3 0.3 0.6", "0", "the seabed under line 11 has no stiffness"),
    (CONTACT, "0 11 3 0.3 0.6 0", "0", "the seabed under line 11 has no stiffness"),
    (CONTACT, "0 11 3 0.3 -0.6 5e4", "-0.6", "MU3 is -0.6, but must be 0 to 1e+06"),
    (CONTACT, "0 11 3 0.3 0.6 5e4 -1", "-1", "XSEUIL2 is -1, but must be 0 to 1e+06"),
    (CONTACT, "0 11 3 0.3 0.6 5e4 0 0 0", "0", "DENSITY is 0, but must be 1e-06 to 1e+06"),
    (CONTACT, f"{CONTACT} ID1=4", "ID1=4", "there is no soil stiffness 4"),
    (CONTACT, f"{CONTACT} ID2=4", "ID2=4", "there is no suction 4"),
    *(
        (CONTACT, f"{CONTACT} {name}=2", f"{name}=2", f"{name} is 2, but must be {rule}")
        for name, rule in (
            *((name, "0") for name in ("L_MINI", "FRICTMOM", "IDSTIFFAMP", "IDTREN", "XMUO")),
            *((name, "0") for name in ("IDFAX", "IDFLAT", "INOR", "ISHELTER")),
            ("RADRATIO", "one of 0, 0.2"),
        )
    ),
    (CONTACT, f"{CONTACT} GAP=0.1", "GAP=0.1", "GAP has no effect here (a line on the seabed)"),
    (CONTACT, f"{CONTACT} SURFACE=DISC", "SURFACE=DISC", "SURFACE 'DISC' is unknown"),
    (CONTACT, f"{CONTACT} FORM=LUMPED", "FORM=LUMPED", "FORM 'LUMPED' is unknown"),
    (CONTACT, f"{CONTACT}\n{CONTACT}", "11", "line 11 lies on the seabed already, at a.deck:16"),
]

# what is added, the line of it and the text that is to blame (empty: behind its end), the message
ADDED = [
    ("*LINE\n11\n1 0.3 0.02 2e11 8000", 2, "11", "line 11 is defined twice, first at a.deck:9"),
    ("*LINE", 1, "*LINE", "*LINE has no data"),
    ("*SUCTION\n1", 2, "1", "suction 1 has no ALPHAF and no CU"),
    ("*SUCTION\n1 900 CU=5e3", 2, "CU=5e3", "suction 1 has both ALPHAF and CU"),
    ("*SUCTION\n1 900 1.2", 2, "1.2", "NF is 1.2, but must be 0 to 1"),
    ("*SUCTION\n1 900 0.2 0 0.2 0.5 0.4", 2, "0.5", "a cut-off x_c1 of 0.5"),
    ("*SUCTION\n1 900 XC2=0.96", 2, "XC2=0.96", "XC2 is 0.96, but must be 1e-06 to 0.95"),
    ("*SUCTION\n1 900 TRAVEL=3", 2, "TRAVEL=3", "suction 1 has one of the two numbers of wear"),
    ("*SUCTION\n1 900 REMAIN=0.3", 2, "REMAIN=0.3", "suction 1 has one of the two numbers of wear"),
    ("*SUCTION\n1 900\n1 800", 3, "1", "suction 1 is defined twice, first at a.deck"),
    ("*SUCTION\n1 CU=0", 2, "CU=0", "CU is 0, but must be 1 to 1e+08"),
    ("*TYPCONTACT", 1, "*TYPCONTACT", "*TYPCONTACT has no data"),
    ("*MOTION", 1, "*MOTION", "*MOTION has no data"),
    ("*MOTION, file=m.txt", 1, "file=m.txt", "*MOTION has no option 'FILE'"),
    ("*MOTION\n11 2", 2, "11", "nothing is said of how it moves"),
    ("*MOTION\n11 2 X", 2, "11", "a record has no rows"),
    ("*MOTION\n11 2 X, file=", 2, "", "*MOTION names no file"),
    ("*MOTION\n11 2 X, file=none.txt", 2, "none.txt", "cannot read 'none.txt': no such file"),
    ("*MOTION\n12 2\nX 5", 2, "12", "there is no line 12"),
    ("*MOTION\n11 3\nX 5", 2, "3", "END is 3, but must be one of 1, 2"),
    ("*MOTION\n11\nX 5", 2, "", "*MOTION lacks END"),
    ("*MOTION\n11 3\nX 5\n*QUASISTATIC\n1 L11E3 1", 2, "3", "END is 3, but must be one of 1, 2"),
    ("*MOTION\n11 2\n5 X", 3, "5", "'5' stands where a degree of freedom is expected"),
    ("*MOTION\n11 2\n0 1\n9 2", 3, "0", "'0' stands where a degree of freedom is expected"),
    ("*MOTION\n11 2\nX", 3, "", "*MOTION lacks VALUE"),
    ("*MOTION\n11 2\nX 5 0", 3, "0", "PERIOD is 0, but must be above 0"),
    ("*MOTION\n11 2\nX 5 9 0 -1", 3, "-1", "RAMP is -1, but must be at least 0"),
    ("*MOTION\n11 2\nX 5 PERIOD=-1", 3, "PERIOD=-1", "PERIOD is -1, but must be above 0"),
    ("*MOTION\n11 2\nRY 5", 3, "RY", "RY of end 2 of line 11 is moved, but not held"),
    ("*MOTION\n11 2\nX 5\nX 4", 4, "X", "X of this end has a displacement already, at a.deck"),
    ("*MOTION\n11 2 X NAME=A\n0 1", 2, "NAME=A", "NAME has no effect here"),
    ("*MOTION\n11 2 X W\n0 1 2", 2, "W", "DOF 'W' is unknown"),
    ("*MOTION\n11 2 X x\n0 1 2", 2, "x", "X of this end has a record already, at a.deck"),
    ("*MOTION\n11 2 RX\n0 1", 2, "RX", "RX of end 2 of line 11 is moved, but not held"),
    ("*MOTION\n11 2 X\n0 1 2", 3, "0", "2 values in a row for 1 degrees of freedom"),
    ("*MOTION\n11 2 X\n0", 3, "", "*MOTION lacks VALUE"),
    ("*MOTION\n11 2 X\n0 1,5", 3, "1,5", "1,5 has a decimal comma"),
    ("*MOTION\n11 2 X\n0 1\n0 2", 4, "0", "time 0 s does not come after 0 s"),
    ("*MOTION\n11 2\nX 5\n*QUASISTATIC\n1 L11 1", 5, "L11", "there is no load or displacement na"),
    ("*LOAD\nA 11 -5 1 0 0", 2, "11", "there is no tube 11"),
    ("*SUPPORT\n1 -5 X", 2, "1", "there is no tube 1"),
]


def faults_of(folder: Path, text: str) -> tuple[Fault, ...]:
    path = folder / "a.deck"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UserError) as caught:
        read_deck(path)
    return caught.value.faults


def check(found: Fault, line: int, blamed: str, message: str) -> None:
    assert found.message.startswith(message)
    assert found.remedy
    place = found.place
    assert place is not None
    assert place.line == line
    start = place.column - 1
    if blamed:
        assert place.text[start : start + place.width].upper() == blamed.upper()
    else:
        assert start == len(place.text)


@pytest.mark.parametrize(("old", "new", "blamed", "message"), CHANGED, ids=lambda v: str(v)[:40])
def test_one_fault_of_a_line_alone(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    old: str,
    new: str,
    blamed: str,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert LINE.count(old) == 1
    found, *more = faults_of(Path(), LINE.replace(old, new))
    assert not more
    line = LINE[: LINE.index(old)].count("\n") + 1 + new.count("\n")
    check(found, line, blamed, message)


@pytest.mark.parametrize(("more", "line", "blamed", "message"), ADDED, ids=lambda v: str(v)[:40])
def test_one_fault_of_what_is_added(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    more: str,
    line: int,
    blamed: str,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (found,) = faults_of(Path(), LINE.replace("*EXEC", f"{more}\n*EXEC"))
    check(found, LAST - 1 + line, blamed, message)


def messages(folder: Path, text: str) -> list[str]:
    return [fault.message for fault in faults_of(folder, text)]


def test_an_end_that_is_missing(tmp_path: Path) -> None:
    (found,) = faults_of(tmp_path, LINE.replace(f"{TOP}\n", ""))
    assert found.message == "line 11 has no end 2"
    assert found.remedy == "add *END with the line 11 2 X Y Z and what is held"
    assert found.place is not None
    assert found.place.line == 9
    text = LINE.replace(f"*END\n{FOOT}\n{TOP}\n", "")
    assert messages(tmp_path, text) == ["line 11 has no end 1", "line 11 has no end 2"]


def test_a_line_has_sections(tmp_path: Path) -> None:
    start, end = LINE.index(FIRST), LINE.index("*END")
    assert messages(tmp_path, LINE[:start] + LINE[end:]) == ["*LINE has no sections"]


@pytest.mark.parametrize(
    ("top", "contact", "what"),
    [
        ("11 2 991 5 0 Y Z", None, "no end and no friction holds line 11 along X"),
        ("11 2 991 5 0 X Z", "0 11 3 0.3 0 5e4", "no end and no friction holds line 11 along Y"),
        ("11 2 991 5 0 X Y", None, "no end and no seabed holds line 11 along Z"),
    ],
)
def test_a_line_that_nothing_holds(
    tmp_path: Path, top: str, contact: str | None, what: str
) -> None:
    text = LINE.replace(FOOT, "11 1 -10 0 -1000 FREE").replace(TOP, top)
    free = text.replace(f"*TYPCONTACT\n{CONTACT}\n", "") if contact is None else text
    (found,) = faults_of(tmp_path, free.replace(CONTACT, contact or CONTACT))
    assert found.message == what
    assert found.remedy.startswith(f"hold {what[-1]} in *END")
    path = tmp_path / "a.deck"
    path.write_text(text, encoding="utf-8")
    assert read_deck(path).scene.lines  # held by the seabed and its friction


def test_tubes_and_lines_share_their_numbers(tmp_path: Path) -> None:
    body = LINE[LINE.index("*LINE") : LINE.index("*EXEC")].replace("11", "1")
    (found,) = faults_of(tmp_path, PILE.replace("*EXEC", f"{body}*EXEC"))
    assert found.message.startswith("tube 1 has this number already, at ")


def test_each_kind_tells_of_the_other(tmp_path: Path) -> None:
    body = LINE[LINE.index("*LINE") : LINE.index("*EXEC")]
    more = body.replace(TOP, f"{TOP}\n1 1 0 0 0 X Y Z") + "*SUPPORT\n11 -58 X\n*EXEC"
    first, second = faults_of(tmp_path, PILE.replace("*EXEC", more))
    assert (first.message, first.remedy) == ("there is no line 1", "1 is a tube, of *CASING")
    assert second.message == "there is no tube 11"
    assert second.remedy == "11 is a line: *END holds it, *MOTION moves it"


def test_what_only_follows_from_a_fault_of_a_line_is_not_told(tmp_path: Path) -> None:
    """A line at fault is still there for its ends, contact, motion; so are suctions, names."""
    more = "*SUCTION\n3 x\n*MOTION\n11 2\nX y\n*QUASISTATIC\n1 L11E2 1\n*EXEC"
    text = LINE.replace(FIRST, "x 0.3 0.02 200e9 8000").replace("*EXEC", more)
    told = messages(tmp_path, text.replace(CONTACT, f"{CONTACT} ID2=3"))
    assert told == [
        "LENGTH is 'x', not a number",
        "ALPHAF is 'x', not a number",
        "VALUE is 'y', not a number",
    ]
    assert messages(tmp_path, LINE.replace(TOP, "11 2 x 5 0 X")) == ["X is 'x', not a number"]
    assert messages(tmp_path, LINE.replace("-1000\n*SEA", "x\n*SEA")) == ["Z is 'x', not a number"]
    free = LINE.replace(FOOT, "11 1 0 0 0 FREE").replace(TOP, "11 2 9 0 0 FREE")
    assert messages(tmp_path, free.replace(CONTACT, "0 11 3 x")) == ["MU2 is 'x', not a number"]
    assert messages(tmp_path, free.replace(CONTACT, "0 11 3 0.3 0.6")) == [
        "the seabed under line 11 has no stiffness"
    ]


def test_a_misspelt_line_lacks_nothing_of_foundations(tmp_path: Path) -> None:
    assert messages(tmp_path, LINE.replace("*LINE", "*LIEN")) == ["there is no keyword *LIEN"]
    told = messages(tmp_path, LINE.replace("*LINE", "*MOORLINE"))
    assert told == ["*MOORLINE is known, but not read by this version"]


def test_a_line_alone_needs_its_depth(tmp_path: Path) -> None:
    assert messages(tmp_path, LINE.replace("*DEPTH\n-1000\n", "")) == ["*DEPTH is missing"]


@pytest.mark.parametrize("more", ["*PYCURVE\n1 1 8e3 6e3 0.5 0.02", "*FONDATION\n1 1"])
def test_a_deck_with_something_of_foundations_needs_all_of_it(tmp_path: Path, more: str) -> None:
    told = messages(tmp_path, LINE.replace("*EXEC", f"{more}\n*EXEC"))
    missing = {f"*{name} is missing" for name in ("GROUNDEPTH", "GROUNDPROP", "CASING")}
    assert missing <= set(told)
    assert "*FONDATION is missing" in told or "*FONDATION" in more
