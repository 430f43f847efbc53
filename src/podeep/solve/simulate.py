"""Motions in blocks of steps, beside twins with steps twice as long that tell their errors."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from ..arrays import Array, Flags, Index
from .dynamics import End, Motion
from .equations import State
from .integrators import Integrator
from .stage import NoBalance

BLOCK = 1024  # steps


#: A state of a problem, and what the soil resists at its points where that depends on the way.
Row: TypeAlias = tuple[State, Array | None]
Pair: TypeAlias = tuple[Row, Row | None]


@dataclass(frozen=True, eq=False)
class Track:
    """Unknowns, velocities and accelerations of a problem, shape (steps, unknowns) each.

    resisted: what the soil resists at the points, where that depends on the way.
    """

    q: Array
    velocity: Array
    acceleration: Array
    resisted: Array | None

    @classmethod
    def of(cls, rows: Sequence[Row]) -> "Track":
        return cls(
            np.array([s.q for s, _ in rows]),
            np.array([s.velocity for s, _ in rows]),
            np.array([s.acceleration for s, _ in rows]),
            None if rows[0][1] is None else np.array([r for _, r in rows]),
        )


Tracks: TypeAlias = tuple[Track, Track | None]


@dataclass(frozen=True, eq=False)
class Block:
    """Some steps of all foundations in motion.

    times: s, (steps,). tracks: of each foundation, deflection and stretch; None: that is at rest.
    twins: the same of the twins, where they were last; none without twins. together: steps at whose
    end the twins are there too. iterations: of all in each step; step_size: the smallest part of it
    that was taken at once; work: of the loads since the start, J; residual: largest force out of
    balance over the largest force, in the steps that are to be recorded.
    """

    times: Array
    together: Flags
    iterations: Index
    step_size: Array
    work: Array
    residual: Array
    tracks: tuple[Tracks, ...]
    twins: tuple[Tracks, ...]


@dataclass(slots=True)
class Simulation:
    """All foundations on their way, and their twins; without these errors are not known.

    start: time at which they begin, s; h: step, s; count: steps to go. share: of the expected
    displacement, what iterations may leave. every: of so many steps one is recorded. reach, apart:
    largest displacement so far, and between a motion and its twin, of deflection and stretch, m.
    """

    motions: Sequence[Motion]
    twins: Sequence[Motion]
    method: Integrator
    start: float
    h: float
    count: int
    share: float
    iterations: int
    every: int = 1
    ending: End = End.COMPLETE
    done: int = 0
    apart: Array = field(default_factory=lambda: np.zeros(2))
    reach: Array = field(default_factory=lambda: np.zeros(2))

    @property
    def error(self) -> float:
        """Estimated error of the displacements so far, as a share of the largest of them."""
        size = (2.0**self.method.order - 1.0) * self.reach
        return float(np.divide(self.apart, size, out=np.zeros(2), where=size > 0.0).max())

    def blocks(self, size: int = BLOCK) -> Iterator[Block]:
        """Yield block after block; `ending` tells how it ended.

        They end at the same steps wherever they begin. With the beginning as a first row, all rows
        fill a block.
        """
        while self.done < self.count and self.ending is End.COMPLETE:
            every = [*self.motions, *self.twins]
            states: list[list[Pair]] = [[] for _ in every]
            told: list[tuple[float, bool, int, float, float, float]] = []
            for _ in range(min(size - (self.done + 1) % size, self.count - self.done)):
                spent = sum(m.effort.iterations for m in self.motions)
                if not self._step():
                    break
                for kept, motion in zip(states, every, strict=True):
                    kept.append(_pair(motion))
                spent = sum(m.effort.iterations for m in self.motions) - spent
                part = min(m.part for m in self.motions) / self.h
                work = sum(m.work for m in self.motions)
                told.append((self.time, self.done % 2 == 0, spent, part, work, self._residual()))
                if self.ending is not End.COMPLETE:
                    break
            if told:
                tracks = tuple(map(_tracks, states))
                n = len(self.motions)
                a, b, c, d, e, f = map(np.array, zip(*told, strict=True))
                yield Block(a, b, c, d, e, f, tracks[:n], tracks[n:])

    def beginning(self) -> Block:
        """The state before the first step, as a block of one."""
        every = [*self.motions, *self.twins]
        tracks = tuple(_tracks([_pair(m)]) for m in every)
        n = len(self.motions)
        times, none = np.array([self.time]), np.zeros(1, dtype=np.intp)
        there = np.ones(1, dtype=bool)
        residual = np.array([self._residual()])
        return Block(
            *(times, there, none, np.ones(1), np.zeros(1), residual), tracks[:n], tracks[n:]
        )

    def _residual(self) -> float:
        """Largest force out of balance where a step is recorded, 0 elsewhere."""
        if self.done % self.every and self.done != self.count:
            return 0.0
        return max(motion.imbalance() for motion in self.motions)

    @property
    def time(self) -> float:
        """Where the motions are, s."""
        return self.motions[0].lateral.time

    def _step(self) -> bool:
        """One step of all; False where one has no equilibrium."""
        try:
            end = self.start + (self.done + 1) * self.h
            for motion in self.motions:
                motion.step(self.method, self.h, end, self.share, self.iterations)
            self.done += 1
            if self.done % 2 == 0:
                for twin in self.twins:
                    twin.step(self.method, 2.0 * self.h, end, self.share, self.iterations)
        except NoBalance:
            self.ending = End.NO_BALANCE
            return False
        self._compare()
        if any(motion.lost() for motion in self.motions):
            self.ending = End.LOST
        return True

    def _compare(self) -> None:
        """Widen the largest displacement, and the error where the twins have come as far."""
        for motion in self.motions:
            np.maximum(self.reach, motion.sizes(), out=self.reach)
        if self.done % 2 == 0:
            for motion, twin in zip(self.motions, self.twins, strict=bool(self.twins)):
                np.maximum(self.apart, motion.sizes(twin), out=self.apart)


def _pair(motion: Motion) -> Pair:
    """Where a motion is."""
    body, axial = motion.body, motion.axial
    lateral = motion.lateral, body.lateral.remembered(motion.lateral.q)
    if body.axial is None or axial is None:
        return lateral, None
    return lateral, (axial, body.axial.remembered(axial.q))


def _tracks(states: Sequence[Pair]) -> Tracks:
    """What states of deflection and stretch are, side by side."""
    lateral, axial = zip(*states, strict=True)
    return Track.of(lateral), None if axial[0] is None else Track.of(axial)
