"""The keyword table: its pages, its examples, its promises."""

from pathlib import Path

import pytest

from podeep.deck.keywords import ALIASES, KEYWORDS, PLANNED, describe
from podeep.deck.read import read_deck
from podeep.errors import UserError


@pytest.mark.parametrize("name", [None, *KEYWORDS])
def test_pages_fit_a_terminal(name: str | None) -> None:
    text = describe(name)
    assert max(len(line) for line in text.splitlines()) <= 80
    assert text == "\n".join(line.rstrip() for line in text.splitlines())


def test_the_list_names_every_keyword_on_its_own_line() -> None:
    starts = [line.split()[0] for line in describe(None).splitlines() if line.startswith("*")]
    assert [s for s in starts if s.lstrip("*") in KEYWORDS] == [f"*{name}" for name in KEYWORDS]
    assert all(f"*{name}" in describe(None) for name in PLANNED)


@pytest.mark.parametrize("keyword", KEYWORDS.values(), ids=lambda k: k.name)
def test_a_page_tells_every_column_and_an_example(keyword: object) -> None:
    found = next(k for k in KEYWORDS.values() if k is keyword)
    page = describe(found.name.lower())
    for row in found.rows:
        for column in (*row.columns, *row.repeated):
            assert f"\n  {column.name}" in page
            assert " ".join(column.meaning.split()) in " ".join(page.split())
    assert all(line in page for line in found.example.splitlines())


def test_the_examples_together_are_a_deck(tmp_path: Path) -> None:
    path = tmp_path / "a.deck"
    texts = [k.example for k in KEYWORDS.values() if k.name not in ("INCLUDE", "STOP")]
    path.write_text("\n".join(texts), encoding="utf-8")
    assert read_deck(path).scene.title == "Jacket pile, storm"


@pytest.mark.parametrize("name", ["*pycurve", "PYCURVE", "pyCurve"])
def test_spellings(name: str) -> None:
    assert describe(name).startswith("*PYCURVE: ")


def test_aliases() -> None:
    assert dict(ALIASES) == {"GROUNDDEPTH": "GROUNDEPTH", "FOUNDATION": "FONDATION"}
    assert describe("foundation") == describe("FONDATION")


def test_an_unknown_name_gets_the_nearest_one() -> None:
    with pytest.raises(UserError, match=r"there is no keyword \*CASSING; did you mean \*CASING\?"):
        describe("cassing")
    with pytest.raises(UserError, match=r"\*GROUP is not read by this version"):
        describe("GROUP")


def test_names_are_unique_within_a_row() -> None:
    for keyword in KEYWORDS.values():
        for row in keyword.rows:
            names = [c.name.upper() for c in (*row.columns, *row.repeated)]
            assert len(names) == len(set(names))


def test_required_columns_come_before_optional_ones() -> None:
    for keyword in KEYWORDS.values():
        for row in keyword.rows:
            optional = [c.optional for c in row.positional]
            assert optional == sorted(optional)
