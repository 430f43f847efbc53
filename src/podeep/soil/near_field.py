"""Soil next to a pile or a tip: rigid within a range of force, yielding beyond it."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Flags
from .approach import way


@dataclass(frozen=True)
class Rigid:
    """The rigid range at n points and where it lies: forces and displacements at its two ends."""

    left: Array
    right: Array
    left_at: Array
    right_at: Array

    def mirrored(self) -> "Rigid":
        """The same seen along the negative direction."""
        return Rigid(-self.right, -self.left, -self.right_at, -self.left_at)


def rigid_between(left: Array, right: Array, slope: Array) -> Rigid:
    """A range of a slope (N/m) through the origin."""
    return Rigid(left, right, left / slope, right / slope)


def turned(
    before: Rigid, force: Array, at: Array, slope: Array, length: Array, past: Array
) -> Rigid:
    """The range after yield towards the positive side and a reversal at (at, force).

    length: of the new range; past: how far it reaches at least beyond zero.
    """
    yielded = force > before.right
    left = np.where(yielded, np.minimum(force - length, -past), before.left)
    right = np.where(yielded, force, before.right)
    right_at = np.where(yielded, at, before.right_at)
    left_at = np.where(yielded, at - (right - left) / slope, before.left_at)
    return Rigid(left, right, left_at, right_at)


def displaced(
    force: Array, rigid: Rigid, peak: Array, slope: Array, c: Array, n: float
) -> tuple[Array, Array]:
    """Displacement at a force on the way to the positive side, and its derivative."""
    beyond = force > rigid.right
    inside = np.where(beyond, rigid.right, force)
    outside = np.where(beyond, force, rigid.right)
    more, rate = way(peak, rigid.right, outside, c, n)
    at = rigid.right_at + (inside - rigid.right) / slope + more
    return at, np.where(beyond, rate, 1.0 / slope)


def chosen(where: Flags, yes: Rigid, no: Rigid) -> Rigid:
    """One range or another, point by point."""
    return Rigid(
        np.where(where, yes.left, no.left),
        np.where(where, yes.right, no.right),
        np.where(where, yes.left_at, no.left_at),
        np.where(where, yes.right_at, no.right_at),
    )
