"""Pile groups: what a pile's neighbours leave of its lateral resistance.

The multipliers scale p at the same y: they are the `multiplier` of every lateral law.
"""

from collections.abc import Callable, Mapping
from math import log
from types import MappingProxyType

from ..errors import InvalidData

_CLOSEST, _WIDEST = 3.0, 5.0  # spacings of the table, diameters
#: multipliers of rows 1, 2, and 3 and beyond, at the closest and at the widest spacing
_TABLE = ((0.8, 1.0), (0.4, 0.85), (0.3, 0.7))
#: a and b of a ln(s/D) + b for rows 1, 2, and 3 and beyond
_LOGARITHMS = ((0.26, 0.5), (0.52, 0.0), (0.60, -0.25))


def _aashto(spacing: float, row: int) -> float:
    close, wide = _TABLE[row]
    share = min((spacing - _CLOSEST) / (_WIDEST - _CLOSEST), 1.0)
    return (1.0 - share) * close + share * wide  # exact at both ends


def _rollins(spacing: float, row: int) -> float:
    slope, level = _LOGARITHMS[row]
    return min(slope * log(spacing) + level, 1.0)


_METHODS: Mapping[str, Callable[[float, int], float]] = MappingProxyType(
    {"AASHTO": _aashto, "ROLLINS": _rollins}
)


def group_multiplier(spacing: float, row: int, method: str = "AASHTO") -> float:
    """p-multiplier of a pile in a row of a group loaded across its rows.

        AASHTO    s/D = 3 -> 5, straight lines between:
                  row 1  0.80 -> 1.00;  row 2  0.40 -> 0.85;  row 3 and beyond  0.30 -> 0.70
        ROLLINS   row 1  0.26 ln(s/D) + 0.50;  row 2  0.52 ln(s/D);
                  row 3 and beyond  0.60 ln(s/D) - 0.25;  each at most 1

    spacing s/D (-, centre to centre in the direction of the load, in diameters), row (1 leads, the
    others follow in its shadow). Piles side by side take no more from each other from 5 D (sand)
    or 3 D (clay) on.

    Range: s/D >= 3; closer piles are refused. Beyond 5 D AASHTO's values are held: its table ends
    there, rows 2 and 3 have not recovered, and to hold them errs towards less resistance. ROLLINS
    rests on tests at 3.3 to 5.65 D and reaches 1 at 6.8 D (rows 1 and 2) and 8.0 D (row 3).
    Source: AASHTO LRFD Bridge Design Specifications 2014, FHWA GEC-9 (FHWA-HIF-18-031) table 7-1.
    ROLLINS: Rollins et al. 2006, coefficients from memory: check them against the paper before
    a design rests on them.
    """
    if method not in _METHODS:
        raise InvalidData(
            f"there is no method {method} of group multipliers",
            f"give one of {', '.join(_METHODS)}",
            "METHOD",
        )
    if not spacing >= _CLOSEST:
        raise InvalidData(
            f"a spacing of {spacing:g} diameters lies below the {_CLOSEST:g} diameters at which "
            "group multipliers begin",
            f"space the piles at {_CLOSEST:g} diameters or more from centre to centre, or give "
            "the multiplier itself",
            "SPACING",
        )
    if row < 1:
        raise InvalidData(f"there is no row {row}", "rows count from 1, the leading one", "ROW")
    return _METHODS[method](spacing, min(row, len(_TABLE)) - 1)


def mean_multiplier(spacing: float, rows: int, method: str = "AASHTO") -> float:
    """p-multiplier of every pile of a group of `rows` rows under cyclic or wave loading.

    All rows lead and follow in turn, so each has the mean over the rows of `group_multiplier`,
    whose spacing, method and range these are. A single row has the value of row 1.
    """
    if rows < 1:
        raise InvalidData(f"a group has no {rows} rows", "give 1 or more", "ROWS")
    return sum(group_multiplier(spacing, row, method) for row in range(1, rows + 1)) / rows
