"""A straight elastic pipe on a seabed that rubs, pulled along itself at one end.

Where it slips, friction f = mu w per length brings the pull down; ahead of that the slope k_t of
elastic slip does, over l = sqrt(EA/k_t). x is the length that slips, L that to an end that is held,
u the displacement of the pulled end:

    u = P l/EA tanh(L/l)              no slip, up to P = f l coth(L/l)
    u = f/k_t + (P x - f x^2/2)/EA    beyond,  P - f x = f l coth((L - x)/l)

Source: derived, from EA u'' = k_t u and EA u'' = f.
"""

from dataclasses import dataclass
from math import exp, expm1, hypot, inf, isinf, sqrt, tanh

from scipy.optimize import brentq

from ..seabed.bounds import MOST, POSITIVE, within

_FAR = 20.0  # l: coth is 1 there


@dataclass(frozen=True, slots=True)
class Pulled:
    """displacement of the pulled end, m; slipping length, m; anchor: what holds the far end, N."""

    displacement: float
    slipping: float
    anchor: float


@dataclass(frozen=True, slots=True)
class Released:
    """Once the pull is back at nothing.

    displacement of the end that is left, m; slipping: length that slipped back, m; loop: what each
    pull and release from then on takes, J.
    """

    displacement: float
    slipping: float
    loop: float


def pulled(
    pull: float,
    axial_stiffness: float,
    weight: float,
    friction: float,
    *,
    stiffness: float = inf,
    length: float = inf,
) -> Pulled:
    """A pipe at rest, without tension or friction, that is pulled by P, N, at least 0.

    axial_stiffness EA, N; weight in water w, N/m; friction: its coefficient along the pipe, -;
    stiffness k_t, N/m2, infinite for friction of the rigid-plastic kind; length L, m, infinite for
    a pipe whose far end nothing reaches. Raises InvalidData for values that are not above 0.
    """
    f = _resistance(pull, axial_stiffness, weight, friction, stiffness, length)
    if isinf(stiffness):
        slipping = min(pull / f, length)
        anchor = max(pull - f * length, 0.0)
        return Pulled(_drawn(pull, f, slipping) / axial_stiffness, slipping, anchor)
    reach = sqrt(axial_stiffness / stiffness)
    whole, share = length / reach, pull / (f * reach)
    if share * tanh(whole) <= 1.0:
        anchor = pull * 2.0 * exp(-whole) / (1.0 + exp(-2.0 * whole))
        return Pulled(pull * reach / axial_stiffness * tanh(whole), 0.0, anchor)
    behind = _behind(whole - share + 1.0)
    slipping = reach * (share - 1.0 if behind > _FAR else whole - behind)
    moved = f / stiffness + _drawn(pull, f, slipping) / axial_stiffness
    return Pulled(moved, slipping, f * reach * 2.0 * exp(-behind) / -expm1(-2.0 * behind))


def _resistance(pull: float, *values: float) -> float:
    """Friction per length, N/m, of values that are what they have to be."""
    within("pull", pull, 0.0)
    names = ("axial stiffness", "weight", "friction", "stiffness", "length")
    for name, value in zip(names, values, strict=True):
        within(name, min(value, MOST), POSITIVE)  # infinite ones are told apart from it
    return values[1] * values[2]


def _drawn(pull: float, f: float, slipping: float) -> float:
    """EA times the stretch of what slips, N m."""
    return slipping * (pull - 0.5 * f * slipping)


def _behind(free: float) -> float:
    """The length that does not slip, over l: the root of eta - (coth(eta) - 1) = free."""
    if free > _FAR:
        return free
    # 1/eta - 1 < coth(eta) - 1 < 1/eta
    low, high = (2.0 / (hypot(c, 2.0) - c) for c in (free - 1.0, free))
    return float(brentq(lambda eta: eta - 2.0 / expm1(2.0 * eta) - free, low, high, xtol=1e-300))


def released(
    pull: float, axial_stiffness: float, weight: float, friction: float, *, stiffness: float = inf
) -> Released:
    """The same pipe, of no end, after it was pulled by P, N, and let go; units as for `pulled`.

    By Masing's rule, which holds where friction has one limit: from the turn on each point has
    twice its limit to go, so that the end goes back by 2 u(P/2).
    """
    there, half = (
        pulled(p, axial_stiffness, weight, friction, stiffness=stiffness)
        for p in (pull, 0.5 * pull)
    )
    f, slips = friction * weight, half.slipping
    elastic = 0.0 if isinf(stiffness) else sqrt(axial_stiffness / stiffness)
    # 2 P u(P/2) less 8 times what u takes from 0 to P/2
    loop = 2.0 * f**2 * slips**2 * (slips + 3.0 * elastic) / (3.0 * axial_stiffness)
    return Released(there.displacement - 2.0 * half.displacement, slips, loop)
