"""What stands in a soil database: one table for the writer, the reader and the docs.

A database holds a group for each foundation and each line, named by its id. `TABLES` lists what
such a group holds; `variables` picks what one database needs. The dimension "axis" stands for the
step of a static database or the time of a dynamic one.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Literal

from ..subject import FOUNDATION, Subject
from .foundation_variables import FOUNDATION_VARIABLES
from .line_variables import LINE_VARIABLES
from .variable import Kind, Variable

Status = Literal["running", "complete", "stopped", "interrupted"]

SCHEMA = "podeep-soil"
MAJOR, MINOR = 1, 0
CONVENTIONS = "CF-1.11"
STATUSES: tuple[Status, ...] = ("running", "complete", "stopped", "interrupted")
ENDINGS = {".dss": "static", ".dst": "dynamic"}
AXES = {"static": "step", "dynamic": "time"}
PARTIAL = ".partial"  # added to the name of a database that is not finished
COMMITTED = "committed"  # rows that a running database vouches for; a finished one has none
DECK = "input/deck"

TABLES: Mapping[str, tuple[Variable, ...]] = {
    "foundation": FOUNDATION_VARIABLES,
    "line": LINE_VARIABLES,
}


def variables(
    kind: Kind, *, spatial: bool, loads: bool, subject: Subject = FOUNDATION
) -> tuple[Variable, ...]:
    """The variables of a subject in a database of this kind, with the axis by its name.

    spatial: lateral values are magnitudes beside their components. loads: there are named loads.
    """
    axis, table = AXES[kind], TABLES[subject.name]
    units = next(v.units for v in table if v.name == axis)

    def named(variable: Variable) -> Variable:
        dims = tuple(axis if d == "axis" else d for d in variable.dims)
        return replace(
            variable, dims=dims, units=units if variable.units == "axis" else variable.units
        )

    return tuple(
        named(v)
        for v in table
        if kind in v.kinds and (spatial or not v.spatial_only) and (loads or "load" not in v.dims)
    )


def places(
    table: tuple[Variable, ...], tubes: Iterable[int]
) -> Iterator[tuple[str, Variable, int | None]]:
    """Path of each variable in its group, and the tube it belongs to, if to one.

    A dimension's scale comes before the variables that use it.
    """
    for variable in table:
        if variable.group != "tubes":
            yield "/".join(filter(None, (variable.group, variable.name))), variable, None
    for igr in tubes:
        for variable in table:
            if variable.group == "tubes":
                yield f"tubes/{igr}/{variable.name}", variable, igr
