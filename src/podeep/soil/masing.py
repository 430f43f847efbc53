"""Masing's rules, extended: any odd backbone becomes a reaction that remembers its reversals."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..arrays import Array, Index
from .energy import energy
from .memory import Backbone, Memory

_WIDTH = 8  # turns that a point can hold before the stacks grow
_QUEUE = 32  # closed loops of a point that may wait for their energy
#: the backbone as a branch: origin, force there, scale, end, row of the stack
_BACKBONE = np.array([[0.0], [0.0], [1.0], [np.inf], [0.0]])
_NONE: Index = np.zeros(0, dtype=np.intp)


class Masing(Memory):
    """Masing's rules on a backbone f.

        backbone                    p = f(u)
        from a reversal (ur, pr)    p = pr + 2 f((u - ur) / 2)

    A branch that comes to the reversal before its own closes a loop: both are forgotten, and the
    branch before them goes on. One that comes to the largest |u| so far goes on along the
    backbone. Energy lost: 2 F(u) - u f(u) along the backbone, F being the work of f, and twice
    that of half its length along a branch.

    backbone: odd, and of a tangent that never exceeds its secant (`energy.gives_back`), so that no
    loop gives energy; not softening (`energy.held`), so that forces stay on their curve.

    Source: Masing (1926); extended rules after Pyke, ASCE GT6 (1979), and Vucetic (1990). They are
    those of a set of elastic-plastic elements side by side (Iwan 1967).
    """

    kept: ClassVar[tuple[str, ...]] = (
        "turns",
        "forces",
        "last",
        "u",
        "force",
        "rising",
        "closed",
    )

    def __init__(self, backbone: Backbone, size: int) -> None:
        self.backbone = backbone
        # Row by row: the reversals, each between the two before it, from -u1 and u1 = +-max |u|
        # on, and above the last one where the point is. Rows from there on mean nothing.
        self.turns: Array = np.zeros((_WIDTH, size))
        self.forces: Array = np.zeros((_WIDTH, size))
        self.last: Index = np.ones(size, dtype=np.intp)
        self.u, self.force, self.closed = np.zeros(size), np.zeros(size), np.zeros(size)
        self.rising = np.ones(size, dtype=bool)
        self._point = np.arange(size)
        self._on, self._back = np.empty((5, size)), np.empty((5, size))
        # half lengths of closed loops whose loss is not added up yet, and how often each counts
        self._halves, self._shares = np.zeros((_QUEUE, size)), np.zeros((_QUEUE, size))
        self._waiting: Index = np.zeros(size, dtype=np.intp)
        self._ready()

    # --- branches ---------------------------------------------------------------------------------

    def _ready(self) -> None:
        """The branch of either direction from here: origin, its force, scale, end, row of origin.

        The backbone is a branch from 0 of scale 1 without an end, in row 0.
        """
        u, on, back = self.u, self._on, self._back
        here = self.last * len(u) + self._point
        self.turns.take(here, out=on[0])
        self.forces.take(here, out=on[1])
        self.turns.take(here - len(u), out=on[3])
        on[4] = self.last
        back[0], back[1], back[3] = u, self.force, on[0]
        np.add(on[4], 1.0, out=back[4])
        up = on[3] > on[0]
        virgin = u == on[0]
        back[2] = on[2] = 2.0
        if virgin.any():
            end = np.where(u < 0.0, -np.inf, np.inf)
            for branch, at in ((back, virgin), (on, virgin & (u == 0.0))):
                for part, value in ((0, 0.0), (1, 0.0), (2, 1.0), (4, 0.0)):
                    np.copyto(branch[part], value, where=at)
                np.copyto(branch[3], end, where=at)
                end = -end
        self._onward = up
        self._down, self._up = np.where(up, back, on), np.where(up, on, back)
        # where a displacement of no change goes on as the point went
        self._split = np.where(self.rising, u, np.nextafter(u, np.inf))

    def _branch(self, u: Array) -> tuple[Array, Index]:
        """The branch on which u lies, as `_ready` gives it, and the points that left theirs."""
        branch = np.where(u >= self._split, self._up, self._down)
        inside = u > self._down[3]
        inside &= u < self._up[3]
        if inside.all():
            return branch, _NONE
        out = np.flatnonzero(~inside)
        n, at, end = len(u), u.take(out), branch[3].take(out)
        rises = end > branch[0].take(out)
        row = branch[4].take(out).astype(np.intp) - 2
        while True:
            place = row * n + out
            end = self.turns.take(place - n, mode="clip")
            passed = np.where(rises, at >= end, at <= end) & (row > 0)
            if not passed.any():
                break
            row -= 2 * passed
        virgin = row <= 0
        origin, base = (s.take(place, mode="clip") for s in (self.turns, self.forces))
        outer = np.array((origin, base, np.full(len(out), 2.0), end, row))
        outer[:, virgin] = _BACKBONE
        outer[3, virgin] = np.where(rises[virgin], np.inf, -np.inf)
        branch[:, out] = outer
        return branch, out

    def _force(self, u: Array, branch: Array) -> tuple[Array, Array]:
        origin, base, scale, _, _ = branch
        force, stiffness = self.backbone.evaluate((u - origin) / scale)
        return base + scale * force, stiffness

    # --- the memory -------------------------------------------------------------------------------

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self._force(u, self._branch(u)[0])

    def commit(self, u: Array, share: Array | float = 1.0) -> None:
        """As `Memory.commit`; share: of the loss of loops that close now, what counts."""
        branch, left = self._branch(u)
        force, _ = self._force(u, branch)
        row = branch[4].astype(np.intp)
        if left.size:
            self._close(u, left, row.take(left), share)
        virgin = row == 0
        if virgin.any():
            row[virgin] = 1
            for stack, value in ((self.turns, u), (self.forces, force)):
                np.copyto(stack[0], -value, where=virgin)
                np.copyto(stack[1], value, where=virgin)
        if row.max(initial=0) + 2 > len(self.turns):
            more = np.zeros(self.turns.shape)
            self.turns = np.concatenate((self.turns, more))
            self.forces = np.concatenate((self.forces, more))
        above = (row + 1) * len(u) + self._point
        self.turns.put(above, u)
        self.forces.put(above, force)
        self.rising = np.where(u == self.u, self.rising, u > self.u)
        self.u, self.force, self.last = np.array(u), force, row
        self._ready()

    def _close(self, u: Array, points: Index, last: Index, share: Array | float) -> None:
        """Note the loops that points close on their way to the branch of a row."""
        n = len(u)
        onward = (u.take(points) >= self._split.take(points)) == self._onward.take(points)
        row = self.last.take(points) + np.where(onward, 0, 1)
        counted = np.broadcast_to(share, u.shape)
        while points.size:
            place = row * n + points
            half = 0.5 * np.abs(self.turns.take(place) - self.turns.take(place - n))
            slot = self._waiting.take(points) * n + points
            self._halves.put(slot, half)
            self._shares.put(slot, counted.take(points) * np.where(row > 1, 4.0, 2.0))
            self._waiting[points] += 1
            if self._waiting.max() == _QUEUE:
                self._settle()
            row = row - 2
            more = row > np.maximum(last, 0)
            points, row, last = points[more], row[more], last[more]

    def state(self) -> dict[str, Array]:
        self._settle()
        return super().state()

    def restore(self, state: Mapping[str, Array]) -> None:
        super().restore(state)
        self._waiting[:] = 0
        self._ready()

    # --- energy -----------------------------------------------------------------------------------

    def _settle(self) -> None:
        """Add up the losses of loops that wait: one after the other, whenever this is done."""
        count = int(self._waiting.max(initial=0))
        if count:
            times = self._shares[:count] * (np.arange(count)[:, None] < self._waiting)
            loss = times * self._loss(self._halves[:count])
            self.closed = np.add.reduce(np.concatenate((self.closed[None], loss)), axis=0)
            self._waiting[:] = 0

    def _loss(self, x: Array) -> Array:
        """Energy lost on the backbone up to x >= 0: 2 F - x f."""
        return 2.0 * energy(self.backbone, x) - x * self.backbone.evaluate(x)[0]

    @property
    def largest(self) -> Array:
        """The largest |u| so far, m."""
        return np.asarray(np.abs(self.turns[1]))

    @property
    def open_loops(self) -> Array:
        """Energy lost on the branches that are not forgotten, the backbone left out."""
        deepest = int(self.last.max(initial=0))
        half = 0.5 * np.abs(np.diff(self.turns[1 : deepest + 2], axis=0))
        half *= np.arange(1, deepest + 1)[:, None] <= self.last
        return np.asarray(2.0 * self._loss(half).sum(axis=0))

    @property
    def dissipated(self) -> Array:
        on_backbone = self._loss(self.largest)
        return self.closed_loops + on_backbone + self.open_loops

    @property
    def closed_loops(self) -> Array:
        """Energy lost by all loops that are closed, each times its share."""
        self._settle()
        return self.closed
