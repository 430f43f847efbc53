"""The page on motion: its formulas and its numbers are those of the code."""

import re
from math import pi

import pytest

from manual import DOCS
from podeep import motion_log, run_motion
from podeep.deck.read import read_deck
from podeep.motion import METHODS, Harmonic
from podeep.solve import dynamics, pace, plan, ready
from podeep.solve.drive import harmonic
from podeep.solve.integrators import Weighted

PAGE = (DOCS / "motion.md").read_text(encoding="utf-8")
SESSIONS = (DOCS / "sessions.md").read_text(encoding="utf-8")
WORDS = {2: "two", 3: "three", 4: "four", 20: "twentieth", 40: "fortieth"}


def says(*parts: str) -> None:
    text = re.sub(r"\s+", " ", PAGE)
    for part in parts:
        assert part in text, part


def test_every_method_is_in_the_table() -> None:
    (table,) = re.findall(r"^\| `METHOD`.*?\n\n", PAGE, re.M | re.S)
    named = set(re.findall(r"^\|.*?`(\w+)`.*?\|", table, re.M))
    assert named == {"METHOD", *METHODS}


def test_the_weights_of_methods() -> None:
    """The rows of the table of weights, read as formulas."""

    def value(cell: str, **names: float) -> float:
        text = re.sub(r"\\frac(?:{(.*?)}{(.*?)}|(\d)(\d))", r"((\1\3)/(\2\4))", cell.strip(" $"))
        text = text.replace("^2", "**2").replace("2\\rho", "2*rho").replace("\\", "")
        return float(eval(re.sub(r"\) \(", ") * (", text), names))

    for title, made, names in (
        ("HHT, $\\alpha$", Weighted.hht(-0.07), {"alpha": -0.07}),
        ("generalised alpha, $\\rho$", Weighted.generalised_alpha(0.6), {"rho": 0.6}),
    ):
        (row,) = (line for line in PAGE.splitlines() if line.startswith(f"| {title} |"))
        cells = [c.strip() for c in row.split("|")[2:-1]]
        am, af = (value(c, **names) for c in cells[:2])
        names |= {"alpha_m": am, "alpha_f": af}
        expected = (made.mass_lag, made.force_lag, made.gamma, made.beta)
        assert (am, af, *(value(c, **names) for c in cells[2:])) == pytest.approx(expected)


def test_numbers_in_prose() -> None:
    says(
        rf"$\alpha = {dynamics._ALPHA:g}$",
        rf"$\rho_\infty = {dynamics._RADIUS:g}$",
        f"a {WORDS[plan._PARTS]} of the shortest period of `*HARMONIC` or a "
        f"{WORDS[plan._OWN_PARTS]} of the foundation's own",
        f"Up to {WORDS[plan.TRIALS]} trials, over {WORDS[int(plan._PERIODS)]} of the longest "
        f"periods or {plan._SERIES_STEPS} steps from the onset of loads, scale it to an error of "
        "half the accuracy",
        f"within 1/{1 / plan._SHORTEST:g} and {plan._LONGEST:g} times the first one",
        f"half the step, {WORDS[run_motion.RESTARTS]} times at most",
        rf"up to $2^{{{dynamics.HALVINGS}}}$ parts",
        f"below {100 * plan._SHARE:g} % of the accuracy",
        f"$(TFIN - TINI)/{motion_log.RECORDS}$",
    )
    assert (plan.AIM, pace.FINER, ready._MESH_SHARE) == (0.5, 0.5, 0.5)


def test_the_ramp_is_half_a_wave_of_a_cosine() -> None:
    one = Harmonic("A", 4.0, 0.5 * pi, ramp=8.0)
    assert [harmonic(one, 2.0 + t, 2.0)[0] for t in (0.0, 4.0, 8.0)] == pytest.approx(
        [0.0, -0.5, -1.0]
    )


def test_rayleighs_factors() -> None:
    path = DOCS.parent / "sample_dbs" / "conductor_waves.deck"
    damping = read_deck(path).scene.damping
    assert damping is not None
    share, first, last = 0.01, 0.2 * pi, 4.0 * pi
    assert damping.mass_factor == pytest.approx(2 * share * first * last / (first + last))
    assert damping.stiffness_factor == pytest.approx(2 * share / (first + last))


def test_sessions_are_included_as_they_are() -> None:
    """Every transcript of a real run stands in the manual; lines that are cut end in a table."""
    included = re.findall(r"transcripts/(motion_\w+)\.txt", SESSIONS)
    assert included == ["motion_evolution", "motion_snapshots", "motion_envelope"]
    (last,) = re.findall(r"motion_evolution\.txt\n(?::.*\n)*?:lines: 2-(\d+)$", SESSIONS, re.M)
    text = (DOCS.parent / "tests" / "transcripts" / "motion_evolution.txt").read_text("utf-8")
    assert re.fullmatch(r" +\d+\.\d( +-?0\.\d{7}){4}", text.splitlines()[int(last) - 1])
