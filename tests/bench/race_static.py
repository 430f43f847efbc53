"""Speed at equal error on the reference pile: this solver against OpenSeesPy.

    pip install "podeep[bench]" && python tests/bench/race_static.py

The scene is a steel tube of 2 m by 50 mm, 10 m free and 40 m embedded, in cube-root clay over API
sand with t-z and Q-z of API RP 2GEO, loaded by 2 MN across and 5 MN down in ten steps. The error is
the larger of those of head displacement and largest moment in the last step. For each error asked,
OpenSees has its coarsest mesh that is within it, as its next two finer ones are; we have, of the
fewest elements of degree 3, 5 and 7 that are so, the fastest. Both iterate to the same residual
over the load. Building is not counted on either side. Times are CPU times of the ten steps in one
process, the programs taking turns; the figures are medians, and a ratio is that of medians.
"""

import argparse
import platform
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from sys import path

import numpy as np
import openseespy.opensees as ops

path.insert(0, str(Path(__file__).parent))
path.insert(0, str(Path(__file__).parents[1]))
from opensees_pile import EMBEDDED, FREE, STEPS, TOLERANCE, build_opensees, meshes, opensees_values

from podeep.model.assemble import Model
from podeep.model.results import Results
from podeep.scene import Numerics, Scene
from podeep.solve.accuracy import estimate
from podeep.solve.analysis import first_model, limits, rebuilt, run, solve
from scenes import reference_pile

Values = tuple[float, float]  # head displacement, m, and largest moment, N m
Body = Callable[[], object]

#: Components of the deflection, dimensions of OpenSees, and the errors asked.
RACES = ((1, 2, (1.5e-4, 3e-5)), (2, 3, (1.5e-4,)))
DEGREES = (3, 5, 7)
SIZES = (10, 30, 100, 300, 1000, 3000, 10_000)
_SURE = 2  # finer meshes that are within an error, too


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


def factors_of(scene: Scene) -> np.ndarray:
    return np.array(scene.steps.factors)


@cache
def model_of(mesh: Mesh) -> Model:
    scene = scene_of(mesh)
    return first_model(scene, scene.foundations[0])


def steps_of(mesh: Mesh) -> Body:
    """The ten steps of one of our models, which is built."""
    model, scene = model_of(mesh), scene_of(mesh)
    limit, factors = replace(limits(scene), residual=TOLERANCE), factors_of(scene)
    return lambda: run(model, factors, limit)


def whole_of(mesh: Mesh) -> Body:
    """All that it takes: building, steps, estimate of the error."""
    scene = scene_of(mesh)
    return lambda: solve(scene, scene.foundations[0])


@cache
def our_values(mesh: Mesh) -> Values:
    states, failure, _ = steps_of(mesh)()  # type: ignore[misc]  # what `run` returns
    assert failure is None
    last = states[-1]
    results = Results(model_of(mesh), last.lateral[None], last.axial[None])
    x = np.linspace(0.0, EMBEDDED, 20001)
    moment = np.abs(results.shear_and_moment(x)[1]).max()
    return float(np.abs(results.deflection(np.array([-FREE]))).max()), float(moment)


@cache
def their_values(elements: int, dimensions: int) -> Values:
    return opensees_values(elements, dimensions)


