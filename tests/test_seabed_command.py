"""podeep-solve stiffness for pipes, and *SOILSTIFF: what is read, shown, refused and warned of."""

import csv
import re
from pathlib import Path

import pytest

from podeep.cli.solve import main
from podeep.deck.read import read_deck
from podeep.errors import ExitCode, UserError
from podeep.seabed.models import MODELS
from podeep.seabed.parameters import PARAMETERS
from test_deck_faults import BASE

CLAY = "--clay --diameter 0.3 --weight 800 --su 5e3 --gamma 5e3 --void-ratio 2 --nu 0.45"
SAND = "--sand --diameter 0.3 --weight 800 --phi 30 --gamma 9.1e3"
PIPE = "--diameter 0.3 --weight 800"
SOILS = """1 DNV14CLAY 5e3 5e3 2.0 0.45
2 DNV14SAND 9.1e3 30 0.7 0.35 NG=1.5
12 direct KS=160e3 KD=100e3
7 AUDIBERTCLAY 5e3 5e3 ZU=0.15
"""


@pytest.fixture
def solver(capsys):
    """Run the command; its output, its messages and its exit code."""

    def run(line, deck=None):
        code = main(["stiffness", *([str(deck)] if deck else []), *line.split()])
        out, err = capsys.readouterr()
        return out, err, code

    return run


def deck(folder: Path, soils: str, more: str = "") -> Path:
    path = folder / "a.deck"
    path.write_text(BASE.replace("*EXEC", f"*SOILSTIFF\n{soils}{more}*EXEC"), encoding="utf-8")
    return path


# --- the command ------------------------------------------------------------------------------


def test_every_model_that_the_parameters_allow(solver):
    """The rows are those of the soil; what lacks a parameter is named with its option."""
    for soil, line in (("CLAY", f"{CLAY} --gamma-vl 18e3"), ("SAND", SAND)):
        out, err, code = solver(line)
        assert (err, code) == ("", ExitCode.DONE)
        names = [name for name, m in MODELS.items() if m.soil == soil]
        assert re.findall(r"^([A-Z0-9]+)  *(?:printed|reconstructed) ", out, re.M) == names
        assert "lacks" not in out
    out, _, _ = solver(CLAY)
    assert "\nVERLEYLUND lacks --gamma-vl\nVERLEYLUNDLINEAR lacks --gamma-vl\n" in out
    out, _, _ = solver("--clay --diameter 0.3 --weight 800 --su 5e3 --gamma 5e3")
    assert re.search(r"^DNV14CLAY .* - (\d)$", out, re.M)
    assert "no Kd: its dynamic stiffness needs the void ratio and Poisson's ratio" in out
    assert "KL of" not in out


def test_marks_stand_beside_every_number(solver):
    words = " ".join(solver(f"{CLAY} --gamma-vl 18e3")[0].split())
    assert "no Kd: no public formula of its dynamic stiffness was found" in words
    assert "not the formula of DeepLines" in words
    assert "in kPa is from memory" in words
    assert "Audibert 1984: static and dynamic stiffness" in words
    assert "153.5 kPa (DNV-RP-F105, from memory)" in words


def test_csv_has_all_digits(solver):
    """The first rows of the check table (02), by options alone."""
    out, err, code = solver(f"{CLAY} --gamma-vl 18e3 --csv")
    assert (err, code) == ("", ExitCode.DONE)
    rows = {row["model"]: row for row in csv.DictReader(out.splitlines())}
    for name, z in (
        ("DNV14CLAY", 0.0008094108814492),
        ("DUNLAP", 0.005009082711671),
        ("VERLEYLUND", 0.01205138292536),
        ("VERLEYLUNDLINEAR", 0.01407133703875),
        ("F114", 0.0007379751479799),
    ):
        assert float(rows[name]["penetration [m]"]) == pytest.approx(z, rel=1e-12)
        assert float(rows[name]["static stiffness [Pa]"]) == pytest.approx(800.0 / z, rel=1e-12)
    assert float(rows["DNV14CLAY"]["dynamic stiffness [Pa]"]) == pytest.approx(222866.8230868)
    assert rows["DUNLAP"]["dynamic stiffness [Pa]"] == ""
    tangent = float(rows["DUNLAP"]["tangent stiffness [Pa]"])
    assert tangent == pytest.approx(0.64 * 800.0 / 0.005009082711671)
    assert rows["AUDIBERTCLAY"]["source"] == "reconstructed"
    assert "not the formula" in rows["AUDIBERTCLAY"]["about the dynamic stiffness"]


