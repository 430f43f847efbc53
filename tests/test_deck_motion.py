"""What the keywords of motion become: each one's values in the scene, defaults and notes."""

from math import pi, radians
from pathlib import Path

import pytest

from podeep.deck.read import Deck, read_deck
from podeep.scene import CoupledSpring, Damping, Dynamics, Harmonic, Mass, Start, Steps

BASE = (Path(__file__).parent / "data" / "decks" / "base.deck").read_text(encoding="utf-8")
RUN = "*DYNAMIC\n0 60\n"
ROWS = "1 WEIGHT 1\n2 STORM 0.5 PUSH 1\n3 STORM 1\n"


def read(folder: Path, more: str, old: str = "", new: str = "") -> Deck:
    """The base deck with more keywords, and one text of it changed."""
    assert not old or BASE.count(old) == 1
    path = folder / "a.deck"
    path.write_text(BASE.replace(old, new).replace("*EXEC", f"{more}\n*EXEC"), encoding="utf-8")
    return read_deck(path)


def notes(folder: Path, more: str) -> tuple[str, ...]:
    return read(folder, more).notes


def test_a_static_deck_has_nothing_of_motion(tmp_path: Path) -> None:
    scene = read(tmp_path, "").scene
    assert (scene.masses, scene.coupled_springs, scene.starts) == ((), (), ())
    assert (scene.harmonics, scene.series, scene.damping, scene.dynamics) == ((), (), None, None)
    assert (scene.numerics.hysteresis, dict(scene.ground.dashpots)) == ("ELASTIC", {})


def test_masses(tmp_path: Path) -> None:
    deck = read(tmp_path, "*MASS\n1 -58 350e3\n1 -110 0 1 2e3 3\n1 -50 5 JYY=7")
    assert deck.scene.masses == (
        Mass(1, -58.0, 350e3),
        Mass(1, -110.0, 0.0, (1.0, 2e3, 3.0)),
        Mass(1, -50.0, 5.0, (0.0, 7.0, 0.0)),
    )
    assert deck.notes == ("the mass of tube 1 at -50 m stands 8 m above its top, on a rigid arm",)
    assert deck.scene.marks(deck.scene.foundations[0])[-1] == -58.0


def test_coupled_springs(tmp_path: Path) -> None:
    scene = read(tmp_path, "*STIFFNESS\n1 -60 4e9 -6e10 9e11\n1 -110 1 0 0").scene
    assert scene.coupled_springs == (
        CoupledSpring(1, -60.0, 4e9, -6e10, 9e11),
        CoupledSpring(1, -110.0, 1.0, 0.0, 0.0),
    )


def test_dashpots(tmp_path: Path) -> None:
    ground = read(tmp_path, "*RADIATION\n1 4e5\n3 0\n*RADIATION 2 7").scene.ground
    assert dict(ground.dashpots) == {1: 4e5, 3: 0.0, 2: 7.0}


def test_starts(tmp_path: Path) -> None:
    scene = read(tmp_path, f"{RUN}*INITIAL\n1 -58 X 0.05 -0.2\n1 -58 RY 2 -3").scene
    assert scene.starts == (
        Start(1, -58.0, "X", 0.05, -0.2),
        Start(1, -58.0, "RY", radians(2.0), radians(-3.0)),
    )


def test_sines(tmp_path: Path) -> None:
    scene = read(tmp_path, f"{RUN}*HARMONIC\nstorm 12.5 90 25\nPUSH 4 0").scene
    assert scene.harmonics == (Harmonic("STORM", 12.5, radians(90.0), 25.0), Harmonic("PUSH", 4.0))


@pytest.mark.parametrize("text", ["*DAMPING\n0.02 0.5 3", "*DAMPING\nF2=0.5 F1=3 RATIO=0.02"])
def test_damping_by_a_ratio_at_two_frequencies(tmp_path: Path, text: str) -> None:
    damping = read(tmp_path, RUN + text).scene.damping
    assert damping is not None
    for omega in (2.0 * pi * 0.5, 2.0 * pi * 3.0):
        ratio = 0.5 * (damping.mass_factor / omega + damping.stiffness_factor * omega)
        assert ratio == pytest.approx(0.02)


