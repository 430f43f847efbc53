"""The log of a motion: its blocks as rows of a database, its errors, and what it goes on from."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from time import monotonic

import numpy as np

from .arrays import Array, Index
from .database.stream import uninterrupted
from .database.write import Writer
from .errors import Fault, UserError
from .motion_record import Book
from .scene import Dynamics
from .solve.dynamics import End
from .solve.resume import resume, state_of
from .solve.simulate import BLOCK, Block, Simulation

RECORDS = 1000  # that a run has by default, at most
_ESTIMATES = ("estimate/displacement", "estimate/reaction", "estimate/moment")

_Three = tuple[Array, Array, Array]
Progress = Callable[[str], None]


@dataclass(slots=True)
class Errors:
    """Estimated errors of a foundation so far.

    sizes: largest displacement, reaction and moment. apart: largest distance of the displacements
    from those of the twin, and the twin's largest reaction and moment.
    """

    order: int
    sizes: Array = field(default_factory=lambda: np.zeros(3))
    apart: Array = field(default_factory=lambda: np.zeros(3))

    def widen(self, ours: _Three, twin: _Three) -> Array:
        """Errors of displacement, reaction and moment up to each row, shape (3, rows)."""
        sizes, apart = np.zeros((2, 3, len(ours[0])))
        for kind, (one, other) in enumerate(zip(ours, twin, strict=True)):
            sizes[kind], apart[kind] = _sizes(one), _sizes(one - other if kind == 0 else other)
        sizes = np.maximum.accumulate(np.maximum(sizes, self.sizes[:, None]), axis=1)
        apart = np.maximum.accumulate(np.maximum(apart, self.apart[:, None]), axis=1)
        self.sizes, self.apart = sizes[:, -1], apart[:, -1]
        apart = np.concatenate([apart[:1], np.abs(apart[1:] - sizes[1:])])
        scale = 2.0**self.order - 1.0
        return np.divide(apart, scale * sizes, out=np.zeros_like(apart), where=sizes > 0.0)


def _sizes(values: Array) -> Array:
    """Largest magnitude in each row."""
    return np.asarray(np.abs(values).reshape(len(values), -1).max(axis=1, initial=0.0))


def part_of(state: Mapping[str, Array], name: str, count: int) -> Array:
    """So many numbers of a run's state; UserError where it is that of another run."""
    if name not in state or state[name].size != count:
        raise _foreign(name)
    return state[name]


def _foreign(what: str) -> UserError:
    return UserError(
        Fault(f"the partial holds another run's state ({what})", "run again without --resume")
    )


def _duration(seconds: float) -> str:
    """A time that is left, in a unit that suits it."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"


class Log:
    """Writes a simulation's blocks, and keeps the count.

    chosen: of the run's state, what was settled before its first step.
    """

    def __init__(
        self,
        one: Simulation,
        dynamics: Dynamics,
        books: Sequence[Book],
        chosen: Mapping[str, Array],
        tell: Progress,
    ) -> None:
        self.simulation, self.books, self.chosen, self.tell = one, books, chosen, tell
        one.record_each(dynamics.recording or (dynamics.end - dynamics.start) / RECORDS)
        self.end = dynamics.end
        self.errors = [Errors(one.order) for _ in books]
        self.records = self.iterations = 0
        self._last = np.zeros((len(books), 3))

    @property
    def state(self) -> dict[str, Array]:
        """What the run goes on from, arrays by names that stay the same."""
        counted = [
            (*e.sizes, *e.apart, *last) for e, last in zip(self.errors, self._last, strict=True)
        ]
        log = np.array([self.records, self.iterations], dtype=np.float64)
        return {**self.chosen, "log": log, "errors": np.array(counted)} | state_of(self.simulation)

    def resume(self, state: Mapping[str, Array]) -> None:
        """Go on from a state; raises UserError where it is that of another run."""
        self.records, self.iterations = map(int, part_of(state, "log", 2))
        counted = part_of(state, "errors", 9 * len(self.errors)).reshape(-1, 3, 3)
        for errors, (sizes, apart, _) in zip(self.errors, counted, strict=True):
            errors.sizes, errors.apart = sizes.copy(), apart.copy()
        self._last = counted[:, 2].copy()
        try:
            resume(self.simulation, state)
        except (KeyError, ValueError) as error:
            raise _foreign(str(error)) from error

    def follow(self, writer: Writer, accuracy: float | None) -> bool:
        """Write all blocks; False where the error has passed an accuracy."""
        one = self.simulation
        begin, behind = monotonic(), one.time
        if not self.records:
            self._write(writer, one.beginning())
        blocks = one.blocks(BLOCK)
        while accuracy is None or one.error <= accuracy:
            block = next(blocks, None)
            if block is None:
                self.tell("")
                return True
            self._write(writer, block)
            left = (monotonic() - begin) * (self.end - one.time) / (one.time - behind)
            self.tell(f"{one.time:.4g} of {self.end:g} s of motion, about {_duration(left)} to go")
        return False

    def failure(self) -> str:
        """Why the motion ended before its time, in words; empty if it did not."""
        one = self.simulation
        if one.ending is End.COMPLETE:
            return ""
        return f"motion stops at {one.time:g} s: {one.ending.value}"

    def _write(self, writer: Writer, block: Block) -> None:
        """Commit what is to be recorded of a block; all of it counts for the envelopes."""
        rows = np.flatnonzero(block.recorded)
        values: dict[str, Array] = {}
        extremes: dict[str, Array] = {}
        count = len(rows)
        for place, (book, tracks) in enumerate(zip(self.books, block.tracks, strict=True)):
            every = book.extremes(tracks)
            extremes |= {f"{book.name}/{name}": value for name, value in every.items()}
            if not count:
                continue
            of_one = book.all(tracks, rows)
            errors = self._estimates(place, block, rows)
            of_one |= dict(zip(_ESTIMATES, errors, strict=True))
            of_one["convergence/iterations"] = block.iterations[rows].astype(float)
            of_one["convergence/residual"] = block.residual[rows]
            of_one["convergence/step_size"] = block.step_size[rows]
            of_one["convergence/energy"] = block.work[rows]
            values |= {f"{book.name}/{name}": value for name, value in of_one.items()}
        self.iterations += int(block.iterations.sum())
        self.records += count
        with uninterrupted():  # rows and state belong together
            writer.widen(block.times, extremes)
            if count:
                writer.append(block.times[rows], values)
            writer.flush(self.state)

    def _estimates(self, place: int, block: Block, rows: Index) -> Array:
        """Errors of displacement, reaction and moment up to each row, (3, rows)."""
        found = np.repeat(self._last[place][:, None], len(rows), axis=1)
        both = np.flatnonzero(block.together[rows])
        if block.twins and len(both):
            book = self.books[place]
            ours = book.largest(block.tracks[place], rows[both])
            twin = book.largest(block.twins[place], rows[both])
            errors = self.errors[place].widen(ours, twin)
            found[:, both] = errors
            found = np.maximum.accumulate(found, axis=1)
            self._last[place] = found[:, -1]
        return found
