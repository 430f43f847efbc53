"""Every setting of a motion followed, its error against a converged motion, its steps timed.

For each accuracy all are followed on the mesh that the program makes for it. The converged motion
there is that by the default method with steps that are halved until what is estimated of its error
is a tenth of that accuracy. What the mesh adds to the errors is told by a still finer mesh.
"""

import time
from dataclasses import replace
from functools import partial
from math import inf
from statistics import median

from ..arrays import Array
from ..errors import AnalysisFailed, UserError
from ..motion import Method
from ..run_motion import RESTARTS, check_motion
from ..scene import Dynamics, Foundation, Scene
from ..solve.dynamics import End, integrator
from ..solve.pace import FINER
from ..solve.plan import simulation, step_for
from ..solve.ready import begun
from .measure import Tell, asking, machine, turns
from .motion_base import Base, Task, base_of, dynamics_of, stable, task
from .motion_chart import TENTH, MotionChart, MotionChoice, MotionReference, MotionRow
from .motion_history import History, Truth, errors_of, places_of
from .motion_settings import (
    EXPLICIT,
    FULL,
    QUICK,
    MotionPlan,
    MotionSeries,
    MotionSetting,
    enough,
    periods_of,
    rates,
)

_FIRST = 640  # steps in a period of the reference, at first
# Shares of all time by which choices, reference and settings are done; then all steps are timed.
_CHOOSING, _CONVERGING, _MEASURING = 0.2, 0.4, 0.65
_HURDLE = 3.5  # times as long as for the last accuracy it takes for the next, about
_PATIENCE = 0.1  # of all time, for a single setting

Bases = dict[float, Base]  # by accuracy, from large to small


def motion_chart(
    scene: Scene, foundation: Foundation, *, quick: bool = False, tell: Tell
) -> MotionChart:
    """Measure a foundation in motion; `tell` hears how far it is.

    Raises AnalysisFailed where it does not come to the end of what is charted.
    """
    return charted_motion(scene, foundation, QUICK if quick else FULL, tell)


def charted_motion(
    scene: Scene, foundation: Foundation, plan: MotionPlan, tell: Tell
) -> MotionChart:
    """The chart of a plan."""
    begin = time.process_time()
    tell("statics")
    bases = {accuracy: base_of(scene, foundation, accuracy) for accuracy in plan.accuracies}
    loose = bases[max(plan.accuracies)]
    work = task(scene, foundation, plan, loose, begin, tell)
    chosen = choices(work)
    x = places_of(loose.begun.model)
    references, truths = references_of(work, bases, x)
    limit = stable(loose)
    rows, cut = settings(work, bases, x, truths, limit)
    judged = [_judged(work, bases[one.accuracy], one, x, truths[one.accuracy]) for one in chosen]
    timed = iter(_timed(work, bases, [*rows, *(c.row for c in judged if c.row)]))
    found, dynamics = periods_of(scene), dynamics_of(scene)
    return MotionChart(
        scene.title,
        foundation.name,
        dynamics,
        scene.default_method,
        work.until,
        found[0] if found else None,
        machine(),
        tuple(references),
        limit,
        tuple(cut),
        tuple(next(timed) for _ in rows),
        tuple(replace(one, row=next(timed)) if one.row else one for one in judged),
    )


def choices(work: Task) -> list[MotionChoice]:
    """What the program chooses for each accuracy, as far as there is time."""
    found: list[MotionChoice] = []
    last = 0.0
    for accuracy in work.plan.accuracies:
        work.tell(f"the program's own choice for {accuracy:g}")
        if _HURDLE * last > work.left(_CHOOSING):
            found.append(MotionChoice(accuracy, failure="left out, for time"))
            continue
        start = time.process_time()
        one = choice(work, accuracy)
        last = time.process_time() - start
        found.append(replace(one, seconds=None if one.failure else last))
    return found


def choice(work: Task, accuracy: float) -> MotionChoice:
    """The mesh and the step for an accuracy, as a run finds them; the row is to be measured."""
    scene, dynamics = asking(work.scene, accuracy), dynamics_of(work.scene)
    start = [begun(scene, work.foundation)]
    step = step_for(scene, dynamics, start)
    for restarts in range(RESTARTS + 1):
        one = simulation(scene, dynamics, start, step, work.until)
        for _ in one.blocks():
            if one.error > accuracy and restarts < RESTARTS:
                break
        else:
            break
        step *= FINER
    if one.ending is not End.COMPLETE:
        return MotionChoice(accuracy, failure=f"at {one.time:.4g} s: {one.ending.value}")
    series = MotionSeries(dynamics.method or scene.default_method, accuracy)
    return MotionChoice(accuracy, MotionRow(MotionSetting(series, one.h)), one.error)


def references_of(
    work: Task, bases: Bases, x: Array
) -> tuple[list[MotionReference], dict[float, Truth]]:
    """The converged motion for each accuracy, and how far its mesh is from a finer one."""
    found: list[MotionReference] = []
    histories: list[History] = []
    spent = 0.0
    for accuracy, base in bases.items():
        first = round(work.period / found[-1].step) // 2 if found else _FIRST
        reference, history, spent = converged(work, base, accuracy, first, x)
        found.append(reference)
        histories.append(history)
    truths = {one.accuracy: Truth.of(h) for one, h in zip(found, histories, strict=True)}
    if spent > work.left(_CONVERGING):
        return found, truths
    work.tell("the same on a finer mesh")
    finer = base_of(work.scene, work.foundation, TENTH * min(bases))
    step = found[-1].step
    followed, _, _ = finer.follow(_default(work.scene), step, work.until, x)
    if followed.history is None:
        return found, truths
    true = Truth.of(followed.history)
    pairs = zip(found, histories, strict=True)
    return [replace(one, mesh_error=errors_of(h, true)) for one, h in pairs], truths


