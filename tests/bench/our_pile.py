"""The reference pile in our settings: what the race and the chart against OpenSees share.

The error is the larger of those of head displacement and largest moment in the last of ten steps.
Both programs iterate to the same residual over the load. Building is not counted on either side.
Times are CPU times of the ten steps in one process, the programs taking turns.
"""

import platform
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from sys import path

import numpy as np

path.insert(0, str(Path(__file__).parents[1]))
from podeep.model.assemble import Model
from podeep.model.results import Results
from podeep.scene import Numerics, Scene
from podeep.solve.analysis import first_model, limits, run, solve
from podeep.solve.statics import State
from scenes import reference_pile

STEPS, FREE, EMBEDDED = 10, 10.0, 40.0
TOLERANCE = 1e-7  # residual over the load; OpenSees stalls on rounding below it
DEGREES = (3, 5, 7)

Values = tuple[float, float]  # head displacement, m, and largest moment, N m
Body = Callable[[], object]


@dataclass(frozen=True)
class Mesh:
    """One of our settings; elements: of the whole tube."""

    components: int
    elements: int
    degree: int

    @property
    def name(self) -> str:
        return f"podeep, {self.elements} elements of degree {self.degree}"


def scene_of(mesh: Mesh) -> Scene:
    numerics = Numerics(
        elements=mesh.elements, degree=mesh.degree, components=mesh.components, accuracy=1e-4
    )
    return reference_pile(steps=STEPS, numerics=numerics)


@cache
def model_of(mesh: Mesh) -> Model:
    scene = scene_of(mesh)
    return first_model(scene, scene.foundations[0])


def states_of(mesh: Mesh) -> list[State]:
    """The ten steps of one of our models, which is built once."""
    model, scene = model_of(mesh), scene_of(mesh)
    limit = replace(limits(scene), residual=TOLERANCE)
    states, failure, _ = run(model, np.array(scene.steps.factors), limit)
    assert failure is None
    return states


def steps_of(mesh: Mesh) -> Body:
    """What is timed of one of our models."""
    model, scene = model_of(mesh), scene_of(mesh)
    limit, factors = replace(limits(scene), residual=TOLERANCE), np.array(scene.steps.factors)
    return lambda: run(model, factors, limit)


def whole_of(mesh: Mesh) -> Body:
    """All that it takes: building, steps, estimate of the error."""
    scene = scene_of(mesh)
    return lambda: solve(scene, scene.foundations[0])


@cache
def our_values(mesh: Mesh) -> Values:
    last = states_of(mesh)[-1]
    results = Results(model_of(mesh), last.lateral[None], last.axial[None])
    x = np.linspace(0.0, EMBEDDED, 20001)
    moment = np.abs(results.shear_and_moment(x)[1]).max()
    return float(np.abs(results.deflection(np.array([-FREE]))).max()), float(moment)


@cache
def converged() -> Values:
    return our_values(Mesh(1, 60, 7))


def error(values: Values) -> float:
    """The larger relative error of the two values."""
    return max(abs(v / true - 1.0) for v, true in zip(values, converged(), strict=True))


def cpu(body: Body) -> float:
    start = time.process_time()
    body()
    return time.process_time() - start


def in_turns(bodies: Sequence[Body], rounds: int) -> list[float]:
    """Medians of CPU times of bodies that take turns, s."""
    spent: list[list[float]] = [[] for _ in bodies]
    for _ in range(rounds):
        for body, times in zip(bodies, spent, strict=True):
            times.append(cpu(body))
    return [statistics.median(times) for times in spent]


def machine() -> str:
    """Processor, where the system tells it, and versions."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    packages = ("podeep", "numpy", "scipy", "openseespy")
    versions = ", ".join(f"{p} {version(p)}" for p in packages)
    return f"{(names or [platform.machine()])[0]}, Python {platform.python_version()}, {versions}"
