"""The model that the program chooses gives what all of the model gives, to the accuracy asked."""

import pytest

from reduced import SAMPLES, compared


@pytest.mark.parametrize("path", SAMPLES, ids=lambda p: p.stem)
def test_every_sample_needs_no_more_than_was_chosen(path):
    pair = compared(path, 1e-3)
    assert pair.difference <= 1e-3
    assert pair.unknowns[0] < pair.unknowns[1]
