"""Decks of linear soil for the closed-form cases, and a way to run them through the program."""

from collections.abc import Sequence
from pathlib import Path

from podeep.cli.solve import main
from podeep.database.read import Database, open_database

REACH = 1e3  # displacement up to which the linear user curves go, m


def linear_curve(id_: int, modulus: float, diameter: float = 1.0) -> str:
    """A p-y user curve of constant modulus (N/m2)."""
    return f"*PYCURVE\n{id_} 0 0\n{modulus / diameter * REACH!r} {REACH!r}\n"


def deck(
    *,
    title: str,
    depths: Sequence[float],
    moduli: Sequence[float],
    casing: Sequence[str],
    actions: Sequence[str],
    axial: Sequence[int] | None = None,
    extra: str = "",
    steps: str = "1",
) -> str:
    """A deck with p-y modulus `moduli` (N/m2) at `depths` (m, positive down), linear between.

    casing: rows of *CASING with OD 1 m. actions: whole keyword lines. A vertical support at the tip
    stands in for an axial soil where `axial` gives no t-z curve at each depth.
    """
    curves = "".join(linear_curve(i, k) for i, k in enumerate(moduli, start=1) if k)
    ids = [i if k else 0 for i, k in enumerate(moduli, start=1)]
    pairs = " ".join(f"{i} {j}" for i, j in zip(ids, axial or [0] * len(ids), strict=True))
    tip = casing[-1].split()[1]
    support = "" if axial else f"*SUPPORT\n1 {tip} Z\n"
    return (
        f"*TITLE\n{title}\n*DEPTH\n0\n*GROUNDEPTH\n{' '.join(repr(-d + 0.0) for d in depths)}\n"
        f"{curves}{extra}*GROUNDPROP\n{pairs}\n*CASING\n1 PILE\n" + "\n".join(casing) + "\n"
        f"*FONDATION\n1 1\n{support}" + "\n".join(actions) + f"\n*QUASISTATIC\n{steps}\n*EXEC\n"
    )


def solved(folder: Path, text: str, *arguments: str) -> Database:
    """Run a deck as a user would and open its database."""
    path = folder / "case.deck"
    path.write_text(text, encoding="utf-8")
    assert main(["run", str(path), "-o", str(folder), "-q", "--force", *arguments]) == 0
    return open_database(folder / "case.dss")
