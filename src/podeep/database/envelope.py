"""The smallest and largest values over all rows, and when they came."""

from typing import Any

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[Any]


def widen(envelope: dict[str, Values], quantity: str, values: Values, axis: Values) -> None:
    """Widen the envelope of a quantity by rows of values, shape (rows, depths), rows > 0.

    `axis` holds their steps or times. The envelope gets `<quantity>_min`, `_max` and `_min_at`,
    `_max_at`, shape (depths,); of equal values the first counts.
    """
    for name, argument, beyond in (("min", np.argmin, np.less), ("max", np.argmax, np.greater)):
        bound, when = f"{quantity}_{name}", f"{quantity}_{name}_at"
        row = argument(values, axis=0)
        found = np.take_along_axis(values, row[None], axis=0)[0]
        if bound in envelope:
            new = beyond(found, envelope[bound])
            envelope[bound] = np.where(new, found, envelope[bound])
            envelope[when] = np.where(new, axis[row], envelope[when])
        else:
            envelope[bound], envelope[when] = found, axis[row]
