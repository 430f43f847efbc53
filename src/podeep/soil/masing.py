"""Masing's rules, extended: any odd backbone becomes a reaction that remembers its reversals."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from ..arrays import Array, Flags, Index
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
        # on. Rows after the last one mean nothing.
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
        on, back = self._on, self._back
        here = self.last * len(self.u) + self._point
        self.turns.take(here, out=on[0])
        self.forces.take(here, out=on[1])
        self.turns.take(here - len(self.u), out=on[3])
        on[4] = self.last
        np.add(on[4], 1.0, out=back[4])
        back[3] = on[0]
        back[2] = on[2] = 2.0
        self._onward = on[3] > on[0]
        virgin = self.u == on[0]
        self._virgin: Flags | None = virgin if virgin.any() else None
        self._branched: Flags | bool = ~virgin if virgin.any() else True
        self._rests = False
        if self._virgin is not None:
            end = np.where(self.u < 0.0, -np.inf, np.inf)
            rest = virgin & (self.u == 0.0)
            self._rests = bool(rest.any())
            for branch, at in ((back, virgin), (on, rest)):
                for part, value in ((0, 0.0), (1, 0.0), (2, 1.0), (4, 0.0)):
                    np.copyto(branch[part], value, where=at)
                np.copyto(branch[3], end, where=at)
                end = -end
        self._turn_here()

    def _turn_here(self) -> None:
        """Branches that begin where the points are now."""
        u, on, back = self.u, self._on, self._back
        np.copyto(back[0], u, where=self._branched)
        np.copyto(back[1], self.force, where=self._branched)
        if self._virgin is not None and not self._rests:
            for of, value in ((on[0], u), (on[1], self.force), (on[3], -u)):
                np.copyto(of, value, where=self._virgin)
        up = self._onward
        self._down, self._up = np.where(up, back, on), np.where(up, on, back)
        # where a displacement of no change goes on as the point went
        self._split = np.where(self.rising, u, np.nextafter(u, np.inf))

    def _branch(self, u: Array) -> tuple[Array, Flags, Index]:
        """The branch on which u lies, whether it is upward, and the points that left theirs."""
        up = u >= self._split
        branch = np.where(up, self._up, self._down)
        inside = u > self._down[3]
        inside &= u < self._up[3]
        if inside.all():
            return branch, up, _NONE
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
        return branch, up, out

    def _force(self, u: Array, branch: Array) -> tuple[Array, Array]:
        origin, base, scale, _, _ = branch
        force, stiffness = self.backbone.evaluate((u - origin) / scale)
        return base + scale * force, stiffness

    # --- the memory -------------------------------------------------------------------------------

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        return self._force(u, self._branch(u)[0])

    def commit(self, u: Array, share: Array | float = 1.0) -> None:
        """As `Memory.commit`; share: of the loss of loops that close now, what counts."""
        branch, up, left = self._branch(u)
        force, _ = self._force(u, branch)
        if left.size or self._rests or (up != self.rising).any():
            self._restack(u, force, branch, left, share)
            self.rising = np.where(u == self.u, self.rising, u > self.u)
            self.u, self.force = np.array(u), force
            self._ready()
            return
        self.u, self.force = np.array(u), force
        if self._virgin is not None:
            self._grow(u, force, self._virgin)
        self._turn_here()

    def _grow(self, u: Array, force: Array, virgin: Flags) -> None:
        """The largest |u| at points on the backbone."""
        for stack, value in ((self.turns, u), (self.forces, force)):
            np.copyto(stack[0], -value, where=virgin)
            np.copyto(stack[1], value, where=virgin)

    def _restack(
        self, u: Array, force: Array, branch: Array, left: Index, share: Array | float
    ) -> None:
        """The reversals after points have turned, closed loops or come to the backbone."""
        row = branch[4].astype(np.intp)
        if left.size:
            self._close(u, left, row.take(left), share)
        turned = np.flatnonzero(row > self.last)
        if turned.size:
            if row.max() + 1 > len(self.turns):
                more = np.zeros(self.turns.shape)
                self.turns = np.concatenate((self.turns, more))
                self.forces = np.concatenate((self.forces, more))
            place = row.take(turned) * len(u) + turned
            self.turns.put(place, self.u.take(turned))
            self.forces.put(place, self.force.take(turned))
        virgin = row == 0
        if virgin.any():
            row[virgin] = 1
            self._grow(u, force, virgin)
        self.last = row

    def _close(self, u: Array, points: Index, last: Index, share: Array | float) -> None:
        """Note the loops that points close on their way to the branch of a row."""
        n = len(u)
        onward = (u.take(points) >= self._split.take(points)) == self._onward.take(points)
        row = self.last.take(points) + np.where(onward, 0, 1)
        counted = np.broadcast_to(share, u.shape)
        while points.size:
            place = row * n + points
            start = np.where(
                row > self.last.take(points),
                self.u.take(points),
                self.turns.take(place, mode="clip"),
            )
            half = 0.5 * np.abs(start - self.turns.take(place - n))
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
        row = np.arange(1, deepest + 1)[:, None]
        ends = np.concatenate((self.turns[2 : deepest + 1], self.u[None]))
        ends = np.where(row == self.last, self.u, ends)
        half = 0.5 * np.abs(ends - self.turns[1 : deepest + 1])
        half *= row <= self.last
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
