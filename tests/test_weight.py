"""Own weight of tubes: in air, in water, filled, and what it does to a foundation."""

import json
from dataclasses import replace
from math import pi

import numpy as np
import pytest

from casings import casings, elastic_shaft, no_ground, push, run, tube
from podeep.cli.solve import main
from podeep.model.weight import unit_weight
from podeep.scene import Ground, Load, Numerics, Sea, Section, Sliding, Support, Tie
from podeep.solve.analysis import solve
from test_ties import BASE

G, STEEL, WATER = 9.80665, 7850.0, 1025.0
HEAVY = Numerics(weight=True, accuracy=1e-6)


def area(diameter, wall):
    return pi / 4.0 * (diameter**2 - (diameter - 2.0 * wall) ** 2)


@pytest.mark.parametrize("fill", [0.0, 1800.0])
@pytest.mark.parametrize("submerged", [False, True])
def test_a_metre_of_tube(fill, submerged):
    section = Section(0.0, -1.0, 1.0, 0.02, 210e9, STEEL, fill_density=fill)
    inside = pi / 4.0 * 0.96**2
    mass = STEEL * area(1.0, 0.02) + fill * inside
    if submerged:
        mass -= WATER * (area(1.0, 0.02) + (inside if fill else 0.0))
    found = unit_weight(section, Sea(), submerged=submerged)
    assert found == pytest.approx(G * mass, rel=1e-12)


def test_a_column_in_air_and_water_on_its_tip():
    """10 m dry, 20 m wet: the normal force grows evenly, the settlement is its integral."""
    scene = casings(
        [tube(1, 10.0, -20.0, 1.0, 0.02)],
        no_ground(),
        [push(1, 10.0, z=-1e5)],
        supports=[Support(1, -20.0, ("X", "Y", "Z", "RX", "RY"))],
        mudline=-15.0,
        numerics=HEAVY,
    )
    results = run(scene).results
    dry, wet = G * STEEL * area(1.0, 0.02), G * (STEEL - WATER) * area(1.0, 0.02)
    x = np.array([-25.0, -20.0, -15.0, -5.0, 5.0])  # below the mudline
    weight = np.array([0.0, 5.0 * dry, 10.0 * dry, 10.0 * dry + 10.0 * wet, 10 * dry + 20 * wet])
    for step, load in ((0, 0.0), (1, 1e5)):
        assert results.compression(x)[step] == pytest.approx(weight + load, rel=1e-9, abs=1e-6)
    stiffness = 210e9 * area(1.0, 0.02)
    head = 20.0 * (10.0 * dry) + 0.5 * dry * 10.0**2 + 0.5 * wet * 20.0**2 + 1e5 * 30.0
    assert results.settlement(x[:1])[1, 0] == pytest.approx(head / stiffness, rel=1e-9)


def test_the_soil_bears_the_weight_of_all_tubes():
    shaft = {1: elastic_shaft(1, 1e7, 0.762)}
    ground = Ground((0.0, 60.0), (0, 0), (1, 1), {}, shaft)
    tubes = [tube(1, 0.0, -40.0, 0.762, 0.0254), tube(2, 0.0, -60.0, 0.508, 0.0127)]
    ties = [Tie(1, 2, 0.0, -40.0, ends=True)]
    scene = casings(tubes, ground, [], ties, [Sliding(1, 2)], mudline=-5.0, numerics=HEAVY)
    solved = run(scene)
    results, points = solved.results, solved.model.axial.system.points[0]
    u = results.settlement(points.x)[0]
    held = points.weight @ points.reaction.evaluate(u)[0]
    wall = area(0.762, 0.0254) * 40.0 + area(0.508, 0.0127) * 60.0
    assert held == pytest.approx(G * (STEEL - WATER) * wall, rel=1e-9)


def test_a_column_buckles_under_its_own_weight():
    """Greenhill (1881): a clamped free column stands up to q L^3 / EI = 7.8373."""
    critical = 7.8373
    for share, stands in ((0.98, True), (1.02, False)):
        length, diameter, wall = 100.0, 0.3, 0.01
        section = Section(0.0, -length, diameter, wall, 210e9, STEEL)
        heavy = share * critical * section.bending_stiffness / length**3 / G
        section = replace(section, mass_override=heavy)
        scene = casings(
            [replace(tube(1, 0.0, -length, diameter, wall), sections=(section,))],
            no_ground(),
            [Load("PUSH", 1, 0.0, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0))],
            supports=[Support(1, -length, ("X", "Y", "Z", "RX", "RY"))],
            numerics=Numerics(weight=True),
        )
        scene = replace(scene, sea=Sea(density=1e-9))
        failure = solve(scene, scene.foundations[0]).failure
        assert (failure is None) == stands
        if failure:
            assert "buckles" in failure.ending.value


def test_a_pile_too_heavy_for_its_soil_stops_at_step_0(tmp_path, capsys):
    path = tmp_path / "case.deck"
    text = BASE.replace("1 40e3 8e3\n*GROUNDPROP", "1 1e3 8e3\n*GROUNDPROP")
    path.write_text(text.format(ties="", extra="*MODEL, WEIGHT=ON\n"), encoding="utf-8")
    assert main(["run", str(path), "-o", str(tmp_path)]) == 1
    told = capsys.readouterr().err
    assert "of step 0" in told
    assert "capacity in compression" in told


def test_weight_in_a_deck(tmp_path, capsys):
    path = tmp_path / "case.deck"
    heads = []
    for words in ("", "*MODEL, WEIGHT=ON\n"):
        path.write_text(BASE.format(ties="", extra=words), encoding="utf-8")
        assert main(["run", str(path), "-o", str(tmp_path), "--force", "--json"]) == 0
        told = json.loads(capsys.readouterr().out)["foundations"][0]
        heads.append(told["head_axial_displacement_m"])
        assert ("own weight: asked" in told["decisions"]) == bool(words)
    assert heads[1] > heads[0]
