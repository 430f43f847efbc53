"""All warnings of a scene: tubes, spudcans, sample decks, commands, and any legal scene."""

import json
import re
from dataclasses import replace
from math import radians
from pathlib import Path

import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis import given, settings

from moving_piles import swaying_pile
from podeep import embedded, run
from podeep.checks import warnings
from podeep.cli.solve import main
from podeep.deck.read import read_deck
from podeep.errors import ExitCode
from podeep.risks.bearing import tip_support_check
from podeep.scene import Curve, Load, Numerics, Section, Spudcan, Steps, Tube
from risky import CLAY, LINE, OFF, OPTIONS, SHAFT, SOUND, TIP, curve, scene

ROOT = Path(__file__).parents[1]
SAMPLES = ROOT / "sample_dbs"


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ((2.134, 0.05, 210e9, 7850.0), None),
        ((2134.0, 50.0, 210e9, 7850.0), "OD = 2134 m: above 20 m it is as a rule a slip"),
        ((84.0, 2.0, 210e9, 7850.0), "write 2.134 if 84 in is meant"),
        ((2.0, 0.05, 210.0, 7850.0), "write 210e9 if 210 GPa is meant"),
        ((2.0, 0.05, 2.1e5, 7850.0), "write 210e9 if 210000 MPa is meant"),
        ((2.0, 0.05, 2.1e8, 7850.0), "write 210e9 if 2.1e+08 kPa is meant"),
        ((2.0, 0.05, 1e9, 7850.0), None),
        ((2.0, 0.05, 210e9, 7.85), "write 7850 if 7.85 t/m3 is meant"),
        ((2.0, 0.05, 210e9, 77.0), "write 7849 if 77 kN/m3 is meant"),
        ((2.0, 0.05, 210e9, 77e3), "write 7849 if 77000 N/m3 is meant"),
        ((2.0, 0.05, 210e9, 0.0), None),
        ((2.0, 0.01, 210e9, 7850.0), None),
        (
            (2.0, 0.00999, 210e9, 7850.0),
            "D/t = 200.2: driven piles have 6.35 mm + D/100, here 26.35",
        ),
    ],
)
def test_tubes_in_a_wrong_unit(section, words):
    pile = scene(CLAY, SHAFT)
    tube = Tube(
        1, "", (Section(5.0, -1.0, 2.0, 0.05, 210e9, 7850.0), Section(-1.0, -40.0, *section))
    )
    lines = [w for w in warnings(replace(pile, tubes={1: tube})) if w.startswith("tube 1")]
    assert [words in line for line in lines] == [True] * (words is not None)


def test_a_modulus_that_overrides_replace_is_not_judged():
    section = Section(5.0, -40.0, 2.0, 0.05, 1.0, 7850.0, bending_stiffness_override=1e10)
    pile = scene(CLAY, SHAFT)
    assert len(warnings(replace(pile, tubes={1: Tube(1, "", (section,))}))) == 1
    section = replace(section, axial_stiffness_override=1e10)
    assert warnings(replace(pile, tubes={1: Tube(1, "", (section,))})) == []


CAN = Spudcan(
    *(1, 14.0, 3.0, 40e6, 0.5, 50e6, "CLAY", 60e3),
    vertical_factor=1.2,
    horizontal_factor=1.2,
    rotational_factor=1.2,
)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, None),
        ({"embedment": 0.0, "vertical_factor": 1.0}, None),
        (
            dict.fromkeys(("vertical_factor", "horizontal_factor", "rotational_factor"), 1.0),
            "KD1 = KD2 = KD3 = 1 at Dp = 3 m, Dp/B = 0.214: 1 is the lower bound",
        ),
        ({"poisson_ratio": 0.45}, None),
        ({"poisson_ratio": 0.44}, "NU = 0.44 with SOIL=CLAY: it is 0.5 in undrained clay"),
        ({"soil": "SAND"}, "NU = 0.5 with SOIL=SAND"),
        ({"soil": "SAND", "poisson_ratio": 0.3}, None),
        ({"preload": 1e6}, None),
        ({"preload": 0.999e6}, "V_PRELOAD = 999 kN and a vertical load of 1000 kN (step 2)"),
        ({"preload": None}, None),
        ({"shear_modulus": 40.0}, "G = 40 Pa"),
        ({"undrained_shear_strength": 60.0}, "write 60e3 if 60 kPa is meant"),
        ({"relative_density": 0.007}, "DR = 0.7 %"),
    ],
)
def test_spudcans(changes, words):
    lines = warnings(scene(CLAY, SHAFT, spudcans=(replace(CAN, **changes),)))
    assert [words in line for line in lines] == [True] * (words is not None)
    assert all(line.startswith("F1 spudcan: ") for line in lines)


