"""Point data of a scene, what holds and drives the tubes, as unknowns of one field."""

from collections.abc import Iterator, Mapping

import numpy as np

from ..arrays import Array, Index
from ..beam.field import Field
from ..scene import Dof, Foundation, Scene
from .footing import Footing
from .needs import Needs
from .springs import Spring

# Component of the deflection that a degree of freedom moves, its derivative, and its sign there.
_LATERAL: Mapping[Dof, tuple[int, int, float]] = {
    "X": (0, 0, 1.0),
    "Y": (1, 0, 1.0),
    "RX": (1, 1, 1.0),
    "RY": (0, 1, -1.0),
}


class Collector:
    """Translates the scene's point data to unknowns of one field (axial where needs is None)."""

    def __init__(
        self,
        scene: Scene,
        foundation: Foundation,
        under: Footing | None,
        needs: Needs | None,
        field: Field,
    ) -> None:
        self.scene, self.field, self.under = scene, field, under
        self.mudline, self.tubes = foundation.mudline, foundation.tubes
        self.axes = needs.direction if needs else ()
        self.leaning = needs is not None and needs.second_order and scene.numerics.weight
        self.size = field.size * max(len(self.axes), 1)

    def unknowns(self, tube: int, elevation: float, dof: Dof) -> list[tuple[int, float, float]]:
        """Unknowns that share in a degree of freedom of a tube.

        Each comes with the cosine between the two and with the length by which the unknown is
        scaled: the unknown is cosine * length * value, its force cosine / length * force.
        """
        node = self.field.node(self.mudline - elevation, self.tubes.index(tube))
        if not self.axes:
            return [(node, -1.0, 1.0)] if dof == "Z" else []
        if dof not in _LATERAL:
            return []
        component, derivative, sign = _LATERAL[dof]
        length = self.field.slope_length if derivative else 1.0
        return [
            ((node + derivative) * len(self.axes) + c, sign * axis[component], length)
            for c, axis in enumerate(self.axes)
            if axis[component] != 0.0
        ]

    def holds(self) -> tuple[list[Spring], Index]:
        """Springs to ground and the held unknowns."""
        springs: list[Spring] = []
        held: set[int] = set()
        for spring in self.scene.springs:
            if spring.tube in self.tubes:
                for unknown, cosine, length in self.unknowns(
                    spring.tube, spring.elevation, spring.dof
                ):
                    springs.append(Spring(unknown, spring.stiffness * (cosine / length) ** 2))
        springs += self._coupled()
        springs += self._toppling() if self.leaning else ()
        if self.under is not None:
            tip = self.mudline - float(self.field.edges[-1])
            carried = self.tubes[self.under.tube]
            k1, k2, k3, _ = (float(k) for k in self.under.stiffness)
            sides: tuple[tuple[Dof, float], ...] = (
                *(("Z", k1), ("X", k2), ("Y", k2)),
                *(("RX", k3), ("RY", k3)),
            )
            for side, stiffness in sides:
                for unknown, cosine, length in self.unknowns(carried, tip, side):
                    softens = side.startswith("R")
                    amount = stiffness * (cosine / length) ** 2
                    springs.append(Spring(unknown, amount, softens))
        for support in self.scene.supports:
            if support.tube in self.tubes:
                for dof in support.dofs:
                    held.update(u for u, *_ in self.unknowns(support.tube, support.elevation, dof))
        for d in self.scene.displacements:
            if d.tube in self.tubes:
                held.update(u for u, *_ in self.unknowns(d.tube, d.elevation, d.dof))
        return springs, np.array(sorted(held), dtype=np.intp)

    def _coupled(self) -> Iterator[Spring]:
        """Springs of deflection and slope together, alike in every component."""
        field, components = self.field, len(self.axes)
        length = field.slope_length
        for spring in self.scene.coupled_springs:
            if spring.tube in self.tubes and components:
                node = field.node(self.mudline - spring.elevation, self.tubes.index(spring.tube))
                for c in range(components):
                    value, slope = node * components + c, (node + 1) * components + c
                    yield Spring(value, spring.lateral)
                    yield Spring(slope, spring.rotational / length**2)
                    yield Spring(slope, spring.coupling / length, other=value)

    def _toppling(self) -> Iterator[Spring]:
        """What the weight of masses on rigid arms does to the slope at the foot of each arm.

        A weight W at a height c above it, on a slope s, has a moment W c s about it: a spring of
        -W c. The normal force in the tube below is with the others.
        """
        field, components = self.field, len(self.axes)
        for mass in self.scene.masses:
            if mass.tube in self.tubes:
                top = self.scene.tubes[mass.tube].top
                above = max(mass.elevation - top, 0.0)
                node = field.node(self.mudline - top, self.tubes.index(mass.tube))
                moment = mass.mass * self.scene.sea.gravity * above
                for c in range(components):
                    slope = (node + 1) * components + c
                    yield Spring(slope, -moment / field.slope_length**2)

    def loads(self) -> tuple[Array, Array]:
        """Forces and imposed values of each named load, shape (names, unknowns)."""
        names = self.scene.steps.names
        forces = np.zeros((len(names), self.size))
        imposed = np.zeros((len(names), self.size))
        moved: tuple[Dof, ...] = ("X", "Y", "Z", "RX", "RY")
        for load in self.scene.loads:
            if load.tube in self.tubes:
                amounts = (*load.force, *load.moment[:2])
                acting = [(d, a) for d, a in zip(moved, amounts, strict=True) if a]
                for dof, amount in acting:
                    for unknown, cosine, length in self.unknowns(load.tube, load.elevation, dof):
                        forces[names.index(load.name), unknown] += amount * cosine / length
        for d in self.scene.displacements:
            if d.tube in self.tubes:
                for unknown, cosine, length in self.unknowns(d.tube, d.elevation, d.dof):
                    imposed[names.index(d.name), unknown] += d.value * cosine * length
        return forces, imposed
