"""Speed at equal error on the reference pile: this solver against OpenSeesPy.

    pip install "podeep[bench]" && python tests/bench/race_static.py

The scene is a steel tube of 2 m by 50 mm, 10 m free and 40 m embedded, in cube-root clay over API
sand with t-z and Q-z of API RP 2GEO, loaded by 2 MN across and 5 MN down in ten steps. OpenSees
has Euler-Bernoulli elements of equal length, two springs for each node on a layer boundary, curves
of 400 points from the same laws, and its band solver; its number of elements is the first of a
series whose head displacement and largest moment are both within the error asked. Its building is
not counted. Times are CPU times of the ten steps in one process, the programs taking turns; the
figures are medians, and the ratio is that of the medians.
"""

import argparse
import platform
import statistics
import time
from collections.abc import Callable
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from sys import path

import numpy as np
import openseespy.opensees as ops

path.insert(0, str(Path(__file__).parents[1]))
from podeep.model.results import Results
from podeep.scene import Numerics
from podeep.soil.profile import Profile
from podeep.soil.reaction import Reaction
from podeep.solve.analysis import limits, run, solve
from scenes import reference_pile

STEPS, FREE, EMBEDDED, DIAMETER = 10, 10.0, 40.0, 2.0
TOLERANCE = 1e-7  # of OpenSees' residual over the load; less stalls on rounding


def largest_values(elements: int, degree: int) -> tuple[float, float, Callable[[], object], int]:
    """Head displacement, largest moment, the timed solve and the number of elements of ours."""
    scene = reference_pile(steps=STEPS, numerics=Numerics(elements=elements, degree=degree))
    solved = solve(scene, scene.foundations[0])
    results: Results = solved.results
    x = np.linspace(0.0, EMBEDDED, 20001)
    moment = np.abs(results.shear_and_moment(x)[1][-1]).max()
    head = float(results.deflection(np.array([-FREE]))[-1, 0, 0])
    factors = np.array(scene.steps.factors)
    limit = replace(limits(scene), residual=TOLERANCE)
    return head, float(moment), lambda: run(solved.model, factors, limit), solved.model.elements


def spring(number: int, reaction: Reaction, share: float, reach: float) -> None:
    """An OpenSees material through 400 points of a reaction times a share."""
    half = reach * np.sinh(np.linspace(0.0, 14.0, 201)[1:]) / np.sinh(14.0)
    u = np.concatenate([-half[::-1], [0.0], half])
    force = share * reaction.evaluate(u[:, None])[0][:, 0]
    ops.uniaxialMaterial("ElasticMultiLinear", number, "-strain", *u, "-stress", *force)


