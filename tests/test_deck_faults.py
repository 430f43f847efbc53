"""Every fault of a deck is told in one go, where it stands, and nothing that only follows."""

from pathlib import Path

import pytest

from podeep.deck.read import read_deck
from podeep.errors import Fault, UserError

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")

# kind: what to replace in the base deck, by what, the faulty text, and the message
KINDS = {
    "decimal comma": ("8e3 6e3 0.5", "8e3 6,5e3 0.5", "6,5e3", "6,5e3 has a decimal comma"),
    "not a number": ("9.5e3 34 19", "9.5e3 x34 19", "x34", "PHI is 'x34', not a number"),
    "not a whole number": ("1 PILE", "1.5 PILE", "1.5", "IGR is 1.5, but must be a whole number"),
    "out of bounds": ("26e3 7e3 0.25", "26e3 7e3 0.9", "0.9", "J is 0.9, but must be 0.25 to 0.5"),
    "unknown keyword": ("*NEWTONSTAT", "*NEWTONSTATS", "*NEWTONSTATS", "no keyword *NEWTONSTATS"),
    "unread keyword": ("*ACCURACY", "*WAVE\n1\n*ACCURACY", "*WAVE", "*WAVE is known, but not read"),
    "unknown option": ("SHAPE=WSD", "SHAP=WSD", "SHAP=WSD", "*PYCURVE has no SHAP here"),
    "unknown choice": ("SHAPE=2GEO", "SHAPE=3GEO", "SHAPE=3GEO", "SHAPE '3GEO' is unknown"),
    "duplicate id": (
        "*TZCURVE\n",
        "*PYCURVE\n3 2 1e4 30 1e6\n*TZCURVE\n",
        "3",
        "3 is defined twice",
    ),
    "missing curve": ("1 1 2 1 3 2 3 2", "1 1 2 1 7 2 3 2", "7", "there is no p-y curve 7"),
    "missing load": ("3 STORM 1", "3 STROM 1", "STROM", "no load or displacement named STROM"),
    "missing tube": ("1 -110 Z", "4 -110 Z", "4", "there is no tube 4"),
    "unknown freedom": ("1 -58 RZ", "1 -58 RW", "RW", "DOF 'RW' is unknown"),
    "off the tube": ("PUSH 1 -60", "PUSH 1 -57", "-57", "Z is -57 m, but tube 1 stands from -110"),
    "rising depth": ("0 -9 -9 -58", "0 -9 -8 -58", "-8", "soil depth -8 m lies above"),
    "impossible wall": ("2.134 0.070", "2.134 1.10", "1.10", "a wall of 1.1 m does not fit"),
    "gap": ("-75 -110", "-76 -110", "-76", "a section starts at -76 m"),
    "too few values": ("-58 0 0 -12e6", "-58 0 0", "", "*LOAD lacks FZ"),
    "too many values": ("1 8e3 6e3\n", "1 8e3 6e3 0 5\n", "5", "a value too many for *TZCURVE"),
    "wrong count": ("1 1 2 1 3 2 3 2", "1 1 2 1 3 2 3", "", "*GROUNDPROP has 7 values for 4"),
    "step gap": ("3 STORM 1", "4 STORM 1", "4", "step 4 stands where step 3 is expected"),
    "keyword twice": (
        "*SUPPORT",
        "*DEPTH\n-3\n*SUPPORT",
        "*DEPTH",
        "*DEPTH stands twice, first at",
    ),
    "missing keyword": ("*DEPTH\n-60\n", "", "*EXEC", "*DEPTH is missing"),
    "no end": ("*EXEC\n", "", "*MODEL ELEMENTS=20 ORDER=5", "the deck has no end"),
    "after the end": ("*EXEC\n", "*EXEC\n*TITLE\nx\n", "*TITLE", "*EXEC ends the deck, but more"),
    "not finite": ("1e-4", "nan", "nan", "A is nan, but must be finite"),
    "too large": ("1 -58 2.2e6", "1 -58 2.2e999", "2.2e999", "FX is 2.2e999, too large a number"),
    "unknown IDRE": ("3 2 3 2", "3 2 3 2 1e8 4", "4", "IDRE is 4, but must be one of 0, 1, 2, 3"),
    "short tube": ("*FONDATION\n1 1", "*FONDATION\n1 1 -120", "1", "tube 1 ends at -110 m, not"),
    "no such tube": ("*FONDATION\n1 1", "*FONDATION\n1 1 2", "2", "there is no tube 2"),
    "held and moved": ("1 -58 RZ", "1 -60 Y", "Y", "Y of tube 1 at -60 m is held"),
    "lost include": ("*LOAD", "*INCLUDE, file=no.inc\n*LOAD", "no.inc", "no such file"),
    "indented": ("*ACCURACY", " *ACCURACY", "*ACCURACY", "*ACCURACY is indented"),
    "no data": ("*ACCURACY\n1e-4", "*ACCURACY", "*ACCURACY", "*ACCURACY has no data"),
    "no text": ("Pile in two layers\n", "", "*TITLE", "*TITLE has no text"),
    "no line after &": ("*EXEC", "*EXEC &", "&", "& joins the next line, but none follows"),
    "option with a comma": (
        "*MODEL ELEMENTS=20",
        "*MODEL SPATIAL, ELEMENTS=20",
        "SPATIAL,",
        "write options after commas: *MODEL, SPATIAL",
    ),
    "a value too many, with a comma": ("1e-4", "1e-4 1,5", "1,5", "commas in '1,5'"),
    "option in data": ("*MODEL ELEMENTS=20", "*MODEL LARGE", "LARGE", "LARGE of *MODEL is not"),
    "IKTSO as a curve": ("3 2 3 2\n", "3 2 1e8 0\n", "1e8", "looks like IKTSO"),
    "misspelt end": ("*EXEC", "*EXECUTE", "*EXECUTE", "there is no keyword *EXECUTE"),
    "misspelt tube": ("*CASING", "*CASSING", "*CASSING", "there is no keyword *CASSING"),
    "misspelt curve": ("*PYCURVE\n3", "*PYCRUVE\n3", "*PYCRUVE", "there is no keyword *PYCRUVE"),
    "misspelt load": ("*DISPLACE", "*DISPLCE", "*DISPLCE", "there is no keyword *DISPLCE"),
    "renumbered curve": ("*PYCURVE\n3", "*PYCURVE\n2", "2", "p-y curve 2 is defined twice"),
    "unreadable name": ("STORM 1 -58", "5 1 -58", "5", "NAME is '5', but must be a word"),
}

