"""Which method of time integration follows which motion with which step, and how it fails."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from itertools import takewhile
from math import isfinite, sqrt

import numpy as np

from ..motion import METHODS as NAMES
from ..motion import Dynamics
from ..solve.dynamics import integrator
from ..solve.integrators import Integrator
from ..solve.stage import NoBalance
from .limits import GAINED, KEPT, OFF, Limit, limits
from .trials import TRIALS, Outcome, Trial

METHODS: dict[str, Integrator] = {
    **{name: integrator(Dynamics(0.0, 1.0, method=name)) for name in NAMES},
    "GAMMA=1": integrator(Dynamics(0.0, 1.0, method="NEWMARK", gamma=1.0, beta=0.5)),
}
_RUNAWAY = 1e6  # energy over that at the start that is called no bound
_DECADES = (-1, 2)  # of omega h
_EACH, _QUICK_EACH = 6, 2  # steps in a decade
_CLOSE, _QUICK_CLOSE = 1.005, 1.05  # ratio of steps on both sides of a boundary


class Verdict(Enum):
    """What became of a motion, in a word."""

    STABLE = "stable"
    WRONG = "wrong"
    FAILED = "failed"


class Cause(Enum):
    """Why it is not stable, and the mark of it."""

    NONE = "."
    GAINED = "+"
    LOST = "-"
    OFF = "e"
    UNBOUNDED = "X"
    NO_BALANCE = "N"


@dataclass(frozen=True, slots=True)
class Cell:
    """A method in a trial with a step, omega h. words: the cause; outcome: None without an end."""

    trial: str
    method: str
    step: float
    verdict: Verdict
    cause: Cause
    words: str
    outcome: Outcome | None


@dataclass(frozen=True, slots=True)
class Boundary:
    """The largest step, omega h, up to which all are stable, and what comes then.

    step: inf where all steps of the map are, 0 where none is. limit: its closed form.
    """

    trial: str
    method: str
    step: float
    words: str
    limit: Limit | None


@dataclass(frozen=True, slots=True)
class StabilityMap:
    """Cells by trial, method and step, and where the stable ones end."""

    steps: tuple[float, ...]
    cells: tuple[Cell, ...]
    boundaries: tuple[Boundary, ...]

    def row(self, trial: str, method: str) -> list[Cell]:
        return [c for c in self.cells if (c.trial, c.method) == (trial, method)]

    def boundary(self, trial: str, method: str) -> Boundary:
        return next(b for b in self.boundaries if (b.trial, b.method) == (trial, method))


def stability_map(tell: Callable[[str], None], *, quick: bool) -> StabilityMap:
    """All trials with all methods; quick: fewer steps."""
    first, last = _DECADES
    count = (last - first) * (_QUICK_EACH if quick else _EACH) + 1
    steps = tuple(np.logspace(first, last, count).tolist())
    known = {(one.trial, one.method): one for one in limits(METHODS)}
    cells: list[Cell] = []
    boundaries: list[Boundary] = []
    for trial in TRIALS:
        for name in METHODS:
            tell(f"{trial.name}, {name}")
            row = [cell(trial, name, h) for h in steps]
            close = _QUICK_CLOSE if quick else _CLOSE
            cells += row
            boundaries.append(boundary(trial, row, close, known.get((trial.name, name))))
    return StabilityMap(steps, tuple(cells), tuple(boundaries))


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what runs away is told
def cell(trial: Trial, name: str, h: float) -> Cell:
    """Try a method with a step."""
    try:
        outcome = trial.outcome(METHODS[name], h)
    except NoBalance:
        words = "no equilibrium in a stage"
        return Cell(trial.name, name, h, Verdict.FAILED, Cause.NO_BALANCE, words, None)
    return Cell(trial.name, name, h, *judged(outcome), outcome)


def judged(outcome: Outcome) -> tuple[Verdict, Cause, str]:
    """The verdict on an outcome with its cause in words."""
    gain, kept, error = outcome.gain, outcome.kept, outcome.error
    if not (isfinite(gain) and isfinite(kept) and isfinite(error)) or gain > _RUNAWAY:
        return Verdict.FAILED, Cause.UNBOUNDED, "grew without bound"
    if gain > GAINED:
        return Verdict.WRONG, Cause.GAINED, f"energy grew {gain:.3g} times"
    if error > OFF:
        return Verdict.WRONG, Cause.OFF, f"its end is {error:.2g} of the exact one away"
    if kept < KEPT:
        return Verdict.WRONG, Cause.LOST, f"kept {kept:.2g} of its energy"
    return Verdict.STABLE, Cause.NONE, ""


def boundary(trial: Trial, row: list[Cell], close: float, limit: Limit | None) -> Boundary:
    """Where a row of cells ceases to be stable, by bisection down to a ratio of steps."""
    good = list(takewhile(lambda one: one.verdict is Verdict.STABLE, row))
    if len(good) == len(row):
        return Boundary(trial.name, row[0].method, np.inf, "", limit)
    beyond = row[len(good)]
    if not good:
        return Boundary(trial.name, beyond.method, 0.0, beyond.words, limit)
    low = good[-1].step
    while beyond.step > close * low:
        middle = cell(trial, beyond.method, sqrt(low * beyond.step))
        if middle.verdict is Verdict.STABLE:
            low = middle.step
        else:
            beyond = middle
    return Boundary(trial.name, beyond.method, sqrt(low * beyond.step), beyond.words, limit)
