"""Tubes and how they stand in each other, as plain data in SI units, z up from sea level."""

from dataclasses import dataclass
from math import pi

from .errors import InvalidData


class Wall:
    """What a round wall gives per length; overrides replace what the geometry gives."""

    __slots__ = ()

    outer_diameter: float
    wall_thickness: float
    youngs_modulus: float
    density: float
    bending_stiffness_override: float | None
    axial_stiffness_override: float | None
    mass_override: float | None

    def check_wall(self) -> None:
        """Raises InvalidData for a wall that does not fit in its diameter."""
        if not 0.0 < self.wall_thickness <= 0.5 * self.outer_diameter:
            raise InvalidData(
                f"a wall of {self.wall_thickness:g} m does not fit in an outer diameter of "
                f"{self.outer_diameter:g} m",
                "the wall lies between 0 and half the outer diameter (a solid bar)",
                "WT",
            )

    @property
    def inner_diameter(self) -> float:
        return self.outer_diameter - 2.0 * self.wall_thickness

    @property
    def area(self) -> float:
        return pi / 4.0 * (self.outer_diameter**2 - self.inner_diameter**2)

    @property
    def second_moment(self) -> float:
        return pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)

    @property
    def bending_stiffness(self) -> float:
        """EI, N m2."""
        override = self.bending_stiffness_override
        return self.youngs_modulus * self.second_moment if override is None else override

    @property
    def axial_stiffness(self) -> float:
        """EA, N."""
        override = self.axial_stiffness_override
        return self.youngs_modulus * self.area if override is None else override

    @property
    def mass(self) -> float:
        """Mass of the tube alone, kg/m."""
        return self.density * self.area if self.mass_override is None else self.mass_override


@dataclass(frozen=True, slots=True)
class Section(Wall):
    """A stretch of tube between two elevations; overrides replace what the geometry gives."""

    top: float
    bottom: float
    outer_diameter: float
    wall_thickness: float
    youngs_modulus: float
    density: float
    poisson_ratio: float = 0.3
    bending_stiffness_override: float | None = None
    axial_stiffness_override: float | None = None
    shear_stiffness_override: float | None = None
    mass_override: float | None = None
    added_mass_coefficient: float = 0.0
    fill_density: float = 0.0

    def __post_init__(self) -> None:
        if not self.top > self.bottom:
            raise InvalidData(
                f"the section's top {self.top:g} m is not above its bottom {self.bottom:g} m",
                "give ZTOP above ZBOT, both as elevations from sea level",
                "ZBOT",
            )
        self.check_wall()

    @property
    def shear_stiffness(self) -> float:
        """GAs, N, of a hollow circle by Cowper, J. Appl. Mech. 33 (1966), unless it is given."""
        if self.shear_stiffness_override is not None:
            return self.shear_stiffness_override
        nu, m = self.poisson_ratio, (self.inner_diameter / self.outer_diameter) ** 2
        share = 6.0 * (1.0 + nu) * (1.0 + m) ** 2
        share /= (7.0 + 6.0 * nu) * (1.0 + m) ** 2 + (20.0 + 12.0 * nu) * m
        return share * self.area * self.youngs_modulus / (2.0 * (1.0 + nu))


@dataclass(frozen=True, slots=True)
class Tube:
    """A casing: sections from top to tip without gaps."""

    id: int
    name: str
    sections: tuple[Section, ...]

    def __post_init__(self) -> None:
        if not self.sections:
            raise InvalidData(f"tube {self.id} has no section", "give at least one row", "IGR")
        for above, below in zip(self.sections, self.sections[1:], strict=False):
            if abs(above.bottom - below.top) > 1e-9:
                raise InvalidData(
                    f"a section starts at {below.top:g} m, the one above it ends at "
                    f"{above.bottom:g} m",
                    "sections follow each other from top to bottom without gap or overlap",
                    "ZTOP",
                )

    @property
    def top(self) -> float:
        return self.sections[0].top

    @property
    def tip(self) -> float:
        return self.sections[-1].bottom


@dataclass(frozen=True, slots=True)
class Tie:
    """An inner tube that takes the motion of an outer one between two elevations.

    ends: at these two elevations alone, not all along.
    """

    outer: int
    inner: int
    top: float
    bottom: float
    ends: bool = False


@dataclass(frozen=True, slots=True)
class Sliding:
    """Contact of a tube with one that slides inside it, wherever both are and nothing ties them.

    stiffness: of the contact, N/m2; None is rigid. clearance: room between them on either side, m;
    None is what the diameters leave. tolerance: penetration over which the contact takes hold, m.
    friction: Coulomb's coefficient along the tubes; threshold: displacement at which it slips, m.
    """

    outer: int
    inner: int
    stiffness: float | None = None
    clearance: float | None = 0.0
    tolerance: float = 1e-4
    friction: float = 0.0
    threshold: float = 1e-3