TOGETHER = (
    *("decimal comma", "not a whole number", "out of bounds", "unknown keyword", "unread keyword"),
    *("unknown choice", "duplicate id", "missing curve", "missing load", "missing tube"),
    *("unknown freedom", "off the tube", "impossible wall", "too few values", "not finite"),
    *("missing keyword", "rising depth", "after the end"),
)


def faults_of(folder: Path, text: str) -> tuple[Fault, ...]:
    path = folder / "a.deck"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UserError) as caught:
        read_deck(path)
    return caught.value.faults


def planted(text: str, kind: str) -> str:
    old, new, *_ = KINDS[kind]
    assert text.count(old) >= 1
    return text.replace(old, new, 1)


def check(found: Fault, kind: str) -> None:
    """A fault is the planted one, and its caret stands under the text that is to blame."""
    *_, blamed, message = KINDS[kind]
    assert message in found.message + found.remedy
    assert found.remedy
    assert found.place is not None
    start = found.place.column - 1
    if blamed:
        assert found.place.text[start : start + found.place.width] == blamed
    else:  # something is missing behind the last value
        assert found.place.text[start:].strip() == ""
        assert found.place.text[start - 1].strip() != ""
    assert str(found).endswith("^" * found.place.width)


@pytest.mark.parametrize("kind", KINDS)
def test_one_fault_alone(kind: str, tmp_path: Path) -> None:
    (found,) = faults_of(tmp_path, planted(BASE, kind))
    check(found, kind)


