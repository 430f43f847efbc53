"""How strongly a seabed holds a pipe that is pulled out, and over how long a way."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..scene import Suction
from ..soil.polyline import Values
from .bounds import POSITIVE, within

FORCE_EXPONENT, REACH_EXPONENT = 0.18, 0.26
_FORCE, _REACH = 1.12, 0.98
_SOONEST = 1e-6  # least of x_c1
_SHARPEST = 0.95  # most of x_c2: beyond it suction would fall off a cliff


def force_factor(
    diameter: Values, undrained_shear_strength: Values, exponent: float = FORCE_EXPONENT
) -> Values:
    """alpha_f = 1.12 D su / D^n_f, so that F_max = alpha_f v^n_f = 1.12 D su (v/D)^n_f.

    diameter D, m; undrained_shear_strength su, Pa. Source: theory page of DeepLines after Bridge,
    Laver, Clukey and Evans (2004), OTC 16628; the paper was not at hand.
    """
    return _FORCE * diameter * undrained_shear_strength / np.power(diameter, exponent)


def reach_factor(diameter: Values) -> Values:
    """alpha_D = 0.98 D, so that Delta_B = alpha_D v^n_D, v in m/s; source as `force_factor`."""
    return _REACH * diameter


@dataclass(frozen=True, eq=False, kw_only=True)
class PullOut:
    """The pull of suction against the lift y of the pipe from where its contact force was nil.

        F_max = alpha_f v^n_f        Delta_B = alpha_D v^n_D        x = y/Delta_B
        F/F_max = x/x_c1, then 1, from x_c2 on (1 - x)/(1 - x_c2), and 0 from x = 1 on: breakout

    v is the velocity of pull-out, m/s, F in N/m, y in m. The laws are not free of units: their
    factors refer to v/D = 1 1/s and to v = 1 m/s.

    force_factor alpha_f, reach_factor alpha_D: `force_factor`, `reach_factor`, or numbers of your
    own, (n,) or one. mobilised x_c1, released x_c2: 1e-6 <= x_c1 <= x_c2 <= 0.95. least_speed v_c,
    m/s: the floor of v; without it F_max would vanish with v, at an infinite rate.

    Source: F_max, Delta_B and the two cut-offs from DeepLines' theory page, which gives no numbers
    for the cut-offs: 0.12 and 0.30 are the defaults of RIFLEX (its input manual). The straight
    lines between are a reconstruction. v_c is ours: the lowest speed of the laws' check table.
    """

    force_factor: Values
    reach_factor: Values
    force_exponent: float = FORCE_EXPONENT
    reach_exponent: float = REACH_EXPONENT
    mobilised: float = 0.12
    released: float = 0.30
    least_speed: float = 1e-6

    def __post_init__(self) -> None:
        within("force factor of suction", self.force_factor, 0.0, field="ALPHAF")
        within("exponent of the force of suction", self.force_exponent, 0.0, 1.0, "NF")
        within("reach factor of suction", self.reach_factor, POSITIVE, field="ALPHAD")
        within("exponent of the reach of suction", self.reach_exponent, 0.0, 1.0, "ND")
        within("cut-off x_c2", self.released, _SOONEST, _SHARPEST, "XC2")
        within("cut-off x_c1", self.mobilised, _SOONEST, self.released, "XC1")
        within("least velocity of pull-out, m/s,", self.least_speed, POSITIVE)

    def force(self, speed: Values) -> Array:
        """F_max at a velocity of pull-out, N/m."""
        return np.asarray(self.force_factor * self._at_least(speed) ** self.force_exponent)

    def reach(self, speed: Values) -> Array:
        """Delta_B at a velocity of pull-out, m."""
        return np.asarray(self.reach_factor * self._at_least(speed) ** self.reach_exponent)

    def terminal_speed(self, pull: Values) -> Array:
        """Velocity at which the plateau of the suction bears a pull, m/s: (F/alpha_f)^(1/n_f).

        Unlike F(v) it is smooth at 0; a pull of 10 % more is 1.7 times as fast.
        """
        return np.asarray(np.power(pull / self.force_factor, 1.0 / self.force_exponent))

    def _at_least(self, speed: Values) -> Array:
        return np.maximum(speed, self.least_speed)

    # --- the shape --------------------------------------------------------------------------------

    def share(self, x: Array, left: Values) -> tuple[Array, Array]:
        """F/F_max at x, (n,), and its derivative; left: the most of it that is still there."""
        rise, fall = x / self.mobilised, (1.0 - x) / (1.0 - self.released)
        share = np.minimum(np.minimum(rise, left), fall)
        slope = np.where(rise < np.minimum(left, fall), 1.0 / self.mobilised, 0.0)
        slope = np.where(fall < np.minimum(left, rise), -1.0 / (1.0 - self.released), slope)
        inside = share > 0.0
        return np.where(inside, share, 0.0), np.where(inside, slope, 0.0)

    def area(self, x: Array, left: Array) -> Array:
        """Integral of `share` from 0 to x."""
        up, down = left * self.mobilised, 1.0 - left * (1.0 - self.released)
        x = np.clip(x, 0.0, 1.0)
        rising = 0.5 * np.minimum(x, up) ** 2 / self.mobilised
        flat = left * (np.clip(x, up, down) - up)
        falling = 0.5 * ((1.0 - down) ** 2 - (1.0 - np.maximum(x, down)) ** 2)
        return np.asarray(rising + flat + falling / (1.0 - self.released))

    def energy(self, speed: Values) -> Array:
        """What a whole pull-out takes, J/m: F_max Delta_B (1 + x_c2 - x_c1)/2."""
        shape = 0.5 * (1.0 + self.released - self.mobilised)
        return self.force(speed) * self.reach(speed) * shape


@dataclass(frozen=True, eq=False, kw_only=True)
class Wear:
    """What is left of the suction after the pipe has worked the soil.

        d = d_rem + (1 - d_rem) exp(-3 xi/xi_95)

    xi: way below the mudline, up and down, over the diameter. diameter: m. remaining d_rem: of the
    remoulded soil, 0 to 1. travel_95 xi_95: xi by which 95 % of the loss has come.

    Source: form of Einav and Randolph (2005), from memory, given there for the strength of soil
    that is sheared. That suction follows it is our reading of DeepLines' theory page, which says
    no more than that suction decreases in cycles. So it holds for suction alone, and numbers are
    yours.
    """

    diameter: Values
    remaining: float
    travel_95: float

    def __post_init__(self) -> None:
        within("diameter, m,", self.diameter, POSITIVE)
        within("share of suction that remains", self.remaining, 0.0, 1.0)
        within("travel to 95 % of wear, over the diameter,", self.travel_95, POSITIVE)

    def left(self, way: Array) -> Array:
        """d after a way, m."""
        decay = np.exp(-3.0 * way / self.diameter / self.travel_95)
        return np.asarray(self.remaining + (1.0 - self.remaining) * decay)


def pull_out_of(suction: Suction, diameter: Values) -> PullOut:
    """The law of a scene's suction on a pipe of a diameter, m.

    Raises InvalidData for values out of bounds.
    """
    force: Values | None = suction.force_factor
    if force is None:  # then it has a strength
        strength = suction.undrained_shear_strength or 0.0
        force = force_factor(diameter, strength, suction.force_exponent)
    reach = suction.reach_factor
    return PullOut(
        force_factor=force,
        reach_factor=reach_factor(diameter) if reach is None else reach,
        force_exponent=suction.force_exponent,
        reach_exponent=suction.reach_exponent,
        mobilised=suction.mobilised,
        released=suction.released,
    )
