"""An element that approaches a bound, in whichever direction it moves: drag, slip, yield.

From a start (force b, displacement o) towards the bound P > 0, both seen along the motion:

    q(s) = P - (P - b) [c / (c + s)]^n ,   s >= 0 the way from o

A reversal starts anew from where it happens. Source: Boulanger et al., ASCE JGGE 125(9) (1999).
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ..arrays import Array

#: of a sum of a few terms, of the largest of them
ROUNDING = 2e-15

Values: TypeAlias = float | Array


def reached(P: Values, b: Array, s: Array, c: Values, n: Values) -> tuple[Array, Array]:
    """Force and stiffness at way s."""
    left = (P - b) * np.power(c / (c + s), n)
    return P - left, n * left / (c + s)


def way(P: Values, b: Array, q: Array, c: Values, n: Values) -> tuple[Array, Array]:
    """Way at force q between b and P, and its derivative."""
    stretched = c * np.power((P - b) / (P - q), 1.0 / n)
    return stretched - c, stretched / (n * (P - q))


def work(P: Values, b: Array, s: Array, c: Values, n: float) -> Array:
    """Integral of the force over the way from 0 to s."""
    ratio = (c + s) / c
    area = np.log(ratio) if n == 1.0 else (1.0 - np.power(ratio, 1.0 - n)) / (n - 1.0)
    return P * s - (P - b) * c * area


def recoverable(P: Values, q: Array, start: Array, c: Values, n: float) -> Array:
    """The most work that can come back at a force q: that of unloading to 0.

    start: force at which the unloading began, or q where it would begin here; 0 where P is 0.
    """
    size, span = np.abs(q), P + np.abs(start)
    ok = span > 0.0
    span = np.where(ok, span, 1.0)
    bound = np.where(ok, P, 1.0)
    now, end = span / (bound + np.minimum(size, span - bound)), span / bound  # (c + s)/c to 1/n
    if n == 1.0:
        out = span * (np.log(end) - np.log(now)) - bound * (end - now)
    else:
        k = 1.0 / n
        out = span * (now ** (k - 1.0) - end ** (k - 1.0)) / (n - 1.0) - bound * (end**k - now**k)
    return np.where(ok, c * out, 0.0)


def root(
    function: Callable[[Array], tuple[Array, Array]],
    low: Array,
    high: Array,
    start: Array,
    noise: Array,
) -> Array:
    """Where a rising function vanishes between low and high, by Newton's steps and halving.

    noise: what rounding within the function makes of its root.
    """
    x, width = start, high - low
    enough = 1e-14 * width + noise
    last, done = width, np.zeros(x.shape, dtype=bool)
    for _ in range(100):
        value, slope = function(x)
        below = value < 0.0
        low, high = np.where(below, x, low), np.where(below, high, x)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            step = value / slope
        new = x - step
        # halve where Newton leaves the bracket, or its steps do not
        good = (new >= low) & (new <= high) & (2.0 * np.abs(step) <= last)
        new = np.where(done | (value == 0.0), x, np.where(good, new, 0.5 * (low + high)))
        last = np.abs(new - x)
        x = new
        done |= last <= enough
        if done.all():
            break
    return x
