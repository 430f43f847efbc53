"""Every setting of a line followed, its error against a finer mesh measured, its steps timed.

The reference is the line with its reaction integrated, on the program's own mesh halved until
nothing changes, as far as there is time. Settings for which there is none are named.
"""

import time
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from ..arrays import Array
from ..errors import AnalysisFailed
from ..line.analysis import Followed, SolvedLine, follow_line, refinements, solve_line
from ..line.assemble import DEGREE, LineModel, assemble, mesh
from ..line.results import LineResults
from ..lines import Form, Line
from ..run import check_lines
from ..scene import Scene
from .chart import Chart, Choice, Reference, Row, Setting
from .line_settings import (
    FULL,
    LINE_WORDS,
    QUICK,
    LineErrors,
    LinePlan,
    LineSeries,
    free_of_numbers,
    line_deck_lines,
    meshes,
)
from .measure import Tell, cpu_time, machine, timed, turns

# Shares of all time by which choices, reference and settings are done; then all steps are timed.
_CHOOSING, _CONVERGING, _MEASURING = 0.35, 0.6, 0.95
_TIMING = 0.05  # that all may take to be timed again, at most
_HURDLE = 2.0  # times as long as the last mesh it takes the next, about
_INSIDE = 8  # places in each element of the program's first mesh where results are compared
_MOST_ELEMENTS = 5000  # of the reference
_OWN = LineSeries("integrated", graded=True)  # what the program chooses

Values = tuple[Array, ...]
LineRow = Row[LineSeries]


@dataclass(slots=True)
class Task:
    """What is measured of a line, its mesh left to the program, and the CPU time that is left, s.

    followed: what was solved of `_OWN`, by elements, with the CPU time of its steps; spent: the
    last of these. late: a choice was left out, for time.
    """

    scene: Scene
    line: Line
    plan: LinePlan
    tell: Tell
    begin: float = field(default_factory=time.process_time)
    followed: dict[int, tuple[Followed, float]] = field(default_factory=dict)
    spent: float = 0.0
    late: bool = False

    def left(self, share: float) -> float:
        return share * self.plan.seconds - (time.process_time() - self.begin)

    def follow(self, scene: Scene, model: LineModel) -> Followed:
        """As the program does it, and timed."""
        self.tell(f"{model.elements} elements")
        start = time.process_time()
        found = follow_line(scene, model)
        self.spent = time.process_time() - start
        return found

    def follow_own(self, scene: Scene, model: LineModel) -> Followed:
        """The same of a mesh of the program, and kept."""
        found = self.follow(scene, model)
        self.followed[model.elements] = found, self.spent
        return found


class Gauge:
    """What is compared of a line, at the same places for every mesh."""

    def __init__(self, task: Task) -> None:
        edges = mesh(task.scene, task.line, task.scene.seabed_under(task.line), 0)
        share = np.arange(_INSIDE) / _INSIDE
        inside = edges[:-1, None] + np.diff(edges)[:, None] * share
        self._s = np.append(inside.ravel(), edges[-1])

    def values(self, results: LineResults) -> Values:
        """Tension, moment (states, places); touchdown, largest normal force (states,)."""
        pressing = np.abs(results.reaction(self._s)[..., -1]).max(axis=1)
        s = self._s
        return results.tension(s), results.moment(s), results.touchdown(), pressing

    def errors(self, found: Values, true: Values) -> LineErrors:
        """Errors of values."""
        sizes = np.array([np.abs(one).max() for one in true])
        sizes[2] = self._s[-1]  # of the touchdown: the length of the line
        apart = np.array([np.abs(a - b).max() for a, b in zip(found, true, strict=True)])
        share = np.divide(apart, sizes, out=np.zeros_like(apart), where=sizes > 0.0)
        return LineErrors(*share.tolist())


def line_chart(scene: Scene, line: Line, *, quick: bool = False, tell: Tell) -> Chart[LineSeries]:
    """Measure the statics of a line; `tell` hears how far it is.

    Raises AnalysisFailed where it has no equilibrium in some step, UserError where it is not solved
    at all.
    """
    return charted_line(scene, line, QUICK if quick else FULL, tell)


def charted_line(scene: Scene, line: Line, plan: LinePlan, tell: Tell) -> Chart[LineSeries]:
    """The chart of a plan."""
    check_lines(replace(scene, dynamics=None))
    task = Task(_formed(scene, line, "integrated"), free_of_numbers(line), plan, tell)
    task.scene = _asking(task.scene, min(plan.accuracies))
    own, gauge = chosen(task), Gauge(task)
    reference, true = converged(task, own[-1][0], gauge)
    rows, edges, cut = measured(task, reference, gauge, true)
    choices = [choice_of(task, accuracy, own, gauge, true) for accuracy in plan.accuracies]
    clocks = [partial(_clock, task, row.setting.series.form, edges[row.setting]) for row in rows]
    clocks = [clock for clock, row in zip(clocks, rows, strict=True) if row.errors]
    bodies = [
        partial(solve_line, _asking(task.scene, one.accuracy), task.line)
        for one in choices
        if one.errors
    ]
    known = (*(row.seconds for row in rows), *(one.seconds for one in choices))
    first = [seconds for seconds in known if seconds is not None]
    runs = [*clocks, *(partial(cpu_time, body) for body in bodies)]
    patience = min(max(task.left(1.0), 0.0), _TIMING * plan.seconds)
    spent = iter(turns(runs, plan.runs, patience, tell, first))
    return Chart(
        scene.title,
        f"L{line.id}",
        LINE_WORDS,
        partial(line_deck_lines, line, scene.seabed_under(line)),
        len(scene.steps.factors),
        machine(),
        reference,
        tuple(timed(row, next(spent)) if row.errors else row for row in rows),
        tuple(timed(one, next(spent)) if one.errors else one for one in choices),
        tuple(cut),
    )


