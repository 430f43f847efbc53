"""From what is ready to move to its motion: the step in time, and all that moves in it."""

from collections.abc import Sequence
from math import ceil, inf

import numpy as np

from ..errors import Fault, UserError
from ..scene import Dynamics, Scene
from .dynamics import End
from .mover import Mover
from .ready import Ready
from .simulate import Simulation

_SHARE = 0.05  # of the accuracy: what the iteration of a step may leave
_PARTS, _OWN_PARTS = 40, 20  # of the shortest period of loads, and of the foundation's longest own
_PERIODS = 4.0  # that a trial takes
_SERIES_STEPS = 400  # that a trial takes where nothing is periodic
AIM = 0.5  # of the accuracy: the error that a step is chosen for
_LONGEST, _SHORTEST = 4.0, 1.0 / 64.0  # of the first step
TRIALS = 3
NEAR = 0.6  # of the step to aim for: a trial so near it needs no other
STEADY = 0.9  # of the limit of an explicit method


def simulation(
    scene: Scene,
    dynamics: Dynamics,
    ready: Sequence[Ready],
    step: float,
    until: float,
    *,
    twins: bool = True,
) -> Simulation:
    """All foundations, and their twins, at the start of a motion of so many seconds.

    Without twins its errors are not known.
    """
    count = steps_in(until, step, dynamics.recording)
    return Simulation(
        set_off(scene, dynamics, ready),
        set_off(scene, dynamics, ready) if twins else (),
        dynamics.start,
        until / count,
        count,
        share_of(scene, dynamics),
        dynamics.iterations,
    )


def set_off(scene: Scene, dynamics: Dynamics, ready: Sequence[Ready]) -> list[Mover]:
    """All where their motion begins."""
    return [one.set_off(scene, dynamics) for one in ready]


def share_of(scene: Scene, dynamics: Dynamics) -> float:
    """Of the expected displacement, what iterations may leave."""
    return min(_SHARE * scene.numerics.accuracy, dynamics.tolerance)


def steps_in(until: float, step: float, recording: float | None) -> int:
    """An even number of steps of at most `step` s; they meet records where these meet the end."""
    records = until / recording if recording else 0.0
    if records and abs(records - round(records)) < 1e-9 * records:
        each = ceil(recording / step * (1.0 - 1e-12)) if recording else 1
        each += each * round(records) % 2
        return each * round(records)
    return max(2 * ceil(0.5 * until / step * (1.0 - 1e-12)), 2)


def step_for(scene: Scene, dynamics: Dynamics, ready: Sequence[Ready]) -> float:
    """The step, s: as it was given, or one whose error is within the accuracy in a trial.

    Raises UserError for a step beyond the limit of an explicit method.
    """
    limit = limit_of(scene, dynamics, ready)
    if dynamics.step is not None:
        check_step(dynamics, dynamics.step, limit)
        return dynamics.step
    first = step = min(first_step(scene, dynamics, ready), STEADY * limit)
    span = trial_span(scene, dynamics, first)
    longest = min(_LONGEST * first, STEADY * limit)
    for _ in range(TRIALS):
        trial = simulation(scene, dynamics, ready, step, span)
        trial.every = trial.count
        for _ in trial.blocks():
            pass
        fine = trial.ending is not End.NO_BALANCE
        share = AIM * scene.numerics.accuracy / max(trial.error, 1e-12)
        share = share ** (1.0 / trial.order) if fine else 0.25
        if NEAR <= share <= 1.0 / NEAR:
            return step * min(share, 1.0)
        step = float(np.clip(share * step, _SHORTEST * first, longest))
    return step


def limit_of(scene: Scene, dynamics: Dynamics, ready: Sequence[Ready]) -> float:
    """The longest step, s, that an explicit method stays stable with; inf: any."""
    return min((one.limit(scene, dynamics) for one in ready), default=inf)


def periods_of(scene: Scene) -> list[float]:
    """Of all that is periodic in what drives a scene, s."""
    of_lines = [wave.period for motion in scene.line_motions for wave in motion.waves]
    return [one.period for one in scene.harmonics] + of_lines


def first_step(scene: Scene, dynamics: Dynamics, ready: Sequence[Ready]) -> float:
    """A step to begin with, s, by the periods of what drives and of what moves."""
    periods = periods_of(scene)
    whole = dynamics.end - dynamics.start
    first = min(periods) / _PARTS if periods else whole / _SERIES_STEPS
    return min([first, *(one.period(scene) / _OWN_PARTS for one in ready)])


def trial_span(scene: Scene, dynamics: Dynamics, first: float) -> float:
    """What a trial is to see of the motion, s: periods of loads, or steps once loads set in."""
    whole = dynamics.end - dynamics.start
    if periods := periods_of(scene):
        span = _PERIODS * max(periods)
    else:
        records = [onset(m.times, m.values) for m in scene.line_motions if m.times]
        onsets = [onset(one.times, one.factors) for one in scene.series] + records
        since = min(onsets, default=dynamics.start) - dynamics.start
        span = max(since, 0.0) + _SERIES_STEPS * first
    return min(span, whole)


def onset(times: Sequence[float], values: Sequence[float]) -> float:
    """The time at which a record first changes, s; the last one where it never does."""
    pairs = zip(times, values, values[1:], strict=False)
    return next((time for time, one, other in pairs if one != other), times[-1])


def check_step(dynamics: Dynamics, step: float, limit: float) -> None:
    """Raises UserError for a step beyond the limit of an explicit method, s."""
    if step > limit:
        raise UserError(
            Fault(
                f"METHOD={dynamics.method} is stable with steps up to {limit:.3g} s here, but "
                f"DT is {step:g} s",
                "give a smaller DT, or an implicit method",
            )
        )
