"""Normal force and shear: what they add to deflections, estimated before anything is solved.

The tube stands as a semi-infinite beam on the soil's modulus k near the mudline, of characteristic
length l = (4 EI/k)^(1/4) (Hetenyi 1946), with a free length e above it:

    bending       y = H/EI (l^3/2 + l^2 e + l e^2 + e^3/3)      H on its head
    shear adds    H/GAs (e + 0.23 l)                            0.23: CF15's pile and softer ones
    normal force  adds N/(Ncr - N) of y, Ncr the lesser of 2 EI/l^2 (a free end in soil) and
                  pi^2 EI / (2 (e + 1.3 l))^2 (a column held 1.3 l below the mudline)

An estimate of this kind is right within a factor of two or so. Both effects are in the model where
they are asked for (*MODEL, PDELTA, SHEAR=ON); what is missed without them is reported where it
exceeds the accuracy. A tube of given EI without GAS has no known stiffness in shear.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from ..errors import Fault, UserError
from ..scene import Foundation, Scene
from ..soil.profile import Profile
from .mesh import Stretch, bent_lengths
from .needs import Decision, Needs, lateral_vectors


@dataclass(frozen=True, slots=True)
class Beam:
    """What the estimate needs of a tube: characteristic and free length (m), EI, EI/GAs (m2)."""

    characteristic: float
    free: float
    stiffness: float
    softness: float

    @property
    def bending(self) -> float:
        """Deflection of the head times EI / H, m3."""
        length, e = self.characteristic, self.free
        return length**3 / 2.0 + length**2 * e + length * e**2 + e**3 / 3.0

    @property
    def shear_share(self) -> float:
        """Of the deflection of the head."""
        return self.softness * (self.free + 0.23 * self.characteristic) / self.bending

    def second_order_share(self, force: float) -> float:
        """Of a compression N > 0; inf where the tube buckles. Tension takes as much away."""
        length, e = self.characteristic, self.free
        column = (pi / (2.0 * (e + 1.3 * length))) ** 2
        critical = self.stiffness * min(2.0 / length**2 if length else inf, column)
        return abs(force) / (critical - force) if force < critical else inf


def beam(pieces: Sequence[Stretch], profile: Profile) -> Beam:
    """The tube near the mudline, where it bends; without soil it is free down to its tip."""
    travelled = depth = 0.0
    for piece in pieces:
        if travelled >= 1.0 or not piece.embedded:
            continue
        rates = 1.0 / bent_lengths(piece, profile)
        step = piece.length / len(rates)
        gone = travelled + step * np.concatenate(([0.0], np.cumsum(rates)))
        depth = piece.top + float(np.interp(1.0, gone, step * np.arange(len(gone))))
        travelled = float(gone[-1])
    near = [p.section for p in pieces if p.top < depth or travelled == 0.0]
    characteristic = depth / min(travelled, 1.0) if travelled else 0.0
    free = -pieces[0].top if travelled else pieces[-1].bottom - pieces[0].top
    return Beam(
        characteristic,
        max(free, 0.0),
        min(s.bending_stiffness for s in near),
        max(s.bending_stiffness / s.shear_stiffness for s in near),
    )


def largest_forces(scene: Scene, foundation: Foundation) -> tuple[float, float]:
    """Largest compression and largest tension of any step on the tube's head, N, both >= 0."""
    down = np.zeros(len(scene.steps.names))
    for load in scene.loads:
        if load.tube in foundation.tubes:
            down[scene.steps.names.index(load.name)] -= load.force[2]
    steps = np.array(scene.steps.factors).reshape(len(scene.steps.factors), -1) @ down
    return float(max(steps.max(initial=0.0), 0.0)), float(max(-steps.min(initial=0.0), 0.0))


def with_effects(
    needs: Needs,
    scene: Scene,
    foundation: Foundation,
    pieces: Sequence[Stretch],
    profile: Profile,
) -> Needs:
    """The needs with what is asked of normal force and shear, and what is missed without it."""
    one, numerics = beam(pieces, profile), scene.numerics
    driven = bool(lateral_vectors(scene, foundation))
    compression, tension = largest_forces(scene, foundation)
    sway = max(one.second_order_share(compression), one.second_order_share(-tension))
    force = f"the normal force {{}} some {sway:.1e} to deflections"
    if compression and sway == inf:
        force = "the normal force may buckle the tube"
    known = all(
        s.section.bending_stiffness_override is None
        or s.section.shear_stiffness_override is not None
        for s in pieces
    )
    if numerics.shear and not known:
        raise UserError(
            Fault(
                f"{foundation.name}: SHEAR=ON, but a section of given EI has no GAS",
                "give its shear stiffness, GAS= at the end of its line, or leave EI= out",
            )
        )
    found = [
        _effect("P-delta", numerics.second_order, force, sway > numerics.accuracy and driven),
        _effect(
            "shear",
            numerics.shear,
            f"it {{}} some {one.shear_share:.1e} to deflections",
            known and driven and one.shear_share > numerics.accuracy,
        ),
    ]
    return replace(
        needs,
        decisions=(*needs.decisions, *(d for d in found if d is not None)),
        second_order=numerics.second_order,
        shear=numerics.shear,
    )


def _effect(name: str, asked: bool, reason: str, counts: bool) -> Decision | None:
    """What the report says of an effect: that it is in, or what is missed without it."""
    if asked:
        return Decision(name, f"asked; {reason.format('adds')}")
    if counts:
        return Decision(f"no {name}", reason.format("would add"))
    return None
