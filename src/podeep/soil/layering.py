"""Layered ground: the depth at which a layer would lie if its soil reached to the mudline."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isinf

import numpy as np

from ..arrays import Array
from ..errors import InvalidData

_ORDER = 8
_LEGENDRE = np.polynomial.Legendre.basis(_ORDER)
#: Lobatto's nodes and weights on (-1, 1)
_NODES = np.array((-1.0, *_LEGENDRE.deriv().roots(), 1.0))
_WEIGHTS = 2.0 / (_ORDER * (_ORDER + 1) * _LEGENDRE(_NODES) ** 2)
#: from values at the nodes of a panel to those of its polynomial at the nodes of its halves
_THROUGH = np.linalg.solve(
    np.polynomial.legendre.legvander(_NODES, _ORDER).T,
    np.polynomial.legendre.legvander(0.5 * np.append(_NODES - 1.0, _NODES + 1.0), _ORDER).T,
)
_PANELS = 4  # of an integral before any is halved
_HALVINGS = 60
_TOLERANCE = 1e-13  # of an integral, by which a panel may be astray
_DEEPEST = 2.0**17  # m, where the search for an equivalent depth ends


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Layer:
    """A layer between two actual depths, as the layering sees it.

    top, bottom: m below the mudline; the last bottom may be inf.
    ultimate: static pu (N/m) at equivalent depths h (m), both (n,), of the soil at the layer's top
    as if it reached from the mudline; None for a layer that has no equivalent depth (no reaction,
    or one that does not come from depth: rock, user rows).
    inside: pu at equivalent depths h and actual depths z within the layer, all (n,), where the soil
    varies over the layer; None where it does not, which is ultimate(h), or 0 without that.
    """

    top: float
    bottom: float
    ultimate: Callable[[Array], Array] | None
    inside: Callable[[Array, Array], Array] | None = None


def depth_shifts(layers: Sequence[Layer]) -> Array:
    """Equivalent less actual depth of each layer, m, shape (layers,), by Georgiadis.

    The soil above a layer counts by the force F (N) that it resists with in all, not by its
    thickness. A layer's top lies at the equivalent depth h at which its own soil, reaching to the
    mudline, would have gathered as much:

        int from 0 to h of pu dh = F
        F = int of pu dz over the layers above, each at z plus its own shift
        shift = h - top

    With F = 0 (first layer, or none above resists) h is 0. A layer without equivalent depth has
    shift 0 and adds to F what it resists with at its actual depth. What the law takes at z + shift,
    and whether the overburden in pu is that of the layer's own soil (g' h, the original reading)
    or the actual one, is the caller's choice.

    layers: from the top, each beginning where the one above ends. Equivalent depths are good to
    1e-10 where pu is smooth but for some kinks or jumps. Raises InvalidData where a layer's own
    soil cannot gather F at any depth.
    Source: Georgiadis, Development of p-y curves for layered soils, ASCE (1983).
    """
    ends = [0.0 if not layers else layers[0].top]
    for layer in layers:
        if not 0.0 <= ends[-1] == layer.top < layer.bottom:
            raise ValueError("layers follow each other downwards without gap or overlap")
        ends.append(layer.bottom)
    force, shifts = 0.0, np.zeros(len(layers))
    for i, layer in enumerate(layers):
        h = layer.top
        if layer.ultimate is not None:
            h = equivalent_depth(layer.ultimate, force)
            if isinf(h):
                raise _too_weak(layer, layer.ultimate, force)
        shifts[i] = h - layer.top
        if i + 1 < len(layers):
            force += _gathered(layer, h)
    return shifts


def equivalent_depth(ultimate: Callable[[Array], Array], force: float) -> float:
    """Depth h (m) down to which `ultimate`, pu (N/m) by depth, gathers a force (N); inf if never.

    pu is not negative. The smallest depth asked for is 0, the largest 131 km.
    """
    # takes half a second to import, which only layered grounds should wait for
    from scipy.optimize import brentq

    if force <= 0.0:
        return 0.0
    start, end, left = 0.0, 1.0, force
    while not (gathered := integral(ultimate, start, end)) >= left:
        left -= gathered
        start, end = end, 2.0 * end
        if end > _DEEPEST:
            return inf
    return float(
        brentq(
            lambda h: integral(ultimate, start, h) - left,
            start,
            end,
            xtol=1e-14,
            rtol=4.0 * np.finfo(float).eps,
        )
    )


def integral(function: Callable[[Array], Array], start: float, end: float) -> float:
    """Integral of a function of shape (n,) -> (n,): Lobatto's rule on panels that are halved.

    A panel is settled when the function is its polynomial at the nodes of its halves too, to 1e-13
    of the whole integral. Two sums that agree would not do, nor nodes without the panel's ends: a
    kink can stand where neither shows it.
    """
    width = (end - start) / _PANELS
    left: Array = np.asarray(start + width * np.arange(_PANELS))
    values, settled = _sampled(function, left, width), 0.0
    for _ in range(_HALVINGS):
        width *= 0.5
        left = np.stack((left, left + width), axis=-1)
        halves = _sampled(function, left, width)
        gathered = 0.5 * width * (halves @ _WEIGHTS).sum(axis=-1)
        astray = np.abs(halves.reshape(len(left), -1) - values @ _THROUGH).max(axis=-1)
        doubt = width * astray > _TOLERANCE * abs(settled + gathered.sum())
        settled += float(gathered[~doubt].sum())
        left, values = left[doubt].ravel(), halves[doubt].reshape(-1, len(_NODES))
        if not doubt.any():
            break
    return settled + float(0.5 * width * (values @ _WEIGHTS).sum())


def _sampled(function: Callable[[Array], Array], left: Array, width: float) -> Array:
    """Values at the nodes (last axis) of panels of one width, given by their left ends."""
    points = left[..., None] + 0.5 * width * (1.0 + _NODES)
    return function(points.ravel()).reshape(points.shape)


def _gathered(layer: Layer, h: float) -> float:
    """Force (N) of a layer whose top lies at equivalent depth h."""
    ultimate, inside, thickness = layer.ultimate, layer.inside, layer.bottom - layer.top
    if inside is not None:
        return integral(lambda below: inside(h + below, layer.top + below), 0.0, thickness)
    return 0.0 if ultimate is None else integral(ultimate, h, h + thickness)


def _too_weak(layer: Layer, ultimate: Callable[[Array], Array], force: float) -> InvalidData:
    own = integral(ultimate, 0.0, _DEEPEST)
    return InvalidData(
        f"the layer from {layer.top:g} m below the mudline has no equivalent depth: the layers "
        f"above it resist with {force:g} N, its own soil with {own:g} N down to {_DEEPEST:g} m",
        "give the layer its strength, or no p-y curve at all, or leave LAYERING=GEORGIADIS out",
        "LAYERING",
    )