def test_ranges_and_slips_are_told(solver):
    out, err, _ = solver("--clay --diameter 0.3 --weight 0.8 --su 5 --gamma 20e3")
    words = " ".join(err.split())
    assert "--weight = 0.8 N/m: below 5 N/m" in words
    assert "(the command takes N/m); write 800 if 0.8 kN/m is meant" in words
    assert "--su = 5 Pa" in words
    assert "--gamma = 20 kN/m3: soil under water weighs 4 to 12 kN/m3" in words
    out, err, _ = solver("--sand --diameter 0.2 --weight 5000 --phi 30 --gamma 9.1e3")
    assert err == ""
    note = re.search(r"^(\d) z/D = 0.642 is above 0.5: the model is for a pipe less", out, re.M)
    assert note
    assert re.search(rf"^NGIDRAINED .* - \d?,?{note[1]}", out, re.M)


def test_lay_factor(solver):
    lay = "--bending-stiffness 1e7 --lay-tension 50e3"
    out, err, _ = solver(f"{CLAY} {lay}")
    assert "\nlaid on F114: k_lay 3.056, z 6.878 mm, z/D 0.02293\n" in out
    assert err == ""
    rows = list(csv.DictReader(solver(f"{CLAY} {lay} --csv")[0].splitlines()))
    assert [row["model"] for row in rows if row["lay factor"]] == ["F114"]
    _, err, code = solver(f"{CLAY} --bending-stiffness 1e7 --lay-tension 30e3")
    assert "F114: a lay tension of 30000 N is below 38620 N" in err
    assert code == ExitCode.DONE


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("", "nothing to show a stiffness of; name a deck, or give --diameter, --weight, --clay"),
        ("--clay --diameter 0.3", "the pipe on the seabed lacks --weight; give it"),
        (f"{PIPE} --su 5e3", "lacks --clay or --sand"),
        (f"--clay {PIPE}", "DUNLAP lacks --su"),
        (f"{CLAY} --phi 30", "--phi: the friction angle has no effect on clay; leave it out"),
        (f"{SAND} --su 5e3", "--su: the undrained shear strength has no effect on sand"),
        (f"{SAND} --void-ratio 3", "--void-ratio: the void ratio is 3; it has to be 0.01 to below"),
        (f"{SAND} --nu 0.5", "--nu: the Poisson's ratio of the soil is 0.5; it has to be 0 to"),
        (f"{CLAY} --weight -800", "--weight: the submerged weight of the pipe is -800"),
        (f"{CLAY} --weight nan", "--weight: the submerged weight of the pipe is nan"),
        (f"{CLAY} --lay-tension 1e4", "lacks --bending-stiffness"),
        (f"{CLAY} --lay-tension 0 --bending-stiffness 1", "as the pipe is laid is 0; it has to"),
        (f"{SAND} --lay-tension 1e4 --bending-stiffness 1e6", "with the model F114, which is not"),
    ],
)
def test_refusals(solver, line, told):
    out, err, code = solver(line)
    assert told in err
    assert (out, code) == ("", ExitCode.USAGE)


def test_all_that_is_out_of_bounds_in_one_go(solver):
    _, err, _ = solver("--clay --diameter 300 --weight 800 --su -1 --gamma 5e3")
    assert len(err.splitlines()) == 2


@pytest.mark.parametrize("line", ["--clay --sand", "--su x"])
def test_usage(line, capsys):
    with pytest.raises(SystemExit) as caught:
        main(["stiffness", *line.split()])
    assert caught.value.code == ExitCode.USAGE
    assert capsys.readouterr().err


# --- decks ------------------------------------------------------------------------------------


