"""From a request to what the user sees: the query, its table and its picture."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import Fault, UserError
from ..figure import save
from ..query import Curves, DatabaseKind, Origin, envelope, snapshot, step_evolution
from ..table import csv_table, text_table
from ..units import plain, short
from .cases import case_name
from .console import Console
from .flow import Request, Source
from .points import Extent

if TYPE_CHECKING:
    from ..database.read import Database, FoundationData, LineData

_AXES = {  # degrees from x
    0.0: "x",
    90.0: "y",
    180.0: "-x",
    270.0: "-y",
    -90.0: "-y",
}


@dataclass(frozen=True, slots=True)
class Results:
    """Makes and shows the results of a session; `pictures` is their folder, None for none."""

    databases: Mapping[DatabaseKind, "Database"]
    console: Console
    csv: bool
    pictures: Path | None

    def __call__(self, request: Request) -> None:
        database = self.databases[request.source]
        data = database[request.name]
        curves, origin = _curves(data, request), _origin(database, data)
        table = csv_table(curves, origin) if self.csv else f"\n{text_table(curves, origin)}\n"
        self.console.show(table)
        if self.pictures is not None:
            path = save(curves, origin, self.pictures, case_name(database.path))
            self.console.say(f"Picture: {path}")


def sources(databases: Mapping[DatabaseKind, "Database"]) -> tuple[Source, ...]:
    """The open databases as the flow sees them.

    Raises `UserError` for one that holds no step or time yet.
    """
    return tuple(
        Source(kind, {name: _extent(database, name) for name in database.names})
        for kind, database in databases.items()
    )


def _extent(database: "Database", name: str) -> Extent:
    data = database[name]
    if not len(data.axis):
        raise UserError(
            Fault(
                f"{database.path} holds no results of {name} yet",
                "open it when the run has written some, or run the analysis again",
            )
        )
    return Extent((float(data.points[0]), float(data.points[-1])), data.axis, data.subject)


def _curves(data: "FoundationData | LineData", request: Request) -> Curves:
    match request.analysis:
        case "step_evolution":
            return step_evolution(data, request.quantity, request.points)
        case "snapshot":
            return snapshot(data, request.quantity, request.points, request.at)
        case "envelope":
            return envelope(data, request.quantity, request.points)


def _origin(database: "Database", data: "FoundationData | LineData") -> Origin:
    direction = None
    if (axis := data.lateral_axis) is not None:
        direction = _AXES.get(axis, f"{short(axis)} degrees from x")
    return Origin(
        database=database.path.name,
        database_kind=database.kind,
        title=plain(database.title),
        name=data.name,
        mudline=data.mudline,
        direction=direction,
        subject=data.subject,
    )