def test_one_warning_a_curve_and_parameter_in_a_fixed_order():
    odd = curve("p-y", "soft_clay", 7, undrained_shear_strength=200e3, strain_50=0.03)
    worse = curve("p-y", "soft_clay", 3, undrained_shear_strength=20.0, multiplier=1.5)
    pile = scene((odd, worse, odd), SHAFT, 6.0, 24.0, depths=(0.0, 30.0, 60.0), wall=0.1)
    lines = warnings(pile)
    assert lines == warnings(pile)
    assert [line.split(" = ")[0] for line in lines] == [
        *("p-y curve 3: CU", "p-y curve 3: PMULT"),
        *("p-y curve 7: CU", "p-y curve 7: EPSC", "F1: D"),
        lines[-1],
    ]
    assert lines[-1].startswith("F1: CU falls from 200 kPa (p-y 7) to 20 Pa (p-y 3) at 30 m")


def test_a_curve_at_no_depth_is_not_judged():
    pile = scene(CLAY, SHAFT)
    idle = {**pile.ground.lateral_curves, 9: curve("p-y", "soft_clay", 9, strain_50=0.1)}
    assert warnings(replace(pile, ground=replace(pile.ground, lateral_curves=idle))) == []


def test_what_cannot_be_evaluated_is_left_to_the_model():
    """Overburden that no curve gives, and rows without a limit of friction."""
    unknown = replace(SHAFT, parameters={"undrained_shear_strength": 40e3})
    user = curve("p-y", "user", rows=((9e3, 0.1),), effective_unit_weight=None)
    assert warnings(scene(user, unknown)) == []
    off = scene(user, unknown, supports=TIP, numerics=OFF)
    line = tip_support_check(off, off.foundations[0])
    assert "the capacity is unknown: the effective overburden" in line
    assert "\n" not in line


@pytest.mark.parametrize(
    ("deck", "expected"),
    [
        (SAMPLES / "jacket_pile.deck", []),
        (SAMPLES / "oc3_monopile.deck", []),
        (SAMPLES / "opensees_pile.deck", []),
        (
            ROOT / "tests/data/decks/base.deck",
            [
                "t-z curve 2: no F6 with beta = 0.373: what sand bears would grow with depth "
                "without bound (limits: API RP 2GEO table 1); give F6=5e6 (Pa)",
                "F1: t-z 1 (SHAPE=EP) reach 8 kPa at 0.08 mm, 3.7e-05 D: friction peaks at about "
                "0.01 D, between 0.0025 and 0.02 D (API RP 2GEO 8.4.2); give SHAPE=2GEO, or a "
                "slope (IKTSO, F3) of 374.9e3 Pa/m for 0.01 D",
            ],
        ),
    ],
    ids=lambda v: v.stem if isinstance(v, Path) else "",
)
def test_warnings_of_the_sample_decks(deck, expected):
    assert warnings(read_deck(deck).scene) == expected


HEAVY = (
    "F1: compression of 60000 kN (step 1) and 1148 kN of own weight, the pile bears 41660 kN "
    "(unplugged: shaft 38830 kN, tip 2835 kN): it can carry 0.675 of that load and no more "
    "(API RP 2GEO 8.1); embed 65.77 m to bear it, not 50 m, or lower the load"
)
SLIP = (
    "p-y curve 1: CU = 40 Pa: below 500 Pa it is as a rule a slip of units (the deck takes Pa); "
    "write 40e3 if 40 kPa is meant"
)


