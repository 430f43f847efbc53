"""Where the values of a foundation or a line stand, as a database needs to know it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..subject import FOUNDATION, LINE, Subject
from .envelope import Values


@dataclass(frozen=True, eq=False)
class Grid:
    """Where the values of a foundation stand.

    depth: m below the mudline, positive down, strictly increasing, shape (depths,); a jump is two
    depths 1e-6 m apart. tube, layer: id of the outermost tube and index of the soil layer at each
    depth. layer_boundaries: depths, m. mudline: elevation, m. lateral_axis: direction of positive
    lateral values in degrees from x, in (-90, 90], or None in a spatial scene. tubes: elevations of
    the results of each tube from its top to its tip, m, by id.
    """

    subject: ClassVar[Subject] = FOUNDATION

    name: str
    depth: Array
    tube: npt.NDArray[np.integer]
    layer: npt.NDArray[np.integer]
    layer_boundaries: Array
    mudline: float
    lateral_axis: float | None
    tubes: Mapping[int, Array]

    def __post_init__(self) -> None:
        if not np.all(np.diff(self.depth) > 0.0):
            raise ValueError(f"{self.name}: depths do not increase")
        if not len(self.depth) == len(self.tube) == len(self.layer) > 0:
            raise ValueError(f"{self.name}: depths, tubes and layers differ in number")
        if not all(e.size and np.all(np.diff(e) < 0.0) for e in self.tubes.values()):
            raise ValueError(f"{self.name}: elevations of a tube do not fall")
        if self.lateral_axis is not None and not -90.0 < self.lateral_axis <= 90.0:
            raise ValueError(f"{self.name}: lateral axis {self.lateral_axis} is not in (-90, 90]")

    @property
    def count(self) -> int:
        """Number of depths."""
        return len(self.depth)

    @property
    def spatial(self) -> bool:
        """Whether lateral values are magnitudes, with components beside them."""
        return self.lateral_axis is None

    @property
    def attributes(self) -> dict[str, float | Array]:
        """What is stored beside the group's name."""
        axis = {} if self.lateral_axis is None else {"lateral_axis": float(self.lateral_axis)}
        return {
            "mudline": float(self.mudline),
            "layer_boundaries": np.asarray(self.layer_boundaries, dtype=np.float64),
            **axis,
        }

    @property
    def fixed(self) -> dict[str, Values]:
        """What does not change from row to row, by its path in the group."""
        elevations = {f"tubes/{igr}/elevation": e for igr, e in self.tubes.items()}
        return {"depth": self.depth, "tube": self.tube, "layer": self.layer} | elevations


@dataclass(frozen=True, eq=False)
class LineGrid:
    """Where the values of a line stand.

    distance: unstretched arc length from end 1, m, strictly increasing, shape (distances,); a jump
    is two distances 1e-6 m apart. mudline: elevation of the seabed, m.
    """

    subject: ClassVar[Subject] = LINE

    name: str
    distance: Array
    mudline: float

    def __post_init__(self) -> None:
        if not (len(self.distance) and np.all(np.diff(self.distance) > 0.0)):
            raise ValueError(f"{self.name}: distances do not increase")

    @property
    def count(self) -> int:
        """Number of distances."""
        return len(self.distance)

    @property
    def spatial(self) -> bool:
        """Lateral values of a line have a sign of their own, whatever the scene."""
        return False

    @property
    def tubes(self) -> Mapping[int, Array]:
        """A line has none."""
        return {}

    @property
    def attributes(self) -> dict[str, float | Array]:
        """What is stored beside the group's name."""
        return {"mudline": float(self.mudline)}

    @property
    def fixed(self) -> dict[str, Values]:
        """What does not change from row to row, by its path in the group."""
        return {"distance": self.distance}
