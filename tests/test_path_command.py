"""*MODEL PATH=ON as a user runs it: the database, the report, what is refused and what is not."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.database.read import open_database
from podeep.errors import UserError
from podeep.scene import Numerics, Scene, Spudcan
from podeep.solve.analysis import solve
from scenes import reference_pile
from test_path_peaks import friction_pile

LOAD = 20e6
DECK = """*TITLE
softening friction
*DEPTH
0
*GROUNDEPTH
0 -40
*TZCURVE, SHAPE=2GEO, RESIDUAL=0.7
1 1 60e3 8e3
*PYCURVE
1 1 60e3 8e3 0.5 0.01
*GROUNDPROP
1 1 1 1
*CASING
{casings}
*FONDATION
{foundations}
*LOAD
{loads}
*MODEL, ELEMENTS=12{path}
*QUASISTATIC
10
*EXEC
"""
ONE = ("1 PILE\n10 -40 2 0.05 210e9 7850", "1 1", "HEAD 1 10 1e6 0 -20e6")


def written(
    folder: Path, parts: tuple[str, str, str], path: str, code: int, *more: str
) -> tuple[Path, Path]:
    names = dict(zip(("casings", "foundations", "loads"), parts, strict=True))
    deck = folder / "pile.deck"
    deck.write_text(DECK.format(path=path, **names))
    assert main(["run", str(deck), "-o", str(folder), "--force", *more]) == code
    return deck, folder / "pile.dss"


def test_the_database_holds_the_descending_branch(tmp_path, capsys):
    _, target = written(tmp_path, ONE, ", PATH=ON", 1)
    told = capsys.readouterr()
    with open_database(target) as database:
        assert database.status == "stopped"
        reason = database.stop_reason
        foundation = database.foundation("F1")
        factor = foundation.load_factor[:, 0]
        normal = foundation.read_tube(1, "normal_force")[:, 0]
        shear = foundation.read_tube(1, "shear_x")[:, 0]
        settlement = -foundation.read_tube(1, "displacement_z")[:, 0]
        errors = foundation.read("estimate/displacement")
    np.testing.assert_allclose(normal, LOAD * factor, rtol=1e-5, atol=1.0)
    np.testing.assert_allclose(shear, 1e6 * factor, rtol=1e-5, atol=1.0)
    peak = int(np.argmax(factor))
    assert 6 <= peak <= 8
    np.testing.assert_allclose(factor[:7], np.arange(7) / 10.0)
    low = peak + int(np.argmin(factor[peak:]))
    assert factor[low] < 0.85 * factor[peak]  # the shaft has softened, the tip not come yet
    assert factor[-1] > 1.02 * factor[low]
    assert settlement[-1] > 0.1 * 2.0  # where the tip has its all
    assert (np.diff(settlement) > 0.0).all()
    assert errors.max() < 1e-2
    for text in (told.err, reason):
        assert "F1: axial peak at " in text
        assert f"step {peak} of the database: HEAD {factor[peak]:.4g}" in " ".join(text.split())
        assert "the load changes no more" in text
    assert f"axial peak in step {peak}: load factors {factor[peak]:.4g}" in told.out
    assert f"followed beyond it to step {len(factor) - 1}" in told.out


def test_the_path_stands_in_the_json_report(tmp_path, capsys):
    written(tmp_path, ONE, ", PATH=ON", 1, "--json")
    path = json.loads(capsys.readouterr().out)["foundations"][0]["path"]
    assert path["problem"] == "axial"
    assert path["peak_factors"][0] > path["last_factors"][0] > 0.4
    assert path["last_step"] > path["peak_step"] + 20
    assert 0.01 < path["peak_head_axial_displacement_m"] < 0.05


def test_without_the_word_the_peak_is_the_same_and_nothing_follows(tmp_path, capsys):
    factors = []
    for word in ("", ", PATH=OFF", ", PATH=ON"):
        _, target = written(tmp_path, ONE, word, 1)
        capsys.readouterr()
        with open_database(target) as database:
            factors.append(database.foundation("F1").load_factor[:, 0])
            told = database.stop_reason
    assert len(factors[0]) == len(factors[1]) == 7
    assert "no axial equilibrium" not in told
    np.testing.assert_array_equal(factors[2][:7], factors[0])


def test_a_path_changes_nothing_below_the_peak():
    plain = reference_pile(numerics=Numerics(elements=13))
    asked = replace(plain, numerics=replace(plain.numerics, follow_path=True))
    one, other = (solve(scene, scene.foundations[0]) for scene in (plain, asked))
    assert other.path is None
    for a, b in zip(one.states, other.states, strict=True):
        np.testing.assert_array_equal(a.lateral, b.lateral)
        np.testing.assert_array_equal(a.axial, b.axial)


def test_every_foundation_is_under_the_loads_of_the_path(tmp_path, capsys):
    """The second pile is wide enough: it is brought to the falling loads of the first one."""
    parts = (
        f"{ONE[0]}\n*CASING\n2 WIDE\n10 -40 4 0.08 210e9 7850",
        "1 1\n2 2",
        f"{ONE[2]}\nHEAD 2 10 1e6 0 -20e6",
    )
    _, target = written(tmp_path, parts, ", PATH=ON", 1)
    capsys.readouterr()
    with open_database(target) as database:
        first, second = (database.foundation(f).load_factor[:, 0] for f in ("F1", "F2"))
        normal = database.foundation("F2").read_tube(2, "normal_force")[:, 0]
        assert "F2: no" not in database.stop_reason
    assert len(first) > 40
    np.testing.assert_array_equal(first, second)
    np.testing.assert_allclose(normal, LOAD * second, rtol=1e-5, atol=1.0)


def test_the_problem_that_comes_less_far_is_followed():
    """In one step both problems would fail: the lateral one at a lower factor than the axial."""
    scene = friction_pile(elements=12, steps=1)
    soft = {
        id_: replace(curve, options={**curve.options, "cyclic": True})
        for id_, curve in scene.ground.lateral_curves.items()
    }
    scene = replace(scene, ground=replace(scene.ground, lateral_curves=soft))
    for side, which in ((40e6, "axial"), (200e6, "lateral")):
        load = replace(scene.loads[0], force=(side, 0.0, -32e6))
        found = solve(replace(scene, loads=(load,)), scene.foundations[0])
        assert found.failure.which == found.path.which == which
        factors = np.array([s.factors[0] for s in found.states])
        head = np.array([-10.0])
        shear, _ = found.results.shear_and_moment(head)
        np.testing.assert_allclose(shear[:, 0, 0], side * factors, rtol=1e-4, atol=1.0)
        normal = found.results.compression(head)[:, 0]
        np.testing.assert_allclose(normal, 32e6 * factors, rtol=1e-4, atol=1.0)


def test_a_spudcan_with_a_preload_is_refused_in_words():
    def on_spudcan(**given: float) -> Scene:
        can = Spudcan(1, 8.0, 5.0, 10e6, 0.3, soil="CLAY", undrained_shear_strength=60e3, **given)
        scene = reference_pile(numerics=Numerics(elements=8, follow_path=True))
        return replace(scene, spudcans=(can,))

    scene = on_spudcan(preload=30e6)
    with pytest.raises(UserError, match=r"PATH=ON, but its spudcan has a preload.*V_PRELOAD"):
        solve(scene, scene.foundations[0])
    elastic = on_spudcan()
    assert solve(elastic, elastic.foundations[0]).failure is None
