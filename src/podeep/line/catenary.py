"""Elastic catenaries that hang from two ends, lie on a flat rigid seabed in between, or both.

Of a suspended part with the horizontal tension H and the vertical one V at its upper end, over the
weight W per unstretched length, from where its slope is 0:

    x = (H/W) asinh(V/H) + H V/(W EA),   z = (H/W) (sqrt(1 + (V/H)^2) - 1) + V^2/(2 W EA)

Source: Jonkman, NREL/TP-500-41958 (2007), section 2.5, as MAP++ and MoorPy have it.
"""

from dataclasses import dataclass
from math import asinh, exp, hypot, inf, log, log1p, sqrt

import numpy as np
from scipy.optimize import brentq, root

from ..arrays import Array
from ..errors import InvalidData


@dataclass(frozen=True, slots=True)
class Grounded:
    """A line that lies on the seabed from its anchor on, as far as it does, and then hangs.

    horizontal, vertical: tension at the upper end, N; anchor: horizontal tension there, N;
    anchor_vertical: N, what the anchor bears upwards where nothing lies. lying: unstretched length
    on the seabed, m; slack: part of it without tension, from the anchor, m.
    """

    horizontal: float
    vertical: float
    anchor: float
    anchor_vertical: float
    lying: float
    slack: float

    @property
    def tension(self) -> float:
        """At the upper end, N."""
        return hypot(self.horizontal, self.vertical)


def grounded(
    span: float,
    height: float,
    length: float,
    axial_stiffness: float,
    weight: float,
    friction: float = 0.0,
) -> Grounded:
    """A line from an anchor on the seabed to an end a span away and a height above, all in m.

    length: unstretched, m; axial_stiffness EA, N; weight W, N/m; friction: its coefficient, with
    all of what slides towards the upper end. Raises InvalidData where there is no such line.
    """
    H, V = _tensions(span, height, length, axial_stiffness, weight, friction)
    lying = max(length - V / weight, 0.0)
    held = H - friction * weight * lying
    slack = max(-held / (friction * weight), 0.0) if friction else 0.0
    return Grounded(H, V, max(held, 0.0), max(V - weight * length, 0.0), lying, slack)


def _tensions(
    span: float, height: float, length: float, EA: float, W: float, mu: float
) -> tuple[float, float]:
    """Horizontal and vertical tension at the upper end, N, by Newton's method on both closures."""
    if not hypot(span, height) < length * 1.2:
        raise InvalidData(
            f"a line of {length:g} m does not reach over {hypot(span, height):g} m",
            "give a longer line, or ends nearer to each other",
            "LENGTH",
        )

    def misses(logs: Array) -> Array:
        H, V = np.exp(logs)
        lying = length - V / W
        if lying > 0.0:
            loose = max(lying - H / (mu * W), 0.0) if mu else 0.0
            x = lying + H / W * asinh(V / H) + H * length / EA
            x -= mu * W / (2.0 * EA) * (lying**2 - loose**2)
            z = H / W * (sqrt(1.0 + (V / H) ** 2) - 1.0) + V**2 / (2.0 * EA * W)
        else:
            low = V - W * length
            x = H / W * (asinh(V / H) - asinh(low / H)) + H * length / EA
            z = H / W * (sqrt(1.0 + (V / H) ** 2) - sqrt(1.0 + (low / H) ** 2))
            z += (V**2 - low**2) / (2.0 * EA * W)
        return np.array([x - span, z - height])

    hanging = min(hypot(span, height), length)
    guess = _inextensible(span, height, length) * W
    start = np.log([max(guess, 1e-3 * W * hanging), W * hanging])
    for more in ((0.0, 0.0), (1.0, 0.0), (-2.0, 0.0), (3.0, 1.0)):
        found = root(misses, start + np.array(more), method="hybr", options={"xtol": 1e-14})
        if np.abs(misses(found.x)).max() < 1e-9 * length:
            H, V = np.exp(found.x).tolist()
            return H, V
    raise InvalidData(
        f"no catenary of {length:g} m over {span:g} m and {height:g} m up was found",
        "check length, ends and weight of the line",
        "LENGTH",
    )


def _inextensible(span: float, height: float, length: float) -> float:
    """H/W, m, of an inextensible line that lies where it can without friction."""

    def excess(h: float) -> float:
        hanging = sqrt(height**2 + 2.0 * height * h)
        return length - hanging + h * asinh(hanging / h) - span

    low, high = 1e-9 * length, 1e6 * length
    if excess(low) > 0.0 or excess(high) < 0.0:
        return length
    return float(brentq(excess, low, high))


def shape(
    s: Array, span: float, heights: tuple[float, float], length: float
) -> tuple[Array, Array, float]:
    """An inextensible line over a seabed at z = 0: places (n, 2) and tangents (n, 2) at arcs s.

    span: between the ends, m; heights of the ends above the seabed, at least 0, m. Returns H/W, m,
    too: infinite where the line is as long as the way between its ends, or shorter.
    """
    low, high = heights
    way = hypot(span, high - low)
    if length <= way * (1.0 + 1e-9):
        direction = np.array([span, high - low]) / way
        places = np.outer(s * way / length, direction) + np.array([0.0, low])
        return places, np.tile(direction, (len(s), 1)), inf
    h, first, second = _two_sided(span, low, high, length)
    if first + second <= length:  # hangs from both ends, lies in between
        left, right = first - s, s - (length - second)
        hanging = np.where(left > 0.0, -left, np.maximum(right, 0.0))
        x = h * np.arcsinh(hanging / h) + np.clip(s, first, length - second)
        x += h * np.arcsinh(first / h) - first
        z = np.sqrt(h**2 + hanging**2) - h
        root_ = np.sqrt(h**2 + hanging**2)
        return np.stack([x, z], 1), np.stack([h / root_, hanging / root_], 1), h
    h, foot = _hanging(span, high - low, length)
    from_foot = s - foot
    root_ = np.sqrt(h**2 + from_foot**2)
    x = h * (np.arcsinh(from_foot / h) + np.arcsinh(foot / h))
    z = low + root_ - np.sqrt(h**2 + foot**2)
    return np.stack([x, z], 1), np.stack([h / root_, from_foot / root_], 1), h


def _two_sided(span: float, low: float, high: float, length: float) -> tuple[float, float, float]:
    """H/W and the lengths that hang from the first end and the second, m."""

    def hangs(h: float) -> tuple[float, float]:
        return sqrt(low**2 + 2.0 * low * h), sqrt(high**2 + 2.0 * high * h)

    def excess(h: float) -> float:
        parts = hangs(h)
        return length - sum(parts) + sum(h * asinh(part / h) for part in parts) - span

    bottom, top = 1e-9 * length, 1e9 * length
    if excess(bottom) >= 0.0:
        h = bottom
    elif excess(top) <= 0.0:
        h = top
    else:
        h = float(brentq(excess, bottom, top))
    return h, *hangs(h)


def _hanging(span: float, rise: float, length: float) -> tuple[float, float]:
    """H/W of an inextensible line that hangs freely, and the arc at its lowest point, m."""
    chord = sqrt(length**2 - rise**2)

    def excess(h: float) -> float:  # 2 h sinh(span/2h) = chord, without overflow
        x = span / (2.0 * h)
        return log(h / chord) + x + log1p(-exp(-2.0 * x))

    h = float(brentq(excess, 1e-4 * span, 1e5 * span))
    middle = h * np.arctanh(np.clip(rise / length, -1.0 + 1e-15, 1.0 - 1e-15))
    foot = h * np.sinh(span / (2.0 * h) - middle / h)
    return h, float(foot)
