"""*TIMESERIES: rows in a file or in the deck, kept with the deck, and their faults."""

from pathlib import Path

import pytest

from podeep.deck.read import Deck, read_deck
from podeep.errors import UserError
from podeep.motion import TimeSeries

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
RECORD = "C quay wall\n! t  factor\n  0  0 ! at rest\n\n2.5\t1.5D0\n10 -1 &\nC joined\n\n"
SERIES = TimeSeries("STORM", (0.0, 2.5, 10.0), (0.0, 1.5, -1.0))


def write(folder: Path, more: str, **files: str) -> Path:
    """A deck with more keywords before its end, and the files beside it."""
    for name, text in files.items():
        (folder / f"{name}.txt").write_bytes(text.encode())
    path = folder / "a.deck"
    path.write_text(BASE.replace("*EXEC", f"*DYNAMIC\n0 60\n{more}\n*EXEC"), encoding="utf-8")
    return path


def read(folder: Path, more: str, **files: str) -> Deck:
    return read_deck(write(folder, more, **files))


def refused(folder: Path, more: str, **files: str) -> list[str]:
    """The first line of each fault, with file names without their folder."""
    with pytest.raises(UserError) as caught:
        read_deck(write(folder, more, **files))
    return [str(f).splitlines()[0].replace(f"{folder}/", "") for f in caught.value.faults]


LINE = BASE.count("\n") + 2  # of the deck's first line of what is added


@pytest.mark.parametrize(
    "more",
    [
        "*TIMESERIES STORM, file=q.txt",
        "*timeseries storm ,FILE = q.txt ! as measured",
        "*TIMESERIES\nSTORM, file=q.txt",
        "*TIMESERIES\n  STORM file=./q.txt",
        "*TIMESERIES\nSTORM,file=q.txt!measured",
        "*TIMESERIES STORM\n0 0\n2.5 1.5\n10 -1",
        "*TIMESERIES\nSTORM\n0 0\nC a comment, file=z.txt\n2.5 1.5 ! , file=z.txt\n10 -1",
    ],
)
def test_the_same_series_in_every_form(tmp_path: Path, more: str) -> None:
    scene = read(tmp_path, more, q=RECORD).scene
    assert scene.series == (SERIES,)
    assert scene.harmonics == ()


@pytest.mark.parametrize("form", [lambda t: t.replace("\n", "\r\n"), lambda t: "\ufeff" + t])
def test_form_of_the_file_does_not_matter(tmp_path: Path, form: object) -> None:
    assert callable(form)
    assert read(tmp_path, "*TIMESERIES STORM, file=q.txt", q=form(RECORD)).scene.series == (SERIES,)


def test_several_series(tmp_path: Path) -> None:
    more = "*TIMESERIES\nSTORM, file=q.txt\nPUSH\n0 7\n*TIMESERIES WEIGHT, file=q.txt"
    storm, push, weight = read(tmp_path, more, q=RECORD).scene.series
    assert storm == SERIES
    assert push == TimeSeries("PUSH", (0.0,), (7.0,))
    assert (weight.name, weight.times, weight.factors) == ("WEIGHT", SERIES.times, SERIES.factors)


def test_the_stored_deck_needs_no_file(tmp_path: Path) -> None:
    more = "*TIMESERIES STORM, file=q.txt ! measured\n*TIMESERIES\nPUSH, file=p.txt"
    deck = read(tmp_path, more, q=RECORD, p="-1 0\n3 1")
    assert f"\n*TIMESERIES STORM !, file=q.txt ! measured\n{RECORD}*TIMESERIES\n" in deck.text
    assert "\nPUSH !, file=p.txt\n-1 0\n3 1\n*EXEC\n" in deck.text
    for file in tmp_path.iterdir():
        file.unlink()
    again = tmp_path / "again.deck"
    again.write_text(deck.text, encoding="utf-8")
    assert read_deck(again).scene == deck.scene
    assert read_deck(again).text == deck.text


def test_the_file_is_relative_to_the_one_that_names_it(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "b.inc").write_text("*TIMESERIES STORM, file=q s.txt\n", encoding="utf-8")
    (tmp_path / "sub" / "q s.txt").write_text(RECORD, encoding="utf-8")
    assert read(tmp_path, "*INCLUDE, file=sub/b.inc").scene.series == (SERIES,)


def test_a_paragraph_that_begins_in_an_included_file_goes_on(tmp_path: Path) -> None:
    (tmp_path / "b.inc").write_text("*TIMESERIES\n", encoding="utf-8")
    more = "*INCLUDE, file=b.inc\nSTORM, file=q.txt"
    assert read(tmp_path, more, q=RECORD).scene.series == (SERIES,)


