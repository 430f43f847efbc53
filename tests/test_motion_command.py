"""podeep-solve run on decks with motion: what it writes, says and returns."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.errors import ExitCode

PILE = (
    "*DEPTH\n0\n*GROUNDEPTH\n0 -15 -15 -40\n"
    "*PYCURVE, SHAPE=POWER\n1 1 20e3 8e3 0.5 0.01\n*PYCURVE, SHAPE=POWER\n2 1 60e3 8e3 0.5 0.01\n"
    "*PYCURVE\n3 2 10e3 35 22e6\n*CASING\n1 PILE\n10 -40 2 0.05 210e9 7850\n*FONDATION\n1 1\n"
    "*MASS\n1 10 200e3\n"
)


def friction(residual: float, bearing: float = 0.0) -> str:
    """t-z by RP 2GEO; a tip that bears next to nothing unless it is told."""
    clay = f"*TZCURVE, SHAPE=2GEO, RESIDUAL={residual}\n"
    limit = 10e6 if bearing else 1.0
    return (
        f"{clay}1 0\n1 20e3 8e3\n{clay}2 0\n1 60e3 8e3\n"
        f"{clay}3 0\n2 0.46 10e3 45 {bearing:g} 96e3 {limit:g}\n"
    )


def deck(*parts: str, rule: int = 0) -> str:
    return f"{PILE}{''.join(parts)}*GROUNDPROP\n1 1 2 2 3 3 3 3 1e8 {rule}\n*EXEC\n"


SWAY = (
    "*LOAD\nSTORM 1 10 1e6 0 0\n*HARMONIC\nSTORM 4.0 0 2.0\n*DAMPING\n0.02 0.25 5\n"
    "*DYNAMIC\n0 6 0.05\n*ACCURACY\n1e-2\n"
)
HEAVY = "*LOAD\nV 1 10 0 0 {still}\nPUSH 1 10 0 0 {push}\n*QUASISTATIC\n1 V 1\n"
SUDDEN = "*TIMESERIES PUSH\n0 0\n0.0001 1\n1000 1\n*DAMPING\n0.02 0.25 5\n"


def run(folder: Path, text: str, *arguments: str) -> int:
    path = folder / "case.deck"
    path.write_text(text)
    return main(["run", str(path), "-o", str(folder), "--force", *arguments])


KNOCKING = (
    "*DEPTH\n0\n*GROUNDEPTH\n0 -40\n*PYCURVE\n1 1 60e3 8e3 0.5 0.01\n"
    "*TZCURVE, SHAPE=2GEO\n1 0\n1 60e3 8e3\n*GROUNDPROP\n1 1 1 1\n"
    "*CASING\n1 OUTER\n5 -30 1.0 0.03 210e9 7850\n*CASING\n2 INNER\n6 -30 0.5 0.02 210e9 7850\n"
    "*FONDATION\n1 1 2\n*SLAVE\n1 2 CEMENTED -10 -30\n*TYPCONTACT\n1 2 2 0 GAP=0.05\n"
    "*LOAD\nSWAY 2 6 3e5 0 0\n*HARMONIC\nSWAY 2.0 0\n*MASS\n2 6 1e3\n*ACCURACY\n1e-1\n"
    "*DYNAMIC\n0 0.3 0.02{method}\n*EXEC\n"
)


@pytest.mark.parametrize(("method", "told"), [("", True), (" METHOD=HHT", False)])
def test_the_default_method_is_told_where_tubes_can_knock(tmp_path, capsys, method, told):
    assert run(tmp_path, KNOCKING.format(method=method)) == ExitCode.DONE
    text = capsys.readouterr().out
    assert ("    followed by METHOD=CONSERVE: tubes have room to knock\n" in text) is told
    with open_database(tmp_path / "case.dst") as database:
        left = database.foundation("F1").read("convergence/residual")
    assert bool(left[1:].max() < 1e-6) is told
    assert main(["check", str(tmp_path / "case.deck")]) == ExitCode.DONE
    named = "method trapezoidal with the mean force of a step, which keeps energy (default)"
    assert (named in " ".join(capsys.readouterr().out.split())) is told


def test_a_motion_is_written_beside_the_statics(tmp_path, capsys):
    assert run(tmp_path, deck(friction(0.9, 40.0), SWAY), "--json") == ExitCode.DONE
    told = json.loads(capsys.readouterr().out)["motion"]
    assert told["steps"] == 120
    assert told["step"] == pytest.approx(0.05)
    assert told["failure"] is None
    assert (tmp_path / "case.dss").exists()
    with open_database(tmp_path / "case.dst") as database:
        data = database.foundation("F1")
        assert database.status == "complete"
        assert data.axis == pytest.approx(np.linspace(0.0, 6.0, 121))
        y, p = (data.read(f"lateral_{name}") for name in ("displacement", "force"))
        assert np.abs(y[0]).max() == 0.0
        assert 0.05 < np.abs(y[:, 0]).max() < 0.2
        assert (np.sign(p[60]) == np.sign(y[60])).all()  # it resists
        low, high, when, _ = data.envelope("lateral_displacement")
        assert low == pytest.approx(y.min(axis=0), abs=1e-9)
        assert high == pytest.approx(y.max(axis=0), abs=1e-9)
        assert data.axis[np.abs(y[:, 0] - low[0]).argmin()] == pytest.approx(when[0])
        moment = data.read_tube(1, "moment_y")
        assert np.abs(moment[:, 0]).max() < 1e-3 * np.abs(moment).max()  # nothing turns the head
        shear = data.read_tube(1, "shear_x")[:, 0]
        acceleration = np.gradient(
            np.gradient(data.read_tube(1, "displacement_x")[:, 0], 0.05), 0.05
        )
        ramp = np.where(data.axis < 2.0, 0.5 - 0.5 * np.cos(0.5 * np.pi * data.axis), 1.0)
        load = 1e6 * ramp * np.sin(0.5 * np.pi * data.axis)
        balance = load - 200e3 * acceleration - shear  # of the mass on the head
        assert np.median(np.abs(balance)) < 0.02 * np.abs(load).max()


def test_envelopes_hold_steps_that_are_not_recorded(tmp_path):
    """A row in ten, the envelope of all."""
    text = deck(friction(0.9, 40.0), SWAY)
    assert run(tmp_path, text) == ExitCode.DONE
    with open_database(tmp_path / "case.dst") as database:
        every = database.foundation("F1").envelope("lateral_force")
    assert run(tmp_path, text.replace("*EXEC", "*DTREC\n0.5\n*EXEC")) == ExitCode.DONE
    with open_database(tmp_path / "case.dst") as database:
        data = database.foundation("F1")
        assert data.axis == pytest.approx(np.linspace(0.0, 6.0, 13))
        for one, other in zip(every, data.envelope("lateral_force"), strict=True):
            assert one == pytest.approx(other)


def test_static_and_dynamic_contribution(tmp_path):
    """IDRE 0 and 1 move alike; 0 shows what the soil resisted at the end of statics, too."""
    still = "*LOAD\nSTEADY 1 10 5e5 0 0\n*QUASISTATIC\n1 STEADY 1\n"
    found = []
    for rule in (0, 1, 2):
        assert run(tmp_path, deck(friction(0.9, 40.0), still, SWAY, rule=rule)) == ExitCode.DONE
        with open_database(tmp_path / "case.dst") as database:
            data = database.foundation("F1")
            found.append((data.read("lateral_displacement"), data.read("lateral_force")))
    (y0, p0), (y1, p1), (y2, p2) = found
    assert y0 == pytest.approx(y1, abs=1e-7)
    assert np.abs(p1[0]).max() == 0.0
    assert p0 - p0[0] == pytest.approx(p1, abs=1e-4 * np.abs(p0).max())
    assert y2[0] == pytest.approx(y0[0], abs=1e-7)
    assert p2[0] == pytest.approx(p0[0], abs=1e-4 * np.abs(p0).max())
    assert np.abs(y2 - y0).max() > 1e-3  # one curve, and another one about statics


@pytest.mark.parametrize("loads", ["1e6 0 0", "8e5 6e5 0"])
def test_directions_are_alike(tmp_path, loads):
    """Planar, spatial, and both at an angle: the same head, to what iterations may leave."""
    text = deck(friction(0.9, 40.0), SWAY).replace("1e6 0 0", loads)
    heads = []
    for more in ("", "*MODEL, SPATIAL\n"):
        assert run(tmp_path, text.replace("*EXEC", f"{more}*EXEC")) == ExitCode.DONE
        with open_database(tmp_path / "case.dst") as database:
            data = database.foundation("F1")
            x, y = (data.read_tube(1, f"displacement_{a}")[:, 0] for a in "xy")
            heads.append(np.hypot(x, y))
    assert heads[0] == pytest.approx(heads[1], abs=5e-4 * heads[0].max())


# --- what fails in OpenSees (peers, section 5) ----------------------------------------------------


def settled(folder: Path) -> np.ndarray:
    with open_database(folder / "case.dst") as database:
        return -database.foundation("F1").read_tube(1, "displacement_z")[:, 0]


def test_4_mn_put_suddenly_on_10(tmp_path):
    """Peers 1 and 2: shaft 16.2 MN, no tip. The usual fallbacks end at four times the settlement;
    here two accuracies agree, the shaft has slipped, and the pile stays."""
    ends = []
    for accuracy in (3e-2, 1e-2):
        more = f"*DYNAMIC\n0 2\n*MODEL HYSTERESIS=MASING\n*ACCURACY\n{accuracy}\n"
        heavy = HEAVY.format(still=-10e6, push=-4e6)
        assert run(tmp_path, deck(friction(1.0), heavy, SUDDEN, more, rule=2)) == ExitCode.DONE
        way = settled(tmp_path)
        ends.append((way.max(), way[-1]))
    assert ends[0] == pytest.approx(ends[1], rel=2e-2)
    assert 1.8 * 0.0133 < ends[1][0] < 0.04


@pytest.mark.parametrize(
    ("still", "push", "residual", "history"),
    [
        (-15e6, -2e6, 1.0, "*HARMONIC\nPUSH 4.0 0\n*DAMPING\n0.02 0.25 5\n"),
        (-12e6, -3e6, 0.7, SUDDEN),
    ],
    ids=["peers 3", "peers 4"],
)
def test_a_pile_that_plunges_is_told(tmp_path, capsys, still, push, residual, history):
    """Not metres of settlement without a word: it stops, and says that the pile is lost."""
    more = "*DYNAMIC\n0 20\n*MODEL HYSTERESIS=MASING\n*ACCURACY\n1e-2\n"
    text = deck(friction(residual), HEAVY.format(still=still, push=push), history, more, rule=2)
    assert run(tmp_path, text) == ExitCode.FAILED
    told = capsys.readouterr().err
    assert "the foundation is lost" in told
    assert "motion stops at" in told
    way = settled(tmp_path)
    assert 2.0 < way[-1] < 2.5  # a diameter of 2 m, and no further
    with open_database(tmp_path / "case.dst") as database:
        assert database.status == "stopped"
        assert "lost" in database.stop_reason


def test_limits_of_newton_and_long_steps(tmp_path):
    """Peers 9 and 10: balance to 1e-9, eight times the load, steps of an eighth of its period."""
    text = deck(friction(0.9, 40.0), SWAY).replace("1e6 0 0", "8e6 0 0")
    exact = "*NEWTONDYN\n60 1e-9 1e-9 1e-9 1e-9\n*EXEC"
    text = text.replace("0 6 0.05", "0 6 0.5").replace("*EXEC", exact)
    assert run(tmp_path, text) == ExitCode.DONE
    with open_database(tmp_path / "case.dst") as database:
        left = database.foundation("F1").read("convergence/residual")
    assert np.median(left) < 0.1  # HHT balances a mean of two times


# --- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ("*MODEL, SPATIAL, HYSTERESIS=GAP\n", "GAP follows motion in one plane"),
    ],
)
def test_what_cannot_be_had_is_told_before_anything_is_solved(tmp_path, capsys, more, words):
    text = deck(friction(0.9, 40.0), SWAY).replace("*EXEC", f"{more}*EXEC")
    assert run(tmp_path, text) == ExitCode.USAGE
    assert words in capsys.readouterr().err
    assert not list(tmp_path.glob("case.d[st]*t")) + list(tmp_path.glob("case.dss"))


def test_an_explicit_step_beyond_its_limit_is_refused(tmp_path, capsys):
    text = deck(friction(0.9, 40.0), SWAY).replace("0 6 0.05", "0 6 0.05 METHOD=CENTRAL")
    assert run(tmp_path, text) == ExitCode.USAGE
    assert "METHOD=CENTRAL is stable with steps up to" in capsys.readouterr().err


def test_the_reduced_model_moves_as_the_full_one(tmp_path):
    """The sample in its first two periods: planar as it is chosen, against spatial with P-delta."""
    sample = Path(__file__).parents[1] / "sample_dbs" / "conductor_waves.deck"
    text = re.sub(r"\*DYNAMIC\n0 \d+", "*DYNAMIC\n0 16", sample.read_text())
    found = []
    for more in ("", "*MODEL, SPATIAL, PDELTA\n"):
        assert run(tmp_path, text.replace("*EXEC", f"{more}*EXEC")) == ExitCode.DONE
        with open_database(tmp_path / "case.dst") as database:
            data = database.foundation("F1")
            names = ("lateral_displacement", "lateral_force")
            found.append([np.concatenate(data.envelope(name)[:2]) for name in names])
    (y, p), (full_y, full_p) = found
    assert np.abs(y - full_y).max() < 1e-3 * np.abs(full_y).max()
    assert np.abs(p).max() == pytest.approx(np.abs(full_p).max(), rel=1e-3)


def test_records_fall_on_round_times_whatever_the_step(tmp_path):
    """A step that the accuracy chooses divides the recording interval, and times do not drift."""
    text = deck(friction(0.9, 40.0), SWAY).replace("0 6 0.05", "0 6")
    assert run(tmp_path, text.replace("*EXEC", "*DTREC\n0.4\n*EXEC")) == ExitCode.DONE
    with open_database(tmp_path / "case.dst") as database:
        times = database.foundation("F1").axis
    assert times.tolist() == pytest.approx((0.4 * np.arange(16)).tolist(), abs=1e-12)
