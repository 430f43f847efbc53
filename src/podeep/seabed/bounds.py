"""Where the numbers of a law have to lie."""

import numpy as np

from ..errors import InvalidData
from ..soil.polyline import Values

MOST = float(np.finfo(float).max)
POSITIVE = float(np.finfo(float).tiny)  # the least number above 0 that loses no digits


def within(name: str, value: Values, low: float, high: float = MOST, field: str = "") -> None:
    """Raises InvalidData where a value, or one of (n,), is not between two bounds.

    field: its column of the deck.
    """
    wrong = [v for v in np.ravel(value).tolist() if not low <= v <= high]
    if not wrong:
        return
    least = "more than 0" if low == POSITIVE else f"{low:g} or more"
    rule = least if high == MOST else f"{low:g} to {high:g}"
    raise InvalidData(f"a {name} of {wrong[0]:g}", f"give {rule}", field)