def changed(folder, *pairs):
    """The jacket's deck with some of its text replaced."""
    text = (SAMPLES / "jacket_pile.deck").read_text(encoding="utf-8")
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    path = folder / "pile.deck"
    path.write_text(text, encoding="utf-8")
    return path


def test_run_tells_before_it_solves_and_json_holds_it(tmp_path, capsys, monkeypatch):
    """The pile of HEAVY is told of, and then has no equilibrium in the solver either."""
    deck = changed(tmp_path, ("1 8e3  6.0e3  0.5", "1 40 6.0e3 0.5"), ("-12e6", "-60e6"))
    told_before = []
    real = run.solve

    def solve(*arguments):
        told_before.append(capsys.readouterr().err)
        return real(*arguments)

    monkeypatch.setattr(run, "solve", solve)
    assert main(["run", str(deck), "-o", str(tmp_path), "--json"]) == ExitCode.FAILED
    lines = told_before[0].splitlines()
    assert lines[:2] == [f"podeep-solve: warning: {SLIP}", f"podeep-solve: warning: {HEAVY}"]
    report = json.loads(capsys.readouterr().out)
    assert [f"podeep-solve: warning: {w}" for w in report["warnings"][: len(lines)]] == lines
    assert report["failure"]


def test_a_deck_that_stops_is_told_of_too(tmp_path, capsys):
    deck = changed(tmp_path, ("1 8e3  6.0e3  0.5", "1 40 6.0e3 0.5"), ("*EXEC", "*STOP"))
    assert main(["run", str(deck), "-o", str(tmp_path)]) == 0
    assert capsys.readouterr().err == f"podeep-solve: warning: {SLIP}\n"


def test_check_ends_with_what_is_risky(tmp_path, capsys):
    deck = changed(tmp_path, ("1 8e3  6.0e3  0.5", "1 40 6.0e3 0.5"))
    assert main(["check", str(deck)]) == 0
    out = capsys.readouterr().out
    assert max(map(len, out.splitlines())) <= 80
    *_, section = out.split("\n\n")
    title, *rest = section.splitlines()
    assert title == "risky"
    assert " ".join(part.strip() for part in rest) == SLIP
    assert main(["check", str(SAMPLES / "jacket_pile.deck")]) == 0
    assert "risky" not in capsys.readouterr().out


def test_run_holds_the_support_against_the_capacity(tmp_path, capsys):
    deck = changed(tmp_path, ("*EXEC", "*MODEL TZ=OFF\n*EXEC"))
    assert main(["run", str(deck), "-o", str(tmp_path), "--json"]) == 0
    (line,) = json.loads(capsys.readouterr().out)["supports"]
    assert line == (
        "F1: the support along z carries compression of 12000 kN (step 1) and 1148 kN of own "
        "weight, the t-z curves bear 41660 kN (unplugged), a factor of 3.168"
    )
    assert main(["run", str(deck), "-o", str(tmp_path), "--force"]) == 0
    words = capsys.readouterr()
    assert line in " ".join(words.out.split())
    assert words.err == ""


def test_the_capacity_is_computed_once(monkeypatch, tmp_path):
    calls = []
    real = embedded.axial_capacity
    monkeypatch.setattr(
        embedded, "axial_capacity", lambda *a, **k: calls.append(1) or real(*a, **k)
    )
    scene_ = read_deck(changed(tmp_path, ("-12e6", "-20e6"))).scene
    assert len(warnings(scene_)) == 1
    assert len(calls) == 1


def finite(low, high):
    return st.floats(low, high, allow_nan=False)


def spread(low, high):
    """Values of any magnitude, as decks have them where units slip."""
    return finite(np.log10(low), np.log10(high)).map(lambda p: float(10.0**p))


