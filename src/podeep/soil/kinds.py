"""Kinds of soil reaction: the laws that have them, and laws made of what is known by name."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache
from math import pi
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from ..arrays import Array
from . import axial, lateral
from .law import Law
from .surroundings import Family


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of reaction: its curves, the laws that have it, and what user rows mean for it."""

    family: Family
    laws: Mapping[str, type[Law]]
    columns: slice | None = None  # of a user's row: reaction and displacement; None: none
    dynamic: slice | None = None  # the same in motion, of rows that have these columns
    width: Callable[[Array], Array] = np.asarray  # what a pressure acts on, from the diameter
    compression_only: bool = False

    def points(self, rows: Sequence[tuple[float, ...]], moving: bool) -> list[tuple[float, ...]]:
        """Reaction and displacement of user rows, those in motion where rows tell them apart."""
        columns = self.columns or slice(0)
        if moving and self.dynamic is not None and len(rows[0]) >= self.dynamic.stop:
            columns = self.dynamic
        return [row[columns] for row in rows]


def _side(laws: Mapping[str, Any], side: str) -> dict[str, type[Law]]:
    """The laws of one side, by name, of those that have it."""
    return {n: getattr(of, side) for n, of in laws.items() if getattr(of, side) is not None}


_ROWS, _LAST_ROWS = slice(0, 2), slice(2, 4)
LATERAL = Kind("p-y", _side(lateral.LAWS, "resistance"), _ROWS, _LAST_ROWS)
MOMENT = Kind("p-y", _side(lateral.LAWS, "moment"))
BASE_SHEAR = Kind("p-y", _side(lateral.LAWS, "base_shear"))
BASE_MOMENT = Kind("p-y", _side(lateral.LAWS, "base_moment"))
SHAFT = Kind("t-z", _side(axial.LAWS, "shaft"), _ROWS, width=lambda diameter: pi * diameter)
TIP = Kind(
    "t-z",
    _side(axial.LAWS, "tip"),
    _LAST_ROWS,
    width=lambda diameter: 0.25 * pi * diameter**2,
    compression_only=True,
)
#: What each curve describes, by family and law.
SIDES: Mapping[Family, Mapping[str, Any]] = MappingProxyType(
    {"p-y": lateral.LAWS, "t-z": axial.LAWS}
)

_L = TypeVar("_L", bound=Law)


@cache
def taken(law: type[Law]) -> frozenset[str]:
    """Names of the fields of a law."""
    names = (field.name for field in fields(law))  # type: ignore[arg-type]  # laws are dataclasses
    return frozenset(names)


def made(law: type[_L], given: Mapping[str, Any]) -> _L:
    """A law of what it takes out of all that is given."""
    wanted = taken(law)
    return law(**{name: value for name, value in given.items() if name in wanted})
