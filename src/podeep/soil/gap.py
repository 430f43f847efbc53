"""A gap between pile and soil, with drag along its sides, in series with a soil that remembers."""

from collections.abc import Mapping
from typing import ClassVar, NamedTuple

import numpy as np

from ..arrays import Array, Flags
from .approach import ROUNDING, reached, recoverable, root, work
from .memory import Memory, nested, unnested

#: Drag of a wide gap over the peak. Flanks of 2 D with an adhesion of half the strength bear su D
#: of 9 su D: 0.11, twice or three times as much near the mudline. The least of the source's range:
#: it loses the least energy.
DRAG = 0.1
_REBOUND = 1.5  # y50 by which the soil follows the pile back
_DRAG_WAY = 0.5  # y50 over which half the drag comes


class _Place(NamedTuple):
    """Where a displacement leads: the gap's, the drag, the force and its derivative."""

    gap: Array
    drag: Array
    force: Array
    stiffness: Array
    moves: Flags
    sense: Array


class Gap(Memory):
    """Soil and gap in series, y = v + g, so that the first loading is the soil's own curve.

        soil    p(v), with its memory
        gap     rigid where it is shut, g = gr or g = gl; within it p is the drag alone:
                q = +-Cd pult -+ (Cd pult -+ q0) (y50/2) / (y50/2 + |g - g0|)
        room    gl = 1.5 y50 - (y - p/ke), at most 0, at the largest y so far; gr likewise at the
                least; ke = pult/y50

    (g0, q0): where the pile turned last within the gap. Behind the pile the gap opens by what it
    has moved for good, p/ke of the elastic soil and 1.5 y50 of rebound left out.

    soil: the memory without a gap. peak pult (N/m), y50 (m, displacement at half the peak; inf: no
    gap), drag Cd (-): (n,) or one for all.

    Range: clay near the mudline under few large waves; a gap in sand fills.
    Source: Boulanger, Curras, Kutter, Wilson and Abghari, ASCE JGGE 125(9) (1999): rebound, drag
    and the order of the elements. There closure is a stiff spring; here it is rigid, and the soil
    is whatever curve it goes with.
    """

    kept: ClassVar[tuple[str, ...]] = (
        "u", "gap", "drag", "start", "start_drag", "sense", "left", "right",
        "highest", "lowest", "worked",
    )  # fmt: skip

    def __init__(self, soil: Memory, peak: Array, y50: Array, drag: Array | float = DRAG) -> None:
        self.soil = soil
        real = np.isfinite(y50) & np.isfinite(peak)
        self.bound = np.where(real, drag * np.where(real, peak, 0.0), 0.0)
        self.y50 = np.where(real, y50, np.inf)
        self.way = np.where(real, _DRAG_WAY * np.where(real, y50, 1.0), 1.0)
        self.compliance = np.divide(y50, peak, out=np.zeros(len(peak)), where=real & (peak > 0.0))
        zero = np.zeros(len(peak))
        self.u, self.gap, self.drag, self.start, self.start_drag = (zero.copy() for _ in range(5))
        self.left, self.right, self.worked = (zero.copy() for _ in range(3))
        self.highest, self.lowest = zero.copy(), zero.copy()
        self.sense = np.ones(len(peak))

    def _origin(self, sense: Array) -> tuple[Array, Array]:
        """Way from where the drag's branch in a direction starts, and the drag there, along it."""
        on = sense == self.sense
        start = np.where(on, self.start, self.gap)
        return sense * (self.gap - start), sense * np.where(on, self.start_drag, self.drag)

    def _place(self, u: Array) -> _Place:
        force, stiffness = self.soil.evaluate(u - self.gap)
        more = force - self.drag
        sense = np.where(more < 0.0, -1.0, 1.0)
        room = np.where(more < 0.0, self.gap - self.left, self.right - self.gap)
        moves = (room > 0.0) & (more != 0.0)
        if not moves.any():
            return _Place(self.gap, self.drag, force, stiffness, moves, sense)
        room = np.where(moves, room, 0.0)
        before, base = self._origin(sense)

        def excess(x: Array) -> tuple[Array, Array]:
            """Drag less the soil's force, along the motion, after a way x in the gap."""
            p, k = self.soil.evaluate(u - (self.gap + sense * x))
            q, kq = reached(self.bound, base, before + x, self.way, 1.0)
            return q - sense * p, kq + k

        # the gap takes no more of the way than there is of it; the rest is the soil's
        most = np.minimum(room, np.abs(u - self.u))
        inside, x = moves & ((most < room) | (excess(most)[0] > 0.0)), room
        if inside.any():
            span = np.where(inside, most, 0.0)
            noise = ROUNDING * (np.abs(u) + np.abs(self.gap))
            x = np.where(inside, root(excess, np.zeros(len(u)), span, span, noise), room)
        bound = np.where(sense > 0.0, self.right, self.left)
        gap = np.where(inside, self.gap + sense * x, np.where(moves, bound, self.gap))
        q, kq = reached(self.bound, base, before + x, self.way, 1.0)
        force, stiffness = self.soil.evaluate(u - gap)
        both = stiffness + kq
        series = np.divide(stiffness * kq, both, out=np.zeros(len(u)), where=both != 0.0)
        stiffness = np.where(inside, series, stiffness)
        return _Place(gap, np.where(moves, sense * q, self.drag), force, stiffness, moves, sense)

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        place = self._place(u)
        return place.force, place.stiffness

    def commit(self, u: Array) -> None:
        gap, drag, force, _, moves, sense = self._place(u)
        if moves.any():
            before, base = self._origin(sense)
            after = before + sense * (gap - self.gap)
            done = work(self.bound, base, after, self.way, 1.0)
            done -= work(self.bound, base, before, self.way, 1.0)
            self.worked = self.worked + np.where(moves, done, 0.0)
            turned = moves & (sense != self.sense)
            self.start = np.where(turned, self.gap, self.start)
            self.start_drag = np.where(turned, self.drag, self.start_drag)
            self.sense = np.where(moves, sense, self.sense)
            self.gap, self.drag = gap, drag
        self.soil.commit(u - gap)
        lasting = u - force * self.compliance
        left = np.minimum(self.left, _REBOUND * self.y50 - lasting)
        right = np.maximum(self.right, -_REBOUND * self.y50 - lasting)
        self.left = np.where(u > self.highest, left, self.left)
        self.right = np.where(u < self.lowest, right, self.right)
        self.highest, self.lowest = np.maximum(self.highest, u), np.minimum(self.lowest, u)
        self.u = np.array(u)

    @property
    def dissipated(self) -> Array:
        returns = self.drag * self.sense < 0.0
        start = np.where(returns, self.start_drag, self.drag)
        return (
            self.soil.dissipated
            + self.worked
            - recoverable(self.bound, self.drag, start, self.way, 1.0)
        )

    def state(self) -> dict[str, Array]:
        return super().state() | nested("soil", self.soil)

    def restore(self, state: Mapping[str, Array]) -> None:
        super().restore(state)
        self.soil.restore(unnested("soil", state))
