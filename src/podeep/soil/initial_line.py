"""Curves whose initial slope is bounded by a line k z y, and curves that fall after a peak."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Array

_TINY = 1e-150  # keeps a quotient finite where its divisor is 0
_SEARCH = 10  # Newton steps to the end of the initial line, quadratic from the right


def below_line(y: Array, initial: Array, force: Array, stiffness: Array) -> tuple[Array, Array]:
    """The smaller of the line `initial` y and a reaction at y >= 0, with its derivative.

    Where they meet, as at rest, the derivative is the smaller one: that away from zero, since the
    reaction is concave as long as it rises.
    """
    line = initial * y
    smaller = np.where(line < force, initial, np.minimum(stiffness, initial))
    return np.minimum(line, force), smaller


@dataclass(frozen=True, eq=False)
class Falling:
    """A concave hump, a straight fall and a residual, over x = y / unit of y >= 0.

    The hump's top is at x = peak, its end at first, where the fall from top (N/m) by loss (N/m
    over one x) starts; from x = last the residual (N/m) holds. hump: reaction and derivative in x.
    """

    hump: Callable[[Array], tuple[Array, Array]]
    unit: Array
    peak: Array
    first: float
    last: Array
    top: Array
    loss: Array
    residual: Array

    def evaluate(self, y: Array) -> tuple[Array, Array]:
        x = y / self.unit
        force, slope = self.hump(np.minimum(x, self.first))
        fallen, left = x >= self.first, x >= self.last
        x -= self.first
        x *= self.loss
        np.copyto(force, self.top - x, where=fallen)
        np.copyto(force, self.residual, where=left)
        np.copyto(slope, -self.loss, where=fallen)
        np.copyto(slope, 0.0, where=left)
        slope /= self.unit
        return np.maximum(force, 0.0, out=force), slope

    def largest_below(self, initial: Array) -> Array:
        """The largest reaction that does not pass the line `initial` y.

        Right of its top the hump is concave and falls, so Newton's steps from its end stay right
        of where the line meets it: what they find is a bound, and but for rounding the meeting.
        """
        first, rise = self.first, initial * self.unit
        crest = self.hump(self.peak)[0]
        x = np.full(crest.shape, first)
        for _ in range(_SEARCH):
            force, slope = self.hump(x)
            x = x - (force - rise * x) / np.minimum(slope - rise, -_TINY)
            x = np.clip(x, self.peak, first)
        on_hump = np.minimum(crest, rise * x)
        x = (self.top + first * self.loss) / np.maximum(rise + self.loss, _TINY)
        x = np.clip(x, first, self.last)
        on_fall = np.minimum(rise * x, self.top - self.loss * (x - first))
        return np.asarray(np.maximum(np.maximum(on_hump, on_fall), self.residual))
