"""A chart of speed against accuracy as data: what was measured, and what is best in it.

It is that of a foundation or of a line: their series, errors and words differ (`settings`,
`line_settings`), all else is shared. Times are medians of CPU times of all steps.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from typing import Generic, Protocol, TypeVar

import numpy as np


class AnySeries(Protocol):
    """What the settings of one line in a chart share; only their number of elements differs."""

    @property
    def name(self) -> str: ...
    @property
    def in_deck(self) -> bool:
        """Whether a deck can ask for its settings."""

    @property
    def cells(self) -> tuple[str, ...]:
        """What it is, for the columns of the CSV that `Words` names."""

    def mesh(self, elements: int) -> str:
        """A setting of it in words that begin with `N elements`."""

    def __hash__(self) -> int: ...


S = TypeVar("S", bound=AnySeries)


@dataclass(frozen=True, slots=True)
class RelativeErrors:
    """Relative errors; the fields of each kind are its parts."""

    @property
    def parts(self) -> dict[str, float]:
        return {one.name: getattr(self, one.name) for one in fields(self)}

    @property
    def largest(self) -> float:
        return max(self.parts.values())

    def part(self, name: str) -> float:
        """A part of this name, or the largest."""
        return float(getattr(self, name))


@dataclass(frozen=True, slots=True)
class Words:
    """What a kind of chart says.

    subject: what it is of. drawn: parts of the error that the picture has, with their labels.
    margin: error of the reference over the smallest accuracy, at most. legend: what the names of
    series mean. columns: of what a series is, in the CSV. replaced: keywords that the lines for
    the deck stand in place of. unreached: what is said where no setting that a deck can ask for is
    within an error.
    """

    subject: str
    drawn: tuple[tuple[str, str], ...]
    margin: float
    legend: str
    columns: tuple[str, ...]
    replaced: str
    unreached: str


@dataclass(frozen=True, slots=True)
class Setting(Generic[S]):
    """One way to solve the scene."""

    series: S
    elements: int

    @property
    def mesh(self) -> str:
        return self.series.mesh(self.elements)


@dataclass(frozen=True, slots=True)
class Row(Generic[S]):
    """One setting: what it cost and how exact it is.

    seconds: median CPU time of all steps over `runs`; building: CPU time of mesh and equations.
    errors, seconds: None where it failed, and `failure` tells why.
    """

    setting: Setting[S]
    unknowns: int = 0
    iterations: int = 0
    evaluations: int = 0
    building: float = 0.0
    errors: RelativeErrors | None = None
    seconds: float | None = None
    runs: int = 0
    failure: str = ""


@dataclass(frozen=True, slots=True)
class Choice(Generic[S]):
    """What the program chooses for an accuracy.

    seconds: of all that it takes, with building, estimates and refinement; last: of all steps on
    the mesh that it ends with, as that of a row. setting, errors: None where it failed.
    """

    accuracy: float
    setting: Setting[S] | None = None
    estimate: float = 0.0
    errors: RelativeErrors | None = None
    seconds: float | None = None
    last: float | None = None
    runs: int = 0
    failure: str = ""


@dataclass(frozen=True, slots=True)
class Reference:
    """The mesh that counts as converged, and the change that its last refinement made."""

    elements: int
    degree: int
    errors: RelativeErrors


@dataclass(frozen=True, slots=True)
class Chart(Generic[S]):
    """All that was measured of a foundation or a line.

    deck_lines: lines that ask for an accuracy and a setting; None: the program's own choice. cut:
    settings for which there was no time.
    """

    title: str
    name: str
    words: Words
    deck_lines: Callable[[float, Setting[S] | None], str]
    steps: int
    machine: str
    reference: Reference
    rows: tuple[Row[S], ...]
    choices: tuple[Choice[S], ...]
    cut: tuple[Setting[S], ...] = ()

    @property
    def accuracies(self) -> tuple[float, ...]:
        """The errors that are marked, from large to small."""
        return tuple(one.accuracy for one in self.choices)

    @property
    def sure(self) -> bool:
        """Whether the reference is exact enough for every accuracy."""
        return self.reference.errors.largest <= self.words.margin * min(self.accuracies)

    def series(self) -> dict[S, list[Row[S]]]:
        """Rows by series, from coarse to fine."""
        found: dict[S, list[Row[S]]] = {}
        for row in self.rows:
            found.setdefault(row.setting.series, []).append(row)
        return found

    def fastest(self, accuracy: float, wanted: Callable[[S], bool]) -> Row[S] | None:
        """The fastest of the wanted series that is within an error, as all its finer meshes are."""
        every = [rows for series, rows in self.series().items() if wanted(series)]
        good = [row for rows in every for row in within(rows, accuracy)]
        return min(good, key=lambda row: row.seconds or 0.0, default=None)

    def front(self, part: str = "largest") -> list[Row[S]]:
        """Rows that none beats in time and a part of the error at once, from fast to exact."""
        return beaten_by_none(self.rows, part)


class Measured(Protocol):
    """A setting of any chart."""

    @property
    def errors(self) -> RelativeErrors | None: ...
    @property
    def seconds(self) -> float | None: ...


AnyRow = TypeVar("AnyRow", bound=Measured)


def within(rows: Sequence[AnyRow], accuracy: float) -> list[AnyRow]:
    """Of rows from coarse to fine, the last ones that are all within an error."""
    good: list[AnyRow] = []
    for row in reversed(rows):
        if row.errors is None or row.errors.largest > accuracy:
            break
        good.append(row)
    return good


def beaten_by_none(rows: Iterable[AnyRow], part: str = "largest") -> list[AnyRow]:
    """Rows that none beats in time and a part of the error at once, from fast to exact."""
    best, found = np.inf, []
    solved = [(r.seconds or 0.0, r.errors.part(part), r) for r in rows if r.errors]
    for _, error, row in sorted(solved, key=lambda one: one[:2]):
        if error < best:
            best = error
            found.append(row)
    return found