def test_soils_of_a_deck(tmp_path, solver):
    path = deck(tmp_path, SOILS)
    scene = read_deck(path).scene
    assert list(scene.soil_stiffnesses) == [1, 2, 12, 7]
    clay = scene.soil_stiffnesses[1]
    assert clay.parameters == {
        "undrained_shear_strength": 5e3,
        "effective_unit_weight": 5e3,
        "void_ratio": 2.0,
        "poisson_ratio": 0.45,
    }
    assert scene.soil_stiffnesses[2].parameters["self_weight_factor"] == 1.5
    out, err, code = solver(PIPE, path)
    assert (err, code) == ("", ExitCode.DONE)
    assert re.findall(r"^(\d+ [A-Z0-9]+) ", out, re.M) == [
        *("1 DNV14CLAY", "2 DNV14SAND", "12 DIRECT", "7 AUDIBERTCLAY")
    ]
    assert max(map(len, out.splitlines())) <= 80
    assert re.search(r"^12 DIRECT +given +5 +0.01667 +76.81 +160 +100 ", out, re.M)
    rows = list(csv.DictReader(solver(f"{PIPE} --csv", path)[0].splitlines()))
    assert [row["soil"] for row in rows] == ["1", "2", "12", "7"]
    assert float(rows[1]["penetration [m]"]) == pytest.approx(0.008292050199754, rel=1e-12)
    assert float(rows[1]["dynamic stiffness [Pa]"]) == pytest.approx(6573364.920656, rel=1e-12)


def test_what_check_says_of_them(tmp_path, capsys):
    path = deck(tmp_path, SOILS + "9 DUNLAP 5\n")
    assert main(["check", str(path)]) == ExitCode.DONE
    words = " ".join(capsys.readouterr().out.split())
    assert "soil stiffness 1: DNV14CLAY, undrained shear strength 5000 Pa, effective" in words
    assert "soil stiffness 1, 2, 12, 7, 9 under no line" in words
    assert "soil stiffness 9: CU = 5 Pa: below 500 Pa" in words
    assert "(the deck takes Pa); write 5000 if 5 kPa is meant" in words


def test_without_soils_nothing_is_said_of_the_seabed(tmp_path, capsys):
    path = tmp_path / "a.deck"
    path.write_text(BASE, encoding="utf-8")
    assert main(["check", str(path)]) == ExitCode.DONE
    assert "seabed" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("soils", "blamed", "told"),
    [
        ("1 DUNLOP 5e3\n", "DUNLOP", "no model 'DUNLOP' of *SOILSTIFF; did you mean DUNLAP?"),
        ("1 AUDIBERT 5e3 5e3\n", "AUDIBERT", "did you mean AUDIBERT"),
        ("1\n", "1", "*SOILSTIFF lacks MODEL; models are DNV14CLAY, DNV14SAND, DUNLAP"),
        ("1.5 DUNLAP 5e3\n", "1.5", "ID is 1.5, but must be a whole number"),
        ("1 DUNLAP 5e3\n1 F114 5e3 5e3\n", "1", "soil stiffness 1 is defined twice, first at"),
        ("1 DUNLAP\n", "", "*SOILSTIFF lacks CU; the line is ID MODEL CU"),
        ("1 DUNLAP 5e3 5e3\n", "5e3", "a value too many for *SOILSTIFF; the line is ID MODEL CU"),
        ("1 DNV14SAND 9e3 30 0.7 0.35 1.5\n", "1.5", "a value too many for *SOILSTIFF"),
        ("1 DUNLAP -5e3\n", "-5e3", "CU is -5e3, but must be 1 to 1e+08"),
        ("1 DNV14CLAY 5e3 5e3 2.97 0.4\n", "2.97", "void ratio is 2.97; it has to be 0.01 to bel"),
        ("1 DNV14CLAY 5e3 5e3 3 0.4\n", "3", "E is 3, but must be 0.01 to 2.97"),
        ("1 DNV14SAND 9e3 30 0.7 0.5\n", "0.5", "0.5; it has to be 0 to below 0.5"),
        ("1 DUNLAP 5e3 NG=1.5\n", "NG=1.5", "NG has no effect here (DUNLAP: Dunlap"),
        ("1 DIRECT 160e3\n", "", "*SOILSTIFF lacks KD"),
        ("", "*SOILSTIFF", "*SOILSTIFF has no data"),
    ],
)
def test_faults_of_a_deck(tmp_path, soils, blamed, told):
    with pytest.raises(UserError) as caught:
        read_deck(deck(tmp_path, soils))
    (found,) = caught.value.faults
    assert told in f"{found.message}; {found.remedy}"
    start = found.place.column - 1
    assert found.place.text[start : start + found.place.width].strip() == blamed


