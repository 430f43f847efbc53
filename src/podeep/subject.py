"""What results are of: foundations over their depth, lines along their length; one table of both.

The names are those of the database, the words those of questions, tables and pictures.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Coordinate = Literal["depth", "distance"]


@dataclass(frozen=True, slots=True)
class Subject:
    """A kind of group in a database, and how its points are spoken of.

    initial: of its ids, as F of F1. coordinate: dimension of its results, m. where: what the
    coordinate measures; reference: from where; positive, order: which way it counts. start: what
    the state of step 0 is. quantities: what is shown of it, and has an envelope. inner: where
    the database holds those that do not stand beside the others. slopes: variables that hold the
    derivative by the coordinate of some quantities; the others are straight between two points.
    """

    name: str
    initial: str
    coordinate: Coordinate
    where: str
    reference: str
    positive: str
    order: str
    start: str
    quantities: tuple[str, ...]
    inner: Mapping[str, str]
    slopes: Mapping[str, str]

    def stored(self, quantity: str) -> str:
        """The path of a quantity in the group."""
        return self.inner.get(quantity, quantity)


_INNER = ("effective_tension", "bending_moment")
_BOTH = ("lateral_displacement", "lateral_force", "axial_displacement", "axial_force")

FOUNDATION = Subject(
    name="foundation",
    initial="F",
    coordinate="depth",
    where="depth below the mudline",
    reference="below the mudline",
    positive="positive down",
    order="above or below the first",
    start="the state before loading",
    quantities=_BOTH,
    inner={},
    slopes={"lateral_displacement": "lateral_slope", "axial_displacement": "axial_strain"},
)

LINE = Subject(
    name="line",
    initial="L",
    coordinate="distance",
    where="distance along the line",
    reference="from end 1",
    positive="from end 1",
    order="before or beyond the first",
    start="the state at the end of laying",
    quantities=(*_BOTH, "penetration", "normal_reaction", *_INNER),
    inner={quantity: f"line/{quantity}" for quantity in _INNER},
    slopes={},
)

SUBJECTS = (FOUNDATION, LINE)
