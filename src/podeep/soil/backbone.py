"""Piecewise linear reactions: the tables of the standards and the user's own rows.

One mechanism serves them all. What differs is where the points come from and their two scales.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ..arrays import Array
from ..errors import InvalidData
from .law import Law
from .polyline import Points, Polyline, Values


class TableLaw(Law):
    """A law that is a polyline at each of its points."""

    @cached_property
    @abstractmethod
    def _backbone(self) -> Polyline:
        """The curve, made once."""

    @property
    def polyline(self) -> Polyline:
        return self._backbone

    @property
    def capacity(self) -> Array:
        return self._backbone.capacity

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self._backbone.evaluate(u)


@dataclass(frozen=True, eq=False, kw_only=True)
class UserCurve(TableLaw):
    """Reaction through the user's own points, straight lines between them.

    The curve starts at (0, 0), is odd, and holds the last reaction beyond the last point.

        force = multiplier force_scale P(|u| / displacement_scale) sign(u)

    points: rows (P, y), P in Pa; one table for all n points.
    force_scale: D for p-y, pi D for t-z (m); the tip's area for Q-z (m2).
    displacement_scale: 1 where y is in metres, D where it is in diameters.
    multiplier: factor on the force at the same displacement.
    Source: the user; the layout is that of DeepLines' *PYCURVE and *TZCURVE.
    """

    source: ClassVar[str] = "the user's own rows"

    points: tuple[tuple[float, float], ...]
    force_scale: Values
    displacement_scale: Values = 1.0
    multiplier: Values = 1.0

    @cached_property
    def _backbone(self) -> Polyline:
        return self._drawn().mirrored()

    def _drawn(self) -> Polyline:
        return Polyline.through(
            sorted_points(self.points),
            np.multiply(self.multiplier, self.force_scale),
            self.displacement_scale,
            odd=False,
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class SignedUserCurve(UserCurve):
    """Reaction through the user's own points, which stand for both signs as they are given.

    As `UserCurve`, but not mirrored: the point (0, 0) is added, and the first reaction is held
    before the first point as the last one is beyond the last. Without points of negative y it
    resists positive displacements only, as a tip does.
    """

    odd: ClassVar[bool] = False

    @cached_property
    def _backbone(self) -> Polyline:
        return self._drawn()


def sorted_points(rows: Points) -> list[tuple[float, float]]:
    """Points (y, P) in rising y with (0, 0) among them, from rows (P, y) in any order.

    Raises InvalidData for a row that pushes instead of resisting, and for two reactions at one y.
    """
    points = sorted({(0.0, 0.0), *((y + 0.0, p + 0.0) for p, y in rows)})
    for (y, p), (above, q) in pairwise(points):
        if y == above:
            raise InvalidData(
                f"the curve has two reactions, {p:g} and {q:g} Pa, at {y:g}",
                "displacements differ from row to row, and the reaction at 0 is 0",
                "Y",
            )
    for y, p in points:
        if y * p < 0.0:
            raise InvalidData(
                f"the curve has a reaction of {p:g} Pa at {y:g}, along the displacement",
                "a reaction resists: it has the sign of its displacement",
                "P",
            )
    return points


def user_law(
    rows: Sequence[tuple[float, ...]],
    force_scale: Values,
    displacement_scale: Values,
    multiplier: Values = 1.0,
    compression_only: bool = False,
) -> UserCurve | None:
    """The law of rows (P, y), odd unless a y is negative; None where they are all zero.

    The scales and the multiplier are those of `UserCurve`. Raises InvalidData as `sorted_points`,
    and for a negative y where only compression is resisted.
    """
    points = tuple((p, y) for p, y in rows)
    if not any(p for p, _ in points):
        return None
    negative = any(y < 0.0 for _, y in points)
    if compression_only and negative:
        raise InvalidData(
            f"the tip has a displacement of {min(y for _, y in points):g} in its rows",
            "a tip resists compression alone: give its rows with yq >= 0",
            "yq",
        )
    law = SignedUserCurve if compression_only or negative else UserCurve
    return law(
        points=points,
        force_scale=force_scale,
        displacement_scale=displacement_scale,
        multiplier=multiplier,
    )
