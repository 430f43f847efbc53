"""`podeep-solve` on decks of lines: what check tells, what is risky, and that none is solved."""

from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from podeep.checks import warnings
from podeep.cli.solve import main
from podeep.deck.column import Column
from podeep.deck.keywords import KEYWORDS
from podeep.deck.read import read_deck
from podeep.describe import risk_report, scene_report
from podeep.errors import UserError

DECKS = Path(__file__).parent / "data" / "decks"
LINE = (DECKS / "line.deck").read_text(encoding="utf-8")
PILE = (DECKS / "base.deck").read_text(encoding="utf-8")
CONTACT = "0 11 3 0.3 0.6 5e4"
EVERYTHING = """*SOILSTIFF
3 DIRECT 160e3 500e3
4 VERLEYLUND 2e3 18e3
*SUCTION
2 CU=5e3 V=0.1 REMAIN=0.3 TRAVEL=4
5 900 0.2 0.4 0.3 0.1 0.5 SMOOTH=2
*MOTION
11 2
X 5
Z 2.5 12 90 20
*MOTION
11 1 X RY
0 0 0
60 1.5 90
*DYNAMIC
0 60
*EXEC"""


def write(folder: Path, text: str) -> str:
    path = folder / "a.deck"
    path.write_text(text, encoding="utf-8")
    return str(path)


def section(report: str, name: str) -> list[str]:
    text = report.replace("\n        ", " ").replace("\n      ", " ").replace("- ", "-")
    lines = text.partition(f"\n{name}\n")[2].partition("\n\n")[0].splitlines()
    return [line.strip() for line in lines]


def checked(folder: Path, capsys: pytest.CaptureFixture[str], text: str = LINE) -> str:
    assert main(["check", write(folder, text)]) == 0
    report = capsys.readouterr().out
    assert max(map(len, report.splitlines())) <= 80
    return report


