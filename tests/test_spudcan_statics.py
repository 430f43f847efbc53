"""A leg on a spudcan: closed forms of a cantilever on springs, and loads near the yield surface."""

import re
from pathlib import Path

import numpy as np
import pytest

from podeep.checks import warnings
from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.deck.read import read_deck
from podeep.model.footing import footing
from podeep.solve.analysis import solve

LEG, EI, EA = 63.0, 4.0e11, 1.2e11
HEAD = "*SUPPORT\n1 0 RY\n"


def deck(spudcan: str, *, support: str = "", across: str = "1e6 0", steps: int = 4) -> str:
    """A leg without soil around it, 60 m of water, its tip 3 m below the mudline."""
    return (
        "*DEPTH\n-60\n*GROUNDEPTH\n0\n*GROUNDPROP\n0 0\n"
        f"*CASING\n1 LEG\n0 -63 3 0.06 210e9 7850 EI={EI!r} EA={EA!r}\n*FONDATION\n1 1\n"
        f"*SPUDCAN\n{spudcan}\n{support}*LOAD\nDOWN 1 0 0 0 -40e6\nSIDE 1 0 {across} 0\n"
        f"*QUASISTATIC\n1 DOWN 1\n"
        + "".join(f"{i + 1} SIDE {i}\n" for i in range(1, steps + 1))
        + "*MODEL, SMALL\n*EXEC\n"
    )


def solved(folder: Path, text: str):
    path = folder / "leg.deck"
    path.write_text(text)
    scene = read_deck(path).scene
    return scene, solve(scene, scene.foundations[0])


def test_an_elastic_spudcan_is_three_springs(tmp_path):
    scene, one = solved(tmp_path, deck("1 14 3 40e6 0.5"))
    springs = footing(scene.spudcans[0]).stiffness
    results, top = one.results, np.array([-60.0])
    for step in range(2, 6):
        H = 1e6 * (step - 1)
        across = H / springs.horizontal + H * LEG**2 / springs.rotational + H * LEG**3 / (3.0 * EI)
        assert results.deflection(top)[step, 0, 0] == pytest.approx(float(across), rel=1e-9)
        down = 40e6 / springs.vertical + 40e6 * LEG / EA
        assert results.settlement(top)[step, 0] == pytest.approx(float(down), rel=1e-9)
    settlement, force = results.tip()
    assert force[-1] == pytest.approx(40e6)
    assert settlement[-1] == pytest.approx(float(40e6 / springs.vertical))


@pytest.mark.parametrize("across", ["1e6 0", "0 1e6", "6e5 8e5"])
def test_the_rotational_spring_softens_as_the_standard_asks(tmp_path, across):
    """A cantilever's moment at the spudcan is H times its length, whatever the springs are."""
    scene, one = solved(tmp_path, deck("1 14 3 40e6 0.5 100e6 SOIL=SAND", across=across))
    under = footing(scene.spudcans[0])
    surface, springs = under.surface, under.stiffness
    top = np.array([-60.0])
    found = np.hypot(*one.results.global_vector(one.results.deflection(top)))[:, 0]
    kept = [state.softening for state in one.states]
    assert one.failure is not None
    assert kept[:2] == [1.0, 1.0]
    for step in range(2, len(one.states)):
        H = 1e6 * (step - 1)
        ratio = surface.utilisation(40e6, H, H * LEG)
        assert kept[step] == pytest.approx(float(surface.reduction(ratio)), rel=1e-8)
        rocking = H * LEG**2 / (kept[step] * springs.rotational)
        across_ = H / springs.horizontal + rocking + H * LEG**3 / (3.0 * EI)
        assert found[step] == pytest.approx(float(across_), rel=1e-7)
    assert len(one.states) == 3  # 2 MN at 63 m are more than the surface allows


