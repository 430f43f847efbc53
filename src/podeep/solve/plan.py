"""From a scene to its motions: meshes, states at the end of statics, the step in time."""

from dataclasses import dataclass, replace
from math import ceil, inf, log2, pi

import numpy as np

from ..arrays import Array
from ..errors import AnalysisFailed, Fault, UserError
from ..model.assemble import Model
from ..model.results import Results
from ..scene import Dynamics, Foundation, Harmonic, Scene, Steps, TimeSeries
from .analysis import factors_of, limits, rebuilt, run, solve
from .body import body
from .dynamics import End, Motion, integrator, started
from .modes import halved
from .moving import Moving
from .newton import largest
from .simulate import Simulation
from .starts import Beginning, beginning
from .statics import State

_SHARE = 0.05  # of the accuracy: what the iteration of a step may leave
_MESH_SHARE = 0.5  # of the accuracy, for the mesh; the rest is for the steps in time
# In motion the corners of curves, and places where the tube stands still, pass along the tube:
# no mesh of statics meets them. Below these accuracies elements are halved until their square suits
# what is asked. Soil that remembers keeps its corners at all depths.
_CORNERS, _CORNERS_REMEMBERED = 3e-4, 1e-3
_PARTS, _OWN_PARTS = 40, 20  # of the shortest period of loads, and of the foundation's longest own
_PERIODS = 4.0  # that a trial takes
_SERIES_STEPS = 400  # that a trial takes where nothing is periodic
AIM = 0.5  # of the accuracy: the error that a step is chosen for
_LONGEST, _SHORTEST = 4.0, 1.0 / 64.0  # of the first step
TRIALS = 3
NEAR = 0.6  # of the step to aim for: a trial so near it needs no other
STEADY = 0.9  # of the limit of an explicit method


@dataclass(frozen=True, eq=False)
class Begun:
    """A foundation at the end of statics: its model and the state there.

    start: from where it moves. peak: under its largest loads in statics, which the mesh suits.
    sizes: how far deflection and stretch may move, m.
    """

    model: Model
    rest: State
    start: Beginning
    peak: Results
    sizes: Array


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


def simulation(
    scene: Scene,
    dynamics: Dynamics,
    begun: list[Begun],
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
        set_off(scene, dynamics, begun),
        set_off(scene, dynamics, begun) if twins else (),
        integrator(dynamics),
        dynamics.start,
        until / count,
        count,
        share_of(scene, dynamics),
        dynamics.iterations,
    )


def set_off(scene: Scene, dynamics: Dynamics, begun: list[Begun]) -> list[Motion]:
    """All foundations where their motion begins."""
    return [
        started(body(scene, one.model, one.rest), dynamics.start, one.start, float(one.sizes.max()))
        for one in begun
    ]


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


def step_for(scene: Scene, dynamics: Dynamics, begun: list[Begun]) -> float:
    """The step, s: as it was given, or one whose error is within the accuracy in a trial.

    Raises UserError for a step beyond the limit of an explicit method.
    """
    moving = moving_in(scene, begun)
    limit = limit_of(dynamics, moving)
    if dynamics.step is not None:
        check_step(dynamics, dynamics.step, limit)
        return dynamics.step
    first = step = min(first_step(scene, dynamics, moving), STEADY * limit)
    span = trial_span(scene, dynamics, first)
    longest = min(_LONGEST * first, STEADY * limit)
    for _ in range(TRIALS):
        trial = simulation(scene, dynamics, begun, step, span)
        trial.every = trial.count
        for _ in trial.blocks():
            pass
        fine = trial.ending is not End.NO_BALANCE
        share = AIM * scene.numerics.accuracy / max(trial.error, 1e-12)
        share = share ** (1.0 / trial.method.order) if fine else 0.25
        if NEAR <= share <= 1.0 / NEAR:
            return step * min(share, 1.0)
        step = float(np.clip(share * step, _SHORTEST * first, longest))
    return step


def moving_in(scene: Scene, begun: list[Begun]) -> list[Moving]:
    """All that moves: deflections and stretches."""
    bodies = [body(scene, one.model, one.rest) for one in begun]
    return [m for b in bodies for m in (b.lateral if b.sways else None, b.axial) if m is not None]


def limit_of(dynamics: Dynamics, moving: list[Moving]) -> float:
    """The longest step, s, that an explicit method stays stable with; inf: any."""
    return min((integrator(dynamics).limit(m) for m in moving), default=inf)


def first_step(scene: Scene, dynamics: Dynamics, moving: list[Moving]) -> float:
    """A step to begin with, s, by the periods of loads and foundations."""
    periods = [h.period for h in scene.harmonics]
    whole = dynamics.end - dynamics.start
    first = min(periods) / _PARTS if periods else whole / _SERIES_STEPS
    return min([first, *(2.0 * pi / m.slowest() / _OWN_PARTS for m in moving)])


def trial_span(scene: Scene, dynamics: Dynamics, first: float) -> float:
    """What a trial is to see of the motion, s: periods of loads, or steps once loads set in."""
    whole = dynamics.end - dynamics.start
    if scene.harmonics:
        span = _PERIODS * max(h.period for h in scene.harmonics)
    else:
        onsets = [onset(history) - dynamics.start for history in scene.series]
        span = max(min(onsets, default=0.0), 0.0) + _SERIES_STEPS * first
    return min(span, whole)


def onset(history: TimeSeries) -> float:
    """The time at which the factor of a load first changes, s; the last one where it never does."""
    pairs = zip(history.times, history.factors, history.factors[1:], strict=False)
    return next((time for time, one, other in pairs if one != other), history.times[-1])


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