def test_an_option_of_the_keyword_is_refused(tmp_path):
    path = deck(tmp_path, SOILS)
    path.write_text(path.read_text().replace("*SOILSTIFF", "*SOILSTIFF, CYCLIC"))
    with pytest.raises(UserError, match="has no option 'CYCLIC'"):
        read_deck(path)


def test_values_by_name(tmp_path):
    path = deck(tmp_path, "3 NU=0.3 MODEL=dnv14sand PHI=30 GAMMA=9e3 E=0.7\n")
    (soil,) = read_deck(path).scene.soil_stiffnesses.values()
    assert (soil.model, soil.parameters["poisson_ratio"]) == ("DNV14SAND", 0.3)


def test_every_model_stands_in_a_deck(tmp_path, solver):
    """By the layout of its row: required values in the middle of their bounds, as numbers."""
    lines = []
    for number, model in enumerate(MODELS.values(), start=1):
        values = (
            f"{(p.low * p.high) ** 0.5:.3g}" for p in model.parameters if p.key in model.needed
        )
        lines.append(f"{number} {model.name} {' '.join(values)}\n")
    path = deck(tmp_path, "".join(lines))
    assert [s.model for s in read_deck(path).scene.soil_stiffnesses.values()] == list(MODELS)
    out, _, code = solver(PIPE, path)
    assert code == ExitCode.DONE
    assert max(map(len, out.splitlines())) <= 80


# --- decks and the command --------------------------------------------------------------------


def test_options_that_do_not_go_with_a_deck(tmp_path, solver):
    path = deck(tmp_path, SOILS)
    for line, told in (
        (f"{PIPE} --clay --su 5e3", "--su, --clay beside a deck, whose *SOILSTIFF gives the soil"),
        ("--diameter 0.3", "the pipe on the seabed lacks --weight"),
        (f"{PIPE} --lay-tension 1e4 --bending-stiffness 1e6", "the model F114, which is not here"),
        ("--lay-tension 1e4 --bending-stiffness 1e6", "lacks --diameter, --weight"),
    ):
        out, err, code = solver(line, path)
        assert told in err
        assert (out, code) == ("", ExitCode.USAGE)
    path.write_text(BASE, encoding="utf-8")
    assert "has no *SOILSTIFF for the pipe to lie on" in solver(PIPE, path)[1]


def test_spudcans_and_pipes_apart(tmp_path, solver):
    """Without a pipe the command shows spudcans, and says how the soils of pipes are shown."""
    path = deck(tmp_path, SOILS)
    _, err, code = solver("", path)
    assert "has no *SPUDCAN: there is no stiffness to show; *SOILSTIFF is shown for a pipe" in err
    assert code == ExitCode.USAGE
    path = deck(tmp_path, SOILS, "*SPUDCAN\n1 14 3 40e6 0.5\n")
    out, err, code = solver("", path)
    assert out.startswith("spudcan of tube 1")
    assert "warning: *SOILSTIFF is shown for a pipe: give --diameter and --weight" in err
    assert code == ExitCode.DONE
    out, err, _ = solver(PIPE, path)
    assert out.startswith("pipe of 0.3 m")
    assert "spudcan" not in out + err
    path.write_text(BASE, encoding="utf-8")
    assert "add one, or a *SOILSTIFF for pipes" in solver("", path)[1]


def test_every_parameter_has_words(capsys):
    """Each is an option with its unit, but for those of a given stiffness."""
    with pytest.raises(SystemExit):
        main(["stiffness", "--help"])
    told = " ".join(capsys.readouterr().out.split())
    for one in PARAMETERS.values():
        assert one.option in told
        assert bool(one.option) == (one.symbol not in ("KS", "KD"))
        if one.option and one.unit != "-":
            assert f"{one.meaning.split()[-1]}, {one.unit}" in told
