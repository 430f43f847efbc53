"""Pages and figures of the manual that are made from the code."""

from pathlib import Path

from figures import write_figures

from podeep.database.schema import TABLES
from podeep.database.variable import Variable
from podeep.deck.keywords import KEYWORDS, describe


def write_pages(folder: Path) -> None:
    """Write the generated pages and figures into a folder."""
    folder.mkdir(exist_ok=True)
    (folder / "keywords.md").write_text(keywords(), encoding="utf-8")
    (folder / "schema.md").write_text(schema(), encoding="utf-8")
    write_figures(folder / "laws")


def keywords() -> str:
    """The keyword table, as `podeep-solve keywords` prints it."""
    parts = ["# Keywords", "", "As `podeep-solve keywords` prints them.", ""]
    parts += ["```text", describe(None), "```", ""]
    for name in KEYWORDS:
        parts += [f"## *{name}", "", "```text", describe(name), "```", ""]
    return "\n".join(parts)


def schema() -> str:
    """What stands in the groups of a database."""
    rows = ["# Variables of a database"]
    for name, table in TABLES.items():
        rows += ["", f"## Group of a {name}", ""]
        rows.append("| group | variable | dimensions | unit | what | remark |")
        rows.append("|---|---|---|---|---|---|")
        rows += _variables(table)
    return "\n".join([*rows, ""])


def _variables(table: tuple[Variable, ...]) -> list[str]:
    rows = []
    for v in table:
        where = f"`{v.group}/`" if v.group else ""
        only = [*(v.kinds if len(v.kinds) == 1 else ()), *(["spatial"] if v.spatial_only else [])]
        remark = "; ".join([*([f"{', '.join(only)} only"] if only else []), v.comment])
        cells = (where, f"`{v.name}`", ", ".join(v.dims), v.units, v.long_name, remark)
        rows.append(f"| {' | '.join(cells)} |")
    return rows
