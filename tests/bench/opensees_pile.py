"""The reference pile in OpenSeesPy: lumped springs of many-point curves on equal elements.

Euler-Bernoulli elements, two springs for each node on a layer boundary, curves of 400 points from
the same laws, the band solver, which is its fastest here.
"""

from pathlib import Path
from sys import path

import numpy as np
import openseespy.opensees as ops

path.insert(0, str(Path(__file__).parent))
path.insert(0, str(Path(__file__).parents[1]))
from our_pile import EMBEDDED, FREE, STEPS, TOLERANCE

from podeep.soil.profile import Profile
from podeep.soil.reaction import Reaction
from scenes import reference_pile

DIAMETER = 2.0
EVERY = 8  # embedded elements from one mesh to the next: a node stands on the layer boundary
_MOST = 1000  # embedded elements


def spring(
    number: int, reaction: Reaction, share: float, reach: float, dense: float = 14.0
) -> None:
    """An OpenSees material through 400 points of a reaction times a share.

    dense: how much closer points lie at rest than at the reach, as a power of e.
    """
    half = reach * np.sinh(np.linspace(0.0, dense, 201)[1:]) / np.sinh(dense)
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


def meshes() -> range:
    """Numbers of embedded elements, from coarse to fine."""
    return range(24, _MOST, EVERY)
