"""Whether normal force and shear count: their share in the deflection, estimated beforehand.

The tube stands as a semi-infinite beam on the soil's modulus k near the mudline, of characteristic
length l = (4 EI/k)^(1/4) (Hetenyi 1946), with a free length e above it:

    bending       y = H/EI (l^3/2 + l^2 e + l e^2 + e^3/3)      H on its head
    shear adds    H/GAs (e + 0.23 l)                            0.23: CF15's pile and softer ones
    normal force  adds N/(Ncr - N) of y, Ncr the lesser of 2 EI/l^2 (a free end in soil) and
                  pi^2 EI / (2 (e + 1.3 l))^2 (a column held 1.3 l below the mudline)

An estimate of this kind is right within a factor of two or so: a share of a tenth of the accuracy
counts for the normal force. Shear counts of itself in stocky tubes alone, embedded by less than 10
diameters, where its share exceeds the accuracy: p-y curves were calibrated with, and programs and
their published results have, slender tubes rigid in shear. EI given without GAS is that, too.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from ..scene import Foundation, Scene
from ..soil.profile import Profile
from .mesh import Stretch, bent_lengths
from .needs import Decision, Needs

_SLENDER = 10.0  # embedded length in diameters from which tubes are taken as rigid in shear
_LEAST = 0.1  # of the accuracy: share of the normal force from which it counts


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
        return self.softness * (self.free + 0.23 * self.characteristic) / self.bending

    def second_order_share(self, force: float) -> float:
        """Of a compression N > 0; inf where the tube buckles. Tension takes as much away."""
        length, e = self.characteristic, self.free
        column = (pi / (2.0 * (e + 1.3 * length))) ** 2
        critical = self.stiffness * min(2.0 / length**2, column)
        return abs(force) / (critical - force) if force < critical else inf


def beam(foundation: Foundation, pieces: Sequence[Stretch], profile: Profile) -> Beam:
    """The tube near the mudline, where it bends."""
    top = pieces[0].top
    free = max(-top, 0.0)
    travelled, depth = 0.0, 0.0
    for piece in pieces:
        if not piece.embedded:
            continue
        lengths = bent_lengths(piece, profile)
        step = piece.length / len(lengths)
        for one in lengths.tolist():
            if travelled < 1.0:
                travelled += step / one
                depth += step
    characteristic = depth / max(travelled, 1e-12) if travelled else inf
    near = [p.section for p in pieces if p.top < depth]
    return Beam(
        characteristic,
        free,
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
    """The needs with normal force and shear decided on, each with its reason."""
    one, numerics = beam(foundation, pieces, profile), scene.numerics
    compression, tension = largest_forces(scene, foundation)
    sway = max(one.second_order_share(compression), one.second_order_share(-tension))
    decisions = list(needs.decisions)
    second_order = numerics.second_order
    if second_order is None:
        second_order = sway > _LEAST * numerics.accuracy
        if compression or tension:
            which = "P-delta" if second_order else "small displacements"
            decisions.append(
                Decision(which, f"the normal force adds some {sway:.1e} to deflections")
            )
    else:
        which = "P-delta" if second_order else "small displacements"
        decisions.append(
            Decision(which, f"asked; the normal force adds some {sway:.1e} to deflections")
        )
    shear = numerics.shear
    if shear is None:
        known = all(
            s.section.bending_stiffness_override is None
            or s.section.shear_stiffness_override is not None
            for s in pieces
        )
        shear = known and one.shear_share > numerics.accuracy
        if shear:
            decisions.append(
                Decision("shear", f"it adds some {one.shear_share:.1e} to deflections")
            )
    else:
        which = "shear" if shear else "rigid in shear"
        decisions.append(
            Decision(which, f"asked; shear adds some {one.shear_share:.1e} to deflections")
        )
    return replace(needs, decisions=tuple(decisions), second_order=second_order, shear=shear)
