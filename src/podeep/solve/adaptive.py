"""Motions whose step follows the error: halved where it grows, doubled where it fades.

Steps come in strides of two. A scout takes every stride in one step from where the motion stands;
their distance at its end tells the error that the stride adds. It may be a given share of the
largest displacement: with every stride adding as much, the strides are fewest. One that adds more
is taken anew in shorter steps. The twins go as they do beside steps of one length, so that the
error of the whole is known in the same way.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import ceil, log2

import numpy as np

from ..arrays import Array
from .dynamics import End
from .mover import Mover, Standing
from .simulate import Rows, Simulation
from .stage import NoBalance

_LEVELS = 20  # halvings of the longest step that time can be told in
_FINEST = 14  # halvings that the error may ask for
_COARSER = 0.7  # of what a step twice as long may add: below it, it is tried
_SPARE = 1e-9  # of a stride: a load that bends so near its end bends there


@dataclass(slots=True)
class Adaptive(Simulation):
    """A simulation whose step `h` is a power of 1/2 of the longest one, `base`.

    scouts: as many as motions. added: what a stride may add to the error, as a share of the largest
    displacement. size: least displacement that counts as the largest, of deflection and
    stretch, m. bends: times at which loads bend, s, rising. count: in steps of `base`.
    coarsest: fewest halvings. tick: where the motions are, in parts of `base`, as `every` is. anew:
    strides that were taken again.
    """

    scouts: Sequence[Mover] = ()
    added: float = np.inf
    size: Array = field(default_factory=lambda: np.zeros(2))
    bends: Array = field(default_factory=lambda: np.zeros(0))
    coarsest: int = 0
    level: int = 0
    deepest: int = 0
    tick: int = 0
    anew: int = 0
    base: float = 0.0

    def __post_init__(self) -> None:
        self.base, self.every = self.h, self.every << _LEVELS
        self._set_level(self.level)

    @property
    def finished(self) -> bool:
        return self.tick == self.count << _LEVELS

    @property
    def longest(self) -> float:
        return self.base

    @property
    def shortest(self) -> float:
        return self.base * 0.5**self.deepest

    @property
    def along(self) -> tuple[float, ...]:
        return self.tick, self.level, self.deepest, self.anew

    def go_on(self, along: Sequence[float]) -> None:
        self.tick, level, self.deepest, self.anew = map(int, along)
        self._set_level(level)

    def _set_level(self, level: int) -> None:
        self.level, self.h = level, self.base * 0.5**level

    def _at(self, tick: int) -> float:
        """The time of a tick, s."""
        return self.start + self.base * (tick / (1 << _LEVELS))

    @property
    def records(self) -> int:
        return (self.count << _LEVELS) // self.every + 2

    def record_each(self, interval: float) -> None:
        """Record the first step that ends at each multiple of an interval, s, or after it."""
        self.every = max(round(interval / self.base * (1 << _LEVELS)), 1)

    def _recorded(self) -> bool:
        due = self.tick // self.every > (self.tick - self._ticks) // self.every
        return due or self.finished or self.ending is not End.COMPLETE

    def _advance(self, rows: Rows) -> bool:
        """Go a stride further, in steps as short as it needs; whether there is more to do."""
        self._meet_loads()
        begun, spent = [motion.standing() for motion in self.motions], self._spent()
        place = self.done, self.tick
        try:
            share, halfway = self._stride(draft := Rows(), spent)
            while share > 1.0 and self.level < _FINEST:
                self._back(place, begun)
                halvings = max(ceil(log2(share) / (self.order + 1)), 1)
                self._set_level(min(self.level + halvings, _FINEST))
                self.anew += 1
                share, halfway = self._stride(draft := Rows(), spent)
            for twin in self.twins:
                twin.step(2.0 * self.h, self.time, self.share, self.iterations)
        except NoBalance:
            self._back(place, begun)
            self.ending = End.NO_BALANCE
            self._keep_last(rows)
            return False
        np.maximum(self.reach, halfway, out=self.reach)
        self._compare()
        self._note(draft, self._spent() - spent - draft.spent, recorded=self._recorded())
        rows.add(draft)
        self.deepest = max(self.deepest, self.level)
        aligned = self.tick % (4 * self._ticks) == 0
        spare = _COARSER * 0.5 ** (self.order + 1)
        if aligned and self.level > self.coarsest and share < spare:
            self._set_level(self.level - 1)
        return self.ending is End.COMPLETE and not self.finished

    def _back(self, place: tuple[int, int], begun: Sequence[Standing]) -> None:
        """Take all motions back to where a stride began."""
        self.done, self.tick = place
        for motion, where in zip(self.motions, begun, strict=True):
            motion.stand(where)

    @property
    def _ticks(self) -> int:
        """Of a step."""
        return 1 << (_LEVELS - self.level)

    def _meet_loads(self) -> None:
        """Shorten the step until a stride jumps over no piece of a load between two bends."""
        now = self._at(self.tick)
        while self.level < _FINEST:
            spare = _SPARE * self.h
            first, last = np.searchsorted(self.bends, (now + spare, now + 2.0 * self.h - spare))
            pieces = np.diff(self.bends[max(first - 1, 0) : last + 1])
            if first == last or not pieces.size or pieces.min() >= self.h - spare:
                return
            self._set_level(self.level + 1)

    def _stride(self, draft: Rows, spent: int) -> tuple[float, Array]:
        """Two steps, of which the first is put down, beside one of the scouts.

        spent: iterations before. Returns the error that they add over what they may, and the
        largest displacements halfway.
        """
        for scout, motion in zip(self.scouts, self.motions, strict=True):
            scout.stand(motion.standing())
        self._both()
        self._note(draft, self._spent() - spent, recorded=self._recorded())
        halfway = np.max([motion.sizes() for motion in self.motions], axis=0)
        self._both()
        for scout in self.scouts:
            scout.step(2.0 * self.h, self.time, self.share, self.iterations)
        pairs = zip(self.motions, self.scouts, strict=True)
        apart = np.max([motion.sizes(scout) for motion, scout in pairs], axis=0)
        most = self.added * np.maximum(self.size, np.maximum(self.reach, halfway))
        most *= 2.0**self.order - 1.0
        return float(np.divide(apart, most, out=np.zeros(2), where=most > 0.0).max()), halfway

    def _both(self) -> None:
        """A step of all motions."""
        self.done += 1
        self.tick += self._ticks
        for motion in self.motions:
            motion.step(self.h, self._at(self.tick), self.share, self.iterations)
