"""What moves in time, in words: histories, starts, damping, and how motion is followed."""

from collections.abc import Iterator, Mapping
from math import degrees

from .scene import Dynamics, Ground, Method, Scene
from .units import short

_METHODS: Mapping[Method, str] = {
    "HHT": "HHT with alpha = -0.05",
    "GALPHA": "generalised alpha",
    "BATHE": "Bathe's of two stages",
    "ROS2": "Rosenbrock's of two stages",
    "CENTRAL": "explicit central differences",
    "CONSERVE": "trapezoidal with the mean force of a step, which keeps energy",
}
#: The soil's force in motion, by IDRE.
_RULES = (
    "the static force at the end of the steps, and the dynamic curve from there",
    "the dynamic curve from the end of the steps alone",
    "the static curve, in statics and in motion",
    "the dynamic curve, in statics and in motion",
)


def motion_lines(scene: Scene) -> Iterator[str]:
    """What drives the motion, what damps it, and how it is followed; nothing without these."""
    if scene.dynamics is not None:
        default = scene.default_method if scene.foundations else "CONSERVE"
        yield from run_lines(scene.dynamics, default)
        if scene.dynamics.method is None and scene.lines and default != "CONSERVE":
            yield f"method of lines {_METHODS['CONSERVE']} (default)"
        if scene.foundations:
            yield f"force of the soil: {_RULES[scene.ground.dynamic_rule]}"
    for sine in scene.harmonics:
        ramp = f", growing over {short(sine.ramp)} s" if sine.ramp else ""
        yield (
            f"{sine.name} follows a sine of {short(sine.period)} s from "
            f"{short(degrees(sine.phase))} deg on{ramp}"
        )
    for series in scene.series:
        times, factors = series.times, series.factors
        count = f"{len(times)} rows" if len(times) > 1 else "1 row"
        yield (
            f"{series.name} follows {count} from {short(times[0])} to {short(times[-1])} s, "
            f"factors {short(min(factors))} to {short(max(factors))}"
        )
    for start in scene.starts:
        unit = "rad" if start.dof.startswith("R") else "m"
        yield (
            f"tube {start.tube} at {short(start.elevation)} m: {start.dof} starts at "
            f"{short(start.value)} {unit} with {short(start.velocity)} {unit}/s"
        )
    if scene.damping is not None:
        whose = ["tubes"] * bool(scene.foundations) + ["lines"] * bool(scene.lines)
        yield (
            f"damping {short(scene.damping.mass_factor)} 1/s of the mass and "
            f"{short(scene.damping.stiffness_factor)} s of the stiffness of the "
            f"{' and '.join(whose)}"
        )


def run_lines(dynamics: Dynamics, default: Method) -> Iterator[str]:
    """The run: its times, its method, its steps, their limits and records."""
    method = dynamics.method or default
    yield f"from {short(dynamics.start)} to {short(dynamics.end)} s"
    newmark = f"Newmark with gamma {short(dynamics.gamma)} and beta {short(dynamics.beta)}"
    yield f"method {_METHODS.get(method, newmark)}{'' if dynamics.method else ' (default)'}"
    if dynamics.step is None:
        step = "as the accuracy asks for (default)"
    else:
        step = f"{short(dynamics.step)} s{' at first' if dynamics.adaptive else ''}"
    yield f"step {step}{', following the error' if dynamics.adaptive else ''}"
    yield (
        f"at most {dynamics.iterations} iterations a step, balanced to "
        f"{short(dynamics.tolerance)} or better"
    )
    if dynamics.recording is None:
        yield "a record each step or thousandth of the run, whichever is longer (default)"
    else:
        yield f"a record each {short(dynamics.recording)} s"


def soil_motion_lines(ground: Ground) -> Iterator[str]:
    """Dashpots of p-y curves."""
    for id_, damping in ground.dashpots.items():
        yield f"p-y {id_}: dashpot {short(damping)} N s/m2 per metre of width"