def test_all_kinds_in_one_go(tmp_path: Path) -> None:
    text = BASE
    for kind in TOGETHER:
        text = planted(text, kind)
    found = faults_of(tmp_path, text)
    assert len(found) == len(TOGETHER) == 18
    for kind in TOGETHER:
        message = KINDS[kind][3]
        (one,) = [f for f in found if message in f.message + f.remedy]
        check(one, kind)
    places = [(f.place.line, f.place.column) for f in found if f.place]
    assert places == sorted(places)


def test_twenty_are_told_and_the_rest_counted(tmp_path: Path) -> None:
    lines = "".join(f"1 -58 W{i}\n" for i in range(25))
    *told, more = faults_of(tmp_path, BASE.replace("*SPRING", lines + "*SPRING"))
    assert len(told) == 20
    assert str(more) == "and 5 more"


def test_a_foundation_needs_axial_support(tmp_path: Path) -> None:
    text = BASE.replace("1 1 2 1 3 2 3 2", "1 0 2 0 3 0 3 0").replace("1 -110 Z", "1 -110 X")
    (found,) = faults_of(tmp_path, text)
    assert "nothing holds foundation 1 along z" in found.message
    assert "*SUPPORT with the line 1 -110 Z" in found.remedy


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("1 1 2 1 3 2 3 2", "1 0 2 0 3 0 3 2"),  # friction in the last layer
        ("1 -110 X", "1 -110 Z"),
        ("1 -58 RZ", "1 -60 X Z"),
        ("PUSH 1 -60 Y", "PUSH 1 -60 Z"),
    ],
)
def test_what_gives_axial_support(tmp_path: Path, old: str, new: str) -> None:
    text = BASE.replace("1 1 2 1 3 2 3 2", "1 0 2 0 3 0 3 0").replace("1 -110 Z", "1 -110 X")
    text = (text if old in text else BASE.replace("1 -110 Z", "1 -110 X")).replace(old, new)
    path = tmp_path / "a.deck"
    path.write_text(text, encoding="utf-8")
    assert read_deck(path).solve


@pytest.mark.parametrize(
    ("rows", "held"),
    [
        ("0 0 0", False),
        ("0 1 0", True),
        ("0 0 1", True),
        ("1 0 8e3", False),
        ("2 0 8e3 30 0", False),
        ("2 0 8e3 30 9", True),
        ("0 1 0\n0 0.1 0 0.1", False),
        ("0 0 0\n0 0.1 9 0.1", True),
    ],
)
def test_a_curve_that_does_not_resist_is_no_support(tmp_path: Path, rows: str, held: bool) -> None:
    curve = f"*TZCURVE\n9 0\n{rows}\n*GROUNDPROP"
    text = BASE.replace("1 1 2 1 3 2 3 2", "1 9 2 9 3 9 3 9").replace("1 -110 Z", "1 -110 X")
    path = tmp_path / "a.deck"
    path.write_text(text.replace("*GROUNDPROP", curve), encoding="utf-8")
    if held:
        assert read_deck(path).solve
    else:
        with pytest.raises(UserError, match="nothing holds foundation 1 along z"):
            read_deck(path)


def test_a_curve_without_extent_is_no_support(tmp_path: Path) -> None:
    text = BASE.replace("0 -9 -9 -58", "0 0 -9 -58").replace("1 -110 Z", "1 -110 X")
    (found,) = faults_of(tmp_path, text.replace("1 1 2 1 3 2 3 2", "1 1 2 0 3 0 3 0"))
    assert "nothing holds foundation 1 along z" in found.message


def test_foundations_do_not_share(tmp_path: Path) -> None:
    first, second = faults_of(
        tmp_path, BASE.replace("*FONDATION\n1 1", "*FONDATION\n1 1\n1 1\n2 1")
    )
    assert "foundation 1 is defined twice, first at" in first.message
    assert "tube 1 already stands in foundation 1" in second.message


def test_nothing_acts_on_a_tube_without_foundation(tmp_path: Path) -> None:
    more = "*CASING\n2\n0 -100 1 0.1 1e9 0\n*LOAD\nX 2 0 1 0 0\n*EXEC"
    (found,) = faults_of(tmp_path, BASE.replace("*EXEC", more))
    assert found.message == "tube 2 stands in no *FONDATION"
