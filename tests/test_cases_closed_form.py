"""Closed forms, run from decks and read back from the database: heads to 1e-6, profiles to 2e-6."""

from pathlib import Path

import pytest

from closed_forms import CASES

HEAD, PROFILE, PROFILE_CF04 = 1e-6, 2e-6, 1e-5


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("how", ["*ACCURACY 1e-7", "*MODEL ELEMENTS=40"])
def test_closed_form(name: str, how: str, tmp_path: Path) -> None:
    errors = CASES[name].errors(how, tmp_path)
    assert errors.pop("head") <= HEAD
    assert max(errors.values()) <= (PROFILE_CF04 if name.startswith("CF04") else PROFILE), errors