@pytest.mark.parametrize(
    ("text", "damping"),
    [
        ("*DAMPING ALPHA=0.1 BETA=2e-3", Damping(0.1, 2e-3)),
        ("*DAMPING\nbeta=2e-3", Damping(0.0, 2e-3)),
        ("*DAMPING, ALPHA=0.1", Damping(0.1)),
    ],
)
def test_damping_by_factors(tmp_path: Path, text: str, damping: Damping) -> None:
    assert read(tmp_path, RUN + text).scene.damping == damping


@pytest.mark.parametrize(
    ("line", "dynamics"),
    [
        ("0 60", Dynamics(0.0, 60.0)),
        ("5 60 0", Dynamics(5.0, 60.0)),
        ("0 60 0.05", Dynamics(0.0, 60.0, 0.05)),
        ("0 60 0.05 7 0", Dynamics(0.0, 60.0, 0.05)),
        *((f"0 60 0 7 {option}", Dynamics(0.0, 60.0, method="NEWMARK")) for option in (1, 2, 3, 4)),
        ("0 60 METHOD=bathe", Dynamics(0.0, 60.0, method="BATHE")),
        ("0 60 0.05 7 1 METHOD=HHT", Dynamics(0.0, 60.0, 0.05, method="HHT")),
    ],
)
def test_the_run(tmp_path: Path, line: str, dynamics: Dynamics) -> None:
    assert read(tmp_path, f"*DYNAMIC\n{line}").scene.dynamics == dynamics


def test_how_steps_are_taken(tmp_path: Path) -> None:
    more = "*DYNIMP\n50 0.6 0.4 1\n*DTREC\n0.25\n*DYNAMIC\n0 60 0.1 7 1"
    assert read(tmp_path, more).scene.dynamics == Dynamics(
        0.0, 60.0, 0.1, "NEWMARK", 0.6, 0.4, True, 50, recording=0.25
    )
    plain = read(tmp_path, RUN + "*DYNIMP\n20").scene.dynamics
    assert plain == Dynamics(0.0, 60.0, iterations=20)


def test_the_tightest_ratio_holds(tmp_path: Path) -> None:
    dynamics = read(tmp_path, RUN + "*NEWTONDYN\n40 0.05 0.02 PMAXD4=0.03").scene.dynamics
    assert dynamics == Dynamics(0.0, 60.0, iterations=40, tolerance=0.02)
    default = read(tmp_path, RUN + "*NEWTONDYN\n40").scene.dynamics
    assert default == Dynamics(0.0, 60.0, iterations=40, tolerance=0.1)


@pytest.mark.parametrize("word", ["ELASTIC", "MASING", "GAP"])
def test_hysteresis(tmp_path: Path, word: str) -> None:
    old = "*MODEL ELEMENTS=20"
    scene = read(tmp_path, "", old, f"{old} HYSTERESIS={word.lower()}").scene
    assert scene.numerics.hysteresis == word


def test_steps_leave_out_what_has_a_history(tmp_path: Path) -> None:
    more = RUN + "*HARMONIC\nstorm 12 0\n*TIMESERIES PUSH\n0 1"
    deck = read(tmp_path, more, ROWS, "2\n")
    assert deck.scene.steps == Steps(("STORM", "WEIGHT", "PUSH"), ((0, 0.5, 0), (0, 1, 0)))
    assert not any("in all steps" in note for note in deck.notes)


def test_rows_of_steps_still_name_what_has_a_history(tmp_path: Path) -> None:
    plain = read(tmp_path, "").scene.steps
    assert read(tmp_path, RUN + "*HARMONIC\nSTORM 12 0").scene.steps == plain