def test_a_line_in_words(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    report = checked(tmp_path, capsys)
    assert report.startswith("Riser on clay\n\nlines\n")
    assert section(report, "lines") == [
        "line 11 RISER: 1635 m, from (-10, 0, -1000) to (991, 5, 0) m",
        "end 1: X Y Z held, leaving in the direction (0.999988, 0.00499494, 0)",
        "end 2: X Y Z held, free to turn",
        "1400 m: OD 0.3 m, WT 0.02 m, EI 3.46581e+07 N m2, EA 3.51858e+09 N, mass 140.743 kg/m, "
        "submerged weight 700.575 N/m, added-mass coefficient 1, drag coefficient 0, 100 elements",
        "235 m: OD 0.4 m, WT 0.03 m, EI 1.20133e+08 N m2, EA 6.97434e+09 N, mass 278.973 kg/m, "
        "contents 900 kg/m3, submerged weight 2350.23 N/m, added-mass coefficient 2, "
        "drag coefficient 0, elements by accuracy (default)",
    ]
    assert section(report, "seabed") == [
        "line 11 on the seabed at -1000 m: stiffness 50000 N/m2, friction 0.3 along and 0.6 "
        "across, reached at slips of 0.001 and 0.001 m, each direction by itself (box), "
        "no suction, integrated along its elements, taking hold over 0.0001 m",
        "section 1 at rest, under 700.575 N/m: 14.0615 mm deep",
        "section 2 at rest, under 2350.23 N/m: 47.0545 mm deep",
    ]
    assert section(report, "steps") == ["no loads and no displacements"]
    assert "\nsoil\n" not in report
    assert "\nheld and loaded\n" not in report


def test_everything_of_lines_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = LINE.replace("*EXEC\n", EVERYTHING).replace(
        CONTACT, f"{CONTACT} SURFACE=ELLIPSE FORM=NODAL ID1=4 ID2=2"
    )
    report = checked(tmp_path, capsys, text.replace("X Y Z RX", "X Y RX"))
    told = section(report, "lines")
    assert told[1].startswith("end 1: X Y held, leaving")
    assert told[2:4] == [
        "end 1: X follows 2 rows from 0 to 60 s, 0 to 1.5 m",
        "end 1: RY follows 2 rows from 0 to 60 s, 0 to 1.5708 rad",
    ]
    assert told[5:7] == [
        "end 2: X moved by 5 m times L11E2",
        "end 2: Z moved in a wave of 2.5 m and 12 s from 90 deg on, growing over 20 s",
    ]
    seabed = section(report, "seabed")
    assert seabed[2:4] == [
        "suction 2: force 1.12 OD 5000 Pa (v/OD)^0.18, over 0.98 OD v^0.26 m, full from 0.12 and "
        "fading from 0.3 of it, pulled out at 0.1 m/s in statics, velocity smoothed over 1 s, "
        "worn to 0.3, 95 % of that by a way of 4 OD",
        "suction 5: force 900 v^0.2 N/m, over 0.4 v^0.3 m, full from 0.1 and fading from 0.5 of "
        "it, pulled out at 0 m/s in statics, velocity smoothed over 2 s",
    ]
    assert "soil stiffness 4, friction 0.3 along" in seabed[4]
    assert "both together (ellipse), suction 2, lumped at its nodes" in seabed[4]
    assert seabed[5].startswith("section 1 at rest, under 700.575 N/m: ")
    assert "mm deep, Ks " in seabed[5]
    assert section(report, "steps") == ["1 quasi-static steps of L11E2", "step 1: 1"]
    assert not any("soil" in line for line in section(report, "motion"))


@pytest.mark.parametrize(
    ("more", "old", "new", "words"),
    [
        ("*MOTION\n11 1\nRY 5 9\n*DYNAMIC\n0 60", "", "", "does not turn them"),
        ("*MOTION\n11 2\nZ 1 9\n*DYNAMIC\n0 60 METHOD=ROS2", "", "", "ROS2"),
        ("*MOTION\n11 1\nRY 5\n*QUASISTATIC\n1 L11E1 1", "", "", "does not turn them"),
        ("", "11 2 991 5 0", "11 2 500 5 0", "it would lie there in bends"),
    ],
)
def test_lines_that_cannot_be_solved_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], more: str, old: str, new: str, words: str
) -> None:
    """Nothing is written."""
    deck = LINE.replace(old, new).replace("*EXEC", f"{more}\n*EXEC")
    assert main(["run", write(tmp_path, deck), "-o", str(tmp_path / "out")]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert words in shown.err
    assert not list(tmp_path.glob("out/*"))


def test_a_deck_of_lines_that_stops_is_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", write(tmp_path, LINE.replace("*EXEC", "*STOP"))]) == 0
    assert "checked, *STOP: nothing solved" in capsys.readouterr().out


@pytest.mark.parametrize(
    "command",
    [["curves", "--depth", "1"], ["capacity"], ["modes"], ["chart", "--foundation", "F1"]],
)
def test_commands_of_foundations_tell_which_ones_lines_have(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    name, *options = command
    assert main([name, write(tmp_path, LINE), *options]) == 2
    told = capsys.readouterr().err
    assert "the deck has lines alone (L11): this is of foundations" in told
    assert "for lines there are podeep-solve run, check, chart and stiffness" in told


# what is changed, the start of what is told, and the part that helps
RISKY = [
    ("1400 0.3 0.02", "1400 300 20", "line 11: OD = 300 m", "write 0.3 if 300 mm is meant"),
    ("200e9 8000 100", "200 8000 100", "line 11: E = 200 Pa", "write 200e9 if 200 GPa is meant"),
    ("200e9 8000 100", "200e9 8 100", "line 11: RHO = 8 kg/m3", "write 8000 if 8 t/m3 is meant"),
    ("0.3 0.02 200e9", "0.3 0.004 200e9", "line 11: 29.76 kg/m with OD = 0.3 m: it floats", "FILL"),
    ("11 2 991", "11 2 1450", "line 11: sections of 1635 m in all, ends 1770 m apart", "LENGTH"),
    (CONTACT, "0 11 3 30 0.6 5e4", "line 11: MU2 = 30", "write 0.3 if 30 % is meant"),
    (CONTACT, "0 11 3 0.3 60 5e4", "line 11: MU3 = 60", "write 0.6 if 60 % is meant"),
    (CONTACT, "0 11 3 0.3 0.6 50", "line 11: KN DENSITY = 50 N/m2", "write 50e3 if 50 kN/m2"),
    (CONTACT, f"{CONTACT} 30 0.1", "line 11: XSEUIL2 = 30 m", "write 0.03 if 30 mm is meant"),
    (CONTACT, f"{CONTACT} 0.1 30", "line 11: XSEUIL3 = 30 m", "write 0.03 if 30 mm is meant"),
    ("11 1 -10 0 -1000", "11 1 -10 0 -1010", "line 11: end 1 at -1010 m: it lies 10 m below", "Z"),
]


@pytest.mark.parametrize(("old", "new", "told", "helps"), RISKY, ids=lambda v: str(v)[:30])
def test_what_is_risky(tmp_path: Path, old: str, new: str, told: str, helps: str) -> None:
    assert LINE.count(old) == 1
    found = warnings(read_deck(Path(write(tmp_path, LINE.replace(old, new)))).scene)
    (line,) = [w for w in found if w.startswith(told)]
    assert helps in line
    assert line.count(": ") >= 2
    assert "; " in line


def test_lengths_in_kilometres(tmp_path: Path) -> None:
    text = LINE.replace("1400 0.3", "1.4 0.3").replace("235 0.4", "0.235 0.4")
    (line,) = warnings(read_deck(Path(write(tmp_path, text))).scene)
    assert line.startswith("line 11: sections of 1.635 m in all, ends 1415 m apart: a strain of ")
    assert line.endswith("; write 1635 if 1.635 km is meant")


def test_a_sound_line_is_not_risky(tmp_path: Path) -> None:
    assert warnings(read_deck(Path(write(tmp_path, LINE))).scene) == []


def test_the_strength_of_a_suction_in_kilopascals(tmp_path: Path) -> None:
    text = LINE.replace(CONTACT, f"{CONTACT} ID2=2").replace("*EXEC", "*SUCTION\n2 CU=5\n*EXEC")
    (line,) = warnings(read_deck(Path(write(tmp_path, text))).scene)
    assert line.startswith("suction 2: CU = 5 Pa")
    assert "write 5000 if 5 kPa is meant" in line


def anything(column: Column) -> st.SearchStrategy[float]:
    """A value within the bounds of a column, of any size."""
    low, high = max(column.bounds.low, -1e300), min(column.bounds.high, 1e300)
    edges = [low, high, *(v for v in (0.0, 1e-300, 1e-9, 1.0) if v in column.bounds)]
    inside = [v for v in edges if v in column.bounds]
    return st.sampled_from(inside) | st.floats(low, high).filter(lambda v: v in column.bounds)


SECTION = [c for c in KEYWORDS["LINE"].rows[1].columns if c.name != "NEL"]
SEABED = [c for c in KEYWORDS["TYPCONTACT"].rows[1].columns if c.name in ("MU2", "KN", "DENSITY")]


@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_whatever_is_within_bounds_can_be_told(tmp_path: Path, data: st.DataObject) -> None:
    """No value overflows, and none is a bug: it is told, or refused in words."""
    section = {c.name: data.draw(anything(c)) for c in SECTION}
    for name in ("EI", "EA", "MASS"):
        if data.draw(st.booleans()):
            del section[name]
    section["WT"] = data.draw(st.floats(0.01, 0.5)) * section["OD"]
    contact = {c.name: data.draw(anything(c)) for c in SEABED}
    soil = data.draw(st.sampled_from(["0", "1", "2"]))
    water, gravity = (data.draw(anything(c)) for c in KEYWORDS["SEA"].rows[0].columns)
    row = " ".join(f"{name}={value!r}" for name, value in section.items())
    kn = " ".join(f"{name}={value!r}" for name, value in contact.items())
    text = (
        f"*DEPTH -1000\n*SEA {water!r} {gravity!r}\n*LINE 11\n{row}\n"
        "*END\n11 1 0 0 -1000 X Y Z\n11 2 1e7 -1e7 1e7 X Y Z\n"
        "*SOILSTIFF\n1 DNV14CLAY 5e3 5e3 2.0 0.45\n2 VERLEYLUND 2e3 18e3\n"
        f"*TYPCONTACT\n0 11 3 ID1={soil} {kn}\n*EXEC\n"
    )
    path = Path(write(tmp_path, text))
    with suppress(UserError):
        deck = read_deck(path)
        report = scene_report(deck.scene, deck.notes) + risk_report(warnings(deck.scene))
        assert "nan" not in report
        assert " inf" not in report
