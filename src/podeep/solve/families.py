"""Unknowns whose natural modes do not mix with others, about a static state.

Deflection and stretch are such families, and the two components of a deflection where no term of
stiffness or mass couples them.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_solve_banded

from ..arrays import Array, Index
from ..beam.band import band_times, without
from ..beam.bubbles import Bubbles, enriched
from ..model.assemble import Model
from ..model.coupling import pressed, rubbed, rubs
from ..model.inertia import mass_band, turning_inside
from ..model.system import System
from ..scene import Scene
from .eigen import lowest, shifted
from .statics import State

_SWEEPS = 2  # of inverse iteration, by which rounding of short elements' stiffness is taken out
_RIGID = 1e-7  # of the shift: a lesser eigenvalue is that of a motion that nothing resists


@dataclass(frozen=True, eq=False)
class Family:
    """Modes that do not mix with others: unknowns `part` of a system, and the mass of all.

    lengthwise: of the stretch. inside: rotations that inertia makes inside elements.
    """

    system: System
    mass: Array
    part: slice
    lengthwise: bool = False
    inside: Bubbles | None = None

    def solved(self, count: int) -> tuple[Array, Array, Array]:
        """Squares of circular frequencies, rising, (n,), unknowns, (n, size), and modal masses,
        (n,), kg."""
        size, step = self.system.size, self.part.step or 1
        stiffness = self.system.tangent()[::step, self.part]
        mass = without(self.mass, self.system.held)[::step, self.part]
        place = np.arange(mass.shape[1])
        if self.inside is not None:
            components = self.system.components // step
            stiffness, mass, place = enriched(self.inside, stiffness, mass, components)
        _, vectors = lowest(stiffness, mass, count, self.shift)
        factor = shifted(stiffness, mass, self.shift)[1]
        states = np.zeros((len(vectors), size))
        weight, energy = np.ones((2, len(vectors)))
        heavy = np.zeros_like(vectors)  # the mass times each vector
        for i, v in enumerate(vectors):
            for sweep in range(_SWEEPS + 1):
                v -= (heavy[:i] @ v / weight[:i]) @ vectors[:i]
                states[i, self.part] = v[place]
                resisting = self.forces(stiffness, v, states[i], place)
                heavy[i] = band_times(mass, v)
                weight[i], energy[i] = v @ heavy[i], v @ resisting
                if sweep < _SWEEPS:
                    missing = resisting - energy[i] / weight[i] * heavy[i]
                    v -= cho_solve_banded((factor, True), missing)
        squares = energy / weight
        squares[np.abs(squares) < _RIGID * self.shift] = 0.0
        return squares, states, weight

    def forces(self, stiffness: Array, v: Array, q: Array, place: Index) -> Array:
        """What resists a motion, without the rounding of the matrix; 0 at held unknowns.

        v, q: the motion in the unknowns of the matrices and of the system, of which each stands at
        its place among the former.
        """
        own = self.system.tangent_times(q)
        own[self.system.held] = 0.0
        inside = v.copy()
        inside[place] = 0.0
        total = band_times(stiffness, inside) if self.inside is not None else inside
        total[place] = own[self.part]
        return total

    @property
    def shift(self) -> float:
        """A square of a circular frequency of the tubes without soil, in its order, 1/s2."""
        field, length = self.system.field, self.system.length
        power = 1 if self.lengthwise else 3
        return float(np.mean(field.stiffness) / length**power / self.total)

    def translation(self, direction: Array) -> Array:
        """Unknowns of a motion of 1 m of all tubes along a direction, (components,)."""
        field = self.system.field
        shift = np.zeros((field.size, self.system.components))
        shift[field.dofs[:, [0, -field.nodal]]] = direction
        return shift.ravel()

    @property
    def total(self) -> float:
        """All mass that moves this way, kg."""
        first = np.eye(self.system.components)[0]
        rigid = self.translation(first)
        return float(rigid @ band_times(self.mass, rigid))


def families(scene: Scene, model: Model, state: State, secant: float) -> tuple[list[Family], bool]:
    """What does not mix, with tangents at a state, and whether secants had to be taken."""
    lateral = model.lateral.system.softened(state.softening)
    if model.needs.second_order:
        lateral = pressed(model, state.axial, state.lateral, lateral)
    axial = model.axial.system
    if rubs(axial):
        axial = rubbed(model, state.lateral, axial)
    lateral.internal(state.lateral)
    axial.internal(state.axial)
    steep = [system.blunted(secant) for system in (lateral, axial)]
    mass = mass_band(scene, model, "lateral")
    stretch = Family(axial, mass_band(scene, model, "axial"), slice(None), lengthwise=True)
    parts = [slice(None)]
    if lateral.components == 2:
        across = slice(1, None, 2)  # diagonals between components
        if not (lateral.tangent()[across].any() or mass[across].any()):
            parts = [slice(0, None, 2), slice(1, None, 2)]
    inside = turning_inside(scene, model)
    bent = (Family(lateral, mass, part, inside=inside) for part in parts)
    return [*bent, stretch], any(steep)
