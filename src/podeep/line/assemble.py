"""From a line of the scene to its equations: mesh, contact with the seabed, ends, first shape.

A line is solved in the vertical plane through both ends unless something moves it out of that
plane. Along x of that plane counts from end 1 towards end 2, z is the elevation. The seabed touches
the line's axis, as in DeepLines: its radius is no part of where it lies.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import hypot, sqrt

import numpy as np

from ..arrays import Array
from ..beam.field import Field
from ..errors import Fault, UserError
from ..scene import Line, LineMotion, LineSection, Scene, SeabedContact
from ..seabed.friction import Friction
from ..seabed.law import SeabedLaw
from ..seabed.models import MODELS
from ..seabed.normal import OneSided, Winkler
from ..seabed.pull_out import Wear, pull_out_of
from ..seabed.suction import Suction
from .bed import Bed, contact_points
from .catenary import shape
from .equations import Clamp, LineSystem, Sections

DEGREE = 7
_FINE = 0.5  # elements at a touchdown or an end, over the length in which bending fades there
_GROWTH = 0.15  # of elements, over the distance from there
_COARSE, _FINEST = 1.0 / 30.0, 1.0 / 4000.0  # elements over the line, most and least
_SLOPES, _STEEPER = 200, 1.05  # places where the slope of a soil is looked for; margin on it
_CLAMP = 1e6  # stiffness of a held direction, over that of a cantilever of an element


@dataclass(frozen=True, eq=False)
class Plane:
    """Where a line's components are: the origin and horizontal axes, rows of (m - 1, 2)."""

    origin: Array
    axes: Array

    @property
    def components(self) -> int:
        return len(self.axes) + 1

    def inside(self, point: Array) -> Array:
        """Components of a place in space, (3,)."""
        return np.append(self.axes @ (point[:2] - self.origin), point[2])

    def turned(self, vector: Array) -> Array:
        """Components of a direction or a move in space, (3,)."""
        return np.append(self.axes @ vector[:2], vector[2])

    def outside(self, places: Array) -> Array:
        """Places in space, (..., 3), of components (..., m)."""
        flat = places[..., :-1] @ self.axes + self.origin
        return np.concatenate([flat, places[..., -1:]], axis=-1)


@dataclass(frozen=True, eq=False)
class LineModel:
    """The discrete model of a line and what it was made of. start: unknowns of its first shape."""

    line: Line
    plane: Plane
    system: LineSystem
    start: Array

    @property
    def elements(self) -> int:
        return len(self.system.field.lengths)


def plane_of(line: Line, motions: tuple[LineMotion, ...]) -> Plane:
    """The vertical plane of both ends, or space where a motion leaves it."""
    one, other = (np.array(end.position) for end in line.ends)
    way = (other - one)[:2]
    along = way / np.hypot(*way) if np.hypot(*way) > 0.0 else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])
    moved = {"X": np.array([1.0, 0.0]), "Y": np.array([0.0, 1.0])}
    leaves = any(abs(moved[m.dof] @ across) > 1e-12 for m in motions if m.dof in moved)
    leaves = leaves or any(
        end.tangent is not None and abs(np.array(end.tangent)[:2] @ across) > 1e-12
        for end in line.ends
    )
    return Plane(one[:2], np.stack([along, across]) if leaves else along[None])


def section_at(line: Line, s: Array) -> list[LineSection]:
    """The section at each distance from end 1."""
    ends = np.cumsum([section.length for section in line.sections])
    return [line.sections[i] for i in np.minimum(ends.searchsorted(s), len(ends) - 1)]