def coarsest(errors: Iterator[tuple[int, float]], asked: float) -> int:
    """The first of a series that is within an error, as the next ones are."""
    good: list[int] = []
    for size, error in errors:
        good = [*good, size] if error <= asked else []
        if len(good) > _SURE:
            return good[0]
    raise RuntimeError(f"no mesh of the series is within {asked:g}")


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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=41)
    rounds = parser.parse_args().rounds
    head, moment = our_values(Mesh(1, 60, 7))

    def error(values: Values) -> float:
        return max(abs(values[0] / head - 1.0), abs(values[1] / moment - 1.0))

    def fastest(components: int, asked: float) -> Mesh:
        fewest = [
            Mesh(components, coarsest(ours(components, degree), asked), degree)
            for degree in DEGREES
        ]
        times = in_turns([steps_of(mesh) for mesh in fewest], rounds)
        return min(zip(times, fewest, strict=True), key=lambda pair: pair[0])[1]

    def ours(components: int, degree: int) -> Iterator[tuple[int, float]]:
        for n in range(3, 100):
            yield n, error(our_values(Mesh(components, n, degree)))

    def theirs(dimensions: int) -> Iterator[tuple[int, float]]:
        return ((n, error(their_values(n, dimensions))) for n in meshes())

    print(f"{machine()}, Python {platform.python_version()}")
    print(", ".join(f"{p} {version(p)}" for p in ("podeep", "numpy", "scipy", "openseespy")))
    print(f"converged: head {head:.8f} m, largest moment {moment / 1e6:.6f} MN m")
    print(f"ten steps, residual {TOLERANCE:g} of the load, medians of {rounds} runs in turns")
    for components, dimensions, asked in RACES:
        for wanted in asked:
            mesh, found = fastest(components, wanted), coarsest(theirs(dimensions), wanted)
            race(mesh, error(our_values(mesh)), found, dimensions, wanted, rounds)
            print(f"  error of OpenSees {error(their_values(found, dimensions)):.1e}")
    shares(fastest(1, 1e-4), fastest(1, 1e-6), rounds)
    growth()


def race(
    mesh: Mesh, miss: float, elements: int, dimensions: int, asked: float, rounds: int
) -> None:
    """Our steps against theirs, in turns."""
    spent: tuple[list[float], list[float]] = ([], [])
    body = steps_of(mesh)
    for _ in range(rounds):
        build_opensees(elements, dimensions)
        spent[0].append(cpu(lambda: ops.analyze(STEPS)))
        spent[1].append(cpu(body))
    theirs, ours = (statistics.median(times) for times in spent)
    print(f"\nwithin {asked:g}, {'planar' if dimensions == 2 else 'spatial'}:", end=" ")
    print(f"{theirs / ours:.1f} times faster")
    print(f"  OpenSees {dimensions}-D, {elements} embedded elements: {1e3 * theirs:.2f} ms")
    print(f"  {mesh.name}: {1e3 * ours:.2f} ms, error {miss:.1e}")


def shares(loose: Mesh, tight: Mesh, rounds: int) -> None:
    """What the estimate of the error adds, and what 1e-6 takes over 1e-4."""
    scene, model = scene_of(loose), model_of(loose)
    richer = rebuilt(scene, model, model.edges, 1)
    states, _, _ = steps_of(loose)()  # type: ignore[misc]  # what `run` returns
    bodies = (steps_of(loose), steps_of(tight), lambda: estimate(model, richer, states, 1e-4))
    first, second, third = in_turns(bodies, rounds)
    print(f"\nwithin 1e-4: {loose.name}, {1e3 * first:.2f} ms")
    print(f"within 1e-6: {tight.name}, {1e3 * second:.2f} ms, {second / first:.2f} times as long")
    print(f"estimate of the error within 1e-4: {1e3 * third:.2f} ms, {third / first:.2f} of that")


def growth() -> None:
    """Time against elements of a mesh that is given."""
    print("\nelements   steps, ms   building, estimate and steps, ms   exponent of both")
    last: tuple[float, float] | None = None
    for n in SIZES:
        mesh = Mesh(1, n, 5)
        repeats = max(3, min(15, 3000 // n))
        steps, whole = in_turns((steps_of(mesh), whole_of(mesh)), repeats)
        line = f"{n:8d}  {1e3 * steps:10.2f}  {1e3 * whole:33.1f}"
        if last:
            base = np.log(n / SIZES[SIZES.index(n) - 1])
            exponents = (np.log(a / b) / base for a, b in zip((steps, whole), last, strict=True))
            line += "".join(f"  {e:6.2f}" for e in exponents)
        print(line)
        last = steps, whole


def machine() -> str:
    """The processor's name where the system tells it."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


if __name__ == "__main__":
    main()
