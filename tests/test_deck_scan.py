"""From files to paragraphs: comments, joins, includes, encodings, and garbage."""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from podeep.deck.read import read_deck
from podeep.errors import UserError

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
LINES = (
    (Path(__file__).parent / "data" / "decks" / "line.deck")
    .read_text(encoding="utf-8")
    .replace(
        "*EXEC",
        "*SUCTION\n1 CU=5e3\n*MOTION\n11 2\nX 5\nZ 1 9\n*MOTION\n11 1 X Z\n0 0 0\n9 1 1\n*EXEC",
    )
)
KEYWORDS = """*TITLE *DEPTH *GROUNDEPTH *PYCURVE *TZCURVE *GROUNDPROP *CASING *FONDATION *SUPPORT
*SPRING *LOAD *DISPLACE *QUASISTATIC *NEWTONSTAT *ACCURACY *MODEL *INCLUDE *EXEC *STOP *LINE
*END *MOTION *SUCTION *MASS *STIFFNESS *RADIATION *INITIAL *HARMONIC *TIMESERIES *DAMPING
*DYNAMIC *DYNIMP *NEWTONDYN *DTREC *TYPCONTACT *SOILSTIFF *FOO""".split()


def write(folder: Path, text: str | bytes, name: str = "a.deck") -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def refused(path: Path) -> str:
    with pytest.raises(UserError) as caught:
        read_deck(path)
    return str(caught.value)


def title(folder: Path, text: str) -> str:
    deck = BASE.replace("*TITLE\nPile in two layers\n", text)
    return read_deck(write(folder, deck)).scene.title


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("*TITLE\n  C: 5 & 6! \n", "C: 5 & 6!"),
        ("*title Pile, one\n", "Pile, one"),
        ("*TITLE ! here it comes\n** two **\n", "** two **"),
        ("*TITLE\n\n", None),
        ("", ""),
    ],
)
def test_title_is_raw(tmp_path: Path, text: str, expected: str | None) -> None:
    if expected is None:
        assert "*TITLE has no text" in refused(
            write(tmp_path, BASE.replace("Pile in two layers", ""))
        )
    else:
        assert title(tmp_path, text) == expected


@pytest.mark.parametrize(
    "change",
    [
        lambda t: t.replace("\n", "\r\n"),
        lambda t: "\ufeff" + t,
        lambda t: t.replace(" ", "\t"),
        lambda t: t.replace("\n*", "\n\n  \nC note\ncNote 5\n*"),
        lambda t: t.replace("*DEPTH\n", "*depth "),
        lambda t: t.replace("\n-60\n", "\n-60 ! & no join\n"),
        lambda t: t.replace("1 1 2 1 3", "1 1 & what stands here is no data\nC nor this\n2 1 3"),
        lambda t: t.replace("1 1 2 1 3", "1 1\n2 1\n3"),
        lambda t: t.replace("200 0.02", "2D2 2.0d-2"),
        lambda t: t.rstrip("\n"),
    ],
    ids="crlf bom tabs comments same_line bang join lines fortran no_newline".split(),
)
def test_form_does_not_matter(tmp_path: Path, change: Callable[[str], str]) -> None:
    plain = read_deck(write(tmp_path, BASE, "plain.deck")).scene
    found = read_deck(write(tmp_path, change(BASE))).scene
    assert found.ground == plain.ground
    assert found.tubes == plain.tubes
    assert (found.loads, found.steps, found.newton) == (plain.loads, plain.steps, plain.newton)


def test_a_name_at_the_start_is_no_comment(tmp_path: Path) -> None:
    text = BASE.replace("7850 0.29 EI=30e9", "7850 0.29 & \nCA=1.5")
    (tube,) = read_deck(write(tmp_path, text)).scene.tubes.values()
    assert tube.sections[1].added_mass_coefficient == 1.5


