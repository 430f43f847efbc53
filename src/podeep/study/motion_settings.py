"""What a chart of motion varies, as data: methods and steps in time, on meshes of the program."""

from dataclasses import dataclass
from math import inf

from ..motion import Method
from ..scene import Dynamics, Scene
from .settings import PRESETS

#: As METHOD of *DYNAMIC names them; explicit differences are added where their steps are not tiny.
IMPLICIT: tuple[Method, ...] = ("NEWMARK", "HHT", "GALPHA", "BATHE", "CONSERVE", "ROS2")
EXPLICIT: Method = "CENTRAL"

_WITHIN = 0.3  # of an accuracy: an error that suffices
_SETTLED, _FALLS = 0.1, 0.85  # an error below, and by what it falls with the next shorter step


@dataclass(frozen=True, slots=True)
class MotionSeries:
    """What the settings of one line share: the method, and the accuracy whose mesh they are on."""

    method: Method
    accuracy: float


@dataclass(frozen=True, slots=True)
class MotionSetting:
    """One way to follow the motion; step in s."""

    series: MotionSeries
    step: float


@dataclass(frozen=True, slots=True)
class MotionPlan:
    """How much is measured.

    least, most, growth: steps in the shortest period, and from one to the next. finest: of the
    converged motion, at most. periods: longest ones that are charted, at most. runs: of each
    setting that are timed, at most. seconds: of CPU time that all may take, about; whole: steps in
    a shortest period, of all settings together, that these are counted for.
    """

    methods: tuple[Method, ...] = IMPLICIT
    least: int = 10
    most: int = 5120
    growth: float = 2.0**0.5
    finest: int = 20480
    periods: int = 2
    runs: int = 9
    seconds: float = inf
    whole: int = 400_000
    accuracies: tuple[float, ...] = PRESETS


FULL = MotionPlan(seconds=240.0)
QUICK = MotionPlan(
    most=2560,
    growth=2.0,
    finest=10240,
    periods=2,
    runs=3,
    seconds=50.0,
    whole=100_000,
    accuracies=PRESETS[:3],
)


def rates(plan: MotionPlan) -> list[int]:
    """Steps in the shortest period, from few to many."""
    found = [plan.least]
    while found[-1] < 0.9 * plan.most:
        found.append(round(plan.least * plan.growth ** len(found)))
    return found


def periods_of(scene: Scene) -> tuple[float, float] | None:
    """Shortest and longest period of the loads, s; None where nothing is periodic."""
    every = [one.period for one in scene.harmonics]
    return (min(every), max(every)) if every else None


def enough(errors: list[float], accuracy: float) -> bool:
    """Whether still shorter steps tell no more.

    errors: from long to short steps; inf where one failed. It is so far within the accuracy that
    these are, or has twice fallen by so little that what iterations leave makes it.
    """
    if errors[-1] <= _WITHIN * accuracy:
        return True
    last = errors[-3:]
    return len(last) == 3 and last[0] < _SETTLED and min(last[1:]) > _FALLS * last[0]


def motion_lines(
    dynamics: Dynamics, accuracy: float, method: str | None, step: float | None
) -> str:
    """The lines of a deck that ask for an accuracy, a method and a step, s.

    step None: what the accuracy asks for, by the method of the scene.
    """
    name = method if step is not None else dynamics.method
    head = "*DYNAMIC" + (f", METHOD={name}" if name else "")
    span = f"{dynamics.start:g} {dynamics.end:g}"
    return "\n".join(
        ["*ACCURACY", f"{accuracy:g}", head, span if step is None else f"{span} {step:.6g}"]
    )
