"""Every setting solved, its error against a converged reference measured, its runs timed.

The reference is the scene itself on a mesh so fine that halving its elements changes less than a
share of the smallest preset. The runs of all settings take turns.
"""

import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from math import inf
from statistics import median
from typing import Any, TypeVar

import numpy as np

from ..arrays import Array
from ..errors import AnalysisFailed, UserError
from ..model.assemble import Model, assemble
from ..model.grid import JUMP
from ..model.results import Results
from ..scene import Foundation, Scene
from ..solve.analysis import Solved, factors_of, limits, run, solve, suited_model
from ..solve.diagnosis import explain
from ..solve.newton import Limits
from ..solve.statics import Failure
from .chart import Chart, Choice, Reference, Row, Setting
from .settings import PRESETS, SURE, WORDS, Errors, Plan, Series, build, deck_lines, plan

_DEPTHS = 1000  # places where results are compared, besides the element ends of the stretches
_REST = 1e-6  # share of a run's largest value below which a step is at rest
_REFERENCE_RESIDUAL = 1e-9
_REFERENCE_DEGREE, _SHEAR_DEGREE = 7, 5  # high powers of a shear's softness are rounding
_MOST_ELEMENTS = 5000  # of the reference
_SECANT_PATIENCE = 20  # times as many iterations as the scene allows: they converge linearly
_SLOW = 1.0  # a run that took so long is not repeated, s

Tell = Callable[[str], None]
Body = Callable[[], object]
AnyTimed = TypeVar("AnyTimed", Row[Any], Choice[Any])


class Probe:
    """Largest values of a state, step by step, at the same depths for every model of a scene."""

    def __init__(self, base: Model) -> None:
        ends = np.array([base.edges[0], *(p.bottom for p in base.pieces)])
        even = np.linspace(ends[0], ends[-1], _DEPTHS)
        self.every = np.unique(np.concatenate([ends, even]))
        below = ends[:-1] + JUMP  # the soil's other side of a layer boundary
        self.wet = np.unique(np.concatenate([self.every, below, [0.0]]))
        self.wet = self.wet[self.wet >= 0.0]

    def values(self, results: Results) -> Array:
        """Shape (2, 3, steps): lateral and axial; displacement, reaction, moment or force."""

        def largest(values: Array) -> Array:
            return np.asarray(np.abs(values).max(axis=-1, initial=0.0))

        def across(values: Array) -> Array:
            return largest(np.linalg.norm(values, axis=1))

        return np.array(
            [
                [
                    across(results.deflection(self.every)),
                    across(results.lateral_reaction(self.wet)),
                    across(
                        results.of_all(
                            lambda x, tube: results.shear_and_moment(x, tube)[1], self.every
                        )
                    ),
                ],
                [
                    largest(results.settlement(self.every)),
                    largest(results.axial_reaction(self.wet)),
                    largest(results.of_all(results.compression, self.every)),
                ],
            ]
        )


def errors(values: Array, true: Array) -> Errors:
    """Errors of values of a `Probe`; a step at rest is measured by a share of the largest step."""
    size = np.maximum(np.abs(true), _REST * np.abs(true).max(axis=-1, keepdims=True))
    change = np.abs(values - true)
    share = np.divide(change, size, out=np.zeros_like(change), where=size > 0.0)
    return Errors(*share.max(axis=(0, 2)).tolist())


def chart(
    scene: Scene, foundation: Foundation, *, quick: bool = False, tell: Tell
) -> Chart[Series]:
    """Measure a foundation; `tell` hears how far it is.

    Raises AnalysisFailed where the scene itself has no equilibrium in some step.
    """
    base, begun = suited_model(scene, foundation)
    if begun:
        raise KeyboardInterrupt
    return measured(scene, base, plan(base, quick=quick), tell)


