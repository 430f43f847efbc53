"""What is analysed, as plain data in SI units: z up from sea level, depths positive down.

A scene knows nothing of decks, meshes or databases. Impossible data raise `InvalidData`;
data that are legal but risky are the business of `checks`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

from .errors import InvalidData
from .lines import TRANSLATIONS as TRANSLATIONS
from .lines import Form as Form
from .lines import Line as Line
from .lines import LineEnd as LineEnd
from .lines import LineMotion as LineMotion
from .lines import LineSection as LineSection
from .lines import SeabedContact as SeabedContact
from .lines import Suction as Suction
from .lines import Wave as Wave
from .motion import CoupledSpring as CoupledSpring
from .motion import Damping as Damping
from .motion import Dof as Dof
from .motion import Dynamics as Dynamics
from .motion import Harmonic as Harmonic
from .motion import Hysteresis as Hysteresis
from .motion import Mass as Mass
from .motion import Method as Method
from .motion import Start as Start
from .motion import TimeSeries as TimeSeries
from .tubes import Section as Section
from .tubes import Sliding as Sliding
from .tubes import Tie as Tie
from .tubes import Tube as Tube

DOFS: tuple[Dof, ...] = ("X", "Y", "Z", "RX", "RY", "RZ")
Interpolation = Literal["PARAMETERS", "LOADS"]
Layering = Literal["NONE", "GEORGIADIS"]
Overburden = Literal["OWN", "ACTUAL"]


@dataclass(frozen=True, slots=True)
class Curve:
    """A p-y or t-z curve as it was given.

    `law` names the law ("soft_clay", "sand", "user", ...), `parameters` are by the law's own
    argument names and may vary over depth, `options` are what must agree for two curves to be of
    one type. `rows` are the user's points; `rows_in_diameters` tells the unit of their
    displacements.
    """

    id: int
    law: str
    parameters: Mapping[str, float]
    options: Mapping[str, str | float | bool] = field(default_factory=lambda: MappingProxyType({}))
    rows: tuple[tuple[float, ...], ...] = ()
    rows_in_diameters: bool = False


@dataclass(frozen=True, slots=True)
class Ground:
    """The soil profile: curves at depths below the mudline, positive down, from 0.

    A depth given twice is a jump; curve id 0 is no reaction. `friction_stiffness` is the slope
    of unit friction against displacement, Pa/m. `dynamic_rule` is the original's IDRE. `layering`
    is by equivalent depth, with the overburden of the layer's own soil or the actual one. dashpots:
    radiation of p-y curves by their id, N s/m2 per metre of width.
    """

    depths: tuple[float, ...]
    lateral: tuple[int, ...]
    axial: tuple[int, ...]
    lateral_curves: Mapping[int, Curve]
    axial_curves: Mapping[int, Curve]
    friction_stiffness: float = 1e8
    dynamic_rule: int = 0
    interpolation: Interpolation = "PARAMETERS"
    layering: Layering = "NONE"
    layering_overburden: Overburden = "OWN"
    dashpots: Mapping[int, float] = field(default_factory=lambda: MappingProxyType({}))

    def __post_init__(self) -> None:
        if not self.depths or self.depths[0] != 0.0:
            raise InvalidData("the first soil depth is not 0", "Z_1 is the mudline: 0", "Z_1")
        for above, below in zip(self.depths, self.depths[1:], strict=False):
            if below < above:
                raise InvalidData(
                    f"soil depth {-below:g} m lies above the one before it, {-above:g} m",
                    "depths are 0, then negative, and never rise",
                    "Z",
                )
        for at in set(self.depths):
            if self.depths.count(at) > 2:
                raise InvalidData(
                    f"soil depth {-at:g} m is given {self.depths.count(at)} times",
                    "a jump between two layers is one depth given twice",
                    "Z",
                )
        if self.layering != "NONE" and self.interpolation == "LOADS":
            raise InvalidData(
                "layering by equivalent depth does not go with loads that vary between depths",
                "leave out LOADS or LAYERING",
                "LAYERING",
            )
        if not len(self.depths) == len(self.lateral) == len(self.axial):
            raise InvalidData(
                f"{len(self.depths)} soil depths, {len(self.lateral)} p-y and "
                f"{len(self.axial)} t-z curves",
                "give one pair of curves for each depth",
                "IY",
            )


#: The ground of a scene without foundations: no reaction at any depth.
NO_GROUND = Ground((0.0,), (0,), (0,), MappingProxyType({}), MappingProxyType({}))


@dataclass(frozen=True, slots=True)
class SoilStiffness:
    """The soil under a pipe on the seabed as it was given.

    `model` names one of `seabed.models.MODELS`, `parameters` are by the keys that it takes, in SI.
    """

    id: int
    model: str
    parameters: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Foundation:
    """Tubes in the soil, the outermost first, and the elevation of the mudline around them."""

    id: int
    tubes: tuple[int, ...]
    mudline: float

    @property
    def name(self) -> str:
        return f"F{self.id}"


@dataclass(frozen=True, slots=True)
class Support:
    """Degrees of freedom held at an elevation of a tube."""

    tube: int
    elevation: float
    dofs: tuple[Dof, ...]


@dataclass(frozen=True, slots=True)
class Spring:
    """A linear spring to ground, N/m or N m/rad."""

    tube: int
    elevation: float
    dof: Dof
    stiffness: float


@dataclass(frozen=True, slots=True)
class Spudcan:
    """A spudcan under the tip of a tube, in place of its end bearing.

    diameter: of the area in contact, m; embedment: depth of the largest bearing area below the
    mudline, m. preload: vertical load that it was pushed in with, N; with it loads are held
    against the yield surface. soil, strengths and the like are for that and for its bearing:
    tip_shear_strength is su at the tip (None: su), lateral_area is embedded and projected
    sideways, m2. embedment_factors: on vertical, horizontal and rotational stiffness.
    """

    tube: int
    diameter: float
    embedment: float
    shear_modulus: float
    poisson_ratio: float
    preload: float | None = None
    soil: Literal["CLAY", "SAND"] | None = None
    undrained_shear_strength: float | None = None
    tip_shear_strength: float | None = None
    lateral_area: float = 0.0
    overconsolidation_ratio: float = 1.0
    friction_angle: float | None = None
    effective_unit_weight: float | None = None
    relative_density: float | None = None
    vertical_factor: float = 1.0
    horizontal_factor: float = 1.0
    rotational_factor: float = 1.0

    def __post_init__(self) -> None:
        if self.preload is not None and self.soil is None:
            raise InvalidData(
                f"the spudcan's yield surface under {self.preload:g} N of preload depends on its "
                "soil, which is not given",
                "give SOIL=CLAY with SU, or SOIL=SAND",
                "V_PRELOAD",
            )
        if self.soil == "CLAY" and self.undrained_shear_strength is None:
            raise InvalidData(
                "a spudcan in clay needs the clay's strength",
                "give SU, undrained and in Pa",
                "SOIL",
            )


@dataclass(frozen=True, slots=True)
class Load:
    """A point load: global force (N) and moment (N m), z up, moments by the right hand."""

    name: str
    tube: int
    elevation: float
    force: tuple[float, float, float]
    moment: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Displacement:
    """An imposed displacement (m) or rotation (rad) of one degree of freedom."""

    name: str
    tube: int
    elevation: float
    dof: Dof
    value: float


@dataclass(frozen=True, slots=True)
class Newton:
    """Limits of the iteration: largest out-of-balance and largest increment, as ratios."""

    iterations: int = 60
    force: float = 0.01
    moment: float = 0.01
    translation: float = 0.01
    rotation: float = 0.01


@dataclass(frozen=True, slots=True)
class Steps:
    """Quasi-static steps: a factor for each named load in each step; step 0 is no load."""

    names: tuple[str, ...]
    factors: tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True)
class Numerics:
    """What the user asks of the model; None leaves the choice to the program.

    axial_curves: t-z and Q-z act; otherwise supports alone carry the tubes along z. second_order:
    the normal force works on the slope (P-delta). shear: tubes are soft in shear. components:
    lateral deflections that are solved, 1 in a plane or 2. weight: tubes have their own weight.
    follow_path: statics go on beyond a peak, with loads that fall. active_length: below it elements
    are as few as the stretch allows. hysteresis: what the soil remembers of its motion.
    """

    accuracy: float = 1e-3
    elements: int | None = None
    degree: int | None = None
    axial_curves: bool = True
    second_order: bool | None = None
    shear: bool = False
    weight: bool = False
    active_length: bool = False
    components: Literal[1, 2] | None = None
    follow_path: bool = False
    hysteresis: Hysteresis = "ELASTIC"


@dataclass(frozen=True, slots=True)
class Sea:
    """The water: density (kg/m3) and the acceleration of gravity (m/s2)."""

    density: float = 1025.0
    gravity: float = 9.80665


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything that an analysis needs to know."""

    title: str
    tubes: Mapping[int, Tube]
    foundations: tuple[Foundation, ...]
    ground: Ground
    supports: tuple[Support, ...] = ()
    springs: tuple[Spring, ...] = ()
    spudcans: tuple[Spudcan, ...] = ()
    loads: tuple[Load, ...] = ()
    displacements: tuple[Displacement, ...] = ()
    steps: Steps = Steps((), ())
    newton: Newton = Newton()
    numerics: Numerics = Numerics()
    sea: Sea = Sea()
    ties: tuple[Tie, ...] = ()
    slidings: tuple[Sliding, ...] = ()
    masses: tuple[Mass, ...] = ()
    coupled_springs: tuple[CoupledSpring, ...] = ()
    starts: tuple[Start, ...] = ()
    harmonics: tuple[Harmonic, ...] = ()
    series: tuple[TimeSeries, ...] = ()
    damping: Damping | None = None
    dynamics: Dynamics | None = None
    soil_stiffnesses: Mapping[int, SoilStiffness] = field(
        default_factory=lambda: MappingProxyType({})
    )
    lines: Mapping[int, Line] = field(default_factory=lambda: MappingProxyType({}))
    seabed_contacts: tuple[SeabedContact, ...] = ()
    suctions: Mapping[int, Suction] = field(default_factory=lambda: MappingProxyType({}))
    line_motions: tuple[LineMotion, ...] = ()

    @property
    def default_method(self) -> Method:
        """What follows motion where no method is named: what keeps energy where tubes have room to
        knock against each other, the original's elsewhere."""
        rooms = any(contact.clearance != 0.0 for contact in self.slidings)
        return "CONSERVE" if rooms else "HHT"

    def spudcan(self, foundation: Foundation) -> Spudcan | None:
        """The spudcan under a foundation, if it has one."""
        return next((s for s in self.spudcans if s.tube in foundation.tubes), None)

    def seabed_under(self, line: Line) -> SeabedContact | None:
        """What a line lies on, if it meets the seabed."""
        return next((c for c in self.seabed_contacts if c.line == line.id), None)

    def tip(self, foundation: Foundation) -> float:
        """Elevation of a foundation's lowest tip, m."""
        return min(self.tubes[tube].tip for tube in foundation.tubes)

    def marks(self, foundation: Foundation) -> tuple[float, ...]:
        """Elevations at which something holds, ties or drives the tubes, rising, m."""
        places = (
            *((t.inner, z) for t in self.ties for z in (t.top, t.bottom)),
            *((s.tube, s.elevation) for s in self.supports),
            *((s.tube, s.elevation) for s in self.springs),
            *((load.tube, load.elevation) for load in self.loads),
            *((d.tube, d.elevation) for d in self.displacements),
            *((m.tube, min(m.elevation, self.tubes[m.tube].top)) for m in self.masses),
            *((k.tube, k.elevation) for k in self.coupled_springs),
            *((s.tube, s.elevation) for s in self.starts),
        )
        return tuple(sorted({elevation for tube, elevation in places if tube in foundation.tubes}))
