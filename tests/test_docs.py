"""The pages on laws: every law has one, in order, with its figures; their decks are read."""

import re

import pytest
from matplotlib import rc_context

from manual import INDEX, LINES, PAGES, SEABED_LAWS, figures
from podeep.cli.solve import main
from podeep.deck.keywords import KEYWORDS
from podeep.deck.read import read_deck
from podeep.soil import axial, lateral

SECTIONS = "Formula|Curves|Range|Source|Trouble spots|Where public programs disagree"

# --- pages ------------------------------------------------------------------------------------


def types(keyword: str) -> dict[str, str]:
    """The ITYP of each law of a keyword."""
    return {
        row.law: column.choices[0]
        for row in KEYWORDS[keyword].rows
        for column in row.columns
        if row.law and column.name == "ITYP"
    }


@pytest.mark.parametrize(
    ("keyword", "law"),
    [("PYCURVE", law) for law in lateral.LAWS] + [("TZCURVE", law) for law in axial.LAWS],
)
def test_every_law_has_a_page(keyword, law):
    name = re.compile(rf"ITYP {types(keyword)[law]}\b")
    (row,) = (line for line in INDEX.splitlines() if f"`*{keyword}`" in line and name.search(line))
    linked = re.findall(r"\((\w+)\.md\)", row)
    assert any(f"`*{keyword}`" in PAGES[page] and name.search(PAGES[page]) for page in linked)


def test_the_index_has_every_page_in_its_table_and_its_toctree():
    (toctree,) = re.findall(r"^```{toctree}\n:maxdepth: 1\n\n(.*?)^```", INDEX, re.M | re.S)
    assert sorted(toctree.split()) == sorted(PAGES)
    assert set(re.findall(r"\((\w+)\.md\)", INDEX)) == set(PAGES)


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_short_and_in_order(page):
    text = PAGES[page]
    assert "|".join(re.findall("^## (.*)", text, re.M)) == SECTIONS
    assert 40 <= len(text.splitlines()) <= 110
    purpose = text.split("```text")[0]
    assert "*" in purpose or "podeep-solve" in purpose  # it names the deck's lines
    for formula in re.findall(r"\$\$(.*?)\$\$", text, re.S):
        assert formula.count("{") == formula.count("}")
        assert formula.count(r"\left") == formula.count(r"\right")
        assert formula.count(r"\begin") == formula.count(r"\end")


def test_every_figure_of_a_page_is_drawn_and_every_drawn_one_shown():
    named = re.findall(r"generated/laws/(\w+)\.png", "".join([*PAGES.values(), SEABED_LAWS, LINES]))
    assert sorted(named) == sorted(figures.FIGURES)
    assert all("{figure}" in text for text in PAGES.values())


def test_a_figure_is_the_same_again_whatever_the_settings_of_the_user():
    first = figures.png("soft_clay_depths")
    assert first.startswith(b"\x89PNG")
    with rc_context({"font.size": 20.0, "savefig.dpi": 50.0, "axes.grid": True}):
        assert figures.png("soft_clay_depths") == first


# --- decks ------------------------------------------------------------------------------------

#: Paragraphs that a block may lack.
REST = {
    "DEPTH": "0",
    "CASING": "1 PILE\n10 -40 2 0.05 210e9 7850",
    "FONDATION": "1 1",
    "LOAD": "PUSH 1 0 1e5 0 -1e5 0 0 0",
    "QUASISTATIC": "1",
}


def whole_deck(block: str) -> str:
    """A block with all that a deck needs besides: each of its curves in a layer of its own."""
    ids = {
        name: re.findall(rf"^\*{name}.*\n *(\d+)", block, re.M) for name in ("PYCURVE", "TZCURVE")
    }
    count = max(*map(len, ids.values()), 1)
    py, tz = (i + ["0"] * (count - len(i)) for i in ids.values())
    text = block
    if "*GROUNDEPTH" not in text:
        bounds = [0, *(-5 * (i // 2 + 1) for i in range(2 * count - 1))]
        pairs = [pair for pair in zip(py, tz, strict=True) for _ in range(2)]
        text += f"*GROUNDEPTH\n{' '.join(map(str, bounds))}\n"
        text += f"*GROUNDPROP\n{' '.join(f'{i} {j}' for i, j in pairs)}\n"
    for name, data in REST.items():
        if f"*{name}\n" not in text:
            text += f"*{name}\n{data}\n"
    if not ids["TZCURVE"] and "*SPUDCAN" not in text:
        text += "*SUPPORT\n1 -40 Z\n"
    if not ids["PYCURVE"]:
        text += "*SUPPORT\n1 0 X Y RX RY\n"
    return f"{text}*STOP\n"


@pytest.mark.parametrize("page", PAGES)
def test_the_deck_lines_of_a_page_are_read(tmp_path, capsys, page):
    (block,) = re.findall(r"^```text\n(\*.*?)^```", PAGES[page], re.M | re.S)
    path = tmp_path / f"{page}.deck"
    path.write_text(whole_deck(block), encoding="utf-8")
    assert main(["check", str(path)]) == 0, capsys.readouterr().err
    scene, said = read_deck(path).scene, capsys.readouterr().out
    curves = len(re.findall(r"^\*(?:PY|TZ)CURVE", block, re.M))
    assert len(scene.ground.lateral_curves) + len(scene.ground.axial_curves) == curves
    assert said