AMOUNT = st.one_of(st.just(0.0), spread(1e-3, 1e9))
STRAIN, ANGLE = spread(1e-5, 0.2), finite(10.0, 50.0).map(radians)
DRAWN = {
    "strain_50": STRAIN,
    "strain_rm": spread(1e-6, 1e-2),
    "friction_angle": ANGLE,
    "interface_friction_angle": finite(0.0, 50.0).map(radians),
    "j": finite(0.25, 0.5),
    "cycles": spread(1.0, 1e4),
    "rock_quality_designation": finite(0.0, 1.0),
    "relative_density": finite(0.0, 1.0),
    "overconsolidation_ratio": spread(1.0, 100.0),
    "strength_ratio": st.just(1.0),
    "residual": finite(0.7, 1.0),
    "multiplier": spread(0.01, 100.0),
    **dict.fromkeys(("subgrade_modulus", "initial_shear_modulus"), spread(1e-3, 1e12)),
    **dict.fromkeys(("friction_limit", "end_bearing_limit"), spread(1e-3, 1e9)),
    "rock_mass_modulus": spread(1e-3, 1e12),
}


@st.composite
def curves(draw, family):
    laws = [law for of, law in SOUND if of == family]
    law = draw(st.sampled_from(laws))
    given_ = {key: draw(DRAWN.get(key, AMOUNT)) for key in SOUND[family, law]}
    for key in ("friction_limit", "mudline_strength", "subgrade_modulus", "residual"):
        if key in given_ and draw(st.booleans()):
            del given_[key]
    options = dict(OPTIONS.get(law, {}))
    if family == "t-z" and "residual" not in given_:
        options["shape"] = draw(st.sampled_from(("EP", "2GEO")))
    rows = ((9e3, 0.1), (5e3, 0.2)) if law == "user" else ()
    return Curve(1, law, given_, options, rows)


@st.composite
def scenes(draw):
    depths = sorted(draw(st.lists(finite(0.1, 90.0), max_size=3, unique=True)))
    depths = tuple(z for z in (0.0, *depths) for _ in range(draw(st.integers(1, 2))))
    depths = depths[1:] if depths[:2] == (0.0, 0.0) else depths
    families = []
    for family in ("p-y", "t-z"):
        drawn = [draw(st.none() | curves(family)) for _ in depths]
        families.append(tuple(replace(c, id=i) if c else None for i, c in enumerate(drawn, 1)))
    diameter = draw(spread(0.1, 3e3))
    force = tuple(draw(finite(-1e9, 1e9) | finite(-1e3, 1e3)) for _ in range(3))
    more = {}
    if draw(st.booleans()):
        more["supports"] = TIP
    if draw(st.booleans()):
        more["spudcans"] = (replace(CAN, poisson_ratio=draw(finite(0.0, 0.5))),)
    return scene(
        *families,
        diameter,
        40.0,
        force,
        diameter * draw(finite(1e-3, 0.5)),
        depths,
        Numerics(axial_curves=draw(st.booleans())),
        density=draw(st.sampled_from((0.0, 7850.0))),
        ground={"layering": draw(st.sampled_from(("NONE", "GEORGIADIS")))},
        **more,
    )


@settings(max_examples=60, deadline=None, derandomize=True)
@given(scenes())
def test_any_legal_scene_is_judged_without_a_failure(pile):
    lines = warnings(pile)
    assert len(lines) == len(set(lines))
    for line in [*lines, tip_support_check(pile, pile.foundations[0])]:
        assert not line or line.isprintable()
    for line in lines:
        assert LINE.fullmatch(line), line
        assert not re.search(r"\b(nan|inf|None)\b", line), line


@pytest.mark.parametrize(
    ("still", "rule", "told"), [(5e5, 0, True), (5e5, 1, True), (5e5, 2, False), (0.0, 0, False)]
)
def test_soil_that_would_give_twice_is_told(still, rule, told):
    """A static load across, and one with a history in the same direction."""
    moving = swaying_pile()
    names = (*moving.steps.names, "STEADY")
    steady = Load("STEADY", 1, 10.0, (still, 0.0, 0.0), (0.0, 0.0, 0.0))
    both = replace(
        moving,
        loads=(*moving.loads, steady),
        steps=Steps(names, ((0.0, 1.0),)),
        ground=replace(moving.ground, dynamic_rule=rule),
    )
    found = [w for w in warnings(both) if f"IDRE = {rule} with 500 kN across" in w]
    assert bool(found) is told
