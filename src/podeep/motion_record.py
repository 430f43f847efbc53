"""From foundations in motion to the rows of a dynamic database."""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from .arrays import Array, Index
from .database.grids import Grid, LineGrid
from .model.assemble import Model, assemble
from .model.inertia import Inertia, inertia
from .model.moved import Moved, Viscosity, Way
from .model.results import Results
from .record import Places, all_values, places, soil_values
from .scene import Scene
from .solve.body import Body
from .solve.ready import Begun
from .solve.simulate import Track, Tracks
from .subject import FOUNDATION

_SHOWN = {0: True, 1: False}  # rules of the ground: what the soil resists in statics is shown too


class Book(Protocol):
    """What turns tracks of a foundation or a line into the values of a database."""

    @property
    def name(self) -> str:
        """Of its group in the database."""

    @property
    def grid(self) -> Grid | LineGrid:
        """Where its values stand."""

    def largest(self, tracks: Tracks, rows: Index) -> tuple[Array, Array, Array]:
        """Displacement, reaction and moment in some rows, (rows, ...), which errors are told of."""

    def all(self, tracks: Tracks, rows: Index) -> dict[str, Array]:
        """Every value of the soil and what stands in it in some rows, by the schema's names."""

    def extremes(self, tracks: Tracks) -> dict[str, Array]:
        """In all rows, what has an envelope."""


@dataclass(frozen=True, eq=False)
class Ledger:
    """The `Book` of a foundation.

    model: in motion, with the normal force on slopes where it counts. still: the end of statics,
    None where the soil's motion counts from rest.
    """

    at: Places
    model: Model
    body: Body
    inertia: Inertia
    viscosity: Viscosity
    still: Results | None
    shown: bool

    @property
    def name(self) -> str:
        return self.at.grid.name

    def results(self, tracks: Tracks, rows: Index | slice) -> Moved:
        """Some rows of tracks as results."""
        lateral, axial = tracks
        deflecting = _way(lateral, rows, self.body.lateral.origin)
        n = len(deflecting.q)
        if axial is None:
            rest = self.body.rest.axial
            q = np.broadcast_to(rest, (n, len(rest)))
            origin = rest if self.still is not None else np.zeros_like(rest)
            stretching = Way(q, np.zeros_like(q), np.zeros_like(q), origin)
        else:
            assert self.body.axial is not None
            stretching = _way(axial, rows, self.body.axial.origin)
        return Moved(
            *(self.model, deflecting.q, stretching.q, deflecting, stretching),
            *(self.inertia, self.viscosity, self.still, self.shown),
        )

    @property
    def grid(self) -> Grid:
        """Where its values stand."""
        return self.at.grid

    def largest(self, tracks: Tracks, rows: Index) -> tuple[Array, Array, Array]:
        """As `Book.largest`, of all tubes."""
        results, x = self.results(tracks, rows), self.at.grid.depth
        moment = results.of_all(lambda at, tube: results.shear_and_moment(at, tube)[1], x)
        return results.deflection(x), results.lateral_reaction(x[x >= 0.0]), moment

    def all(self, tracks: Tracks, rows: Index) -> dict[str, Array]:
        return all_values(self.results(tracks, rows), self.at)

    def extremes(self, tracks: Tracks) -> dict[str, Array]:
        grid = self.at.grid
        found = soil_values(self.results(tracks, slice(None)), grid.depth, grid.lateral_axis)
        return {name: found[name] for name in FOUNDATION.quantities}


def _way(track: Track, rows: Index | slice, origin: Array) -> Way:
    resisted = None if track.resisted is None else track.resisted[rows]
    return Way(track.q[rows], track.velocity[rows], track.acceleration[rows], origin, resisted)


def ledger(scene: Scene, begun: Begun, body: Body) -> Ledger:
    """The ledger of one foundation; its grid suits the largest loads as in statics."""
    static, foundation = begun.model, begun.model.foundation
    second = replace(body.model.needs, second_order=static.needs.second_order)
    field = static.lateral.system.field
    same = (body.model.profile, static.pieces, static.edges, field.degree)
    model = assemble(scene, foundation, second, *same)
    rule = scene.ground.dynamic_rule
    still = None
    if rule in _SHOWN:
        still = Results(static, body.rest.lateral[None], body.rest.axial[None])
    soil = model.lateral.system.points[0]
    interval = np.searchsorted(field.edges[1:-1], soil.x)
    width = model.parts.width[interval]
    damping = scene.damping
    viscosity = Viscosity(
        damping.mass_factor if damping else 0.0,
        damping.stiffness_factor if damping else 0.0,
        model.profile.dashpot(soil.x, width),
    )
    peak = begun.peak
    return Ledger(
        places(scene, peak, scene.numerics.accuracy),
        model,
        body,
        inertia(scene, foundation, static.pieces, static.edges),
        viscosity,
        still,
        _SHOWN.get(rule, True),
    )
