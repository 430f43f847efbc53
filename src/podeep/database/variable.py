"""What a variable of a database is, and those that groups of every kind have."""

from dataclasses import dataclass
from typing import Literal

from ..subject import Subject

Kind = Literal["static", "dynamic"]
Group = Literal["", "envelope", "estimate", "convergence", "tubes", "line"]
Number = Literal["result", "coordinate", "integer", "text"]

KINDS: tuple[Kind, ...] = ("static", "dynamic")
EXTREMES = ("min", "max", "min_at", "max_at")

_RELATIVE = "estimated error as a share of the largest value in the step"


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a foundation's or a line's group, or of a group inside it.

    number: "result" has the precision of the database, "coordinate" is always float64, "integer"
    is int32, "text" a string without units. A variable named as its only dimension is the scale
    of that dimension. later: databases of earlier programs have it not.
    """

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    comment: str = ""
    group: Group = ""
    kinds: tuple[Kind, ...] = KINDS
    spatial_only: bool = False
    number: Number = "result"
    later: bool = False
    positive: Literal["", "up", "down"] = ""

    @property
    def is_scale(self) -> bool:
        return self.dims == (self.name,)


def axes(subject: Subject) -> tuple[Variable, ...]:
    """The step of a static database and the time of a dynamic one."""
    return (
        Variable(
            "step",
            ("axis",),
            "1",
            "quasi-static step",
            f"0 is {subject.start}",
            kinds=("static",),
            number="integer",
        ),
        Variable("time", ("axis",), "s", "time", kinds=("dynamic",), number="coordinate"),
    )


def extremes(table: tuple[Variable, ...], subject: Subject) -> tuple[Variable, ...]:
    """The envelopes of what is shown of a subject."""
    shown = (v for v in table if v.name in subject.quantities)
    return tuple(_extreme(v, which) for v in shown for which in EXTREMES)


def _extreme(variable: Variable, which: str) -> Variable:
    bound = "smallest" if which.startswith("min") else "largest"
    name, dims = f"{variable.name}_{which}", variable.dims[1:]
    if which.endswith("_at"):
        what = f"step or time of the {bound} {variable.long_name}"
        comment = "the first, where several are equal"
        return Variable(name, dims, "axis", what, comment, "envelope", number="coordinate")
    what, comment = f"{bound} {variable.long_name}", "over all computed steps"
    return Variable(name, dims, variable.units, what, comment, "envelope")


LOADS: tuple[Variable, ...] = (
    Variable("load", ("load",), "", "name of the load", kinds=("static",), number="text"),
    Variable(
        "load_factor", ("axis", "load"), "1", "share of the load that acts", kinds=("static",)
    ),
)

PROGRESS: tuple[Variable, ...] = (
    Variable(
        "displacement",
        ("axis",),
        "1",
        "error of the largest displacement",
        _RELATIVE,
        group="estimate",
    ),
    Variable(
        "reaction", ("axis",), "1", "error of the largest reaction", _RELATIVE, group="estimate"
    ),
    Variable("moment", ("axis",), "1", "error of the largest moment", _RELATIVE, group="estimate"),
    Variable("iterations", ("axis",), "1", "iterations", group="convergence", number="integer"),
    Variable(
        "residual",
        ("axis",),
        "1",
        "forces out of balance",
        "as a share of the forces that act",
        group="convergence",
    ),
    Variable(
        "step_size",
        ("axis",),
        "1",
        "size of the step taken at once",
        "static: smallest part of the load step; dynamic: share of the time step",
        group="convergence",
    ),
    Variable(
        "energy",
        ("axis",),
        "N m",
        "work of loads and supports",
        "since the first step",
        group="convergence",
    ),
)
"""Estimated errors and what the iteration took."""
