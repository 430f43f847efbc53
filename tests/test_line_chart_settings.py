"""What a chart of a line varies: meshes, contacts, and the lines of a deck that ask for them."""

from dataclasses import replace

import numpy as np
import pytest

from line_charts import CASE_B, DECKS, EVEN, EVEN_NODAL, GRADED, GRADED_NODAL, read
from podeep.line.analysis import solve_line
from podeep.study.chart import Setting
from podeep.study.line_settings import (
    FULL,
    QUICK,
    free_of_numbers,
    line_deck_lines,
    meshes,
    with_numbers,
)


def test_lines_of_a_deck_keep_sections_and_tell_of_the_contact(tmp_path):
    text = (DECKS / "line.deck").read_text(encoding="utf-8")
    scene, line = read(tmp_path, text)
    contact = scene.seabed_under(line)
    lines = line_deck_lines(line, contact, 1e-3, Setting(EVEN_NODAL, 90))
    *asked, comment = lines.splitlines()
    assert asked[:4] == ["*ACCURACY", "0.001", "*LINE", "11 RISER"]
    assert comment == "C with FORM=NODAL for line 11 in *TYPCONTACT"
    start, rest = text.split("*LINE")
    again = read(tmp_path, f"{start}{lines}\n*END{rest.split('*END')[1]}")[1]
    assert again == with_numbers(line, 90)
    automatic = line_deck_lines(line, replace(contact, form="nodal"), 1e-3, None)
    assert "FORM=INTEGRATED" in automatic
    assert " 100" not in automatic
    plain = line_deck_lines(free_of_numbers(line), contact, 1e-3, None)
    assert plain == "*ACCURACY\n0.001"


@pytest.mark.parametrize("elements", [1, 2, 7, 64, 1001])
def test_numbers_of_elements_are_as_even_as_sections_allow(tmp_path, elements):
    line = read(tmp_path, (DECKS / "line.deck").read_text(encoding="utf-8"))[1]
    counts = [section.elements for section in with_numbers(line, elements).sections]
    assert sum(counts) == max(round(0.5 * elements), 2)  # a run halves them
    assert min(counts) >= 1
    assert abs(counts[0] - sum(counts) * 1400 / 1635) <= 1.5


def test_meshes_end_where_sections_do_and_nodes_are_for_lines_on_a_seabed(tmp_path):
    text = (DECKS / "line.deck").read_text(encoding="utf-8")
    scene, line = read(tmp_path, text)
    every = dict(meshes(scene, line, FULL))
    assert {setting.series for setting in every} == {GRADED, EVEN, GRADED_NODAL, EVEN_NODAL}
    for setting, edges in every.items():
        assert len(edges) == setting.elements + 1
        assert (np.diff(edges) > 0.0).all()
        assert np.abs(edges[[0, -1]] - (0.0, 1635.0)).max() < 1e-9
        assert np.abs(edges - 1400.0).min() < 1e-9
    hanging = replace(scene, seabed_contacts=())
    assert {s.series.form for s, _ in meshes(hanging, line, FULL)} == {"integrated"}
    assert len(dict(meshes(scene, line, QUICK))) < 0.5 * len(every)


def test_a_run_returns_the_elements_of_the_setting(tmp_path):
    scene, line = read(tmp_path, CASE_B)
    assert solve_line(scene, with_numbers(line, 40)).model.elements == 40
