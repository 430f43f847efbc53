"""The manual as tests read it: its pages on laws, and the figures drawn for them."""

import re
import sys
from importlib import import_module
from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"
sys.path.append(str(DOCS))
figures = import_module("figures")

PAGES = {
    page.stem: page.read_text(encoding="utf-8")
    for page in sorted((DOCS / "laws").glob("*.md"))
    if page.stem != "index"
}
SEABED_LAWS = (DOCS / "seabed_laws.md").read_text(encoding="utf-8")
LINES = (DOCS / "lines.md").read_text(encoding="utf-8")
INDEX = (DOCS / "laws" / "index.md").read_text(encoding="utf-8")


def table(page: str, start: str) -> list[float]:
    """The numbers of the row of a page that starts so."""
    (row,) = re.findall(rf"^\| {re.escape(start)} \|(.*)\|$", PAGES[page], re.M)
    return [float(cell) for cell in row.split("|") if cell.strip()]


def says(page: str, *parts: str) -> None:
    """The page holds these words, however its lines are broken."""
    text = re.sub(r"\s+", " ", PAGES[page])
    for part in parts:
        assert part in text, part


def power(value: float, digits: int = 0) -> str:
    """A small number as the pages write it."""
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return rf"{mantissa} \times 10^{{{int(exponent)}}}"