def build_opensees(elements: int, dimensions: int) -> None:
    """The same pile on lumped springs; `elements` is the number below the mudline."""
    scene = reference_pile()
    section, profile = scene.tubes[1].sections[0], Profile(scene.ground)
    h = EMBEDDED / elements
    nodes = elements + round(FREE / h)
    ops.wipe()
    ops.model("basic", "-ndm", dimensions, "-ndf", 3 if dimensions == 2 else 6)
    up = 1 if dimensions == 2 else 2  # index of the vertical axis
    for i in range(nodes + 1):
        ops.node(i, *[0.0] * up, h * i - EMBEDDED)
    ea, ei = section.axial_stiffness, section.bending_stiffness
    modulus = section.youngs_modulus
    area, inertia = ea / modulus, ei / modulus
    if dimensions == 2:
        ops.geomTransf("Linear", 1)
        for i in range(nodes):
            ops.element("elasticBeamColumn", i, i, i + 1, area, modulus, inertia, 1)
    else:
        ops.geomTransf("Linear", 1, 0.0, 1.0, 0.0)
        gj = modulus / 2.6
        for i in range(nodes):
            ops.element(
                *("elasticBeamColumn", i, i, i + 1, area, modulus, gj, 2 * inertia),
                *(inertia, inertia, 1),
            )
    material = 0
    for i in range(elements + 1):
        depth = EMBEDDED - h * i
        sides = [(depth - 1e-9, depth > 0.0), (depth + 1e-9, depth < EMBEDDED)]
        ground = 100_000 + i
        ops.node(ground, *ops.nodeCoord(i))
        ops.fix(ground, *[1] * (3 if dimensions == 2 else 6))
        for k, (z, present) in enumerate(sides):
            if not present:
                continue
            at, width = np.array([abs(z)]), np.array([DIAMETER])
            materials, directions = [], []
            lateral = range(1, dimensions)
            spring(material := material + 1, profile.lateral(at, width), 0.5 * h, 5.0)
            for direction in lateral:
                materials.append(material)
                directions.append(direction)
            spring(material := material + 1, profile.shaft(at, width), 0.5 * h, 1.0)
            materials.append(material)
            directions.append(dimensions)
            ops.element(
                *("zeroLength", 200_000 + 2 * i + k, ground, i, "-mat", *materials),
                *("-dir", *directions),
            )
    # -z is down: the tip's curve is mirrored
    half = np.sinh(np.linspace(0.0, 14.0, 401)) / np.sinh(14.0)
    tip = profile.tip(EMBEDDED, DIAMETER).evaluate(half[:, None])[0][:, 0]
    material += 1
    ops.uniaxialMaterial(
        *("ElasticMultiLinear", material, "-strain", *(-half[::-1]), 1.0),
        *("-stress", *(-tip[::-1]), 1e-6),
    )
    ops.element("zeroLength", 300_000, 100_000, 0, "-mat", material, "-dir", dimensions)
    if dimensions == 3:
        ops.fix(0, 0, 0, 0, 0, 0, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    down = [2e6, -5e6, 0.0] if dimensions == 2 else [2e6, 0.0, -5e6, 0.0, 0.0, 0.0]
    ops.load(nodes, *down)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandSPD")
    ops.test("NormUnbalance", TOLERANCE * 5.4e6, 50)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0 / STEPS)
    ops.analysis("Static")


def opensees_values(elements: int, dimensions: int) -> tuple[float, float]:
    """Head displacement and largest moment; infinite where no equilibrium is found."""
    build_opensees(elements, dimensions)
    if ops.analyze(STEPS) != 0:
        return np.inf, np.inf
    nodes = elements + round(FREE * elements / EMBEDDED)
    which = 2 if dimensions == 2 else 4
    moments = [abs(ops.eleForce(i)[which]) for i in range(nodes)]
    return ops.nodeDisp(nodes, 1), max(moments)


def cpu(body: Callable[[], object]) -> float:
    start = time.process_time()
    body()
    return time.process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--error", type=float, default=1e-4)
    options = parser.parse_args()
    head, moment, _, _ = largest_values(60, 7)

    def error(values: tuple[float, float]) -> float:
        return max(abs(values[0] / head - 1.0), abs(values[1] / moment - 1.0))

    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}")
    print(", ".join(f"{p} {version(p)}" for p in ("podeep", "numpy", "scipy", "openseespy")))
    print(f"converged: head {head:.8f} m, largest moment {moment / 1e6:.6f} MN m")
    ours = []
    for elements, degree in ((13, 3), (8, 5), (13, 5)):
        y, m, body, count = largest_values(elements, degree)
        ours.append(
            (f"podeep, {count - 1} embedded elements of degree {degree}", error((y, m)), body)
        )
    series = range(40, 400, 8)  # a node stands on the layer boundary
    for dimensions in (2, 3):
        found = next(n for n in series if error(opensees_values(n, dimensions)) <= options.error)
        name = f"OpenSees {dimensions}-D, {found} embedded elements"
        rival = error(opensees_values(found, dimensions))
        times: list[list[float]] = [[] for _ in range(len(ours) + 1)]
        for _ in range(options.rounds):
            build_opensees(found, dimensions)
            times[0].append(cpu(lambda: ops.analyze(STEPS)))
            for spent, (_, _, body) in zip(times[1:], ours, strict=True):
                spent.append(cpu(body))
        base = statistics.median(times[0])
        print(f"\n{name}: error {rival:.1e}, {1e3 * base:.2f} ms")
        for spent, (label, miss, _) in zip(times[1:], ours, strict=True):
            median = statistics.median(spent)
            ratio = f"{base / median:.1f} times faster"
            print(f"{label}: error {miss:.1e}, {1e3 * median:.2f} ms, {ratio}")


if __name__ == "__main__":
    main()
