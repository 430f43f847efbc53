"""Static cases on nonlinear soil through decks, the solver and the database, each to its bar."""

from pathlib import Path

import pytest

from decks import solved
from static_cases import STATIC_CASES


@pytest.mark.parametrize("name", STATIC_CASES)
def test_oracle(name: str, tmp_path: Path) -> None:
    case = STATIC_CASES[name]
    with solved(tmp_path, f"*ACCURACY 1e-6\n{case.text}") as database:
        missed = [d for d in case.compare(database) if not d.found <= d.asked]
    assert not missed