def mesh(scene: Scene, line: Line, contact: SeabedContact | None, refined: int) -> Array:
    """Element boundaries, m: as given by NEL, or graded from touchdown and ends.

    refined: how often all elements are halved.
    """
    ends = np.cumsum([0.0, *(section.length for section in line.sections)])
    one, other = (np.array(end.position) for end in line.ends)
    middle = line.sections[0]
    weight = max(abs(_weight(scene, middle)), 1e-9)
    span = hypot(*(other - one)[:2])
    _, heights = over(line, contact)
    h = _shape_height(span, heights, line.length)
    tension = max(weight * h, 1e-6 * middle.axial_stiffness)
    fine = sqrt(middle.bending_stiffness / tension) if middle.bending_stiffness else 0.0
    marks = [0.0, line.length]
    if contact is not None:
        fine = max(fine, sqrt(tension / _stiffness(scene, contact, middle)))
        marks += [
            s
            for end, height in enumerate(heights)
            for hangs in [sqrt(height**2 + 2.0 * height * h)]
            if 0.0 < hangs < line.length
            for s in [hangs if end == 0 else line.length - hangs]
        ]
    least = min(max(_FINE * fine, _FINEST * line.length), _COARSE * line.length)
    found = [0.0]
    for section, (begin, end) in zip(line.sections, pairwise(ends), strict=True):
        if section.elements is not None:
            found += np.linspace(begin, end, section.elements + 1)[1:].tolist()
            continue
        inner = sorted({begin, *(m for m in marks if begin < m < end), end})
        for left, right in pairwise(inner):
            found += _graded(left, right, marks, least, _COARSE * line.length)
    edges = np.array(found)
    for _ in range(refined):
        edges = np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))
    return edges


def over(line: Line, contact: SeabedContact | None) -> tuple[float, tuple[float, float]]:
    """Elevation of the ground of a line's first shape, and heights of both ends above it, m.

    Without a seabed it lies deeper than the line can hang.
    """
    one, other = (end.position[2] for end in line.ends)
    low = min(one, other) - line.length
    base = low if contact is None else max(low, contact.mudline)
    return base, (max(one - base, 0.0), max(other - base, 0.0))


def _shape_height(span: float, heights: tuple[float, float], length: float) -> float:
    """H/W of the line's first shape, or its length where it is straight, m."""
    h = shape(np.zeros(1), span, heights, length)[2]
    return h if np.isfinite(h) else length


def _graded(
    left: float, right: float, marks: list[float], least: float, most: float
) -> list[float]:
    """Ends of elements between two places, as long as their distance from marks lets them be."""
    sample = np.linspace(left, right, 2001)
    away = np.abs(sample[:, None] - np.array(marks)).min(axis=1)
    density = 1.0 / np.minimum(least + _GROWTH * away, most)
    count = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(sample))])
    number = max(int(np.ceil(count[-1])), 1)
    ends = np.interp(np.arange(1, number + 1) / number * count[-1], count, sample)
    return [*ends[:-1].tolist(), right]


def _weight(scene: Scene, section: LineSection) -> float:
    return section.submerged_weight(scene.sea.density, scene.sea.gravity)


def _stiffness(scene: Scene, contact: SeabedContact, section: LineSection) -> float:
    """Of the seabed under a section at rest, N/m2."""
    if contact.stiffness is not None:
        return contact.stiffness
    law = _law(scene, contact, section.outer_diameter)
    weight = max(_weight(scene, section), 1e-6)
    return weight / float(law.penetration(weight))


def _law(scene: Scene, contact: SeabedContact, diameter: float | Array) -> SeabedLaw:
    assert contact.soil_stiffness is not None
    soil = scene.soil_stiffnesses[contact.soil_stiffness]
    return MODELS[soil.model].at(diameter, soil.parameters)


def assemble(scene: Scene, line: Line, edges: Array) -> LineModel:
    """The model of a line on given element boundaries.

    Raises UserError for a shape that cannot be laid.
    """
    motions = tuple(m for m in scene.line_motions if m.line == line.id)
    plane, n = plane_of(line, motions), len(edges) - 1
    m = plane.components
    every = section_at(line, 0.5 * (edges[1:] + edges[:-1]))
    axial = np.array([section.axial_stiffness for section in every])
    bending = np.array([section.bending_stiffness for section in every])
    weight = np.array([_weight(scene, section) for section in every])
    field = Field(edges, bending, DEGREE, 1, float(np.mean(np.diff(edges))))
    contact = scene.seabed_under(line)
    bed = None if contact is None else bed_of(scene, line, contact, field, m)
    held, clamps = [], []
    for end in line.ends:
        node = field.node(0.0 if end.number == 1 else float(edges[-1])) * m
        held += [node + i for i in _held(end.held, plane, line)]
        if end.tangent is not None:
            outwards = plane.turned(np.array(end.tangent)) * (1.0 if end.number == 1 else -1.0)
            length, element = field.slope_length, 0 if end.number == 1 else n - 1
            stiffness = _CLAMP * bending[element] / np.diff(edges)[element] / length**2
            clamps.append(Clamp(node + m + np.arange(m), outwards, float(stiffness)))
    unknowns = np.array(sorted(held), dtype=np.intp)
    system = LineSystem(field, m, Sections(axial, bending, weight), unknowns, bed, clamps)
    return LineModel(line, plane, system, first_shape(line, plane, field, contact))


