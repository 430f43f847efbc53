"""The hyperbolic seabed of Randolph and Quiggin (2009): penetration, uplift, re-penetration."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array, Flags
from ..soil.energy import energy
from ..soil.memory import Memory
from ..soil.polyline import Values
from .bounds import POSITIVE, within

_SHALLOW = 0.1  # z/D up to which the bearing factor is a square root
_TOUCH = 1e-100  # penetration that counts as none, m: squares of forces there are nothing


@dataclass(frozen=True, eq=False, kw_only=True)
class HyperbolicSoil:
    """Clay under a pipe, numbers or (n,).

        su(z) = su0 + rho z,   Nc = a (z/D)^b from z/D = 0.1 on, Nc(0.1) sqrt(10 z/D) below
        Pu = Nc su D,          Pus = -f_suc Pu,          zeta = K_max z/D

    diameter D, m, in contact; undrained_shear_strength su0 (Pa) at the mudline, strength_gradient
    rho, Pa/m; factor a, exponent b, normalised_stiffness K_max, suction_ratio f_suc, suction_decay
    lambda_suc, repenetration_offset lambda_rep, whose defaults are from memory of the paper.
    """

    diameter: Values
    undrained_shear_strength: Values
    strength_gradient: Values = 0.0
    factor: Values = 6.0
    exponent: Values = 0.25
    normalised_stiffness: Values = 200.0
    suction_ratio: Values = 0.6
    suction_decay: Values = 0.6
    repenetration_offset: Values = 0.3

    def __post_init__(self) -> None:
        within("diameter, m,", self.diameter, POSITIVE)
        within("undrained shear strength, Pa,", self.undrained_shear_strength, 0.0)
        within("gradient of the undrained shear strength, Pa/m,", self.strength_gradient, 0.0)
        within("factor a of bearing", self.factor, POSITIVE)
        within("exponent b of bearing", self.exponent, 0.0)
        within("normalised stiffness", self.normalised_stiffness, POSITIVE)
        within("suction ratio", self.suction_ratio, 0.0)
        within("suction decay", self.suction_decay, POSITIVE)
        within("repenetration offset", self.repenetration_offset, 0.0)

    def ultimate(self, z: Array) -> tuple[Array, Array]:
        """Pu at penetrations z > 0, N/m, and its derivative."""
        D, b = self.diameter, self.exponent
        ratio = z / D
        deep = ratio >= _SHALLOW
        power = np.where(deep, b, 0.5)
        start = self.factor * np.power(_SHALLOW, b)
        factor = start * np.power(ratio / _SHALLOW, power)
        strength = self.undrained_shear_strength + self.strength_gradient * z
        rise = factor / ratio * power * strength + factor * self.strength_gradient * D
        return np.asarray(factor * strength * D), np.asarray(rise)

    def evaluate(self, z: Array) -> tuple[Array, Array]:
        """First penetration, P = zeta/(1 + zeta) Pu: a backbone; 0 where z <= 0."""
        inside = z > _TOUCH
        z = np.where(inside, z, self.diameter)
        most, rise = self.ultimate(z)
        zeta = self.normalised_stiffness / self.diameter * z
        share = zeta / (1.0 + zeta)
        slope = share * rise + most * share / (z * (1.0 + zeta))
        return np.where(inside, share * most, 0.0), np.where(inside, slope, 0.0)


class Hyperbolic(Memory):
    """Vertical reaction of the seabed by hyperbolas, penetration z positive down, P up.

        first     P = zeta/(1 + zeta) Pu(z)
        uplift    P = P0 - S,  1/S = 1/(c d) + 1/G,  G = P0 - Pus(z),  c = Pu(z0)
                  P >= E Pus(z),    E = exp(min(0, (z - z0)/(lambda_suc z_max)))
        again     P = P0 + S,  1/S = 1/(c d) + 1/G,  G = Pu(z) - P0,   c = Pu(z0*)
                  P <= E P_first(z), E = exp(min(0, z/z_max - (1 + lambda_rep)))

    from the last reversal (z0, P0), at d = |zeta - zeta0| from it; z0* is where the uplift before
    began. Any reversal starts with the slope K_max c/D. Off the seabed P = 0, with a drop from
    what little the uplift curve has left there.

    z_max grows with z, so that the bound of re-penetration stays at exp(-lambda_rep) of the first
    curve for ever. rejoins: z_max is that before the re-penetration, which then joins the first
    curve at (1 + lambda_rep) z_max. The words of the source allow both, the form of the bound
    speaks for the second.

    The bound of re-penetration holds after a pull alone (P0 <= 0). After less the force would drop
    to it at once, and small cycles would give energy. This is ours.

    Range: slow cycles; no rate, no softening by remoulding, no recovery with time.
    Source: Randolph and Quiggin, OMAE2009-79259; ultimate resistance and zeta as OrcaFlex's theory
    prints them, hyperbolas, bounds and default numbers from memory: a check of what is written
    here, not of the paper. Work, for `dissipated`, by the trapezoidal rule over the committed path.
    """

    kept: ClassVar[tuple[str, ...]] = (
        "z", "force", "down", "virgin", "start", "base", "most", "deepest", "before", "worked",
    )  # fmt: skip

    def __init__(self, soil: HyperbolicSoil, size: int, *, rejoins: bool = False) -> None:
        self.soil, self.rejoins = soil, rejoins
        zero = np.zeros(size)
        #: penetration, 0 off the seabed, and force there
        self.z, self.force = zero.copy(), zero.copy()
        self.down, self.virgin = np.ones(size, dtype=bool), np.ones(size, dtype=bool)
        #: the last reversal, and Pu where the last uplift began
        self.start, self.base, self.most = (zero.copy() for _ in range(3))
        #: largest penetration, now and before the present way down
        self.deepest, self.before = zero.copy(), zero.copy()
        self.worked = zero.copy()

    # --- the curves -------------------------------------------------------------------------------

    def _branch(self, u: Array) -> tuple[Flags, Flags, Array, Array]:
        """Whether a way leads down and whether it turns; the reversal that it comes from."""
        down = (u > self.z) | ((u == self.z) & self.down)
        turns = down != self.down
        start = np.where(turns, self.z, self.start)
        return down, turns, start, np.where(turns, self.force, self.base)

    def _most(self, lifts: Flags) -> Array:
        """Pu where the last uplift began, or begins now."""
        here, _ = self.soil.ultimate(np.where(self.z > 0.0, self.z, self.soil.diameter))
        return np.where(lifts & (self.z > 0.0), here, self.most)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        soil = self.soil
        down, turns, start, base = self._branch(u)
        inside = u > _TOUCH
        z = np.where(inside, u, soil.diameter)
        most, rise = soil.ultimate(z)
        first, first_slope = soil.evaluate(z)
        # how far off what the hyperbola tends to is from the reversal, and its derivative
        goal = np.where(down, most - base, base + soil.suction_ratio * most)
        change = np.where(down, rise, -soil.suction_ratio * rise)
        passed = goal <= 0.0
        goal, change = np.where(passed, 0.0, goal), np.where(passed, 0.0, change)
        rate = self._most(turns & ~down) * soil.normalised_stiffness / soil.diameter
        way = rate * np.abs(z - start)
        both = np.where(goal + way > 0.0, goal + way, 1.0)
        force = base + np.where(down, 1.0, -1.0) * way * goal / both
        slope = (rate * goal**2 + way**2 * change) / both**2
        # bounds
        decay = soil.suction_decay * np.where(self.deepest > 0.0, self.deepest, soil.diameter)
        share = -soil.suction_ratio * np.exp(np.minimum(0.0, (z - start) / decay))
        low, low_slope = share * most, share * (rise + most / decay)
        share, growth = self._regained(z, turns)
        high, high_slope = share * first, share * (first_slope + growth * first)
        over, under = down & (base <= 0.0) & (force > high), ~down & (force < low)
        new = down & self.virgin
        force = np.select([new, over, under], [first, high, low], force)
        slope = np.select([new, over, under], [first_slope, high_slope, low_slope], slope)
        return np.where(inside, force, 0.0), np.where(inside, slope, 0.0)

    def _regained(self, z: Array, turns: Flags) -> tuple[Array, Array]:
        """E of re-penetration, and its derivative over it."""
        if self.rejoins:
            largest = np.where(turns, self.deepest, self.before)
            still = np.ones(z.shape, dtype=bool)
        else:
            largest, still = np.maximum(self.deepest, z), z <= self.deepest
        largest = np.where(largest > 0.0, largest, z)
        power = z / largest - 1.0 - self.soil.repenetration_offset
        growth = np.where(still & (power < 0.0), 1.0 / largest, 0.0)
        return np.exp(np.minimum(0.0, power)), growth

    # --- the memory -------------------------------------------------------------------------------

    def commit(self, u: Array) -> None:
        force, _ = self.evaluate(u)
        down, turns, self.start, self.base = self._branch(u)
        lifts = turns & ~down
        self.most = self._most(lifts)
        self.virgin = self.virgin & ~((self.z > 0.0) & ~down)
        self.before = np.where(turns & down, self.deepest, self.before)
        z = np.where(u > _TOUCH, u, 0.0)
        self.worked = self.worked + 0.5 * (self.force + force) * (z - self.z)
        self.deepest = np.maximum(self.deepest, z)
        self.z, self.force, self.down = z, force, down

    @property
    def dissipated(self) -> Array:
        up = energy(_Back(self, -1.0), np.maximum(self.z, 0.0))
        return np.asarray(self.worked - up - energy(_Back(self, 1.0), self._diameter()))

    def _diameter(self) -> Array:
        return np.array(np.broadcast_to(self.soil.diameter, self.z.shape), dtype=float)


@dataclass(frozen=True, eq=False)
class _Back:
    """What a hyperbolic seabed gives back on a way from its state, up (-1) or down (1)."""

    law: Hyperbolic
    sense: float

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, slope = self.law.evaluate(self.law.z + self.sense * u)
        back = np.maximum(-self.sense * force, 0.0)
        return back, np.where(back > 0.0, -slope, 0.0)
