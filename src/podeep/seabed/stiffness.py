"""Penetration and stiffness of the soil under one pipe that rests on it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..units import short
from .law import SeabedLaw

_EDGE = 1e-9  # share of a bound that rounding may pass it by


@dataclass(frozen=True, slots=True)
class PipeStiffness:
    """What a model says of a pipe: m, and N/m per metre of pipe (Pa).

    static: the secant K_s = W/z. tangent: dW/dz there. dynamic, lateral: in small quick motions,
    None where the model has none. warnings: why not to trust it, in words.
    """

    penetration: float
    contact_width: float
    static: float
    tangent: float
    dynamic: float | None
    lateral: float | None
    warnings: tuple[str, ...]


def pipe_stiffness(law: SeabedLaw, weight: float) -> PipeStiffness:
    """Stiffness at rest under a submerged weight W, N/m. Raises InvalidData, as `law` does."""
    z = law.penetration(weight)
    dynamic, lateral = (
        None if k is None else float(k)
        for k in (law.dynamic_stiffness(z), law.lateral_dynamic_stiffness(z))
    )
    static = weight / float(z)
    return PipeStiffness(
        float(z),
        float(law.contact_width(z)),
        static,
        float(law.stiffness(z)),
        dynamic,
        lateral,
        tuple(_warnings(law, float(z), static, dynamic)),
    )


def _warnings(law: SeabedLaw, z: float, static: float, dynamic: float | None) -> Iterator[str]:
    measures = law.measures(np.array(z))
    for name, high, why in law.ranges:
        if name in measures and (found := float(measures[name])) > high * (1.0 + _EDGE):
            yield f"{name} = {short(float(f'{found:.3g}'))} is above {high:g}: {why}"
    if dynamic is not None and dynamic < static * (1.0 - _EDGE):
        yield "Kd is below Ks, though soil is stiffer in small quick motions than at rest"
