"""Motions in blocks of steps, beside twins with steps twice as long that tell their errors."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

import numpy as np

from ..arrays import Array, Flags, Index
from .dynamics import End
from .mover import Mover, Pair, Row
from .stage import NoBalance

BLOCK = 1024  # steps


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

    times: s, (steps,). together: steps at whose end the twins are there too. recorded: those that
    are to be kept. iterations: of all in each step; step_size: the smallest part of the longest
    step that was taken at once; work: of the loads since the start, J; residual: largest force out
    of balance over the largest force, in the steps that are recorded. tracks: of each foundation,
    deflection and stretch; None: that is at rest. twins: the same of the twins, where they were
    last; none without twins.
    """

    times: Array
    together: Flags
    recorded: Flags
    iterations: Index
    step_size: Array
    work: Array
    residual: Array
    tracks: tuple[Tracks, ...]
    twins: tuple[Tracks, ...]


class Told(NamedTuple):
    """What is told of a step; see `Block`."""

    time: float
    together: bool
    recorded: bool
    iterations: int
    step_size: float
    work: float
    residual: float


@dataclass(slots=True)
class Rows:
    """Steps on their way into a block: where every motion was, and what is told of each."""

    states: list[list[Pair]] = field(default_factory=list)
    told: list[Told] = field(default_factory=list)

    def add(self, others: "Rows") -> None:
        """Steps that came after these."""
        self.states += others.states
        self.told += others.told

    @property
    def spent(self) -> int:
        """Iterations of all."""
        return sum(told.iterations for told in self.told)

    def block(self, foundations: int) -> Block:
        tracks = tuple(map(_tracks, zip(*self.states, strict=True)))
        a, b, c, d, e, f, g = map(np.array, zip(*self.told, strict=True))
        return Block(a, b, c, d, e, f, g, tracks[:foundations], tracks[foundations:])


@dataclass(slots=True)
class Simulation:
    """All foundations and lines on their way, and their twins; without these errors are not known.

    start: time at which they begin, s; h: step, s; count: steps to go. share: of the expected
    displacement, what iterations may leave. every: of so many steps one is recorded. reach, apart:
    largest displacement so far, and between a motion and its twin, of deflection and stretch, m.
    """

    motions: Sequence[Mover]
    twins: Sequence[Mover]
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
    def order(self) -> int:
        """Of the error in the step."""
        return min(motion.method.order for motion in self.motions)

    @property
    def error(self) -> float:
        """Estimated error of the displacements so far, as a share of the largest of them."""
        size = (2.0**self.order - 1.0) * self.reach
        return float(np.divide(self.apart, size, out=np.zeros(2), where=size > 0.0).max())

    @property
    def time(self) -> float:
        """Where the motions are, s."""
        return self.motions[0].time

    @property
    def finished(self) -> bool:
        """Whether the whole time was followed."""
        return self.done == self.count

    @property
    def records(self) -> int:
        """Most rows that are recorded, with that of the beginning."""
        return self.count // self.every + 2

    def record_each(self, interval: float) -> None:
        """Record the steps that end nearest to multiples of an interval, s."""
        self.every = max(round(interval / self.h), 1)

    @property
    def longest(self) -> float:
        """The longest step, s."""
        return self.h

    @property
    def shortest(self) -> float:
        """The shortest step so far, s."""
        return self.h

    @property
    def along(self) -> tuple[float, ...]:
        """Where it is, beyond `done`, for `go_on`."""
        return ()

    def go_on(self, along: Sequence[float]) -> None:
        """Be where another one was `along`."""

    def blocks(self, size: int = BLOCK) -> Iterator[Block]:
        """Yield block after block; `ending` tells how it ended.

        They end at the same steps wherever they begin. With the beginning as a first row, all rows
        fill a block.
        """
        while not self.finished and self.ending is End.COMPLETE:
            rows, room = Rows(), size - (self.done + 1) % size
            while len(rows.told) < room and self._advance(rows):
                pass
            if rows.told:
                yield rows.block(len(self.motions))

    def beginning(self) -> Block:
        """The state before the first step, as a block of one."""
        rows = Rows()
        self._note(rows, 0, recorded=True)
        return rows.block(len(self.motions))

    def _advance(self, rows: Rows) -> bool:
        """Go a step further; whether there is more to do."""
        spent = self._spent()
        if not self._step():
            self._keep_last(rows)
            return False
        self._note(rows, self._spent() - spent, recorded=self._recorded())
        return self.ending is End.COMPLETE and not self.finished

    def _spent(self) -> int:
        return sum(m.effort.iterations for m in self.motions)

    def _recorded(self) -> bool:
        """Whether the step that was done last is to be kept."""
        return self.done % self.every == 0 or self.finished or self.ending is not End.COMPLETE

    def _note(self, rows: Rows, spent: int, *, recorded: bool) -> None:
        """Put down where all are, after as many iterations as were spent on this step."""
        pairs = [m.pair() for m in (*self.motions, *self.twins)]
        rows.states.append(self._settled(pairs) if recorded else pairs)
        part = min(self.h, *(m.part for m in self.motions)) / self.longest
        work = sum(m.work for m in self.motions)
        residual = self._imbalance() if recorded else 0.0
        together = self.done % 2 == 0
        rows.told.append(Told(self.time, together, recorded, spent, part, work, residual))

    def _keep_last(self, rows: Rows) -> None:
        """Record the last step: there is none after it."""
        if rows.told:
            rows.told[-1] = rows.told[-1]._replace(recorded=True, residual=self._imbalance())
            rows.states[-1] = self._settled(rows.states[-1])

    def _settled(self, pairs: Sequence[Pair]) -> list[Pair]:
        """Rows of all with accelerations that balance there."""
        motions = (*self.motions, *self.twins)
        return [motion.settled(pair) for motion, pair in zip(motions, pairs, strict=True)]

    def _imbalance(self) -> float:
        """Largest force out of balance over the largest force, where all are."""
        return max(motion.imbalance() for motion in self.motions)

    def _step(self) -> bool:
        """One step of all; False where one has no equilibrium."""
        try:
            end = self.start + (self.done + 1) * self.h
            for motion in self.motions:
                motion.step(self.h, end, self.share, self.iterations)
            self.done += 1
            if self.done % 2 == 0:
                for twin in self.twins:
                    twin.step(2.0 * self.h, end, self.share, self.iterations)
        except NoBalance:
            self.ending = End.NO_BALANCE
            return False
        self._compare()
        return True

    def _compare(self) -> None:
        """Widen the largest displacement, and the error where the twins have come as far."""
        for motion in self.motions:
            np.maximum(self.reach, motion.sizes(), out=self.reach)
        if self.done % 2 == 0:
            for motion, twin in zip(self.motions, self.twins, strict=bool(self.twins)):
                np.maximum(self.apart, motion.sizes(twin), out=self.apart)
        if any(motion.lost() for motion in self.motions):
            self.ending = End.LOST


def _tracks(states: Sequence[Pair]) -> Tracks:
    """What states of deflection and stretch are, side by side."""
    lateral, axial = zip(*states, strict=True)
    return Track.of(lateral), None if axial[0] is None else Track.of(axial)