def measured(scene: Scene, base: Model, wanted: Plan, tell: Tell) -> Chart[Series]:
    """The chart of a plan for the foundation of a model."""
    own: list[Solved] = []
    for accuracy in PRESETS:
        tell(f"the program's own choice for {accuracy:g}")
        own.append(solve(asking(scene, accuracy), base.foundation))
        if own[-1].interrupted:
            raise KeyboardInterrupt
    if failure := own[-1].failure:
        why = explain(own[-1], failure, scene.steps.names)
        raise AnalysisFailed(f"{why}\n  no chart: every step needs an equilibrium")
    probe = Probe(base)
    reference, true = converged(scene, own[-1].model, probe, tell)
    rows: list[Row[Series]] = []
    bodies: list[Body] = []
    for number, setting in enumerate(wanted.settings, start=1):
        tell(f"setting {number} of {len(wanted.settings)}")
        row, body = solved_row(scene, base, setting, probe, true)
        rows.append(row)
        bodies += [body] * (row.errors is not None)
    choices = [choice_of(one, probe, true) for one in own]
    for one, choice in zip(own, choices, strict=True):
        if choice.errors:
            bodies += [whole_choice(scene, one), last_mesh(scene, one)]
    times = iter(timings(bodies, wanted, tell))
    return Chart(
        scene.title,
        base.foundation.name,
        WORDS,
        partial(deck_lines, scene.numerics),
        len(scene.steps.factors),
        machine(),
        reference,
        tuple(timed(row, next(times)) if row.errors else row for row in rows),
        tuple(_last(timed(c, next(times)), next(times)) if c.errors else c for c in choices),
    )


def timed(one: AnyTimed, times: list[float]) -> AnyTimed:
    """With the median of its times."""
    return replace(one, seconds=median(times), runs=len(times))


def _last(one: Choice[Series], times: list[float]) -> Choice[Series]:
    return replace(one, last=median(times))


def converged(scene: Scene, own: Model, probe: Probe, tell: Tell) -> tuple[Reference, Array]:
    """The scene on a mesh that is halved until nothing changes, and its largest values.

    own: what the program chooses for the smallest preset, whose elements are small where they
    must be. Even elements would have to be a hundred times as many around a cube root.
    """
    limit = replace(limits(scene), residual=_REFERENCE_RESIDUAL)
    same = (scene, own.foundation, own.needs, own.profile, own.pieces)
    degree = _SHEAR_DEGREE if own.needs.shear else _REFERENCE_DEGREE
    boundaries = own.edges
    found: tuple[Reference, Array] | None = None
    while len(boundaries) - 1 <= _MOST_ELEMENTS:
        tell(f"converged reference: {len(boundaries) - 1} elements")
        results, failure, _ = states_of(assemble(*same, boundaries, degree), scene, limit)
        if failure and found is None:
            raise AnalysisFailed(f"no chart: the converged reference failed: {said(failure)}")
        if failure:  # so short elements are mere rounding
            break
        true = probe.values(results)
        change = errors(found[1], true) if found else Errors(inf, inf, inf)
        found = Reference(len(boundaries) - 1, degree, change), true
        if change.largest <= SURE * min(PRESETS):
            break
        middle = 0.5 * (boundaries[:-1] + boundaries[1:])
        boundaries = np.sort(np.concatenate([boundaries, middle]))
    assert found is not None
    return found


def states_of(
    model: Model, scene: Scene, limit: Limits
) -> tuple[Results, Failure | None, tuple[int, int]]:
    """All steps of a model: results, why they end early, iterations and evaluations."""
    states, failure, interrupted = run(model, factors_of(scene), limit)
    if interrupted:
        raise KeyboardInterrupt
    work = sum(s.iterations for s in states), sum(s.evaluations for s in states)
    lateral, axial = np.array([s.lateral for s in states]), np.array([s.axial for s in states])
    return Results(model, lateral, axial), failure, work


def said(failure: Failure) -> str:
    """Why a step failed, in a line."""
    return f"step {failure.step}, {failure.which}: {failure.ending.value}"


