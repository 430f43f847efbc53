"""What normal force and shear add to deflections.

Measured on the solved shape, to first order, as shares of the work W of all forces on it:

    shear         int V^2 / GAs dx / W
    normal force  int N w'^2 dx / W        N compression; tension takes away

Each is what the load's own displacement grows by, if the rest stays as it is. The normal force adds
more than that as it nears the critical one.

A beam that turns by a slope w' has the curvature w'' / (1 + w'^2)^1.5, of which w'' alone is
taken: at most 1.5 w'^2 of it is missing.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..errors import Fault, UserError
from ..scene import Numerics
from .around import quadrature
from .assemble import Model
from .mesh import Stretch
from .needs import Decision
from .results import Results

PDELTA = "P-delta"
_POINTS = 4  # of each element
_SHARE = 0.25  # of the accuracy: an effect that is smaller may be left out


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


@dataclass(frozen=True, slots=True)
class Effects:
    """Effects on the deflection in each step, shape (steps,), measured on its solved shape.

    slope: the steepest. normal_force, shear: share of the deflection that they add, to first
    order; the normal force's is negative where tension takes away.
    """

    slope: Array
    normal_force: Array
    shear: Array


def effects(results: Results) -> Effects:
    """What normal force and shear do to the deflection of each step, or would do."""
    model, steps = results.model, len(results.lateral)
    field, system = model.lateral.system.field, model.lateral.system
    work = np.array([float(system.internal(q) @ q) for q in results.lateral])
    steepest, pressing, shearing = np.zeros((3, steps))
    for tube, soft in enumerate(_softness(model)):
        there = np.flatnonzero(field.strings.carrier[tube] >= 0)
        x, weight = quadrature(field.edges, there, _POINTS)
        slope = np.linalg.norm(results.deflection(x, 1, tube), axis=1)
        shear = np.linalg.norm(results.shear_and_moment(x, tube)[0], axis=1)
        steepest = np.maximum(steepest, slope.max(axis=1))
        pressing = pressing + (results.compression(x, tube) * slope**2) @ weight
        shearing = shearing + shear**2 @ (weight * np.repeat(soft[there], _POINTS))
    work = np.where(work > 0.0, work, np.inf)  # a step at rest
    return Effects(steepest, pressing / work, shearing / work)


def on_normal_force(results: Results, accuracy: float, *, complete: bool) -> Decision | None:
    """Whether the normal force has to bend the tubes further; None: it need not be thought of.

    results: without it. complete: every step has an equilibrium without it.
    """
    share = effects(results).normal_force
    worst = float(share[np.abs(share).argmax()])
    if worst == 0.0:
        return None
    verb = "adds" if worst > 0.0 else "takes away"
    needed = abs(worst) > _SHARE * accuracy or not complete
    reason = f"the normal force {verb} some {abs(worst):.1e} of the deflection"
    return Decision(PDELTA if needed else "small displacements", reason)


def left_out(results: Results, accuracy: float) -> tuple[Decision, ...]:
    """The effects that are left out and would add more than the accuracy in the last step."""
    model, found = results.model, []
    last = effects(results)
    steepest, pressing, shearing = (
        float(values[-1]) for values in (last.slope, last.normal_force, last.shear)
    )
    if 1.5 * steepest**2 > accuracy:
        reason = f"a slope of {steepest:.2g} alters curvatures by up to {1.5 * steepest**2:.1e}"
        found.append(Decision("no large rotations", reason))
    if not model.needs.second_order and abs(pressing) > accuracy:
        verb = "add" if pressing > 0.0 else "take away"
        reason = f"the normal force would {verb} some {abs(pressing):.1e} of the deflection"
        found.append(Decision("no P-delta", reason))
    if not model.needs.shear and _known(model.pieces) and shearing > accuracy:
        reason = f"it would add some {shearing:.1e} of the deflection (SHEAR=ON)"
        found.append(Decision("no shear", reason))
    return tuple(found)


def _softness(model: Model) -> Array:
    """1 / GAs of each tube in each interval, (tubes, intervals); 0 where it is not."""
    stiffness = model.parts.shearing.T
    return np.divide(1.0, stiffness, out=np.zeros_like(stiffness), where=stiffness > 0.0)