def _asking(scene: Scene, accuracy: float) -> Scene:
    return replace(scene, numerics=replace(scene.numerics, accuracy=accuracy))


def _formed(scene: Scene, line: Line, form: Form) -> Scene:
    """The scene with a form of the contact under a line."""
    contacts = (replace(c, form=form) if c.line == line.id else c for c in scene.seabed_contacts)
    return replace(scene, seabed_contacts=tuple(contacts))


def chosen(task: Task) -> list[tuple[SolvedLine, float]]:
    """The meshes of the program up to the smallest accuracy, as far as there is time.

    With the CPU time of all up to each, s.
    """
    found: list[tuple[SolvedLine, float]] = []
    start = time.process_time()
    for solved in refinements(task.scene, task.line, task.follow_own):
        if solved.failure:
            raise _no_chart(solved)
        found.append((solved, time.process_time() - start))
        task.late = not solved.accurate and _HURDLE * task.spent > task.left(_CHOOSING)
        if solved.accurate or task.late:
            break
    return found


def _no_chart(found: Followed) -> AnalysisFailed:
    name, count = f"L{found.line.id}", f"{found.model.elements} elements"
    why = f"{name}, {count}: {found.failure}"
    return AnalysisFailed(f"{why}\n  no chart: every step needs an equilibrium")


def converged(task: Task, last: SolvedLine, gauge: Gauge) -> tuple[Reference, Values]:
    """The line on meshes halved until nothing changes, and what is compared of it.

    They begin with half the elements of the program's last one, and are finer than all settings.
    """
    edges, before = last.model.system.field.edges, gauge.values(last.results)
    finest = max((len(e) - 1 for s, e in _meshes(task) if s.series == _OWN), default=0)
    while True:
        edges = np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))
        found = task.follow(task.scene, assemble(task.scene, task.line, edges))
        if found.failure:
            raise _no_chart(found)
        true = gauge.values(found.results)
        reference = Reference(len(edges) - 1, DEGREE, gauge.errors(before, true))
        enough = reference.errors.largest <= LINE_WORDS.margin * task.scene.numerics.accuracy
        late = _HURDLE * task.spent > task.left(_CONVERGING)
        if late or len(edges) > _MOST_ELEMENTS or (enough and reference.elements > finest):
            return reference, true
        before = true


def measured(
    task: Task, reference: Reference, gauge: Gauge, true: Values
) -> tuple[list[LineRow], dict[Setting[LineSeries], Array], list[Setting[LineSeries]]]:
    """Rows of all settings, their element boundaries, and settings that were cut, for time."""
    rows: list[LineRow] = []
    cut: list[Setting[LineSeries]] = []
    last: dict[LineSeries, float] = {}
    every = dict(_meshes(task))
    for setting, edges in every.items():
        series, expected = setting.series, _HURDLE * last.get(setting.series, 0.0)
        known = task.followed.get(setting.elements) if series == _OWN else None
        same = series == _OWN and setting.elements >= reference.elements
        late = series in last and known is None and expected > task.left(_MEASURING)
        if same or late:
            cut.append(setting)
            continue
        rows.append(_row(task, setting, edges, known, gauge, true))
        last[series] = task.spent
    order = [series for series, _ in task.plan.series]
    return sorted(rows, key=lambda row: order.index(row.setting.series)), every, cut


def _meshes(task: Task) -> list[tuple[Setting[LineSeries], Array]]:
    return list(meshes(task.scene, task.line, task.plan))


def _row(
    task: Task,
    setting: Setting[LineSeries],
    edges: Array,
    known: tuple[Followed, float] | None,
    gauge: Gauge,
    true: Values,
) -> LineRow:
    """A setting followed once, or what is known of it."""
    scene = _formed(task.scene, task.line, setting.series.form)
    start = time.process_time()
    model = assemble(scene, task.line, edges)
    building = time.process_time() - start
    found, seconds = known or (task.follow(scene, model), 0.0)
    work = [state.work for state in found.states]
    row = Row(
        setting,
        model.system.size,
        sum(one.iterations for one in work),
        sum(one.evaluations for one in work),
        building,
    )
    if found.failure:
        return replace(row, failure=found.failure)
    errors = gauge.errors(gauge.values(found.results), true)
    return replace(row, errors=errors, seconds=seconds if known else task.spent)


def choice_of(
    task: Task,
    accuracy: float,
    own: list[tuple[SolvedLine, float]],
    gauge: Gauge,
    true: Values,
) -> Choice[LineSeries]:
    """What the program makes of an accuracy alone."""
    good = [one for one in own if (one[0].errors <= accuracy).all()]
    if not good and task.late:
        return Choice(accuracy, failure="left out, for time")
    solved, seconds = good[0] if good else own[-1]
    elements = solved.model.elements
    return Choice(
        accuracy,
        Setting(_OWN, elements),
        float(solved.errors.max()),
        gauge.errors(gauge.values(solved.results), true),
        seconds,
        task.followed[elements][1],
    )


def _clock(task: Task, form: Form, edges: Array) -> float:
    """CPU time of the steps on a mesh, s."""
    scene = _formed(task.scene, task.line, form)
    model = assemble(scene, task.line, edges)
    return cpu_time(partial(follow_line, scene, model))
