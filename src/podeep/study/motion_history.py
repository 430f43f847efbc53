"""Histories of a foundation in motion, and how far one is from a history that is converged."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, inf, isfinite

import numpy as np
from scipy.interpolate import CubicSpline

from ..arrays import Array
from ..model.assemble import Model
from ..motion_record import Ledger
from ..solve.dynamics import End
from ..solve.simulate import Block, Simulation
from .motion_chart import MotionErrors

_PLACES = 60  # where results are compared, besides the ends of stretches
_ROWS = 10_000  # of a history, at most
_BLOCK = 256  # steps between looks at the clock


@dataclass(frozen=True, eq=False)
class History:
    """Displacements at times, shape (steps, components, places), m; and the largest moment, N m."""

    times: Array
    displacement: Array
    moment: float


@dataclass(frozen=True, eq=False)
class Followed:
    """A motion that was followed: its history, its work; failure: why it ended early, in words."""

    history: History | None
    iterations: int
    evaluations: int
    failure: str


def places_of(model: Model) -> Array:
    """Depths where the motions of a scene are compared, on any mesh; the head and the tip too."""
    ends = [model.edges[0], *(piece.bottom for piece in model.pieces)]
    return np.unique(np.concatenate([ends, np.linspace(ends[0], ends[-1], _PLACES), [0.0]]))


def follow(one: Simulation, book: Ledger, x: Array, patience: float) -> Followed:
    """The history of the first foundation of a simulation at depths x.

    patience: CPU seconds that it may take.
    """
    one.every = one.count  # the last step alone is recorded
    stride = max(ceil(one.count / _ROWS), 1)
    parts = [_history(one.beginning(), book, x, 1)]
    begin = time.process_time()
    with np.errstate(over="ignore", invalid="ignore"):  # a method may go astray
        for block in one.blocks(_BLOCK):
            parts.append(_history(block, book, x, stride))
            if time.process_time() - begin > patience and one.done < one.count:
                return _failed(one, f"at {one.time:.4g} s: it takes longer than {patience:.0f} s")
    if one.ending is not End.COMPLETE:
        return _failed(one, f"at {one.time:.4g} s: {one.ending.value}")
    effort = one.motions[0].effort
    times = np.concatenate([part.times for part in parts])
    moved = np.concatenate([part.displacement for part in parts])
    moment = max(part.moment for part in parts)
    return Followed(History(times, moved, moment), effort.iterations, effort.evaluations, "")


def _failed(one: Simulation, why: str) -> Followed:
    effort = one.motions[0].effort
    return Followed(None, effort.iterations, effort.evaluations, why)


def _history(block: Block, book: Ledger, x: Array, stride: int) -> History:
    """Displacements of the last of so many steps each; the moment is that of all."""
    results = book.results(block.tracks[0], slice(None))
    rows = slice(stride - 1, None, stride) if len(block.times) >= stride else slice(-1, None)
    moved = results.of_all(lambda at, tube: results.deflection(at, tube=tube), x)[rows]
    if block.tracks[0][1] is not None:
        down = results.of_all(lambda at, tube: results.settlement(at, tube=tube), x)[rows]
        moved = np.concatenate([moved, down[:, None]], axis=1)
    moment = results.of_all(lambda at, tube: results.shear_and_moment(at, tube)[1], x)
    largest = np.linalg.norm(moment, axis=1).max(initial=0.0)
    return History(block.times[rows], moved, float(largest))


@dataclass(frozen=True, eq=False)
class Truth:
    """The converged displacements at any time, the largest displacement and the largest moment."""

    displacement: Callable[[Array], Array]
    moved: float
    moment: float

    @classmethod
    def of(cls, one: History) -> "Truth":
        """Cubic splines between its rows, which are dense, and exact at them."""
        moved = float(np.abs(one.displacement).max(initial=0.0))
        return cls(CubicSpline(one.times, one.displacement), moved, one.moment)


def errors_of(one: History, true: Truth) -> MotionErrors:
    """The largest difference at the times of a history, and that of the largest moments.

    inf where it is not finite.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        moved = float(np.abs(one.displacement - true.displacement(one.times)).max())
    pairs = (moved, true.moved), (abs(one.moment - true.moment), true.moment)
    shares = [value / size if size > 0.0 else 0.0 for value, size in pairs]
    return MotionErrors(*(share if isfinite(share) else inf for share in shares))