def test_one_step_without_quasistatic_leaves_it_out_too(tmp_path: Path) -> None:
    deck = read(tmp_path, RUN + "*HARMONIC\nSTORM 12 0", f"*QUASISTATIC\n{ROWS}", "")
    assert deck.scene.steps.factors == ((0.0, 1.0, 1.0),)
    assert (
        "without *QUASISTATIC there is one step with all loads without a history at factor 1"
        in deck.notes
    )


def test_without_a_run_histories_do_nothing(tmp_path: Path) -> None:
    deck = read(tmp_path, "*HARMONIC\nSTORM 12 0", ROWS, "2\n")
    assert deck.scene.steps.factors == ((0.5,) * 3, (1.0,) * 3)
    assert deck.notes == ("*HARMONIC has no effect without *DYNAMIC",)


NEEDING = {
    "INITIAL": "1 -58 X 0 1",
    "HARMONIC": "STORM 12 0",
    "TIMESERIES": "STORM\n0 1",
    "DAMPING": "0.01 1 2",
    "DTREC": "0.1",
    "DYNIMP": "30",
    "NEWTONDYN": "30",
}


@pytest.mark.parametrize("keyword", NEEDING)
def test_what_needs_a_run(tmp_path: Path, keyword: str) -> None:
    more = f"*{keyword}\n{NEEDING[keyword]}\n"
    note = f"*{keyword} has no effect without *DYNAMIC"
    assert notes(tmp_path, more) == (note,)
    assert note not in notes(tmp_path, more + RUN)


@pytest.mark.parametrize(
    ("more", "note"),
    [
        *(
            (
                f"*DYNAMIC\n0 60 0 7 {option}",
                f"IOPDYN {option} is plain Newmark here: where a step starts to iterate is our "
                "choice",
            )
            for option in (2, 3, 4)
        ),
        ("*DYNAMIC\n0 60 0 7 2 METHOD=HHT", "METHOD=HHT holds in place of IOPDYN 2"),
        (
            RUN + "*DYNIMP\n30 DELTA=0.6",
            "DELTA of *DYNIMP is for Newmark, and has no effect on the default method",
        ),
        (
            "*DYNAMIC\n0 60 METHOD=BATHE\n*DYNIMP\n30 ALPHA=0.3",
            "ALPHA of *DYNIMP is for Newmark, and has no effect on BATHE",
        ),
        (
            "*DYNAMIC\n0 60 METHOD=NEWMARK\n*DYNIMP\n30 0.5 0.1",
            "Newmark with DELTA 0.5 and ALPHA 0.1 is stable for short steps alone; "
            "2 ALPHA >= DELTA is for any",
        ),
        (RUN + "*DYNIMP\n30 ITMIN=3", "ITMIN of *DYNIMP has no effect here"),
        (RUN + "*NEWTONDYN\n30 IKRIG=-1", "IKRIG of *NEWTONDYN has no effect here"),
        (RUN + "*NEWTONDYN\n30 IKDIV=4", "IKDIV of *NEWTONDYN has no effect here"),
        (
            RUN + "*NEWTONDYN\n40\n*DYNIMP\n30",
            "ITEMAX of *NEWTONDYN holds in place of that of *DYNIMP",
        ),
    ],
)
def test_what_has_no_effect_is_noted(tmp_path: Path, more: str, note: str) -> None:
    assert notes(tmp_path, more + "\n*HARMONIC\nSTORM 12 0") == (note,)


@pytest.mark.parametrize(
    "more",
    [
        "*DYNAMIC\n0 60 0.1 7 1\n*DYNIMP\n30 0.6 0.31",
        "*DYNAMIC\n0 60 0 7 0 METHOD=HHT",
        RUN + "*DYNIMP\nIOPTDT=1\n*NEWTONDYN\n40 0.01\n*DTREC\n1",
    ],
)
def test_nothing_is_noted_where_all_has_effect(tmp_path: Path, more: str) -> None:
    assert notes(tmp_path, more + "\n*INITIAL\n1 -58 X 0 1") == ()


def test_motion_without_a_cause_is_noted(tmp_path: Path) -> None:
    assert notes(tmp_path, RUN) == (
        "no history and no start: in motion the loads stay as the steps leave them",
    )