def converged(
    work: Task, base: Base, accuracy: float, rate: int, x: Array
) -> tuple[MotionReference, History, float]:
    """The motion by the default method with steps that are halved until they are small enough.

    rate: of steps in a period, the first that is tried. Also tells the CPU time of the last, s.
    """
    dynamics = _default(work.scene)
    gain = 2.0 ** integrator(dynamics, work.scene.default_method).order - 1.0
    rate, error = min(rate, work.plan.finest // 2), inf
    before = None
    while True:
        work.tell(f"converged motion for {accuracy:g}: {rate} steps in {work.period:g} s")
        begin = time.process_time()
        followed, step, _ = base.follow(dynamics, work.period / rate, work.until, x)
        if followed.history is None:
            raise AnalysisFailed(f"no chart: the motion itself ends {followed.failure}")
        if before is not None:
            error = errors_of(before, Truth.of(followed.history)).largest / gain
        spent = time.process_time() - begin
        late = before is not None and 2.0 * spent > work.left(_CONVERGING)
        if error <= TENTH * accuracy or 2 * rate > work.plan.finest or late:
            reference = MotionReference(accuracy, *base.mesh, step, error)
            return reference, followed.history, spent
        before, rate = followed.history, 2 * rate


def _default(scene: Scene) -> Dynamics:
    return replace(dynamics_of(scene), method=None)


def settings(
    work: Task, bases: Bases, x: Array, truths: dict[float, Truth], limit: float
) -> tuple[list[MotionRow], list[MotionSeries]]:
    """Rows of all settings, and the series that were cut short, for time.

    Steps get shorter until the mesh's accuracy is reached; that for the next one goes on there.
    """
    plan, steps = work.plan, [work.period / rate for rate in rates(work.plan)]
    methods: list[Method] = list(plan.methods)
    first = dict.fromkeys(methods, 0)
    if limit > steps[-1]:
        methods.append(EXPLICIT)
        first[EXPLICIT] = next(i for i, step in enumerate(steps) if step < limit)
    rows: list[MotionRow] = []
    cut: list[MotionSeries] = []
    for accuracy, base in bases.items():
        for method in methods:
            series, errors, last = MotionSeries(method, accuracy), list[float](), 0.0
            if why := unsuited(work.scene, method):
                if accuracy == max(bases):
                    rows.append(MotionRow(MotionSetting(series, steps[0]), failure=why))
                continue
            for step in steps[first[method] :]:
                work.tell(f"{method} for {accuracy:g}, steps of {step:.3g} s")
                if plan.growth * last > work.left(_MEASURING):
                    cut.append(series)
                    break
                begin = time.process_time()
                rows.append(measured(work, base, MotionSetting(series, step), x, truths[accuracy]))
                last = time.process_time() - begin
                found = rows[-1].errors
                errors.append(found.largest if found else inf)
                if enough(errors, accuracy):
                    break
            good = [i for i, error in enumerate(errors) if error <= accuracy]
            first[method] += good[0] if good else max(len(errors) - 1, 0)
    order = {method: number for number, method in enumerate(methods)}
    return sorted(rows, key=lambda row: order[row.setting.series.method]), cut


def unsuited(scene: Scene, method: Method) -> str:
    """Why a method cannot follow a scene at all; empty if it can."""
    try:
        check_motion(replace(scene, dynamics=replace(dynamics_of(scene), method=method)))
    except UserError as fault:
        return fault.faults[0].message
    return ""


def measured(work: Task, base: Base, setting: MotionSetting, x: Array, true: Truth) -> MotionRow:
    """A setting followed once; its time is to come."""
    dynamics = replace(dynamics_of(work.scene), method=setting.series.method)
    patience = max(_PATIENCE * work.plan.seconds, 1.0)
    followed, step, count = base.follow(dynamics, setting.step, work.until, x, patience)
    work_done = followed.iterations, followed.evaluations
    row = MotionRow(replace(setting, step=step), *base.mesh, count, *work_done)
    if followed.history is None:
        return replace(row, failure=followed.failure)
    found = errors_of(followed.history, true)
    if found.largest > 1.0:
        return replace(row, failure=f"an error of {found.largest:.2g}")
    return replace(row, errors=found)


def _judged(work: Task, base: Base, one: MotionChoice, x: Array, true: Truth) -> MotionChoice:
    """A choice with the errors of its row."""
    if one.row is None:
        return one
    row = measured(work, base, one.row.setting, x, true)
    return replace(one, row=row, failure=row.failure)


def _timed(work: Task, bases: Bases, rows: list[MotionRow]) -> list[MotionRow]:
    """Rows with the times of their steps, in turns; not of those that failed."""
    clocks = []
    for row in (row for row in rows if row.errors):
        series, step = row.setting.series, row.setting.step
        dynamics = replace(dynamics_of(work.scene), method=series.method)
        clocks.append(partial(bases[series.accuracy].clock, dynamics, step, work.until))
    spent = iter(turns(clocks, work.plan.runs, max(work.left(1.0), 0.0), work.tell))
    return [_with_times(row, next(spent)) if row.errors else row for row in rows]


def _with_times(row: MotionRow, times: list[float]) -> MotionRow:
    return replace(row, seconds=median(times), runs=len(times))