def limits_of(scene: Scene, setting: Setting[Series]) -> Limits:
    """How a setting iterates: so far that the smallest preset is not spoilt."""
    exact = replace(scene.numerics, accuracy=min(PRESETS))
    limit = replace(limits(replace(scene, numerics=exact)), method=setting.series.method)
    patience = _SECANT_PATIENCE if limit.method == "secant" else 1
    return replace(limit, iterations=patience * limit.iterations)


def solved_row(
    scene: Scene, base: Model, setting: Setting[Series], probe: Probe, true: Array
) -> tuple[Row[Series], Body]:
    """A setting solved once, and the body to be timed."""
    limit, factors = limits_of(scene, setting), factors_of(scene)
    start = time.process_time()
    try:
        model = build(scene, base, setting)
    except UserError as fault:
        return Row(setting, failure=str(fault)), lambda: None
    building = time.process_time() - start
    results, failure, work = states_of(model, scene, limit)
    unknowns = model.lateral.system.size + model.axial.system.size
    row = Row(setting, unknowns, *work, building)
    if failure:
        return replace(row, failure=said(failure)), lambda: None
    found = errors(probe.values(results), true)
    return replace(row, errors=found), lambda: run(model, factors, limit)


def asking(scene: Scene, accuracy: float) -> Scene:
    """The scene with an accuracy alone, the mesh left to the program."""
    free = replace(scene.numerics, accuracy=accuracy, elements=None, degree=None)
    return replace(scene, numerics=free)


def choice_of(solved: Solved, probe: Probe, true: Array) -> Choice[Series]:
    """What the program made of an accuracy alone."""
    if solved.failure:
        return Choice(solved.accuracy, failure=said(solved.failure))
    found = errors(probe.values(solved.results), true)
    series = Series(solved.model.lateral.system.field.degree)
    mesh = Setting(series, solved.model.elements)
    return Choice(solved.accuracy, mesh, solved.error, found)


def whole_choice(scene: Scene, solved: Solved) -> Body:
    """All that it takes the program to make a choice."""
    asked = asking(scene, solved.accuracy)
    return lambda: solve(asked, solved.model.foundation)


def last_mesh(scene: Scene, solved: Solved) -> Body:
    """The steps alone on the mesh that it ended with."""
    limit, factors = limits(asking(scene, solved.accuracy)), factors_of(scene)
    return lambda: run(solved.model, factors, limit)


def timings(bodies: Sequence[Body], wanted: Plan, tell: Tell) -> list[list[float]]:
    """CPU times of bodies, as `turns` has them."""
    return turns([partial(cpu_time, body) for body in bodies], wanted.runs, wanted.patience, tell)


def cpu_time(body: Body) -> float:
    """CPU time of a run, s."""
    start = time.process_time()
    body()
    return time.process_time() - start


def turns(
    clocks: Sequence[Callable[[], float]],
    runs: int,
    patience: float,
    tell: Tell,
    first: Sequence[float] = (),
) -> list[list[float]]:
    """Times told by clocks that take turns, in one order and then in the other.

    Each runs once, then all as often as is asked and as the patience, s, allows. first: times of
    the first run, where they are known.
    """
    spent: list[list[float]] = [[one] for one in first] or [[] for _ in clocks]
    deadline = time.monotonic() + patience
    for number in range(1 if first else 0, runs):
        if number and time.monotonic() > deadline:
            break
        tell(f"timing, run {number + 1} of {runs}")
        pairs = list(zip(clocks, spent, strict=True))
        for clock, times in pairs if number % 2 == 0 else reversed(pairs):
            if not times or times[0] <= _SLOW:
                times.append(clock())
    return spent


def machine() -> str:
    """Where the times were measured."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("podeep", "numpy", "scipy"))
    name = platform.processor() or platform.machine()
    return f"{name}, {platform.system()}, Python {platform.python_version()}, {packages}"
