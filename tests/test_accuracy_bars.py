"""What an accuracy asks is what comes: errors against converged solutions, and their estimates.

A part of the cases of tests/bench/accuracy_table.py: errors of the largest displacement, reaction
and moment at most 2 times the accuracy, estimates within a factor of 10 of the errors.
"""

from pathlib import Path

import pytest

from accuracy_cases import every
from measured import converged, measured
from podeep.deck.read import read_deck

NAMES = (
    *("CF01 point load", "CF04 Zmax 4 B", "CF05 H100kN_free", "CF06 floating_Kb0"),
    *("CF08 backbone", "CF09 elastic-plastic e 2.5", "CF13 N 0.3 moment", "CF15 H"),
    *("CF28 rigid", "CF28 flexible", "PR02 fixed head", "PR03 0.9", "PR13 D2", "jacket_pile"),
    *("CF32 sliding H N", "CF32 cemented V", "combined_casings"),
)


@pytest.mark.parametrize("name", NAMES)
def test_bars(name: str, tmp_path: Path) -> None:
    case = every()[name]
    path = case if isinstance(case, Path) else tmp_path / "case.deck"
    if not isinstance(case, Path):
        path.write_text(case.text, encoding="utf-8")
    scene = read_deck(path).scene
    against = converged(scene)
    assert {m.asked: m.misses for m in measured(scene, against) if m.misses} == {}
