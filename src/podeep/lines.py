"""Lines (pipes, risers) and the seabed under them, as plain data in SI, z up from sea level."""

from dataclasses import dataclass
from math import dist, hypot, pi
from typing import Literal

from .errors import InvalidData
from .motion import Dof, check_rising
from .tubes import Wall

Surface = Literal["box", "ellipse"]
Form = Literal["integrated", "nodal"]
Point = tuple[float, float, float]
_SOFTEST = 1e-3  # N/m2
TRANSLATIONS: tuple[Dof, ...] = ("X", "Y", "Z")


@dataclass(frozen=True, slots=True)
class LineSection(Wall):
    """A stretch of a line, unstretched length in m; overrides replace what the geometry gives.

    elements: how many it is cut into; None leaves it to the accuracy. fill_density: of the
    contents, kg/m3. added_mass_coefficient, drag_coefficient: of water across the line.
    """

    length: float
    outer_diameter: float
    wall_thickness: float
    youngs_modulus: float
    density: float
    elements: int | None = None
    bending_stiffness_override: float | None = None
    axial_stiffness_override: float | None = None
    mass_override: float | None = None
    added_mass_coefficient: float = 1.0
    drag_coefficient: float = 0.0
    fill_density: float = 0.0

    def __post_init__(self) -> None:
        self.check_wall()
        if not self.length > 0.0:
            raise InvalidData(f"a section is {self.length:g} m long", "give more than 0", "LENGTH")
        if self.elements is not None and self.elements < 1:
            raise InvalidData(f"{self.elements} elements in a section", "give 1 or more", "NEL")

    @property
    def total_mass(self) -> float:
        """Mass of the line and its contents, kg/m."""
        return self.mass + self.fill_density * pi / 4.0 * self.inner_diameter**2

    def submerged_weight(self, water_density: float, gravity: float) -> float:
        """Weight of the line and its contents less the buoyancy of the outer diameter, N/m.

        water_density: kg/m3; gravity: m/s2. Negative for a line that floats.
        """
        displaced = water_density * pi / 4.0 * self.outer_diameter**2
        return (self.total_mass - displaced) * gravity


@dataclass(frozen=True, slots=True)
class LineEnd:
    """An end of a line: end 1 is where its sections begin, end 2 where they end.

    position: of the axis, x, y and elevation, m. held: which of X, Y and Z are held there, or
    moved. direction: in which the line leaves the end, of any length, where its direction is held;
    None lets it turn.
    """

    number: Literal[1, 2]
    position: Point
    held: tuple[Dof, ...] = TRANSLATIONS
    direction: Point | None = None

    def __post_init__(self) -> None:
        if self.direction is not None and not hypot(*self.direction) > 0.0:
            raise InvalidData(
                "a direction of length 0", "give one of DX, DY, DZ other than 0", "DX"
            )

    @property
    def tangent(self) -> Point | None:
        """The direction as a unit vector; None where it is not held."""
        if self.direction is None:
            return None
        length = hypot(*self.direction)
        x, y, z = (component / length for component in self.direction)
        return x, y, z

    def holds(self, dof: Dof) -> bool:
        """Whether a degree of freedom is held: rotations are, all three, with the direction."""
        return dof in self.held if dof in TRANSLATIONS else self.direction is not None


def towards(here: Point, there: Point) -> Point:
    """The horizontal unit vector from a point to another. Raises InvalidData if there is none."""
    x, y = there[0] - here[0], there[1] - here[1]
    length = hypot(x, y)
    if not length > 0.0:
        raise InvalidData(
            "the ends stand above each other: no horizontal direction leads to the other one",
            "give DX=, DY= and DZ=, the direction in which the line leaves the end",
            "DOF",
        )
    return x / length, y / length, 0.0


@dataclass(frozen=True, slots=True)
class Line:
    """A pipe or riser: sections from end 1 to end 2, and both ends."""

    id: int
    name: str
    sections: tuple[LineSection, ...]
    ends: tuple[LineEnd, LineEnd]

    def __post_init__(self) -> None:
        if not self.sections:
            raise InvalidData(f"line {self.id} has no section", "give at least one row", "IGR")
        if [end.number for end in self.ends] != [1, 2]:
            raise InvalidData(f"line {self.id} lacks an end", "give end 1, then end 2", "END")

    @property
    def length(self) -> float:
        """Unstretched length, m."""
        return sum(section.length for section in self.sections)

    @property
    def distance(self) -> float:
        """The straight way between the ends, m."""
        one, other = (end.position for end in self.ends)
        return dist(one, other)


