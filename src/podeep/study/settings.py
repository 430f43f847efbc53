"""What a chart of a foundation varies, as data, its errors, and how one setting is built."""

from dataclasses import dataclass, replace
from itertools import takewhile

from ..model.around import Reactions
from ..model.assemble import Model, assemble
from ..model.mesh import edges
from ..scene import Numerics, Scene
from ..solve.newton import Method
from .chart import RelativeErrors, Setting, Words

PRESETS = (1e-2, 1e-3, 1e-4, 1e-5)  # errors that are marked
SURE = 1e-2  # error of the reference over the smallest preset, at most
_MOST_ELEMENTS = 192  # of a series whose reactions are integrated, at least
_LONGEST = 4.0  # ratio of the largest to the smallest number of elements, at least
_LUMPED_MORE = 8.0  # times as many elements where reactions are lumped
_GROWTH, _QUICK_GROWTH = 2.0**0.5, 2.0  # from one number of elements to the next


@dataclass(frozen=True, slots=True)
class Series:
    """What the settings of one line in the chart share; only their number of elements differs.

    spatial: two components of the deflection are solved where one would do.
    """

    degree: int
    reactions: Reactions = "integrated"
    method: Method = "line search"
    spatial: bool = False

    @property
    def name(self) -> str:
        parts = ["lumped" if self.reactions == "lumped" else f"degree {self.degree}"]
        parts += [] if self.method == "line search" else [self.method]
        return ", ".join([*parts, *(["spatial"] if self.spatial else [])])

    @property
    def in_deck(self) -> bool:
        """Whether ELEMENTS and ORDER of a deck alone ask for it."""
        return self == Series(self.degree)

    @property
    def cells(self) -> tuple[str, ...]:
        spatial = "yes" if self.spatial else "no"
        return str(self.degree), self.reactions, self.method, spatial

    def mesh(self, elements: int) -> str:
        return f"{elements} elements of degree {self.degree}"


_SERIES = (
    Series(3),
    Series(5),
    Series(7),
    Series(5, method="full steps"),
    Series(5, method="secant"),
    Series(5, spatial=True),
    Series(3, "lumped"),
    Series(3, "lumped", "full steps"),
)


@dataclass(frozen=True, slots=True)
class Errors(RelativeErrors):
    """Relative errors of the largest values of a foundation, each the largest of all steps.

    Along the axis they are those of settlement, shaft friction and normal force.
    """

    displacement: float
    reaction: float
    moment: float


WORDS = Words(
    subject="Foundation",
    drawn=(("largest", "Largest relative error of displacement, reaction and moment in any step"),),
    margin=SURE,
    legend="Without more words the soil's reaction is integrated and Newton's iteration has a line "
    "search. lumped: springs at the ends of elements of degree 3, with half an element's length "
    "each; full steps: no line search; secant: secant moduli in place of tangents; spatial: two "
    "components of the deflection where one would do",
    columns=("degree", "reactions", "iteration", "spatial"),
    replaced="*ACCURACY and *MODEL",
    unreached="no ELEMENTS and ORDER that were measured reach it",
)


@dataclass(frozen=True, slots=True)
class Plan:
    """What is measured: settings, runs of each that are timed, and the time for these, s."""

    settings: tuple[Setting[Series], ...]
    runs: int
    patience: float


def plan(model: Model, *, quick: bool) -> Plan:
    """The settings that suit the scene of a model (whose mesh does not matter).

    Where tubes touch, iterations without a search, or along secants, go on and on: they are no
    settings there.
    """
    growth = _QUICK_GROWTH if quick else _GROWTH
    touching = any(p.against is not None for p in model.lateral.system.points)
    settings = [
        Setting(series, elements)
        for series in _SERIES
        if not (touching and series.method != "line search")
        if not series.spatial or (model.needs.components == 1 and model.lateral.forces.any())
        for elements in counts(len(model.pieces), growth, series.reactions == "lumped")
    ]
    return Plan(tuple(settings), 7 if quick else 31, 15.0 if quick else 150.0)


def counts(least: int, growth: float, lumped: bool) -> tuple[int, ...]:
    """Numbers of elements from the least that the tube's stretches need."""
    most = max(_MOST_ELEMENTS, _LONGEST * least) * (_LUMPED_MORE if lumped else 1.0)
    first = max(least, 4)
    sizes = (round(first * growth**i) for i in range(64))
    coarse = list(takewhile(lambda n: n < most / growth**0.5, sizes))
    return (*coarse, round(most))


def build(scene: Scene, base: Model, setting: Setting[Series]) -> Model:
    """The model of a setting on the ground and stretches of another model of the scene.

    Raises UserError where the curves do not allow the setting.
    """
    series, needs = setting.series, base.needs
    if series.spatial:
        needs = replace(needs, lateral_axis=None, components=2)
    boundaries = edges(base.pieces, base.profile, 1.0, setting.elements)
    same = (scene, base.foundation, needs, base.profile, base.pieces)
    return assemble(*same, boundaries, series.degree, series.reactions)


def deck_lines(numerics: Numerics, accuracy: float, setting: Setting[Series] | None) -> str:
    """The lines of a deck that ask for an accuracy and a setting, None: the program's own choice.

    The other options of *MODEL stay as they are.
    """
    options = ["PDELTA"] if numerics.second_order else []
    options += ["SHEAR=ON"] if numerics.shear else []
    options += [] if numerics.axial_curves else ["TZ=OFF"]
    options += {None: [], 1: ["PLANAR"], 2: ["SPATIAL"]}[numerics.components]
    if setting:
        options += [f"ELEMENTS={setting.elements}", f"ORDER={setting.series.degree}"]
    return "\n".join(
        ["*ACCURACY", f"{accuracy:g}", *([", ".join(["*MODEL", *options])] * bool(options))]
    )
