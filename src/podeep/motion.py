"""What moves in time, and how it is followed, as plain data in SI units, z up from sea level."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, get_args

from .errors import InvalidData

Dof = Literal["X", "Y", "Z", "RX", "RY", "RZ"]
Method = Literal["NEWMARK", "HHT", "GALPHA", "BATHE", "ROS2", "CENTRAL", "CONSERVE"]
METHODS: tuple[Method, ...] = get_args(Method)
Hysteresis = Literal["ELASTIC", "MASING", "GAP"]


@dataclass(frozen=True, slots=True)
class Mass:
    """A lumped mass, kg, and its moments of inertia about x, y and z through itself, kg m2.

    An elevation above the tube's top is that of a mass on a rigid arm.
    """

    tube: int
    elevation: float
    mass: float
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class CoupledSpring:
    """A spring to ground of deflection and slope together: H = kxx y + kxr y', M = kxr y + krr y'.

    lateral: kxx, N/m; coupling: kxr, N/rad; rotational: krr, N m/rad. The slope y' is that over
    depth, and the same holds in every vertical plane.
    """

    tube: int
    elevation: float
    lateral: float
    coupling: float
    rotational: float

    def __post_init__(self) -> None:
        if not self.lateral * self.rotational >= self.coupling * self.coupling:
            raise InvalidData(
                f"a spring of {self.lateral:g} N/m and {self.rotational:g} N m/rad cannot have a "
                f"coupling of {self.coupling:g} N: it would push along some motions",
                "KXX KRR is at least the square of KXR",
                "KXR",
            )


@dataclass(frozen=True, slots=True)
class Start:
    """Where a degree of freedom starts, m or rad, and how fast, m/s or rad/s."""

    tube: int
    elevation: float
    dof: Dof
    value: float
    velocity: float


@dataclass(frozen=True, slots=True)
class Harmonic:
    """The factor sin(2 pi t / period + phase) of a named load; phase in rad.

    ramp: seconds over which it grows from nothing.
    """

    name: str
    period: float
    phase: float = 0.0
    ramp: float = 0.0


def check_rising(times: Sequence[float]) -> None:
    """Raises InvalidData for times that do not rise."""
    for before, after in pairwise(times):
        if not after > before:
            raise InvalidData(
                f"time {after:g} s does not come after {before:g} s",
                "times rise from line to line",
                "file",
            )


@dataclass(frozen=True, slots=True)
class TimeSeries:
    """The factor of a named load at times, s: straight lines between, held before and after."""

    name: str
    times: tuple[float, ...]
    factors: tuple[float, ...]

    def __post_init__(self) -> None:
        check_rising(self.times)


@dataclass(frozen=True, slots=True)
class Damping:
    """Rayleigh's damping: mass_factor (1/s) times the mass and stiffness_factor (s) times EI."""

    mass_factor: float = 0.0
    stiffness_factor: float = 0.0


@dataclass(frozen=True, slots=True)
class Dynamics:
    """How motion is followed from `start` to `end`, s.

    step: s; None is what the accuracy asks for. method: None is the original's, HHT with alpha =
    -0.05. gamma, beta: Newmark's. adaptive: the step follows the error. recording: s between rows
    of the database; None is the larger of the step and a thousandth of the run.
    """

    start: float
    end: float
    step: float | None = None
    method: Method | None = None
    gamma: float = 0.5
    beta: float = 0.25
    adaptive: bool = False
    iterations: int = 30
    tolerance: float = 0.1
    recording: float | None = None

    def __post_init__(self) -> None:
        if not self.end > self.start >= 0.0:
            raise InvalidData(
                f"motion from {self.start:g} to {self.end:g} s does not go forward",
                "TFIN lies after TINI, which is 0 or later",
                "TFIN",
            )
        if self.step is not None and not 0.0 < self.step <= self.end - self.start:
            raise InvalidData(
                f"a step of {self.step:g} s does not fit in {self.end - self.start:g} s",
                "DT is positive and at most TFIN - TINI",
                "DT",
            )
