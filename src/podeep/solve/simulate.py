"""Motions in blocks of steps, beside twins with steps twice as long that tell their errors."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Index
from .dynamics import End, Motion
from .equations import State
from .integrators import Integrator
from .newton import largest
from .stage import NoBalance

BLOCK = 1024  # steps


@dataclass(frozen=True, eq=False)
class Track:
    """Unknowns, velocities and accelerations of a problem, shape (steps, unknowns) each."""

    q: Array
    velocity: Array
    acceleration: Array

    @classmethod
    def of(cls, states: Sequence[State]) -> "Track":
        return cls(
            np.array([s.q for s in states]),
            np.array([s.velocity for s in states]),
            np.array([s.acceleration for s in states]),
        )


@dataclass(frozen=True, eq=False)
class Block:
    """Some steps of all foundations in motion.

    times: s, (steps,). tracks: of each foundation, deflection and stretch; None: that is at rest.
    iterations: of all in each step; step_size: the smallest part of it that was taken at once;
    error: of the displacements so far, as it is estimated, a share of the largest.
    """

    times: Array
    tracks: tuple[tuple[Track, Track | None], ...]
    iterations: Index
    step_size: Array
    error: Array


@dataclass(slots=True)
class Simulation:
    """All foundations on their way, and their twins; without these errors are not known.

    h: step, s; count: steps to go. share: of the expected displacement, what iterations may leave.
    reach, apart: largest displacement so far, and between a motion and its twin, m.
    """

    motions: Sequence[Motion]
    twins: Sequence[Motion]
    method: Integrator
    h: float
    count: int
    share: float
    iterations: int
    ending: End = End.COMPLETE
    done: int = 0
    apart: float = 0.0
    reach: float = 0.0

    @property
    def error(self) -> float:
        """Estimated error of the displacements so far, as a share of the largest of them."""
        return self.apart / (2.0**self.method.order - 1.0) / self.reach if self.reach else 0.0

    def blocks(self, size: int = BLOCK) -> Iterator[Block]:
        """Yield block after block; `ending` tells how it ended."""
        while self.done < self.count and self.ending is End.COMPLETE:
            states: list[list[tuple[State, State | None]]] = [[] for _ in self.motions]
            told: list[tuple[int, float, float]] = []
            for _ in range(min(size, self.count - self.done)):
                spent = sum(m.effort.iterations for m in self.motions)
                if not self._step():
                    break
                for kept, motion in zip(states, self.motions, strict=True):
                    kept.append((motion.lateral, motion.axial))
                spent = sum(m.effort.iterations for m in self.motions) - spent
                told.append((spent, min(m.part for m in self.motions) / self.h, self.error))
                if self.ending is not End.COMPLETE:
                    break
            if told:
                yield _block(states, told)

    def _step(self) -> bool:
        """One step of all; False where one has no equilibrium."""
        try:
            for motion in self.motions:
                motion.step(self.method, self.h, self.share, self.iterations)
            self.done += 1
            if self.done % 2 == 0:
                for twin in self.twins:
                    twin.step(self.method, 2.0 * self.h, self.share, self.iterations)
        except NoBalance:
            self.ending = End.NO_BALANCE
            return False
        self._compare()
        if any(motion.lost() for motion in self.motions):
            self.ending = End.LOST
        return True

    def _compare(self) -> None:
        """Widen the largest displacement, and the error where the twins have come as far."""
        self.reach = max(self.reach, *(largest(m.lateral.q) for m in self.motions))
        if self.done % 2 == 0:
            for motion, twin in zip(self.motions, self.twins, strict=bool(self.twins)):
                self.apart = max(self.apart, largest(motion.lateral.q - twin.lateral.q))
                if motion.axial is not None and twin.axial is not None:
                    self.apart = max(self.apart, largest(motion.axial.q - twin.axial.q))


def _block(
    states: Sequence[Sequence[tuple[State, State | None]]], told: Sequence[tuple[int, float, float]]
) -> Block:
    tracks = []
    for of_one in states:
        lateral, axial = zip(*of_one, strict=True)
        tracks.append((Track.of(lateral), None if axial[0] is None else Track.of(axial)))
    iterations, sizes, errors = (np.array(column) for column in zip(*told, strict=True))
    times = np.array([lateral.time for lateral, _ in states[0]])
    return Block(times, tuple(tracks), iterations, sizes, errors)
