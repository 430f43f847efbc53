"""From lines in motion to the rows of a dynamic database."""

from dataclasses import dataclass

import numpy as np

from .arrays import Array, Index
from .database.grids import LineGrid
from .line.assemble import Plane
from .line.motion import LineReady
from .line.results import LineResults
from .line_record import line_grid, line_values, shown
from .scene import Scene
from .solve.simulate import Tracks


@dataclass(frozen=True, eq=False)
class LineBook:
    """The `Book` of a line. laid: the line as it was laid, from which its displacements count."""

    grid: LineGrid
    laid: LineResults
    plane: Plane

    @property
    def name(self) -> str:
        return self.grid.name

    def _results(self, tracks: Tracks, rows: Index | slice) -> LineResults:
        track, system = tracks[0], self.laid.system
        resisted = np.zeros((len(track.q), 0, system.components))
        if track.resisted is not None:
            resisted = track.resisted
        return LineResults(system, track.q[rows], resisted[rows])

    def largest(self, tracks: Tracks, rows: Index) -> tuple[Array, Array, Array]:
        results, s = self._results(tracks, rows), self.grid.distance
        moved = results.position(s) - self.laid.position(s)[:1]
        return moved, results.reaction(s)[..., -1], results.moment(s)

    def all(self, tracks: Tracks, rows: Index) -> dict[str, Array]:
        return line_values(self._results(tracks, rows), self.laid, self.plane, self.grid)

    def extremes(self, tracks: Tracks) -> dict[str, Array]:
        return shown(self._results(tracks, slice(None)), self.laid, self.plane, self.grid)


def line_book(scene: Scene, ready: LineReady) -> LineBook:
    """The book of a line that is ready to move."""
    solved = ready.solved
    laid = LineResults.of(solved.model.system, solved.states[:1])
    return LineBook(line_grid(scene, solved), laid, solved.model.plane)
