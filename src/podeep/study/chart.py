"""A chart of speed against accuracy as data: what was measured, and what is best in it.

The error of a setting is the largest, over all steps, of the relative errors of the largest
displacement, the largest reaction and the largest moment (along the axis: settlement, shaft
friction, normal force). Times are medians of CPU times of all steps.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from ..scene import Numerics
from .settings import PRESETS, Series, Setting

SURE = 1e-2  # error of the reference over the smallest preset, at most


@dataclass(frozen=True, slots=True)
class Errors:
    """Relative errors of the largest values, each the largest of all steps."""

    displacement: float
    reaction: float
    moment: float

    @property
    def largest(self) -> float:
        return max(self.displacement, self.reaction, self.moment)


@dataclass(frozen=True, slots=True)
class Row:
    """One setting: what it cost and how exact it is.

    seconds: median CPU time of all steps over `runs`; building: CPU time of mesh and equations.
    errors, seconds: None where it failed, and `failure` tells why.
    """

    setting: Setting
    unknowns: int = 0
    iterations: int = 0
    evaluations: int = 0
    building: float = 0.0
    errors: Errors | None = None
    seconds: float | None = None
    runs: int = 0
    failure: str = ""


@dataclass(frozen=True, slots=True)
class Choice:
    """What the program chooses for an accuracy.

    seconds: of all that it takes, with building, estimates and refinement; last: of all steps on
    the mesh that it ends with, as that of a row.
    """

    accuracy: float
    elements: int = 0
    degree: int = 0
    estimate: float = 0.0
    errors: Errors | None = None
    seconds: float | None = None
    last: float | None = None
    runs: int = 0
    failure: str = ""


@dataclass(frozen=True, slots=True)
class Reference:
    """The mesh that counts as converged, and the change that its last refinement made."""

    elements: int
    degree: int
    error: float


@dataclass(frozen=True, slots=True)
class Chart:
    """All that was measured of a foundation."""

    title: str
    foundation: str
    numerics: Numerics
    steps: int
    machine: str
    reference: Reference
    rows: tuple[Row, ...]
    choices: tuple[Choice, ...]

    @property
    def sure(self) -> bool:
        """Whether the reference is exact enough for every preset."""
        return self.reference.error <= SURE * min(PRESETS)

    def series(self) -> dict[Series, list[Row]]:
        """Rows by series, from coarse to fine."""
        found: dict[Series, list[Row]] = {}
        for row in self.rows:
            found.setdefault(row.setting.series, []).append(row)
        return found

    def fastest(self, preset: float, wanted: Callable[[Series], bool]) -> Row | None:
        """The fastest of the wanted series that is within an error, as all its finer meshes are."""
        every = [rows for series, rows in self.series().items() if wanted(series)]
        good = [row for rows in every for row in within(rows, preset)]
        return min(good, key=lambda row: row.seconds or 0.0, default=None)

    def front(self) -> list[Row]:
        """Rows that none beats in time and error at once, from fast to exact."""
        return beaten_by_none(self.rows)


class HasError(Protocol):
    @property
    def largest(self) -> float: ...


class Measured(Protocol):
    """A setting of any chart."""

    @property
    def errors(self) -> HasError | None: ...
    @property
    def seconds(self) -> float | None: ...


AnyRow = TypeVar("AnyRow", bound=Measured)


def within(rows: Sequence[AnyRow], preset: float) -> list[AnyRow]:
    """Of rows from coarse to fine, the last ones that are all within an error."""
    good: list[AnyRow] = []
    for row in reversed(rows):
        if row.errors is None or row.errors.largest > preset:
            break
        good.append(row)
    return good


def beaten_by_none(rows: Iterable[AnyRow]) -> list[AnyRow]:
    """Rows that none beats in time and error at once, from fast to exact."""
    best, found = np.inf, []
    solved = [(r.seconds or 0.0, r.errors.largest, r) for r in rows if r.errors]
    for _, error, row in sorted(solved, key=lambda one: one[:2]):
        if error < best:
            best = error
            found.append(row)
    return found
