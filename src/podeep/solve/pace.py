"""How fast a motion goes: in steps of one length, or in steps that follow the error.

A pace is the step, s, or the share of the largest displacement that a stride of two steps may add
to the error.
"""

from collections.abc import Sequence
from math import ceil, log2

import numpy as np

from ..arrays import Array
from ..scene import Dynamics, Scene
from .adaptive import Adaptive
from .dynamics import End
from .plan import (
    AIM,
    NEAR,
    STEADY,
    TRIALS,
    first_step,
    limit_of,
    set_off,
    share_of,
    simulation,
    step_for,
    steps_in,
    trial_span,
)
from .ready import Ready
from .simulate import Simulation

FINER = 0.5  # of a step whose error turned out too large
_LEFT = 0.05  # of what a stride may add, that iterations may leave: else steps would follow these
_SIZE = 0.1  # of the displacements expected: least that error is a share of
_LOOSE = 0.1  # of the error to aim for, in the first trial's strides
_CHANGE = 1000.0  # of the pace from one trial to the next, at most


def pace_for(scene: Scene, dynamics: Dynamics, ready: Sequence[Ready]) -> float:
    """The pace that was asked for, or one whose error is within the accuracy in a trial."""
    if not dynamics.adaptive:
        return step_for(scene, dynamics, ready)
    span = trial_span(scene, dynamics, first_step(scene, dynamics, ready))
    aim = AIM * scene.numerics.accuracy
    added = _LOOSE * aim
    for _ in range(TRIALS):
        trial = adaptive(scene, dynamics, ready, added, span)
        trial.record_each(span)
        for _ in trial.blocks():
            pass
        share = aim / max(trial.error, 1e-12) if trial.ending is not End.NO_BALANCE else 0.25
        share = float(share ** (1.0 + 1.0 / trial.order))
        if NEAR <= share <= 1.0 / NEAR:
            return added * min(share, 1.0)
        added *= min(max(share, 1.0 / _CHANGE), _CHANGE)
    return added


def finer(dynamics: Dynamics, pace: float, order: int) -> float:
    """A pace for errors as much smaller as steps of half the length have."""
    return pace * float(FINER ** (order + 1 if dynamics.adaptive else 1))


def paced(
    scene: Scene, dynamics: Dynamics, ready: Sequence[Ready], pace: float, until: float
) -> Simulation:
    """All foundations, and their twins, at the start of a motion of so many seconds."""
    make = adaptive if dynamics.adaptive else simulation
    return make(scene, dynamics, ready, pace, until)


def adaptive(
    scene: Scene, dynamics: Dynamics, ready: Sequence[Ready], added: float, until: float
) -> Adaptive:
    """A motion in steps that follow the error: they meet records, and loads are seen.

    Raises UserError for a first step beyond the limit of an explicit method.
    """
    limit = STEADY * limit_of(scene, dynamics, ready)
    longest = first_step(scene, dynamics, ready)
    first = dynamics.step or longest
    longest = min(longest, dynamics.recording or longest)
    count = steps_in(until, longest, dynamics.recording)
    base = until / count
    return Adaptive(
        set_off(scene, dynamics, ready),
        set_off(scene, dynamics, ready),
        dynamics.start,
        base,
        count,
        min(share_of(scene, dynamics), _LEFT * added),
        dynamics.iterations,
        scouts=set_off(scene, dynamics, ready),
        added=added,
        size=_SIZE * np.max([one.sizes for one in ready], axis=0),
        bends=bends(scene, dynamics),
        coarsest=halvings(base, limit),
        level=halvings(base, min(first, limit)),
    )


def halvings(step: float, longest: float) -> int:
    """How often a step is to be halved to be no longer than another one."""
    return max(ceil(log2(step / longest * (1.0 - 1e-12))), 0) if longest < step else 0


def bends(scene: Scene, dynamics: Dynamics) -> Array:
    """Times at which loads bend, s, rising."""
    times = [dynamics.start + h.ramp for h in scene.harmonics]
    times += [time for history in scene.series for time in history.times]
    for motion in scene.line_motions:
        times += [dynamics.start + wave.ramp for wave in motion.waves]
        times += motion.times
    return np.unique(np.array(times, dtype=float))