def test_include(tmp_path: Path) -> None:
    head, tail = BASE.split("*TZCURVE\n", 1)
    (tmp_path / "sub").mkdir()
    write(tmp_path / "sub", "*INCLUDE ,  FILE = ../t z.inc ! curves\n", "b.inc")
    axial, rest = ("*TZCURVE\n" + tail).split("*GROUNDPROP", 1)
    write(tmp_path, axial, "t z.inc")
    deck = read_deck(write(tmp_path, f"{head}*include, file=sub/b.inc\n*GROUNDPROP{rest}"))
    assert deck.scene == read_deck(write(tmp_path, BASE)).scene
    again = read_deck(write(tmp_path, deck.text, "again.deck"))
    assert again.scene == deck.scene
    assert again.text == deck.text


def test_a_fault_in_an_included_file_is_placed_there(tmp_path: Path) -> None:
    write(tmp_path, "*PYCURVE\n5 2 1e4 99 1e6\n", "b.inc")
    message = refused(write(tmp_path, BASE.replace("*LOAD", "*INCLUDE, file=b.inc\n*LOAD")))
    assert message.startswith(f"{tmp_path / 'b.inc'}:2:9: PHI is 99")


def test_include_cycle_tells_the_chain(tmp_path: Path) -> None:
    write(tmp_path, "*INCLUDE, file=./a.deck\n", "b.inc")
    message = refused(write(tmp_path, BASE.replace("*LOAD", "*INCLUDE, file=b.inc\n*LOAD")))
    a, b = tmp_path / "a.deck", tmp_path / "b.inc"
    assert f"{b}:1:16: the file includes itself: {a} -> {b} -> {a}; take one" in message


def test_a_file_may_be_included_twice(tmp_path: Path) -> None:
    write(tmp_path, "C nothing\n", "b.inc")
    text = BASE.replace("*LOAD", "*INCLUDE, file=b.inc\n*INCLUDE, file=b.inc\n*LOAD")
    assert read_deck(write(tmp_path, text)).solve


def test_data_behind_an_include_need_a_keyword(tmp_path: Path) -> None:
    write(tmp_path, "5 6\n7\n", "b.inc")
    message = refused(write(tmp_path, BASE.replace("*LOAD", "*INCLUDE, file=b.inc\n*LOAD")))
    assert message.count("these data stand under no keyword") == 1


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    assert "no such file or directory" in refused(tmp_path / "none.deck")
    assert "it is a directory" in refused(tmp_path)
    assert "line 2 holds the byte 0xe9, which is not UTF-8" in refused(
        write(tmp_path, b"*TITLE\ncaf\xe9\n")
    )
    assert "no regular file" in refused(Path("/dev/null"))
    assert "no file can have this name" in refused(Path("a\0b"))
    assert "has no keyword" in refused(write(tmp_path, ""))


VALUES = """1 2 0 -9 1e8 2,5 nan 1.5D6 & ! C , = , LOADS SHAPE=WSD J= =3 X RZ -58
STORM file=a.deck ALPHA=1""".split()
words = st.sampled_from([*KEYWORDS, *VALUES]) | st.text(max_size=6)
garbage = st.lists(st.lists(words, max_size=7).map(" ".join), max_size=25).map("\n".join)


@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(text=garbage)
def test_garbage_is_refused_in_words(tmp_path: Path, text: str) -> None:
    path = write(tmp_path, text.encode("utf-8", "surrogatepass"))
    with suppress(UserError):
        scene = read_deck(path).scene
        assert scene.foundations or scene.lines


@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_a_damaged_deck_is_read_or_refused(tmp_path: Path, data: st.DataObject) -> None:
    lines = data.draw(st.sampled_from([BASE, LINES])).splitlines()
    for _ in range(data.draw(st.integers(1, 4))):
        fields = lines[at := data.draw(st.integers(0, len(lines) - 1))].split(" ")
        fields[data.draw(st.integers(0, len(fields) - 1))] = data.draw(words)
        lines[at] = " ".join(fields)
    path = write(tmp_path, "\n".join(lines).encode("utf-8", "surrogatepass"))
    with suppress(UserError):
        scene = read_deck(path).scene
        assert scene.foundations or scene.lines