@dataclass(frozen=True, slots=True)
class SeabedContact:
    """A line on a flat seabed at the elevation `mudline`, m.

    axial_friction, lateral_friction: coefficients mu; axial_threshold, lateral_threshold: slips at
    which they are reached, m, more than 0 (friction that is rigid to its limit cannot be solved).
    stiffness: N/m2, N/m per metre of line; None where that of a soil holds, `soil_stiffness` by its
    id. suction: its id, None for none. surface: limits of friction along and across separately
    ("box"), or together. form: the reaction integrated along the line or lumped at its nodes.
    tolerance: penetration over which the contact takes hold, m.
    """

    line: int
    mudline: float
    stiffness: float | None = None
    soil_stiffness: int | None = None
    suction: int | None = None
    axial_friction: float = 0.0
    lateral_friction: float = 0.0
    axial_threshold: float = 1e-3
    lateral_threshold: float = 1e-3
    surface: Surface = "box"
    form: Form = "integrated"
    tolerance: float = 1e-4

    def __post_init__(self) -> None:
        if (self.stiffness is None) == (self.soil_stiffness is None):
            both = "both a stiffness and a soil" if self.stiffness is not None else "no stiffness"
            raise InvalidData(
                f"the seabed under line {self.line} has {both}",
                "give KN, or the id of a *SOILSTIFF as ID1, or KN_SOL of *CONTACT",
                "KN",
            )
        if self.stiffness is not None and not self.stiffness >= _SOFTEST:
            rule = f"give KN DENSITY of {_SOFTEST:g} or more"
            raise InvalidData(f"a seabed of {self.stiffness:g} N/m2", rule, "KN")
        for value, name, field in (
            (self.axial_threshold, "a threshold", "XSEUIL2"),
            (self.lateral_threshold, "a threshold", "XSEUIL3"),
            (self.tolerance, "a tolerance", "DISCON"),
        ):
            if not value > 0.0:
                raise InvalidData(f"{name} of {value:g} m", "give more than 0", field)
        for value, field in ((self.axial_friction, "MU2"), (self.lateral_friction, "MU3")):
            if not value >= 0.0:
                raise InvalidData(f"a friction coefficient of {value:g}", "give 0 or more", field)


@dataclass(frozen=True, slots=True)
class Suction:
    """How a seabed holds a line that is pulled out, by the names of `seabed.pull_out.PullOut`.

    force_factor, reach_factor: None takes those of the theory page, by the diameter of the line and
    undrained_shear_strength (Pa). speed: of pull-out where statics have no time, m/s. smoothing: of
    the velocity in motion, s. remaining, travel_95: wear, as in `seabed.pull_out.Wear`; None for
    none.
    """

    id: int
    force_factor: float | None = None
    force_exponent: float = 0.18
    reach_factor: float | None = None
    reach_exponent: float = 0.26
    mobilised: float = 0.12
    released: float = 0.30
    undrained_shear_strength: float | None = None
    speed: float = 0.0
    smoothing: float = 1.0
    remaining: float | None = None
    travel_95: float | None = None

    def __post_init__(self) -> None:
        if (self.force_factor is None) == (self.undrained_shear_strength is None):
            both = self.force_factor is not None
            raise InvalidData(
                f"suction {self.id} has {'both ALPHAF and CU' if both else 'no ALPHAF and no CU'}",
                "give ALPHAF, or CU= for ALPHAF = 1.12 OD CU / OD^NF",
                "CU" if both else "ALPHAF",
            )
        if (self.remaining is None) != (self.travel_95 is None):
            raise InvalidData(
                f"suction {self.id} has one of the two numbers of wear",
                "give REMAIN= and TRAVEL=, or neither",
                "REMAIN" if self.travel_95 is None else "TRAVEL",
            )


@dataclass(frozen=True, slots=True)
class Wave:
    """amplitude times sin(2 pi t / period + phase), m or rad; phase in rad.

    ramp: seconds from the start of motion over which it grows from nothing, as of a `Harmonic`.
    """

    amplitude: float
    period: float
    phase: float = 0.0
    ramp: float = 0.0

    def __post_init__(self) -> None:
        if not self.period > 0.0:
            raise InvalidData(f"a period of {self.period:g} s", "give more than 0", "PERIOD")


@dataclass(frozen=True, slots=True)
class LineMotion:
    """What moves a degree of freedom of a line's end from its place, m or rad: the sum of

    target, times the factor that the steps and histories give to `name`; waves; and a record of
    `values` at `times`, s, straight lines between, held before and after. Waves and record belong
    to motion, the target to statics as well. Rotations turn the held direction.
    """

    line: int
    end: Literal[1, 2]
    dof: Dof
    name: str = ""
    target: float = 0.0
    waves: tuple[Wave, ...] = ()
    times: tuple[float, ...] = ()
    values: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if len(self.times) != len(self.values):
            raise InvalidData(
                f"{len(self.times)} times and {len(self.values)} values", "give as many", "T"
            )
        check_rising(self.times)

    @property
    def moves_in_time(self) -> bool:
        """Whether it has waves or a record."""
        return bool(self.waves or self.times)
