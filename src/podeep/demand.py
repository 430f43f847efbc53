"""What the steps of a scene ask of a foundation."""

from dataclasses import dataclass

import numpy as np

from .scene import Foundation, Scene


@dataclass(frozen=True, slots=True)
class Demand:
    """The largest loads of any step about the mudline, N and N m, and the steps, from 1.

    compression, tension: magnitudes. lateral: the largest horizontal resultant; moment: of the
    same step, in its plane, positive where it acts as `lateral` above the mudline would; across:
    the moment out of that plane. A step of 0: there is no such load in any.
    """

    compression: float
    tension: float
    lateral: float
    moment: float
    across: float
    compression_step: int
    tension_step: int
    lateral_step: int


def demand(scene: Scene, foundation: Foundation) -> Demand:
    """What the steps of a scene ask of a foundation: its point loads, summed about the mudline."""
    names = scene.steps.names
    factors = np.array(scene.steps.factors).reshape(len(scene.steps.factors), len(names))
    force = np.zeros((1 + len(factors), 3))  # step 0 is no load
    turning = np.zeros((1 + len(factors), 2))  # in x and y, as a lateral load above the mudline
    for load in scene.loads:
        if load.tube in foundation.tubes:
            factor = factors[:, names.index(load.name)]
            height = load.elevation - foundation.mudline
            x, y = load.moment[1] + height * load.force[0], height * load.force[1] - load.moment[0]
            force[1:] += np.multiply.outer(factor, load.force)
            turning[1:] += np.multiply.outer(factor, (x, y))
    down, up = int(np.argmin(force[:, 2])), int(np.argmax(force[:, 2]))
    sideways, moments = (np.hypot(*v.T) for v in (force[:, :2], turning))
    step = int(np.argmax(sideways if sideways.any() else moments))
    lateral, moment, across = float(sideways[step]), float(moments[step]), 0.0
    if lateral:
        x, y = (force[step, :2] / lateral).tolist()
        moment, across = (float(turning[step] @ axis) for axis in ((x, y), (-y, x)))
    return Demand(
        compression=0.0 - float(force[down, 2]),
        tension=float(force[up, 2]),
        lateral=lateral,
        moment=moment,
        across=abs(across),
        compression_step=down,
        tension_step=up,
        lateral_step=step,
    )
