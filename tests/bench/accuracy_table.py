"""Every static case and sample at four accuracies against its own converged solution.

    python tests/bench/accuracy_table.py [--csv | --short] [WORD ...]

For each case and accuracy: elements, then true error and stored estimate of the largest
displacement, reaction and moment (normal force where there is no other), and what misses a bar:
errors at most 2 times the accuracy, estimates within a factor of 10 of the errors, below 1e-9
counted as 1e-9. Then the converged solution against the case's oracle. WORDs choose cases; --short
prints a line for each family of cases, --csv all figures.
"""

import argparse
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from textwrap import wrap

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from accuracy_cases import SAMPLE_ORACLES, every
from measured import Converged, Measured, converged, measured
from podeep.database.read import open_database
from podeep.deck.read import Deck, read_deck
from podeep.record import sheet
from podeep.run import write
from static_cases import Deviations, StaticCase

GRID = 1e-7  # accuracy of what is read between the depths of the converged database
HEAD = f"{'':21} el.  {'displacement':>17} {'reaction':>17} {'moment':>17}"
SHORT = f"{'cases':<16}{'':>4}{'elements':>20}{'error':>10}{'estimate':>16}{'oracle':>10}"


@dataclass(frozen=True)
class Row:
    """One case measured: its converged solution, its accuracies, its distance from its oracle."""

    name: str
    against: Converged
    accuracies: tuple[Measured, ...]
    oracle: Deviations

    @property
    def missed(self) -> list[str]:
        """Bars of the oracle that do not hold."""
        return [d.what for d in self.oracle if not d.found <= d.asked]


def deviations(name: str, case: StaticCase | Path, deck: Deck, against: Converged) -> Deviations:
    """The converged solution as a database against the oracle."""
    compare = case.compare if isinstance(case, StaticCase) else SAMPLE_ORACLES[name]
    scene = replace(deck.scene, numerics=replace(deck.scene.numerics, accuracy=GRID))
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "case.dss"
        sheets = [sheet(scene, against.solved)]
        write(target, deck, scene, sheets, "", interrupted=False, force=True)
        with open_database(target) as database:
            return compare(database)


def table(words: list[str]) -> Iterator[Row]:
    """Cases whose names hold one of the words, or all, one after the other."""
    with tempfile.TemporaryDirectory() as folder:
        for name, case in every().items():
            if words and not any(w in name for w in words):
                continue
            path = case if isinstance(case, Path) else Path(folder) / "case.deck"
            if isinstance(case, StaticCase):
                path.write_text(case.text, encoding="utf-8")
            deck = read_deck(path)
            against = converged(deck.scene)
            accuracies = tuple(measured(deck.scene, against))
            yield Row(name, against, accuracies, deviations(name, case, deck, against))


def told(row: Row) -> str:
    """A case as text of 80 columns."""
    model = row.against.solved.model
    lines = [f"{row.name}: converged on {model.elements} elements, {row.against.change:.0e} away"]
    for one in row.accuracies:
        pairs = zip(one.true, one.estimate, strict=True)
        cells = " ".join(f"{true:8.1e} {estimate:8.1e}" for true, estimate in pairs)
        lines.append(f"{one.asked:>20.0e} {one.elements:4d}  {cells}")
        lines += [f"    MISS {miss}" for miss in one.misses]
    if row.oracle:
        worst = ", ".join(f"{d.what} {d.found:.1e} of {d.asked:g}" for d in row.oracle)
        lines += wrap(f"oracle: {worst}", 80, initial_indent=" " * 14, subsequent_indent=" " * 22)
        lines += [f"    MISS oracle: {what}" for what in row.missed]
    return "\n".join(lines)


def shortly(family: str, rows: list[Row]) -> str:
    """Cases of one family in a line: how many, most elements at each accuracy, largest error over
    its accuracy, estimates over errors, largest distance from an oracle over its bar."""
    elements = [max(counts) for counts in zip(*([m.elements for m in r.accuracies] for r in rows))]  # noqa: B905
    every = [m for row in rows for m in row.accuracies]
    ratios = np.array([m.ratios for m in every])
    excess = max(m.excess for m in every)
    oracle = [d.found / d.asked for row in rows for d in row.oracle]
    beside = f"{max(oracle):.2g}" if oracle else "none"
    counts = " ".join(f"{n:d}" for n in elements)
    spread = f"{ratios.min():.2f} to {ratios.max():.2f}"
    return f"{family:<16}{len(rows):>4}{counts:>20}{excess:10.2g}{spread:>16}{beside:>10}"


def as_csv(row: Row) -> str:
    """A line for each accuracy."""
    oracle = max((d.found / d.asked for d in row.oracle), default=float("nan"))
    return "\n".join(
        ",".join(
            [row.name, f"{one.asked:g}", str(one.elements)]
            + [f"{v:.3e}" for v in (*one.true, *one.estimate)]
            + [f"{oracle:.3e}", f"{row.against.change:.1e}"]
        )
        for one in row.accuracies
    )


CSV = (
    "case,accuracy,elements,error_displacement,error_reaction,error_moment,"
    "estimate_displacement,estimate_reaction,estimate_moment,oracle_over_bar,change"
)


def main() -> None:
    parser = argparse.ArgumentParser()
    ways = parser.add_mutually_exclusive_group()
    ways.add_argument("--csv", action="store_true")
    ways.add_argument("--short", action="store_true")
    parser.add_argument("words", nargs="*")
    asked = parser.parse_args()
    print(CSV if asked.csv else SHORT if asked.short else HEAD)
    found: list[Row] = []
    for row in table(asked.words):
        found.append(row)
        if not asked.short:
            print(as_csv(row) if asked.csv else told(row), flush=True)
    if asked.short:
        for family, rows in groupby(found, key=lambda row: row.name.split()[0]):
            print(shortly(family, list(rows)))
    if not asked.csv:
        ratios = np.array([[one.ratios for one in row.accuracies] for row in found])
        excess = max(one.excess for row in found for one in row.accuracies)
        misses = sum(len(one.misses) for row in found for one in row.accuracies)
        oracles = sum(len(row.missed) for row in found)
        print(
            f"{len(found)} cases: errors up to {excess:.2g} times the accuracy, estimates "
            f"{ratios.min():.2g} to {ratios.max():.2g}\ntimes the errors; {misses} misses, "
            f"{oracles} of oracles"
        )


if __name__ == "__main__":
    main()
