"""What an open database holds of a foundation or a line."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from ..arrays import Array, Index
from ..subject import FOUNDATION, LINE, Subject
from .stored import Stored


@dataclass(frozen=True, eq=False)
class FoundationData(Stored):
    """What a database holds of one foundation.

    lateral_axis: degrees from x, None in a spatial scene. layer, tube: soil layer and outermost
    tube at each depth. elevations: of each tube's results, by id.
    """

    subject: ClassVar[Subject] = FOUNDATION

    lateral_axis: float | None
    layer: Index
    tube: Index
    elevations: Mapping[int, Array]

    @property
    def depth(self) -> Array:
        """Depths of the results, m below the mudline, shape (depths,)."""
        return self.points

    @property
    def spatial(self) -> bool:
        """Whether lateral values are magnitudes, with components beside them."""
        return self.lateral_axis is None

    @property
    def tubes(self) -> tuple[int, ...]:
        """Ids of the tubes."""
        return tuple(self.elevations)

    def read_tube(
        self, igr: int, quantity: str, rows: int | slice | Sequence[int] | None = None
    ) -> Array:
        """Values of a tube at its elevations, shape (rows, elevations)."""
        return self.read(f"tubes/{igr}/{quantity}", rows)


class LineData(Stored):
    """What a database holds of one line; its shape and its forces are under `line/`."""

    subject: ClassVar[Subject] = LINE
    lateral_axis: ClassVar[None] = None