def _held(dofs: tuple[str, ...], plane: Plane, line: Line) -> list[int]:
    """Components that held translations hold.

    Raises UserError where they hold a horizontal direction that is not the line's own.
    """
    flat = [dof for dof in ("X", "Y") if dof in dofs]
    if len(flat) == 1 and not np.isin(np.abs(plane.axes), (0.0, 1.0)).all():
        raise UserError(
            Fault(
                f"line {line.id}: an end that is held along {flat[0]} alone, in a line that does "
                "not run along X or Y",
                "hold X and Y, or lay the line along one of them",
            )
        )
    found = [len(plane.axes)] if "Z" in dofs else []
    for place, axis in enumerate(plane.axes):
        wanted = {dof for dof, share in zip(("X", "Y"), axis, strict=True) if share}
        if wanted <= set(flat):
            found.append(place)
    return found


def bed_of(scene: Scene, line: Line, contact: SeabedContact, field: Field, m: int) -> Bed:
    """What the seabed does to a line."""
    places = contact_points(field, contact.form)
    count = len(places[0])
    diameter = np.array([section.outer_diameter for section in section_at(line, places[0])])
    normal: Winkler | OneSided | Suction
    if contact.stiffness is not None:
        normal, stiffness = Winkler(contact.stiffness, contact.tolerance), contact.stiffness
    else:
        law = _law(scene, contact, diameter)
        normal = OneSided(law, contact.tolerance)
        stiffness = unloading(law, normal, _stiffness(scene, contact, line.sections[0]))
    if contact.suction is not None:
        suction = scene.suctions[contact.suction]
        wear = None
        if suction.remaining is not None and suction.travel_95 is not None:
            wear = Wear(diameter=diameter, remaining=suction.remaining, travel_95=suction.travel_95)
        normal = Suction(
            normal,
            count,
            stiffness,
            pull_out_of(suction, diameter),
            speed=suction.speed,
            smoothing=suction.smoothing,
            wear=wear,
        )
    friction: Friction | None = None
    coefficients = np.array([contact.axial_friction, contact.lateral_friction])
    if coefficients.any():
        thresholds = np.array([contact.axial_threshold, contact.lateral_threshold])
        friction = Friction(count, coefficients, threshold=thresholds, surface=contact.surface)
    return Bed(field, m, places, normal, friction, contact.mudline)


def unloading(law: SeabedLaw, normal: OneSided, secant: float) -> float:
    """Stiffness that a soil lets go with: its dynamic one, but as steep as it was met, N/m2.

    secant: that of the line at rest, N/m2. Less than the steepest slope would give energy.
    """
    shape = np.shape(law.capacity)
    z = np.geomspace(1e-3 * normal.tolerance, float(np.max(law.diameter)), _SLOPES)
    steepest = max(float(normal.evaluate(np.full(shape, at))[1].max()) for at in z)
    dynamic = law.dynamic_stiffness(np.asarray(normal.tolerance))
    own = 0.0 if dynamic is None else float(np.max(dynamic))
    return max(secant, own, _STEEPER * steepest)


def first_shape(line: Line, plane: Plane, field: Field, contact: SeabedContact | None) -> Array:
    """Unknowns of an inextensible line that hangs between the ends, over the seabed, (size,)."""
    m = plane.components
    one, other = (plane.inside(np.array(end.position)) for end in line.ends)
    base, heights = over(line, contact)
    span = float(np.linalg.norm((other - one)[:-1]))
    places, tangents, _ = shape(field.edges, span, heights, line.length)
    q = np.zeros((field.size, m))
    for s, place, tangent in zip(field.edges, places, tangents, strict=True):
        node = field.node(float(s))
        q[node, 0], q[node, -1] = place[0], place[1] + base
        q[node + 1, [0, -1]] = tangent * field.slope_length
    q[0], q[field.node(float(field.edges[-1]))] = one, other
    return q.ravel()
