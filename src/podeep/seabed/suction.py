"""A pipe that is pushed into the seabed, pulled out against suction, and pushed in again."""

from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array, Flags
from ..errors import InvalidData
from ..soil.energy import energy
from ..soil.memory import Backbone, Memory
from ..soil.polyline import Values
from .bounds import MOST, POSITIVE, within
from .pull_out import PullOut, Wear

_GRID = np.geomspace(1e-4, 1.0, 129)  # penetrations at which a backbone is looked at, m
_SLACK = 1e-9
_TOUCH = 1e-100  # penetration whose energy is nothing, m


class _Place(NamedTuple):
    """Where a penetration leads: force, derivative, and whether the elastic line's anchor moves.

    bears: below z0. most, reach: F_max and Delta_B; x: lift from z0 over Delta_B.
    """

    force: Array
    tangent: Array
    drags: Flags
    bears: Flags
    most: Array
    reach: Array
    x: Array


class Suction(Memory):
    """The vertical reaction of a seabed with suction, penetration z positive down, R up.

    1. R = f(z), the backbone, at the deepest penetration z_max so far and beyond.
    2. Unloading: R = f(z_max) - k (z_max - z), down to R = 0 at z0.
    3. Suction above z0: along k on to -F(x), F as `PullOut` with x = (z0 - z)/Delta_B, and along
       that curve to breakout.
    4. After it, or after a reversal along k to R = 0, no force until z0 is met again; then along k
       to f(z_max), and the backbone.

    k is the larger of the stiffness given, of f(z_max)/z_max and of f'(z_max): a softer one would
    give back more than was put in. Suction that was released on the way up does not come back
    before the pipe bears again (R > 0).

    Velocity: that of the upward motion, smoothed over `smoothing` and frozen where suction starts.
    So a pull has one F_max and one Delta_B, the force does not depend on the velocity of the moment
    and has no infinite slope at v = 0, and a reversal cannot move the curve underneath the pipe.
    Pulls that speed up after they have started are not followed. `commit` takes the time of a step;
    without it the speed stays as it was given.

    backbone f: rising, 0 at z = 0; asked for z > 0 alone. unloading_stiffness: N/m per metre of
    pipe (N/m at a node), above 0. speed: of pull-out, upward, at first, m/s. smoothing: s, of a
    first-order low-pass. wear: None for none; taken at the start of each pull.

    Source: DeepLines' theory page in words, after Bridge et al. (2004). The rules of unloading,
    reversal and re-penetration are a reconstruction; smoothing, freezing and the least k are ours.
    """

    kept: ClassVar[tuple[str, ...]] = (
        "u", "deepest", "peak", "slope", "anchor", "left", "speed", "travel", "worn", "pulled",
    )  # fmt: skip

    def __init__(
        self,
        backbone: Backbone,
        size: int,
        unloading_stiffness: Values,
        pull_out: PullOut,
        *,
        speed: Values = 0.0,
        smoothing: float = 1.0,
        wear: Wear | None = None,
    ) -> None:
        self.backbone, self.pull_out, self.wear = backbone, pull_out, wear
        self.unloading_stiffness = np.array(np.broadcast_to(unloading_stiffness, size), dtype=float)
        self.smoothing = smoothing
        within("unloading stiffness", unloading_stiffness, POSITIVE, field="KD")
        within("smoothing time of the velocity, s,", smoothing, POSITIVE)
        within("velocity of pull-out, m/s,", speed, -MOST)
        _check_shape(backbone, size, self.unloading_stiffness)
        zero = np.zeros(size)
        #: penetration, its largest, the force and slope of the backbone there
        self.u, self.deepest, self.peak, self.slope = (zero.copy() for _ in range(4))
        #: where the elastic line through the present state is without force
        self.anchor = zero.copy()
        #: most of F_max that this pull still has; nothing before the first contact
        self.left = zero.copy()
        self.speed = np.array(np.broadcast_to(speed, size), dtype=float)
        #: way below the mudline, and as much of it as had passed when the pull began, m
        self.travel, self.worn = zero.copy(), zero.copy()
        self.pulled = zero.copy()  # energy lost to suction

    # --- the curves -------------------------------------------------------------------------------

    @property
    def stiffness(self) -> Array:
        """k of unloading, N/m per metre, (n,)."""
        secant = np.divide(
            self.peak, self.deepest, out=np.zeros_like(self.peak), where=self.deepest > 0.0
        )
        return np.asarray(np.maximum(np.maximum(self.unloading_stiffness, secant), self.slope))

    @property
    def lift_off(self) -> Array:
        """z0, the penetration at which unloading ends, m, (n,)."""
        return np.asarray(self.deepest - self.peak / self.stiffness)

    def _worn(self, lift_off: Array) -> Array:
        """Way below the mudline to where the present pull began, or begins."""
        return np.where(self.u > lift_off, self.travel + self.u - lift_off, self.worn)

    def _place(self, u: Array) -> _Place:
        k, lift_off, pull_out = self.stiffness, self.lift_off, self.pull_out
        most, reach = pull_out.force(self.speed), pull_out.reach(self.speed)
        if self.wear is not None:
            most = most * self.wear.left(self._worn(lift_off))
        x = (lift_off - u) / reach
        share, slope = pull_out.share(x, self.left)
        elastic, curve = k * (u - self.anchor), 0.0 - most * share
        held, gone = elastic <= curve, elastic >= 0.0  # on the curve, or without force
        force = np.where(held, curve, np.minimum(elastic, 0.0))
        tangent = np.where(held, most * slope / reach, np.where(gone, 0.0, k))
        bears = u > lift_off
        force = np.where(bears, k * (u - lift_off), force)
        tangent = np.where(bears, k, tangent)
        return _Place(force, tangent, held | gone, bears, most, reach, x)

    def _first(self, u: Array, further: Flags) -> tuple[Array, Array]:
        """The backbone at penetrations that are reached for the first time."""
        return self.backbone.evaluate(np.where(further, u, _GRID[0]))

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force, tangent = self._place(u)[:2]
        further = (u >= self.deepest) & (u > 0.0)
        if further.any():
            first = self._first(u, further)
            return np.where(further, first[0], force), np.where(further, first[1], tangent)
        return force, tangent

    # --- the memory -------------------------------------------------------------------------------

    def commit(self, u: Array, time: float = 0.0) -> None:
        """As `Memory.commit`; time: what the way took, s, 0 where there is none."""
        place, lift_off = self._place(u), self.lift_off
        self.pulled = self.pulled + np.where(place.bears, 0.0, self._torn(u, place))
        released = self.pull_out.share(np.maximum(place.x, self.pull_out.released), 1.0)[0]
        self.left = np.where(place.bears, 1.0, np.minimum(self.left, released))
        anchor = np.where(place.drags, u - place.force / self.stiffness, self.anchor)
        self.worn = self._worn(lift_off)
        self.travel = self.travel + np.abs(np.maximum(u, 0.0) - np.maximum(self.u, 0.0))
        further = u > self.deepest
        if further.any():
            peak, slope = self._first(u, further)
            self.deepest = np.where(further, u, self.deepest)
            self.peak = np.where(further, peak, self.peak)
            self.slope = np.where(further, slope, self.slope)
        self.anchor = np.where(place.bears, self.lift_off, anchor)
        if time > 0.0:
            share = -np.expm1(-time / self.smoothing)
            smoothed = self.speed + share * ((self.u - u) / time - self.speed)
            self.speed = np.where(place.bears, smoothed, self.speed)
        self.u = np.array(u)

    def _torn(self, u: Array, place: _Place) -> Array:
        """Energy lost on the curve of suction on the way to u, above z0.

        The elastic line from the last state meets the curve where it first meets one of its three
        lines; from there on what the curve takes is lost, but for what the line has stored.
        """
        k, law, left, most = self.stiffness, self.pull_out, self.left, place.most
        lift_off, fall = self.lift_off, 1.0 - law.released
        rise = most / (law.mobilised * place.reach)
        behind = np.maximum(lift_off - self.anchor, 0.0)
        softer = k > rise
        first = np.where(softer, k * behind / np.where(softer, k - rise, 1.0), np.inf)
        second = behind + most * left / k
        third = (most / fall + k * behind) / (k + most / (place.reach * fall))
        met = np.minimum(np.minimum(np.minimum(first, second), third), lift_off - u)
        met = np.maximum(met, 0.0) / place.reach
        force, before = most * law.share(place.x, left)[0], most * law.share(met, left)[0]
        taken = most * place.reach * (law.area(place.x, left) - law.area(met, left))
        return np.asarray(taken - 0.5 * (force**2 - before**2) / k)

    @property
    def dissipated(self) -> Array:
        touched = self.deepest > _TOUCH
        pressed = energy(self.backbone, np.where(touched, self.deepest, 1.0))
        pressed = np.where(touched, pressed, 0.0)
        return np.asarray(pressed - 0.5 * self.peak**2 / self.stiffness + self.pulled)


def _check_shape(backbone: Backbone, size: int, unloading: Array) -> None:
    """Raises InvalidData for a backbone that unloading would make give energy."""
    grid = np.repeat(_GRID[:, None], size, axis=1)
    force, slope = backbone.evaluate(grid)
    stiffens = slope * grid > force * (1.0 + _SLACK)
    softens = slope[1:] < slope[:-1] * (1.0 - _SLACK)
    steep = np.where(stiffens[:-1] & softens, slope[:-1], 0.0).max(axis=0)
    if (steep > unloading).any():
        raise InvalidData(
            f"the backbone stiffens to a slope of {steep.max():.4g} before it softens, more than "
            f"the unloading stiffness of {unloading[steep > unloading].min():.4g}: pushed in and "
            "let go the seabed would give energy",
            f"unload with {steep.max():.4g} or more",
            "KD",
        )