def test_a_held_head_takes_over_and_the_loads_stay_on_the_surface(tmp_path):
    text = deck("1 14 3 40e6 0.5 100e6 SOIL=SAND", support=HEAD, steps=6)
    scene, one = solved(tmp_path, text)
    surface = footing(scene.spudcans[0]).surface
    assert one.failure is None
    kept = np.array([state.softening for state in one.states])
    assert (np.diff(kept) <= 1e-12).all()
    assert kept[-1] < 0.1
    for state in one.states[2:]:
        system = one.model.lateral.system.softened(state.softening)
        loads = one.model.footing.across(system, state.lateral)
        ratio = float(surface.utilisation(40e6, *loads))
        if state.softening > 0.1:
            assert state.softening == pytest.approx(float(surface.reduction(ratio)), rel=1e-6)
        else:
            assert ratio == pytest.approx(1.0, rel=1e-6)
        assert loads[0] == pytest.approx(1e6 * (state.step - 1), rel=1e-9)


def test_loads_outside_the_surface_end_the_run_and_keep_the_steps(tmp_path, capsys):
    path = tmp_path / "leg.deck"
    path.write_text(deck("1 14 3 40e6 0.5 100e6 SOIL=SAND"))
    assert main(["run", str(path), "-o", str(tmp_path)]) == 1
    message = capsys.readouterr().err
    assert "the loads on the spudcan lie outside its yield surface" in message
    assert "there it carries V 4e+07 N, H 1." in message
    assert "of QV 1e+08 N, QH 1.2e+07 N, QM 1.05e+08 N m; with that V and H, M up to" in message
    assert re.search(r"beyond \d\d\.\d+% of step 3", message)
    with open_database(tmp_path / "leg.dss") as database:
        assert database.status == "stopped"


def test_the_part_of_a_step_that_is_reached_lies_on_the_surface(tmp_path):
    """A cantilever's loads grow with one factor: rf = 1 there, whatever the steps."""
    text = deck("1 14 3 40e6 0.2 100e6 SOIL=SAND").split("*QUASISTATIC")[0]
    scene, one = solved(tmp_path, text.replace("1e6 0 0", "2e6 0 0") + "*QUASISTATIC\n1\n*EXEC\n")
    surface, part = footing(scene.spudcans[0]).surface, one.failure.reached
    inside, outside = (
        surface.utilisation(40e6 * f, 2e6 * f, 2e6 * f * LEG) for f in (part, part + 2.0**-15)
    )
    assert inside <= 1.0 + 1e-9 < outside


def test_more_weight_than_the_preload_is_outside(tmp_path):
    _, one = solved(tmp_path, deck("1 14 3 40e6 0.5 39e6 SOIL=SAND"))
    assert one.failure is not None
    assert one.failure.step == 1  # already under its weight alone


@pytest.mark.parametrize(
    ("spudcan", "message"),
    [
        ("1 14 3 40e6 0.5 1e8", "which is not given; give SOIL=CLAY with SU, or SOIL=SAND"),
        ("1 14 3 40e6 0.5 SOIL=CLAY", "needs the clay's strength; give SU"),
        ("1 14 3 40e6 0.6", "NU is 0.6, but must be 0 to 0.5"),
        ("2 14 3 40e6 0.5", "there is no tube 2"),
        ("1 14 3 40e6 0.5\n1 10 3 40e6 0.5", "tube 1 already has a spudcan"),
    ],
)
def test_faults(tmp_path, capsys, spudcan, message):
    path = tmp_path / "leg.deck"
    path.write_text(deck(spudcan))
    assert main(["check", str(path)]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("spudcan", "down", "message"),
    [
        ("1 14 3 40e6 0.5", 50e6, "uplift of 50000 kN (step 1): a spudcan without suction"),
        ("1 14 3 40e6 0.5 9e7 SOIL=CLAY SU=60e3 GAMMA=8e3", -1e6, "the soil bears 63990 kN"),
    ],
)
def test_what_a_spudcan_cannot_do_is_told_before(tmp_path, spudcan, down, message):
    path = tmp_path / "leg.deck"
    path.write_text(deck(spudcan).replace("-40e6", repr(down)))
    assert any(message in line for line in warnings(read_deck(path).scene))


def test_a_step_without_load_is_at_rest(tmp_path, capsys):
    path = tmp_path / "leg.deck"
    path.write_text(deck("1 14 3 40e6 0.5 100e6 SOIL=SAND").replace("1 DOWN 1", "1 DOWN 0"))
    scene = read_deck(path).scene
    assert solve(scene, scene.foundations[0]).states[1].softening == 1.0
