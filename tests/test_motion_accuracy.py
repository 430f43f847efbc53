"""The accuracy that is asked of a motion is kept: true errors against fine solutions."""

import pytest

from measured_motion import Case, rows
from podeep.solve.dynamics import End


@pytest.mark.parametrize("hysteresis", ["ELASTIC", "MASING"])
def test_true_errors_are_within_twice_what_is_asked(hysteresis: str) -> None:
    """As `tests/bench/motion_accuracy.py` has it for more loads and down to 1e-4."""
    for row in rows(Case(hysteresis, 1e6, 6.0), (1e-2, 1e-3)):
        assert row.ending is End.COMPLETE
        assert row.error <= 2.0 * row.accuracy
        assert row.estimate <= row.accuracy
        assert 0.1 < row.estimate / row.error < 10.0
        assert row.lost < 2.0 * row.accuracy
        assert row.steps < 2000
