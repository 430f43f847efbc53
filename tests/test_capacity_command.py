"""podeep-solve capacity as a user runs it: closed forms, table 16, words, refusals, pictures."""

import csv
import io
from collections.abc import Sequence
from math import pi
from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.embedded import rows
from podeep.errors import ExitCode
from test_soil_tables import table

ROOT = Path(__file__).parents[1]
SAMPLES = ROOT / "sample_dbs"
G, WATER, STEEL = 9.80665, 1025.0, 7850.0
F, Q, D, T, L = 40e3, 1e6, 1.0, 0.04, 30.0  # unit friction, unit bearing, tube, length
SOIL = 8e3
WALL, INSIDE = pi * (D - T) * T, 0.25 * pi * (D - 2 * T) ** 2
PILE, PLUG = (STEEL - WATER) * G * WALL, SOIL * INSIDE  # weights in water, N/m
BEARING, OUTER, INNER = Q * (WALL + INSIDE), pi * D * F, pi * (D - 2 * T) * F
TZ = f"*TZCURVE\n1 0\n0 {F} {Q} GAMMA={SOIL}\n"
PY = "*PYCURVE\n1 0 0\n100e3 0.01\n"
LOADS = ("*LOAD\nPUSH 1 -58 0 0 -1e6\n", "*LOAD\nPULL 1 -58 0 0 1e6\n")


def deck(
    path: Path,
    curves: str = TZ,
    *,
    depths: str = "0",
    props: str = "0 1",
    loads: Sequence[str] = (),
    steps: str = "",
    more: str = "",
    casing: str = f"-58 -90 {D} {T} 210e9 {STEEL}",
) -> str:
    """A tube of 30 m below a mudline at -60 m in what the curves say, with its head 2 m above."""
    text = (
        f"*TITLE\na pile\n*DEPTH\n-60\n*GROUNDEPTH\n{depths}\n{curves}*GROUNDPROP\n{props}\n"
        f"*CASING\n1 PILE\n{casing}\n*FONDATION\n1 1\n{''.join(loads)}{more}{steps}*EXEC\n"
    )
    path = path / "case.deck"
    path.write_text(text, encoding="utf-8")
    return str(path)


def facts(text: str) -> dict[str, str]:
    lines = [line[2:].split(": ", 1) for line in text.splitlines() if line.startswith("#")]
    return dict(lines)  # type: ignore[arg-type]  # pairs


def table_of(text: str) -> dict[str, np.ndarray]:
    data = io.StringIO("".join(line + "\n" for line in text.splitlines() if line[0] != "#"))
    found = list(csv.DictReader(data))
    words = ("compression_governed_by", "tension_governed_by")
    return {
        name.split(" ")[0]: np.array([r[name] if name in words else float(r[name]) for r in found])
        for name in found[0]
    }


