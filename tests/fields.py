"""Foundations and lines with given fields, in memory: what a query needs of a reader."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from podeep.arrays import Array
from podeep.subject import FOUNDATION, Subject

Field = Callable[[Array, Array], Array]  # (steps or times, points), broadcast against each other


@dataclass
class Foundation:
    """Fields sampled on a grid; `windows` tells which points were read."""

    fields: Mapping[str, Field]
    points: Array
    axis: Array
    spatial: bool = False
    lateral_axis: float | None = 0.0
    layer_boundaries: Array = field(default_factory=lambda: np.array([5.0]))
    name: str = "F1"
    mudline: float = -100.0
    windows: list[slice] = field(default_factory=list)
    subject: Subject = FOUNDATION

    def read(
        self, quantity: str, rows: Sequence[int] | None = None, points: slice | None = None
    ) -> Array:
        window = slice(None) if points is None else points
        self.windows.append(window)
        stored = np.asarray(self.axis, dtype=float)
        at = stored if rows is None else stored[rows]
        shape = (len(at), len(self.points[window]))
        return np.broadcast_to(self.fields[quantity](at[:, None], self.points[window]), shape)

    def envelope(self, quantity: str) -> tuple[Array, Array, Array, Array]:
        values = self.read(quantity)
        return (
            values.min(axis=0),
            values.max(axis=0),
            self.axis[values.argmin(axis=0)],
            self.axis[values.argmax(axis=0)],
        )
