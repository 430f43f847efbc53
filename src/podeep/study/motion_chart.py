"""A chart of motion as data: what was measured, and what is best in it.

The error of a setting is the larger of two. One is the largest difference of a displacement from
that of the converged motion on the same mesh, at any place and time, over the largest displacement.
The other is the relative error of the largest moment at any place and time. Times are medians of
CPU times of all steps.
"""

from dataclasses import dataclass

from ..scene import Dynamics, Method
from .chart import RelativeErrors, beaten_by_none, within
from .motion_settings import MotionSeries, MotionSetting

TENTH = 0.1  # error of a reference over that of its mesh, at most


@dataclass(frozen=True, slots=True)
class MotionErrors(RelativeErrors):
    """Relative errors over the whole span."""

    displacement: float
    moment: float


@dataclass(frozen=True, slots=True)
class MotionRow:
    """One setting: what it cost and how exact it is.

    steps: of the span. seconds: median CPU time of them over `runs`. errors, seconds: None where
    it failed, and `failure` tells why.
    """

    setting: MotionSetting
    elements: int = 0
    degree: int = 0
    steps: int = 0
    iterations: int = 0
    evaluations: int = 0
    errors: MotionErrors | None = None
    seconds: float | None = None
    runs: int = 0
    failure: str = ""


@dataclass(frozen=True, slots=True)
class MotionChoice:
    """What the program chooses for an accuracy.

    row: its mesh and step, timed as every setting. estimate: of its error. seconds: of all that it
    takes, with building, trials of steps and twins for the estimate.
    """

    accuracy: float
    row: MotionRow | None = None
    estimate: float = 0.0
    seconds: float | None = None
    failure: str = ""

    @property
    def errors(self) -> MotionErrors | None:
        return self.row.errors if self.row else None


@dataclass(frozen=True, slots=True)
class MotionReference:
    """The motion that counts as converged on the mesh for an accuracy.

    step: s; error: of it, estimated. mesh_error: how far it is from the motion on a mesh for a
    tenth of the smallest preset; None where there was no time for that.
    """

    accuracy: float
    elements: int
    degree: int
    step: float
    error: float
    mesh_error: MotionErrors | None = None

    @property
    def sure(self) -> bool:
        """Whether it is exact enough for its accuracy."""
        return self.error <= TENTH * self.accuracy


@dataclass(frozen=True, slots=True)
class MotionChart:
    """All that was measured of a foundation in motion.

    dynamics: what the scene asks for, but for the step. default: the method where none is named.
    span: seconds of it that are charted, from its start. period: the shortest of the loads, s; None
    where nothing is periodic. limit: the longest stable step of explicit differences, s. cut:
    series that were cut short, for time.
    """

    title: str
    foundation: str
    dynamics: Dynamics
    default: Method
    span: float
    period: float | None
    machine: str
    references: tuple[MotionReference, ...]
    limit: float
    cut: tuple[MotionSeries, ...]
    rows: tuple[MotionRow, ...]
    choices: tuple[MotionChoice, ...]

    @property
    def accuracies(self) -> tuple[float, ...]:
        """The errors that are marked, from large to small."""
        return tuple(one.accuracy for one in self.choices)

    def series(self) -> dict[MotionSeries, list[MotionRow]]:
        """Rows by series, from long to short steps."""
        found: dict[MotionSeries, list[MotionRow]] = {}
        for row in self.rows:
            found.setdefault(row.setting.series, []).append(row)
        return found

    def methods(self) -> list[str]:
        """Every method that was measured, in order."""
        return list(dict.fromkeys(row.setting.series.method for row in self.rows))

    def fastest(self, preset: float, method: str | None = None) -> MotionRow | None:
        """The fastest on the mesh for an error and within it, as are all its shorter steps."""
        good = [
            row
            for series, rows in self.series().items()
            if series.accuracy == preset and method in (None, series.method)
            for row in within(rows, preset)
        ]
        return min(good, key=lambda row: row.seconds or 0.0, default=None)

    def front(self, method: str | None = None) -> list[MotionRow]:
        """Rows, of a method, that none of these beats in time and error at once."""
        return beaten_by_none(
            [row for row in self.rows if method in (None, row.setting.series.method)]
        )

    def rate(self, row: MotionRow) -> int:
        """Steps in the shortest period; in all where nothing is periodic."""
        return row.steps if self.period is None else round(self.period / row.setting.step)