class Run:
    """The command's output, and that it ended well."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self.capsys = capsys

    def __call__(self, *arguments: str, code: int = 0) -> str:
        assert main(["capacity", *arguments]) == code
        self.out, self.err = self.capsys.readouterr()
        return self.out

    def words(self, *arguments: str) -> str:
        """The report with its folded lines joined."""
        return " ".join(self(*arguments).split())


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    return Run(capsys)


class TestClosedForms:
    def test_uniform_friction_and_bearing_at_every_depth(self, run: Run, tmp_path: Path) -> None:
        t = table_of(run(deck(tmp_path), "--csv"))
        z = t["depth"]
        assert (z[0], z[-1]) == (0.0, 45.0)
        expected = {
            "unit_friction": np.full(len(z), F),
            "unit_bearing": np.full(len(z), Q),
            "outer_friction": OUTER * z,
            "inner_friction": INNER * z,
            "wall_bearing": np.full(len(z), Q * WALL),
            "plug_bearing": np.full(len(z), Q * INSIDE),
            "pile_weight": PILE * z,
            "plug_weight": PLUG * z,
            "compression_plugged": OUTER * z + BEARING,
            "compression_unplugged": (OUTER + INNER) * z + Q * WALL,
            "tension_plugged": (OUTER + PILE + PLUG) * z,
            "tension_unplugged": (OUTER + INNER + PILE) * z,
        }
        for name, exact in expected.items():
            np.testing.assert_allclose(t[name], exact, rtol=1e-10, atol=1e-6, err_msg=name)
        plugs = INNER * z > Q * INSIDE
        assert (t["compression_governed_by"] == np.where(plugs, "plugged", "unplugged")).all()
        lesser = np.minimum(t["compression_plugged"], t["compression_unplugged"])
        assert (t["compression"] == lesser).all()
        assert set(t["tension_governed_by"][1:]) == {"plugged"}

    @pytest.mark.parametrize("safety", [1.5, 2.0])
    def test_length_that_tension_requires(self, run: Run, tmp_path: Path, safety: float) -> None:
        """FS P = (pi D f + W' + Wp') L."""
        path = deck(tmp_path, loads=LOADS[1:])
        found = facts(run(path, "--csv", "--safety-factor", str(safety)))
        exact = safety * 1e6 / (OUTER + PILE + PLUG)
        assert float(found["Required length [m]"]) == pytest.approx(exact, rel=1e-8)
        assert found["Length decided by"] == "tension"
        factor = (OUTER + PILE + PLUG) * L / 1e6
        assert float(found["Tension factor"]) == pytest.approx(factor, rel=1e-9)
        assert found["Compression factor"] == "no load"

    @pytest.mark.parametrize("safety", [1.5, 2.0])
    def test_length_that_compression_requires(
        self, run: Run, tmp_path: Path, safety: float
    ) -> None:
        """(pi D f L + q A) / FS = P + (W' + Wp') L, of the plugged pile."""
        path = deck(tmp_path, loads=("*LOAD\nPUSH 1 -58 0 0 -1.5e6\n",))
        found = facts(run(path, "--csv", "--safety-factor", str(safety)))
        exact = (1.5e6 - BEARING / safety) / (OUTER / safety - PILE - PLUG)
        assert float(found["Required length [m]"]) == pytest.approx(exact, rel=1e-8)
        factor = (OUTER * L + BEARING) / (1.5e6 + (PILE + PLUG) * L)
        assert float(found["Compression factor"]) == pytest.approx(factor, rel=1e-9)

    def test_a_short_pile_turns_about_its_pivot(self, run: Run, tmp_path: Path) -> None:
        """Broms: H = pu L (sqrt((1 + 2 e/L)^2 + 1) - (1 + 2 e/L)), uniform pu, e above ground."""
        path = deck(tmp_path, PY, props="1 0", loads=("*LOAD\nH 1 -58 3e5 4e5 0\n",), more=SUPPORT)
        found = facts(run(path, "--csv"))
        pu, e = 100e3 * D, 2.0
        a = 1 + 2 * e / L
        exact = pu * L * (np.sqrt(a**2 + 1) - a)
        assert float(found["Lateral load [N]"]) == pytest.approx(5e5)
        assert float(found["Moment of the lateral load [N m]"]) == pytest.approx(1e6)
        assert float(found["Lateral capacity, free head [N]"]) == pytest.approx(exact, rel=1e-9)
        assert float(found["Lateral factor, free head"]) == pytest.approx(exact / 5e5, rel=1e-9)
        pivot = 0.5 * (L + exact / pu)
        assert float(found["Its pivot [m]"]) == pytest.approx(pivot, rel=1e-9)
        still = float(found["Lateral capacity, head that cannot turn [N]"])
        assert still == pytest.approx(pu * L, rel=1e-12)


SUPPORT = "*SUPPORT\n1 -90 Z\n"


def test_table_16(run: Run, tmp_path: Path) -> None:
    """The clay of its first row: su 20 to 100 kPa over 40 m."""
    row = {name: values[0] for name, values in table("16").items()}
    curves = "".join(f"*TZCURVE\n{i} 0\n1 {su} 8e3\n" for i, su in ((1, 20e3), (2, 100e3)))
    t = table_of(run(deck(tmp_path, curves, depths="0 -40", props="0 1 0 2"), "--csv"))
    (tip,) = np.flatnonzero(t["depth"] == row["L"])
    for name, column in (
        ("Qo", "outer_friction"),
        ("Qi", "inner_friction"),
        ("qb", "unit_bearing"),
        ("Qw", "wall_bearing"),
        ("Qp", "plug_bearing"),
        ("plugged", "compression_plugged"),
        ("unplugged", "compression_unplugged"),
        ("comp", "compression"),
    ):
        assert t[column][tip] == pytest.approx(1e3 * row[name], rel=1e-6), name


def soil(id_: int, pressure: float, more: str = "") -> str:
    return f"*TZCURVE\n{id_} 0\n0 {F} {pressure} GAMMA={SOIL} {more}\n"


class TestDepths:
    def test_both_sides_of_a_jump_and_none_where_nothing_jumps(
        self, run: Run, tmp_path: Path
    ) -> None:
        curves = soil(1, 1e6) + soil(2, 4e6)
        depths, props = "0 -7.3 -20.1 -20.1 -50", "0 1 0 1 0 1 0 2 0 2"
        t = table_of(run(deck(tmp_path, curves, depths=depths, props=props), "--csv"))
        near = np.abs(t["depth"] - 20.1) < 1e-6
        assert t["unit_bearing"][near].tolist() == [1e6, 4e6]
        assert not (np.abs(t["depth"] - 7.3) < 0.05).any()
        assert 30.0 in t["depth"]

    def test_a_change_of_wall_is_a_jump(self, run: Run, tmp_path: Path) -> None:
        casing = f"-58 -70 1 0.08 210e9 {STEEL}\n-70 -90 1 0.04 210e9 {STEEL}"
        t = table_of(run(deck(tmp_path, casing=casing), "--csv"))
        walls = t["wall_bearing"][np.abs(t["depth"] - 10.0) < 1e-6]
        np.testing.assert_allclose(walls, [Q * pi * 0.92 * 0.08, Q * pi * 0.96 * 0.04], rtol=1e-12)

    @pytest.mark.parametrize("end", ["12", "77.7"])
    def test_to_is_the_end_and_the_tip_is_there(self, run: Run, tmp_path: Path, end: str) -> None:
        z = table_of(run(deck(tmp_path), "--csv", "--to", end))["depth"]
        assert {float(end), 30.0} <= set(z.tolist())
        assert z[z != 30.0].max() == float(end)
        assert facts(run.out).get("Lengths scanned [m]") is None  # no loads, no length

    @pytest.mark.parametrize("end", [0.3, 1.0, 4.4, 45.0, 75.0, 81.0, 100.0, 999.0])
    def test_twenty_to_forty_round_rows(self, end: float) -> None:
        z = rows(end, end / 3.0, np.zeros(0))
        assert 20 <= len(z) <= 44
        mantissa = z[1] / 10.0 ** np.floor(np.log10(z[1]) + 1e-9)
        assert np.isclose(mantissa, [1.0, 2.0, 2.5, 5.0]).any()


class TestDemand:
    def test_the_largest_of_all_steps(self, run: Run, tmp_path: Path) -> None:
        steps = "*QUASISTATIC\n1 PUSH 1\n2 PULL 1.5\n3 PUSH -1\n4 PUSH 2 PULL 0\n"
        text = run.words(deck(tmp_path, loads=LOADS, steps=steps))
        assert "compression 2000 kN (step 4), tension 2500 kN (step 3)" in text

    def test_moments_are_about_the_mudline_in_the_plane_of_the_load(
        self, run: Run, tmp_path: Path
    ) -> None:
        """Along y, MX turns it over with the opposite sign; MY acts across."""
        load = "*LOAD\nH 1 -58 0 2e5 0 -3e5 7e4 0\n"
        path = deck(tmp_path, PY, props="1 0", loads=(load,), more=SUPPORT)
        found = facts(run(path, "--csv"))
        assert float(found["Moment of the lateral load [N m]"]) == pytest.approx(4e5 + 3e5)
        assert "a moment of 7e+04 N m acts across the plane" in run.err
        assert "supports are left out" in run.err

    def test_a_couple_alone(self, run: Run, tmp_path: Path) -> None:
        """Uniform pu: M = pu L^2/4, about the middle."""
        load = "*LOAD\nM 1 -58 0 0 0 0 -3e6 0\n"
        path = deck(tmp_path, PY, props="1 0", loads=(load,), more=SUPPORT)
        text = run.words(path)
        assert "free head: 22500 kN m at the mudline (in the ratio of step 1)" in text
        assert "turning about 15 m: factor 7.5" in text

    def test_none(self, run: Run, tmp_path: Path) -> None:
        text = run.words(deck(tmp_path, TZ + PY, props="1 1"))
        assert "compression: 4555.31 kN, plugged governs; no step has such a load" in text
        assert "required length: no step has an axial load" in text
        assert "(no lateral load in any step)" in text
        assert "factor" not in text


class TestWords:
    def test_the_jacket_pile(self, run: Run) -> None:
        """41661.7 / (12000 + 1147.51); the sand below 42 m bears it at once."""
        deck = str(SAMPLES / "jacket_pile.deck")
        text = run(deck)
        assert max(len(line) for line in text.splitlines()) <= 80
        assert ">   50 95.70 19855.0 18971.6 9600.00 54191.0   41661.7* 22437.8*  39974.1\n" in text
        assert "    24 59.31  5526.4  5247.3  630.00  7779.7*  10959.7   6801.2*  11407.2\n" in text
        words = " ".join(text.split())
        assert (
            "compression: 41661.7 kN, unplugged governs; load 12000 kN and 1147.51 kN of the pile "
            "in water: factor 3.169" in words
        )
        assert "tension: 22437.8 kN, plugged governs; no step has such a load" in words
        assert "safety factor of 2: 42 m embedded, compression decides" in words
        assert "lateral 2200 kN with a moment of -100 kN m (step 6)" in words
        assert "turning about 45.8814 m: factor 40.32" in words
        assert "Plastic hinges of the pile are not looked at" in words
        assert "The soil is given down to 58 m" in words
        assert "the required length at 42 m is 0.00 m inside its layer" in run.err

    def test_a_pile_without_friction_still_has_its_lateral_part(self, run: Run) -> None:
        text = run.words(str(SAMPLES / "opensees_pile.deck"))
        assert "axial: no t-z curve reacts, there is no axial capacity to compute" in text
        assert "free head: 25833.6 kN with 25833.6 kN m at the mudline" in text

    def test_a_pile_without_p_y_curves_still_has_its_axial_part(
        self, run: Run, tmp_path: Path
    ) -> None:
        text = run.words(deck(tmp_path, loads=LOADS[:1]))
        assert "lateral: no p-y curve reacts, there is no lateral capacity to compute" in text
        assert "compression: 4555.31 kN, plugged governs" in text

    def test_a_length_that_fails_again(self, run: Run, tmp_path: Path) -> None:
        """Strong over weak over strong; it holds again where the third layer begins."""
        curves = soil(1, 4e6) + soil(2, 0.2e6)
        depths, props = "0 -20 -20 -30 -30 -60", "0 1 0 1 0 2 0 2 0 1 0 1"
        load = "*LOAD\nPUSH 1 -58 0 0 -2e6\n"
        path = deck(tmp_path, curves, depths=depths, props=props, loads=(load,))
        exact = (2e6 - 0.5 * 4e6 * WALL) / ((OUTER + INNER) / 2 - PILE)
        found = facts(run(path, "--csv"))
        assert float(found["Required length [m]"]) == pytest.approx(exact, rel=1e-8)
        assert exact < 20.0
        text = run.words(path)
        assert "it fails again from 20 to 30 m" in text

    def test_a_length_beyond_the_pile(self, run: Run, tmp_path: Path) -> None:
        text = run.words(deck(tmp_path, loads=("*LOAD\nPULL 1 -58 0 0 2.5e6\n",)))
        assert f"{5e6 / (OUTER + PILE + PLUG):.6g} m embedded, tension decides; more than" in text

    def test_bearing_at_the_mudline_is_doubted(self, run: Run, tmp_path: Path) -> None:
        text = run.words(deck(tmp_path, soil(1, 4e7), loads=LOADS[:1]))
        assert "safety factor of 2: 0 m embedded, compression decides" in text
        assert "the required length at 0 m is 0.00 m inside its layer, whose larger" in run.err

    def test_a_length_that_is_not_reached(self, run: Run, tmp_path: Path) -> None:
        load = "*LOAD\nPULL 1 -58 0 0 9e6\n"
        text = run.words(deck(tmp_path, loads=(load,)), "--to", "40")
        capacity = (OUTER + PILE + PLUG) * 40.0 / 1e3
        assert "not reached from 0 to 40 m (tension lacks most); at 40 m the capacity is" in text
        assert f"and {capacity:.6g} kN in tension" in text

    def test_a_solid_bar_has_no_plug_to_carry(self, run: Run, tmp_path: Path) -> None:
        casing = f"-58 -90 1 0.5 210e9 {STEEL}"
        text = run.words(deck(tmp_path, casing=casing, loads=LOADS[:1]))
        weight = (STEEL - WATER) * G * pi / 4 * L / 1e3
        assert f"load 1000 kN and {weight:.6g} kN of the pile in water" in text
        assert run.err == ""

    @pytest.mark.parametrize("scale", [1e-4, 1.0, 1e4])
    def test_no_line_is_wider_than_eighty(self, run: Run, tmp_path: Path, scale: float) -> None:
        curves = soil(1, 1e6).replace(f"{F}", f"{F * scale}").replace("1000000.0", f"{scale * Q}")
        casing = f"-58 -90.1234 {D} {T} 210e9 {STEEL}"
        load = f"*LOAD\nPUSH 1 -58 0 0 {-scale * 1e6}\n"
        text = run(deck(tmp_path, curves, casing=casing, loads=(load,)))
        assert max(len(line) for line in text.splitlines()) <= 80

    def test_the_water_counts(self, run: Run, tmp_path: Path) -> None:
        t = table_of(run(deck(tmp_path, more="*SEA\n1000 9.8\n"), "--csv"))
        np.testing.assert_allclose(t["pile_weight"], 6850 * 9.8 * WALL * t["depth"], rtol=1e-12)


class TestPlug:
    def test_the_option_of_the_tip_is_taken_and_told(self, run: Run, tmp_path: Path) -> None:
        curves = soil(1, 1e6, "PLUG=UNPLUGGED") + soil(2, 1e6)
        depths, props = "0 -20 -20 -50", "0 2 0 2 0 1 0 1"
        t = table_of(run(deck(tmp_path, curves, depths=depths, props=props), "--csv"))
        assert "differ in PLUG (AUTO, UNPLUGGED): that of the curve at the tip, UNPLUGGED" in (
            run.err
        )
        assert facts(run.out)["Plug"] == "UNPLUGGED"
        assert (t["compression"] == t["compression_unplugged"]).all()

    def test_the_factor_is_that_of_the_chosen_way(self, run: Run, tmp_path: Path) -> None:
        path = deck(tmp_path, soil(1, 1e6, "PLUG=UNPLUGGED"), loads=LOADS[:1])
        factor = ((OUTER + INNER) * L + Q * WALL) / (1e6 + PILE * L)
        assert float(facts(run(path, "--csv"))["Compression factor"]) == pytest.approx(factor)
        assert run.err == ""

    def test_a_plug_of_unknown_weight_is_told(self, run: Run, tmp_path: Path) -> None:
        t = table_of(run(deck(tmp_path, f"*TZCURVE\n1 0\n0 {F} {Q}\n"), "--csv"))
        assert not t["plug_weight"].any()
        assert "warning: the plug is taken as weightless" in run.err


def test_a_support_in_place_of_the_t_z_curves_leaves_the_capacity(run: Run, tmp_path: Path) -> None:
    with_curves = table_of(run(deck(tmp_path), "--csv"))
    without = table_of(run(deck(tmp_path, more="*MODEL TZ=OFF\n"), "--csv"))
    assert (without["compression"] == with_curves["compression"]).all()


class TestRefusals:
    @pytest.mark.parametrize(
        ("arguments", "words"),
        [
            (["--foundation", "F3"], "no foundation F3; the deck has F1"),
            (["--to", "0"], "the depth 0 m of --to is not above 0 and at most 1000 m; give metres"),
            (["--to", "-4"], "the depth -4 m of --to"),
            (["--to", "1e9"], "the depth 1e+09 m of --to"),
            (["--to", "nan"], "the depth nan m of --to"),
            (["--safety-factor", "0.9"], "the safety factor 0.9 is not a number of 1 or more; giv"),
            (["--safety-factor", "inf"], "the safety factor inf"),
        ],
    )
    def test_values(self, run: Run, tmp_path: Path, arguments: list[str], words: str) -> None:
        assert run(deck(tmp_path), *arguments, code=ExitCode.USAGE) == ""
        assert words in run.err

    @pytest.mark.parametrize("option", ["--to", "--safety-factor"])
    def test_words_for_numbers(
        self, tmp_path: Path, option: str, capsys: pytest.CaptureFixture[str]
    ) -> None:
        with pytest.raises(SystemExit) as ending:
            main(["capacity", deck(tmp_path), option, "two"])
        assert ending.value.code == ExitCode.USAGE
        assert "'two' is no number: write it as 2.0 or 75" in capsys.readouterr().err


def test_two_foundations(run: Run, tmp_path: Path) -> None:
    more = f"*CASING\n2 SHORT\n-58 -75 2 0.05 210e9 {STEEL}\n*FONDATION\n2 2\n"
    path = deck(tmp_path, more=more, loads=LOADS[:1])
    assert facts(run(path, "--csv"))["Embedded length [m]"] == "30.0"
    found = facts(run(path, "--csv", "--foundation", "F2"))
    assert (found["Foundation"], found["Embedded length [m]"]) == ("F2", "15.0")
    assert found["Compression load [N]"] == "0.0"
