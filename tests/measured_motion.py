"""Accuracy asked and true error of motions: the reference pile with 200 t on its head.

The truth is a solution on 40 elements of degree 7 (80 of degree 5 where the soil remembers: its
corners are everywhere) with steps of 1 ms. Errors are the largest difference of the head's
displacement over its largest value. Where gaps open, histories part for good after a while: there
the peak and the energy lost in the first 20 s are compared.
"""

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from moving_piles import head_of, motion_of, start_of, swaying_pile
from podeep.arrays import Array
from podeep.scene import Scene
from podeep.solve.dynamics import End
from podeep.solve.integrators import Weighted
from podeep.solve.plan import simulation, step_for

_FINE, _STILL = 1e-3, 1e-7  # step of the truth, s, and what its iterations leave
PARTING = 20.0  # s of a motion with gaps that are compared


@dataclass(frozen=True, slots=True)
class Case:
    """A motion: soil's memory, force (N), seconds; gaps: its histories part."""

    hysteresis: str
    force: float
    end: float

    @property
    def name(self) -> str:
        return f"{self.hysteresis.lower()}, {self.force / 1e6:g} MN, {self.end:g} s"


@dataclass(frozen=True, slots=True)
class Truth:
    """Times and displacements of the head, m, and energy lost by the soil, J."""

    times: Array
    head: Array
    lost: float


@dataclass(frozen=True, slots=True)
class Row:
    """error: true, relative. estimate: the program's own. peak, lost: their relative errors."""

    case: Case
    accuracy: float
    error: float
    estimate: float
    peak: float
    lost: float
    steps: int
    elements: int
    seconds: float
    ending: End


CASES = (
    Case("ELASTIC", 1e6, 12.0),
    Case("ELASTIC", 4e6, 12.0),
    Case("MASING", 1e6, 12.0),
    Case("MASING", 4e6, 12.0),
)
GAPS = (Case("GAP", 4e6, PARTING),)


def scene_of(case: Case, accuracy: float, step: float | None = None) -> Scene:
    return swaying_pile(case.force, accuracy, case.end, step, hysteresis=case.hysteresis)


def truth_of(case: Case) -> Truth:
    scene = scene_of(case, 1e-6, _FINE)
    elements, degree = (40, 7) if case.hysteresis == "ELASTIC" else (80, 5)
    scene = replace(scene, numerics=replace(scene.numerics, elements=elements, degree=degree))
    motion = motion_of(scene)
    times, head = head_of(motion, Weighted(), _FINE, round(case.end / _FINE), _STILL)
    return Truth(times, head, motion.body.lateral.dissipated())


def rows(case: Case, accuracies: tuple[float, ...]) -> Iterator[Row]:
    true = truth_of(case)
    whole = CubicSpline(true.times, true.head)
    for accuracy in accuracies:
        begin = time.process_time()
        scene = scene_of(case, accuracy)
        assert scene.dynamics is not None
        start = [start_of(scene)]
        step = step_for(scene, scene.dynamics, start)
        one = simulation(scene, scene.dynamics, start, step, case.end)
        blocks = list(one.blocks())
        times = np.concatenate([b.times for b in blocks])
        head = np.concatenate([b.tracks[0][0].q[:, 0] for b in blocks])
        largest = np.abs(true.head).max()
        lost = one.motions[0].body.lateral.dissipated()
        yield Row(
            case,
            accuracy,
            float(np.abs(head - whole(times)).max() / largest),
            one.error,
            float(abs(np.abs(head).max() / largest - 1.0)),
            abs(lost / true.lost - 1.0) if true.lost else 0.0,
            one.done,
            one.motions[0].body.model.elements,
            time.process_time() - begin,
            one.ending,
        )
