"""Largest deviation from the independently computed tables in tests/data/soil, test by test.

python tests/bench/soil_tables.py runs the tests that compare laws, and decks through the commands,
with those tables, and prints what they found instead of that they passed. Tolerances of rows that
sit on a jump, or are printed with few digits, are the tests' own.
"""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

TESTS = Path(__file__).parents[1]
FILES = sorted(
    {
        *TESTS.glob("test_soil_*.py"),
        *TESTS.glob("test_tables_through_decks*.py"),
        TESTS / "test_piles_whole.py",
        TESTS / "test_lpile_piles.py",
        TESTS / "test_pisa_piles.py",
    }
)


ROUNDING = 1e-10  # below it a test compares formulas, not printed tables


class Recorder:
    """Notes the largest relative deviation that a test accepts."""

    def __init__(self) -> None:
        self.found: dict[str, float] = {}
        self.test = ""

    def pytest_runtest_setup(self, item: pytest.Item) -> None:
        self.test = re.sub(r"\[.*", "", item.nodeid)

    def pytest_configure(self) -> None:
        compare = np.testing.assert_allclose

        def recorded(actual, desired, **options):  # type: ignore[no-untyped-def]
            compare(actual, desired, **options)
            a, b = np.broadcast_arrays(np.asarray(actual, float), np.asarray(desired, float))
            known = np.isfinite(b) & (b != 0.0)
            worst = np.abs(a[known] / b[known] - 1.0).max(initial=0.0)
            self.found[self.test] = max(self.found.get(self.test, 0.0), float(worst))

        np.testing.assert_allclose = recorded


def main() -> int:
    recorder = Recorder()
    wanted = "table or tables or soft_clay_static or soft_clay_cyclic or test_sand or friction or "
    wanted += "bearing or unit_values or weak_rock or free_water or decks or whole or table_09 or "
    wanted += "pr02 or pr03 or pr13"
    code = pytest.main(["-q", "--no-header", "-k", wanted, *map(str, FILES)], [recorder])
    for test, worst in sorted(recorder.found.items()):
        if worst > ROUNDING:
            file, *names = test.split("::")
            print(f"{worst:9.1e}  {Path(file).stem}: {names[-1].removeprefix('test_')}")
    return int(code)


if __name__ == "__main__":
    sys.exit(main())
