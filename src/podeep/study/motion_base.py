"""A foundation ready to be followed again and again: its mesh for an accuracy, and what is charted.

What is charted of the motion are as many periods as the time for all measurements allows.
"""

import time
from dataclasses import dataclass, replace
from math import inf

from ..arrays import Array
from ..motion_record import Ledger, ledger
from ..scene import Dynamics, Foundation, Scene
from ..solve.dynamics import Motion
from ..solve.integrators import CentralDifference
from ..solve.plan import simulation, step_for
from ..solve.ready import Begun, begun
from .measure import Tell, asking, cpu_time
from .motion_history import Followed, follow
from .motion_settings import MotionPlan, periods_of

_TRIED, _FINE = 100, 1000  # steps whose pace counts, and how many of them are in a period
_COARSE = 40.0  # of the program's steps for 1e-2 stand for a period where nothing is periodic


@dataclass(frozen=True, eq=False)
class Base:
    """A foundation at the end of statics on the mesh for an accuracy, which the scene asks for."""

    scene: Scene
    begun: Begun
    book: Ledger

    @property
    def mesh(self) -> tuple[int, int]:
        """Elements and degree."""
        model = self.begun.model
        return model.elements, model.lateral.system.field.degree

    def motion(self) -> Motion:
        """At its start."""
        return self.begun.set_off(self.scene, dynamics_of(self.scene))

    def follow(
        self, dynamics: Dynamics, step: float, until: float, x: Array, patience: float = inf
    ) -> tuple[Followed, float, int]:
        """Histories at depths x for so many seconds; the step, s, and their number."""
        one = simulation(self.scene, dynamics, [self.begun], step, until, twins=False)
        return follow(one, self.book, x, patience), one.h, one.count

    def clock(self, dynamics: Dynamics, step: float, until: float) -> float:
        """CPU time of the steps alone, s."""
        one = simulation(self.scene, dynamics, [self.begun], step, until, twins=False)
        motion = one.motions[0]

        def steps() -> None:
            for _ in range(one.count):
                end = motion.time + one.h
                motion.step(one.h, end, one.share, one.iterations)

        return cpu_time(steps)


def base_of(scene: Scene, foundation: Foundation, accuracy: float) -> Base:
    """The mesh that the program makes for an accuracy.

    Raises AnalysisFailed where statics has no equilibrium.
    """
    asked = asking(scene, accuracy)
    start = begun(asked, foundation)
    return Base(asked, start, ledger(asked, start, start.body(asked)))


def dynamics_of(scene: Scene) -> Dynamics:
    """How a scene's motion is followed where the program chooses one step for all of it."""
    assert scene.dynamics is not None
    return replace(scene.dynamics, step=None, adaptive=False)


def stable(base: Base) -> float:
    """The longest step, s, of explicit differences that is stable where the motion begins."""
    body, method = base.motion().body, CentralDifference()
    limits = [method.limit(one) for one in (body.lateral, body.axial) if one is not None]
    return min(limits)


@dataclass(frozen=True, eq=False)
class Task:
    """What all measurements of a foundation share.

    period: s, in which steps are counted; until: seconds of motion that are charted; begin: of the
    work. Time for it is CPU time: what else a machine does has no part in what is measured.
    """

    scene: Scene
    foundation: Foundation
    plan: MotionPlan
    period: float
    until: float
    begin: float
    tell: Tell

    def left(self, share: float) -> float:
        """CPU seconds until a share of what all may take is spent."""
        return self.begin + share * self.plan.seconds - time.process_time()


def task(
    scene: Scene, foundation: Foundation, plan: MotionPlan, loose: Base, begin: float, tell: Tell
) -> Task:
    """The task of a plan; loose: the base for the largest accuracy."""
    dynamics, found = dynamics_of(scene), periods_of(scene)
    whole = dynamics.end - dynamics.start
    if found is None:
        one = min(_COARSE * step_for(loose.scene, dynamics, [loose.begun]), whole)
        found = one, one
    period, longest = found
    count = plan.periods
    if plan.seconds < inf:
        step = period / _FINE
        pace = loose.clock(replace(dynamics, method=None), step, _TRIED * step) / _TRIED
        count = int(plan.seconds / (pace * plan.whole * longest / period))
    until = min(max(min(count, plan.periods), 1) * longest, whole)
    return Task(scene, foundation, plan, period, until, begin, tell)