@pytest.mark.parametrize(
    ("record", "where", "message"),
    [
        ("t factor\n0 1", "1:1", "T is 't', not a number; T is the time, rising"),
        ("0 1\n1 x", "2:3", "FACTOR is 'x', not a number; FACTOR is the factor of the load"),
        ("0 1\n0,5 1", "2:1", "0,5 has a decimal comma; write 0.5"),
        ("0 1\n1 2 3", "2:5", "a value too many for *TIMESERIES; the line is T FACTOR"),
        ("0 1\n\n  1", "3:4", "*TIMESERIES lacks FACTOR; the line is T FACTOR"),
        ("0 1\n1 nan", "2:3", "FACTOR is nan, but must be finite"),
        ("C t\n1 1\n1 2", "3:1", "time 1 s does not come after 1 s; times rise from line to line"),
        ("1 1\n0 2\n2 2\n1 1", "2:1", "time 0 s does not come after 1 s"),
        ("0 1\n*EXEC\n", "2:6", "*TIMESERIES lacks FACTOR; the line is T FACTOR"),
        ("0 1\n*LOAD 1\n", "2:1", "T is '*LOAD', not a number"),
        ("0 1\nPUSH, file=q.txt", "2:1", "commas in 'PUSH,'; separate values by blanks"),
        ("0 1\n1 2 &", "2:5", "& joins the next line, but a keyword follows; take & out"),
    ],
)
def test_a_fault_in_the_file_stands_there(
    tmp_path: Path, record: str, where: str, message: str
) -> None:
    found, *others = refused(tmp_path, "*TIMESERIES STORM, file=q.txt", q=record)
    assert found.startswith(f"q.txt:{where}: {message}")
    assert all(o.startswith(f"q.txt:{where.partition(':')[0]}:") for o in others)


def test_every_row_at_fault_is_told(tmp_path: Path) -> None:
    record = "0 x\n1 1\n2\n" + "3 y\n" * 30
    *told, more = refused(tmp_path, "*TIMESERIES STORM, file=q.txt", q=record)
    assert told[0].startswith("q.txt:1:3: FACTOR is 'x'")
    assert told[1].startswith("q.txt:3:2: *TIMESERIES lacks FACTOR")
    assert [t.partition(": ")[0] for t in told[2:]] == [f"q.txt:{i}:3" for i in range(4, 22)]
    assert more == "and 12 more"


@pytest.mark.parametrize(
    ("more", "where", "message"),
    [
        ("*TIMESERIES STORM, file=no.txt", "0:25", "cannot read 'no.txt': no such file"),
        ("*TIMESERIES STORM, file=.", "0:25", "cannot read '.': it is a directory; name the data"),
        ("*TIMESERIES STORM, file=b.txt", "0:25", "cannot read 'b.txt': line 1 holds a null"),
        ("*TIMESERIES STORM, file=", "0:25", "*TIMESERIES names no file; write *TIMESERIES NAME"),
        ("*TIMESERIES STORM, file= ! q", "0:26", "*TIMESERIES names no file"),
        ("*TIMESERIES, file=q.txt", "0:14", "*TIMESERIES has no option 'FILE'; write *TIMESERIES"),
        ("*TIMESERIES\nfile=q.txt", "1:11", "*TIMESERIES lacks NAME; the line is NAME"),
        ("*TIMESERIES, STORM, file=q.txt", "0:14", "*TIMESERIES has no option 'STORM'"),
        ("*TIMESERIES", "0:1", "*TIMESERIES has no data; a line is NAME"),
        ("*TIMESERIES STORM", "0:13", "the series of STORM has no rows; rows are T FACTOR"),
        ("*TIMESERIES STORM, file=e.txt", "0:13", "the series of STORM has no rows"),
        ("*TIMESERIES\n0 1\n1 2", "1:1", "'0' stands before the name of a load"),
        ("*TIMESERIES STORM 0 1\n1 2", "0:19", "2 values too many for *TIMESERIES"),
        ("*TIMESERIES STROM, file=q.txt", "0:13", "there is no load or displacement named STROM"),
        ("*TIMESERIES STORM\n0 1\n0,5 1", "2:1", "0,5 has a decimal comma"),
        ("*TIMESERIES STORM\n0 1\n-inf 1", "2:1", "T is -inf, but must be finite"),
        ("*TIMESERIES STORM\n0 1\nSTORM\n0 1", "2:1", "STORM has a history already, at a.deck:"),
        ("*HARMONIC\nSTORM 9 0\n*TIMESERIES storm, file=q.txt", "2:13", "storm has a history"),
        ("*TIMESERIES STORM\n*INCLUDE, file=q.txt", "0:13", "the series of STORM has no rows"),
    ],
)
def test_one_fault_in_the_deck(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, more: str, where: str, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    found, *others = refused(Path(), more, q=RECORD, b="0 \0", e="C nothing\n")
    row, column = map(int, where.split(":"))
    assert found.startswith(f"a.deck:{LINE + row}:{column}: {message}")
    assert len(others) == more.count("*INCLUDE")  # the rows behind it stand under no keyword


def test_a_second_file_needs_a_name_of_its_own(tmp_path: Path) -> None:
    more = "*TIMESERIES\nPUSH, file=q.txt\n, file=q.txt"
    found = refused(tmp_path, more, q=RECORD)
    assert [f.partition(": ")[0] for f in found] == [f"a.deck:{LINE + 2}:{c}" for c in (1, 3)]
    assert "FILE has no effect here" in found[1]


def test_a_lost_file_hides_no_other_fault(tmp_path: Path) -> None:
    lost, missing = refused(tmp_path, "*TIMESERIES STORM, file=no.txt\n*HARMONIC\nNONE 9 0")
    assert "cannot read" in lost
    assert "there is no load or displacement named NONE" in missing


def test_other_keywords_have_no_files(tmp_path: Path) -> None:
    (found,) = refused(tmp_path, "*DTREC\n1 file=q.txt", q="2 2")
    assert "*DTREC has no FILE here" in found


def test_a_title_is_no_file(tmp_path: Path) -> None:
    deck = write(tmp_path, "")
    text = deck.read_text(encoding="utf-8").replace("Pile in two layers", "Pile, file=q.txt")
    deck.write_text(text, encoding="utf-8")
    assert read_deck(deck).scene.title == "Pile, file=q.txt"
