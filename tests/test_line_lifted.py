"""The sample of a pipe whose end is lifted against suction and laid down, and what the manual says.

The deck is solved on few elements, by two parts in a hundred of what its database has.
"""

import doctest
import re
from importlib import import_module

import numpy as np
import pytest

from manual import DOCS, LINES
from podeep.cli.podeep import main as podeep
from podeep.deck.read import read_deck
from podeep.line.analysis import solve_line

figure = import_module("figures.lines")
TOP = 5  # the step in which the end is highest
TEXT = re.sub(r"\s+", " ", LINES)


def coarse(folder, text):
    """Moments of the sample on elements of 2.5 m, and the work done up to each step."""
    path = folder / "pipe.deck"
    path.write_text(text, encoding="utf-8")
    scene = read_deck(path).scene
    found = solve_line(scene, scene.lines[1])
    assert not found.failure
    s = figure.lifted()[0]
    return found.results.moment(s), np.array([state.energy for state in found.states])


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """With suction, and without."""
    folder = tmp_path_factory.mktemp("lifted")
    text = figure.LIFTED.read_text(encoding="utf-8")
    text = text.replace("7850 FILL", "7850 12 FILL")
    bare = text.replace("1 0 0 1 1\n*MOTION", "1 0 0 1\n*MOTION")
    assert bare != text
    return coarse(folder, text), coarse(folder, bare)


def test_the_database_of_the_sample_is_what_its_deck_makes(solved):
    (moment, _), _ = solved
    kept = figure.lifted()[2]
    np.testing.assert_allclose(moment, kept, atol=0.02 * np.abs(kept).max())


def test_lifted_it_bends_more_than_without_suction_and_laid_down_no_more(solved):
    """Both where it sags and behind that; between, as long as what holds has not broken out."""
    (held, _), (free, _) = solved
    most, least = held.max(axis=1), held.min(axis=1)
    up = slice(1, TOP + 1)
    assert (most[up] > 1.2 * free.max(axis=1)[up]).all()
    assert (least[up] < 2.0 * free.min(axis=1)[up]).all()
    down = slice(TOP + 2, 10)
    np.testing.assert_allclose(most[down], free.max(axis=1)[down], rtol=0.03)
    for step in range(1, TOP):
        assert most[step] > 1.2 * most[10 - step]


def test_a_way_up_and_down_makes_no_energy(solved):
    """It takes at least what suction does on the part that broke out; without it, nothing."""
    (_, taken), (_, free) = solved
    assert abs(free[-1]) < 1e-5 * free.max()
    scene = read_deck(figure.LIFTED).scene
    law = figure.pull_out_of(scene.suctions[1], scene.lines[1].sections[0].outer_diameter)
    whole = float(law.force(0.1) * law.reach(0.1)) * 0.5 * (1.0 + law.released - law.mobilised)
    with figure.open_database(figure.LIFTED.with_suffix(".dss")) as database:
        line = database.line("L1")
        above = line.points[line.read("penetration")[TOP] < -float(law.reach(0.1))]
    assert np.ptp(above) > 10.0
    assert taken[-1] > whole * np.ptp(above)
    assert (np.diff(taken[: TOP + 1]) > 0.0).all()


def test_the_closed_forms_of_the_figure():
    """The larger one has as much suction as the sample, on a seabed that does not give way."""
    _, up, moment = figure.lifted()
    free, held = figure.closed(up[1:10])
    most = moment.max(axis=1)[1:10]
    np.testing.assert_allclose(held[:TOP], most[:TOP], rtol=0.07)
    np.testing.assert_allclose(free[TOP + 1 :], most[TOP + 1 :], rtol=0.02)


def test_the_page_tells_what_the_sample_has(solved):
    _, (free, _) = solved
    _, _, moment = figure.lifted()
    most, least = 1e-3 * moment.max(axis=1), 1e-3 * moment.min(axis=1)
    for words in (
        f"Lifted by 0.1 m the pipe bends by {most[1]:.2f} kN m, on its way down by {most[9]:.2f}",
        f"at 0.5 m it is {most[3]:.1f} and {most[7]:.1f} kN m",
        f"{-least[3]:.2f} kN m at 0.5 m, against {-1e-3 * free.min(axis=1)[3]:.2f} kN m without",
        f"with {most[10]:.0f} kN m in it",
    ):
        assert words in TEXT
    with figure.open_database(figure.LIFTED.with_suffix(".dss")) as database:
        line = database.line("L1")
        taken = line.read("convergence/energy")[-1]
        deep = line.read("penetration")[-1].max()
    assert f"takes {taken:.0f} J, and leaves the pipe up to {1e3 * deep:.1f} mm deep" in TEXT


def test_the_example_of_the_page():
    (block,) = re.findall(r"^```python\n(>>> .*?)^```", LINES, re.M | re.S)
    example = doctest.DocTestParser().get_doctest(block, {}, "lines.md", None, None)
    assert not doctest.DocTestRunner().run(example).failed
    assert len(example.examples) == 6


def test_the_answers_of_the_sample(capsys, monkeypatch):
    monkeypatch.chdir(DOCS.parent / "sample_dbs")
    assert podeep(["pipe_lifted", "--answers", "pipe_lifted.answers", "--no-plot"]) == 0
    out = capsys.readouterr().out
    assert out.count("Result      Bending moment (kN m), positive sagging") == 3
    assert "Normal force (kN/m)" in out
