"""A heavy pipe over a free span between two level shoulders of Winkler seabed, without tension.

Distances x from the edge over 1/beta, y (up) over w/k, with beta = (k/4EI)^(1/4), sg = beta Ls/2:

    y = -1 + e^-x (A cos x + B sin x),  B = 2 (sg^3/3 - sg/2)/(1 + sg),  A = -B - 2 sg

where the seabed pulls as well as it pushes. One that does not pull lets go of a part of each
shoulder, of length t, once sg > 2.98486. From the far end of that part, outwards and back:

    y = -1 + e^-x (cos x + B sin x)                       on the seabed
    y = (1 - B) x - B x^2 - (1 + B) x^3/3 - x^4/6         off it, up to x = t
    B = (1 - t^2/3 - t^3/6)/(1 + t + t^2/3)               as y = 0 there, too

Up to the edge y goes on from there as a beam on the seabed does. The edge is where the span fits:
y' = sg y'' + 4 sg^3/3 and y''' = -4 sg. Source: derived.
"""

from dataclasses import dataclass
from math import atan2, cos, cosh, exp, sin, sinh

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import brentq

from ..errors import InvalidData
from ..seabed.bounds import POSITIVE, within

LET_GO = 2.98485989999
"""beta Ls/2 beyond which a seabed that does not pull lets go of the shoulders."""
_LONGEST = 100.0  # from 138 on it lets go of a second part


@dataclass(frozen=True, slots=True)
class FreeSpan:
    """Deflections are up from the level of the shoulders, m; moments positive sagging, N m.

    edge_slope: outwards, rad; edge_shear: what comes onto a shoulder, N; highest: point of the
    shoulders, m; lifted: the part off the seabed, from the edge on, m, or None.
    """

    edge_deflection: float
    edge_slope: float
    edge_moment: float
    edge_shear: float
    middle_deflection: float
    middle_moment: float
    highest: float
    lifted: tuple[float, float] | None


def free_span(
    span: float,
    bending_stiffness: float,
    weight: float,
    stiffness: float,
    *,
    bilateral: bool = False,
) -> FreeSpan:
    """A span Ls, m, of a pipe that lies on either side of it as far as that matters.

    bending_stiffness EI, N m2; weight in water w, N/m; stiffness k of the seabed, N/m2;
    bilateral: it pulls, too. Raises InvalidData for values that are not above 0, and for spans so
    long, beta Ls > 200, that a seabed might let go of more than one part of a shoulder.
    """
    for name, value in {
        "span": span,
        "bending stiffness": bending_stiffness,
        "weight": weight,
        "stiffness": stiffness,
    }.items():
        within(name, value, POSITIVE)
    beta = (stiffness / (4.0 * bending_stiffness)) ** 0.25
    half = 0.5 * beta * span
    if half > _LONGEST and not bilateral:
        raise InvalidData(
            f"a span of {span:g} m, {2.0 * half:g}/beta",
            f"give {2.0 * _LONGEST / beta:g} m at most, or bilateral",
        )
    holds = bilateral or half <= LET_GO
    (y, slope, moment), highest, lifted = _held(half) if holds else _let_go(half)
    middle = moment + 2.0 * half**2
    sinks, bends = weight / stiffness, weight / (4.0 * beta**2)
    return FreeSpan(
        edge_deflection=sinks * y,
        edge_slope=sinks * beta * slope,
        edge_moment=bends * moment,
        edge_shear=0.5 * weight * span,
        middle_deflection=sinks * (y - middle * half**2 / 2.0 + half**4 / 6.0),
        middle_moment=bends * middle,
        highest=sinks * highest,
        lifted=None if lifted is None else (lifted[0] / beta, lifted[1] / beta),
    )


_Found = tuple[tuple[float, float, float], float, tuple[float, float] | None]


def _held(half: float) -> _Found:
    """y, y' and y'' at the edge, the highest y, and that no part is let go."""
    B = 2.0 * (half**3 / 3.0 - half / 2.0) / (1.0 + half)
    A = -B - 2.0 * half
    top = atan2(B - A, A + B)
    highest = exp(-top) * (A * cos(top) + B * sin(top)) - 1.0
    return (A - 1.0, B - A, -2.0 * B), highest, None


def _let_go(half: float) -> _Found:
    """The same where a part of the shoulder is let go, and from where to where."""

    def edge(t: float) -> tuple[float, float, float, float, float]:
        """For a length t of it: the seabed before it, then y, y', y'' and sg at the edge."""
        inner = [float(derivative(t)) for derivative in _off(t)]

        def misses(x: float) -> float:
            _, slope, moment, sg = _inwards(inner, x)
            return slope - moment * sg - 4.0 * sg**3 / 3.0

        # x (t + 2) lies between 3.9 and 5; a span of negative length has it between 2.6 and 3
        x = float(brentq(misses, 3.2 / (t + 2.0), 5.5 / (t + 2.0), xtol=1e-300, rtol=1e-15))
        return x, *_inwards(inner, x)

    t = float(brentq(lambda t: edge(t)[-1] - half, 0.0, 1.5 * half, xtol=1e-300, rtol=1e-15))
    x, y, slope, moment, _ = edge(t)
    up, climb = _off(t)[:2]
    top = float(brentq(climb, 0.0, t, xtol=1e-300, rtol=1e-15))
    return (y, slope, moment), float(up(top)), (x, x + t)


def _off(t: float) -> list[Polynomial]:
    """y off the seabed, inwards from the far end of the part that is let go, and derivatives."""
    B = (1.0 - t**2 / 3.0 - t**3 / 6.0) / (1.0 + t + t**2 / 3.0)
    y = Polynomial([0.0, 1.0 - B, -B, -(1.0 + B) / 3.0, -1.0 / 6.0])
    return [y, y.deriv(1), y.deriv(2), y.deriv(3)]


def _inwards(start: list[float], x: float) -> tuple[float, float, float, float]:
    """y, y', y'' and sg at the edge, x further in than y and its derivatives inwards."""
    c, s, ch, sh = cos(x), sin(x), cosh(x), sinh(x)
    one, two = ch * c, 0.5 * (ch * s + sh * c)
    three, four = 0.5 * sh * s, 0.25 * (ch * s - sh * c)
    onwards = [  # each row is the derivative of the one above it
        [one, two, three, four],
        [-4.0 * four, one, two, three],
        [-4.0 * three, -4.0 * four, one, two],
        [-4.0 * two, -4.0 * three, -4.0 * four, one],
    ]
    y, slope, moment, shear = np.array(onwards) @ (start[0] + 1.0, *start[1:])
    return float(y) - 1.0, -float(slope), float(moment), 0.25 * float(shear)
