"""The smallest and largest values over all rows, and when they came."""

from typing import Any

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[Any]

_SIDES = (("min", np.min, np.argmin, np.less), ("max", np.max, np.argmax, np.greater))


def widen(envelope: dict[str, Values], quantity: str, values: Values, axis: Values) -> None:
    """Widen the envelope of a quantity by rows of values, shape (rows, depths), rows > 0.

    `axis` holds their steps or times. The envelope gets `<quantity>_min`, `_max` and `_min_at`,
    `_max_at`, shape (depths,); of equal values the first counts.
    """
    for name, bounding, argument, beyond in _SIDES:
        bound, when = f"{quantity}_{name}", f"{quantity}_{name}_at"
        found = bounding(values, axis=0)
        if bound in envelope:
            new = np.flatnonzero(beyond(found, envelope[bound]))
            envelope[bound], envelope[when] = envelope[bound].copy(), envelope[when].copy()
        else:
            new = np.arange(len(found))
            envelope[bound], envelope[when] = found.copy(), np.empty(len(found), axis.dtype)
        # Where a bound is takes longer to find than how large it is, and is rarely new.
        envelope[bound][new] = found[new]
        envelope[when][new] = axis[argument(values[:, new], axis=0)]
