"""What normal force and shear would add to deflections: left out unless they are asked for.

Measured on the solved shape, to first order, as shares of the work W of all forces on it:

    shear         int V^2 / GAs dx / W
    normal force  int N w'^2 dx / W        N compression; tension takes away

Each is what the load's own displacement grows by, if the rest stays as it is. The normal force adds
more than that as it nears the critical one.

A beam that turns by a slope w' has the curvature w'' / (1 + w'^2)^1.5, of which w'' alone is
taken: at most 1.5 w'^2 of it is missing.
"""

import numpy as np

from ..arrays import Array
from ..errors import Fault, UserError
from ..scene import Numerics
from .assemble import Model, quadrature
from .mesh import Stretch
from .needs import Decision
from .results import Results

_POINTS = 4  # of each element


def check_shear(numerics: Numerics, name: str, pieces: tuple[Stretch, ...]) -> None:
    """Raises UserError where shear is asked for in a section whose stiffness is not known."""
    if numerics.shear and not _known(pieces):
        raise UserError(
            Fault(
                f"{name}: SHEAR=ON, but a section of given EI has no GAS",
                "give its shear stiffness, GAS= at the end of its line, or leave EI= out",
            )
        )


def _known(pieces: tuple[Stretch, ...]) -> bool:
    """Whether the stiffness in shear is known all along."""
    return all(
        section.bending_stiffness_override is None or section.shear_stiffness_override is not None
        for piece in pieces
        for section in piece.sections
        if section is not None
    )


def left_out(results: Results, accuracy: float) -> tuple[Decision, ...]:
    """The effects that are left out and would add more than the accuracy in the last step."""
    model = results.model
    field, system = model.lateral.system.field, model.lateral.system
    work = float(system.internal(results.lateral[-1]) @ results.lateral[-1])
    if not work > 0.0:
        return ()
    found = []
    steepest, pressing, shearing = 0.0, 0.0, 0.0
    for tube, soft in enumerate(_softness(model)):
        there = np.flatnonzero(field.strings.carrier[tube] >= 0)
        x, weight = quadrature(field.edges, there, _POINTS)
        slope = np.linalg.norm(results.deflection(x, 1, tube)[-1], axis=0)
        shear = np.linalg.norm(results.shear_and_moment(x, tube)[0][-1], axis=0)
        steepest = max(steepest, float(slope.max()))
        pressing += float(weight @ (results.compression(x, tube)[-1] * slope**2))
        shearing += float(weight @ (np.repeat(soft[there], _POINTS) * shear**2))
    if 1.5 * steepest**2 > accuracy:
        reason = f"a slope of {steepest:.2g} alters curvatures by up to {1.5 * steepest**2:.1e}"
        found.append(Decision("no large rotations", reason))
    if not model.needs.second_order:
        share = pressing / work
        if abs(share) > accuracy:
            verb = "add" if share > 0.0 else "take away"
            reason = f"the normal force would {verb} some {abs(share):.1e} of the deflection"
            found.append(Decision("no P-delta", reason))
    if not model.needs.shear and _known(model.pieces):
        share = shearing / work
        if share > accuracy:
            found.append(Decision("no shear", f"it would add some {share:.1e} of the deflection"))
    return tuple(found)


def _softness(model: Model) -> Array:
    """1 / GAs of each tube in each interval, (tubes, intervals); 0 where it is not."""
    stiffness = model.parts.shearing.T
    return np.divide(1.0, stiffness, out=np.zeros_like(stiffness), where=stiffness > 0.0)
