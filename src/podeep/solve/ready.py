"""What stands at the end of statics, ready to move."""

from dataclasses import dataclass, replace
from math import ceil, inf, log2, pi
from typing import Protocol

import numpy as np

from ..arrays import Array
from ..errors import AnalysisFailed
from ..model.assemble import Model
from ..model.results import Results
from ..scene import Dynamics, Foundation, Harmonic, Scene, Steps, TimeSeries
from .analysis import factors_of, limits, rebuilt, run, solve
from .body import Body, body
from .dynamics import Motion, integrator, started
from .modes import halved
from .mover import Mover
from .newton import largest
from .starts import Beginning, beginning
from .statics import State

_MESH_SHARE = 0.5  # of the accuracy, for the mesh; the rest is for the steps in time
# In motion the corners of curves, and places where the tube stands still, pass along the tube:
# no mesh of statics meets them. Below these accuracies elements are halved until their square suits
# what is asked. Soil that remembers keeps its corners at all depths.
_CORNERS, _CORNERS_REMEMBERED = 3e-4, 1e-3


class Ready(Protocol):
    """A foundation or a line before its motion begins."""

    @property
    def sizes(self) -> Array:
        """How far both of its problems may move, m, (2,)."""

    def set_off(self, scene: Scene, dynamics: Dynamics) -> Mover:
        """A motion of it at its start."""

    def period(self, scene: Scene) -> float:
        """Its longest natural period that steps are to see, s; inf for none."""

    def limit(self, scene: Scene, dynamics: Dynamics) -> float:
        """The longest step that an explicit method stays stable with, s; inf: any."""


@dataclass(frozen=True, eq=False)
class Begun:
    """A foundation at the end of statics, `Ready`: its model and the state there.

    start: from where it moves. peak: under its largest loads in statics, which the mesh suits.
    sizes: how far deflection and stretch may move, m.
    """

    model: Model
    rest: State
    start: Beginning
    peak: Results
    sizes: Array

    def body(self, scene: Scene) -> Body:
        """What moves of it."""
        return body(scene, self.model, self.rest)

    def set_off(self, scene: Scene, dynamics: Dynamics) -> Motion:
        """As `Ready.set_off`."""
        reach, method = float(self.sizes.max()), integrator(dynamics, scene.default_method)
        return started(self.body(scene), method, dynamics.start, self.start, reach)

    def period(self, scene: Scene) -> float:
        """As `Ready.period`."""
        return max((2.0 * pi / m.slowest() for m in self.body(scene).moving), default=inf)

    def limit(self, scene: Scene, dynamics: Dynamics) -> float:
        """As `Ready.limit`."""
        method = integrator(dynamics)
        return min((method.limit(m) for m in self.body(scene).moving), default=inf)


def begun(scene: Scene, foundation: Foundation) -> Begun:
    """Bring a foundation to the end of statics on a mesh that suits its loads in motion.

    Raises AnalysisFailed where statics has no equilibrium.
    """
    accuracy = _MESH_SHARE * scene.numerics.accuracy
    still = replace(scene, numerics=replace(scene.numerics, accuracy=accuracy, follow_path=False))
    largest_loads = solve(replace(still, steps=peaks(scene)), foundation)
    edges = largest_loads.model.edges
    if scene.numerics.elements is None:
        elastic = scene.numerics.hysteresis == "ELASTIC"
        corners = _CORNERS if elastic else _CORNERS_REMEMBERED
        for _ in range(ceil(0.5 * log2(max(corners / scene.numerics.accuracy, 1.0)))):
            edges = halved(edges)
    model = rebuilt(still, largest_loads.model, edges, 0)
    states, failure, interrupted = run(model, factors_of(scene), limits(still))
    if interrupted:
        raise KeyboardInterrupt
    if failure is not None or not states:
        raise AnalysisFailed(
            f"{foundation.name}: statics has no equilibrium, so there is no state to move from"
        )
    start = beginning(scene, model, states[-1])
    there: tuple[State | Beginning, ...] = (*largest_loads.states, *states, start)
    sizes = np.max([(largest(at.lateral), largest(at.axial)) for at in there], axis=0)
    return Begun(model, states[-1], start, largest_loads.results, sizes)


def peaks(scene: Scene) -> Steps:
    """The static steps, and one more with every history at its largest factor."""
    names, factors = scene.steps.names, scene.steps.factors
    last = list(factors[-1]) if factors else [0.0] * len(names)
    histories: list[Harmonic | TimeSeries] = [*scene.harmonics, *scene.series]
    for history in histories:
        last[names.index(history.name)] = largest_factor(history)
    return Steps(names, (*factors, tuple(last)))


def largest_factor(history: Harmonic | TimeSeries) -> float:
    """The factor of largest size that a history comes to."""
    return 1.0 if isinstance(history, Harmonic) else max(history.factors, key=abs)
