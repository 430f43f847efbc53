"""Speed at equal error on the reference pile: this solver against OpenSeesPy.

    pip install "podeep[bench]" && python tests/bench/race_static.py

The scene is a steel tube of 2 m by 50 mm, 10 m free and 40 m embedded, in cube-root clay over API
sand with t-z and Q-z of API RP 2GEO, loaded by 2 MN across and 5 MN down in ten steps. For each
error asked, OpenSees has its coarsest mesh that is within it. We have the fastest of the fewest
elements of degree 3, 5 and 7, and up to three more, that are within it, as two finer meshes are.
`our_pile.py` and `opensees_pile.py` tell how both are measured; figures are medians, and a ratio
is that of medians.
"""

import one_thread  # noqa: F401, I001  # before numpy


import argparse
import statistics
from collections.abc import Iterator
from pathlib import Path
from sys import path

import numpy as np
import openseespy.opensees as ops

path.insert(0, str(Path(__file__).parent))
from opensees_pile import build_opensees, meshes, opensees_values
from our_pile import (
    DEGREES,
    STEPS,
    TOLERANCE,
    Mesh,
    converged,
    cpu,
    error,
    in_turns,
    machine,
    model_of,
    our_values,
    scene_of,
    states_of,
    steps_of,
    whole_of,
)

from podeep.solve.analysis import estimated

#: Components of the deflection, dimensions of OpenSees, and the errors asked.
RACES = ((1, 2, (1.5e-4, 3e-5)), (2, 3, (1.5e-4,)))
SIZES = (10, 30, 100, 300, 1000, 3000, 10_000)
_SURE = 2  # finer meshes of ours that are within an error, too
_MORE = 3  # elements more than the fewest that may be faster


def fewest(components: int, degree: int, asked: float) -> int:
    """The fewest elements within an error, as the next ones are."""
    good: list[int] = []
    for n in range(3, 100):
        good = [*good, n] if error(our_values(Mesh(components, n, degree))) <= asked else []
        if len(good) > _SURE:
            return good[0]
    raise RuntimeError(f"no mesh of degree {degree} is within {asked:g}")


def fastest(components: int, asked: float, rounds: int) -> Mesh:
    """The fastest of our settings within an error."""
    settings = [
        Mesh(components, least + more, degree)
        for degree in DEGREES
        for least in [fewest(components, degree, asked)]
        for more in range(_MORE + 1)
    ]
    settings = [mesh for mesh in settings if error(our_values(mesh)) <= asked]
    times = in_turns([steps_of(mesh) for mesh in settings], rounds)
    return min(zip(times, settings, strict=True), key=lambda pair: pair[0])[1]


def coarsest(dimensions: int, asked: float) -> tuple[int, float]:
    """The first mesh of OpenSees within an error, and its error."""
    found: Iterator[tuple[int, float]] = (
        (n, error(opensees_values(n, dimensions))) for n in meshes()
    )
    return next(pair for pair in found if pair[1] <= asked)


def race(components: int, dimensions: int, asked: float, rounds: int) -> None:
    """Our steps against theirs, in turns."""
    mesh, (elements, miss) = fastest(components, asked, rounds), coarsest(dimensions, asked)
    body = steps_of(mesh)
    spent: tuple[list[float], list[float]] = ([], [])
    for _ in range(rounds):
        build_opensees(elements, dimensions)
        spent[0].append(cpu(lambda: ops.analyze(STEPS)))
        spent[1].append(cpu(body))
    theirs, ours = (statistics.median(times) for times in spent)
    print(f"\nwithin {asked:g}, {'planar' if dimensions == 2 else 'spatial'}:", end=" ")
    print(f"{theirs / ours:.1f} times faster")
    print(f"  OpenSees {dimensions}-D, {elements} embedded elements:", end=" ")
    print(f"error {miss:.1e}, {1e3 * theirs:.2f} ms")
    print(f"  {mesh.name}: error {error(our_values(mesh)):.1e}, {1e3 * ours:.2f} ms")


def shares(rounds: int) -> None:
    """What 1e-6 takes over 1e-4, and what the estimate of the error adds."""
    loose, tight = fastest(1, 1e-4, rounds), fastest(1, 1e-6, rounds)
    scene, model = scene_of(loose), model_of(loose)
    states = states_of(loose)
    bodies = (steps_of(loose), steps_of(tight), lambda: estimated(scene, model, states, None))
    first, second, third, whole = in_turns((*bodies, whole_of(loose)), rounds)
    print(f"\nwithin 1e-4: {loose.name}, {1e3 * first:.2f} ms")
    print(f"within 1e-6: {tight.name}, {1e3 * second:.2f} ms, {second / first:.2f} times as long")
    print(f"estimate of the error within 1e-4: {1e3 * third:.2f} ms, {third / first:.2f} of that,")
    print(f"  {third / whole:.2f} of all that it takes with building, {1e3 * whole:.1f} ms")


def growth() -> None:
    """Time against elements of a mesh that is given, and the exponent from one to the next."""
    print("\nelements of degree 5: ms of the steps; of building, steps and estimate")
    last: tuple[int, list[float]] | None = None
    for n in SIZES:
        mesh = Mesh(1, n, 5)
        times = in_turns((steps_of(mesh), whole_of(mesh)), max(3, min(15, 3000 // n)))
        line = "".join(f"{1e3 * t:12.1f}" for t in times)
        if last:
            ratio = np.log(n / last[0])
            powers = [np.log(a / b) / ratio for a, b in zip(times, last[1], strict=True)]
            line += "   exponents" + "".join(f"{p:7.2f}" for p in powers)
        print(f"{n:8d}{line}")
        last = n, times


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=41)
    rounds = parser.parse_args().rounds
    head, moment = converged()
    print(machine())
    print(f"converged: head {head:.8f} m, largest moment {moment / 1e6:.6f} MN m")
    print(f"ten steps, residual {TOLERANCE:g} of the load, medians of {rounds} runs in turns")
    for components, dimensions, asked in RACES:
        for wanted in asked:
            race(components, dimensions, wanted, rounds)
    shares(rounds)
    growth()


if __name__ == "__main__":
    main()
