"""What a table of keywords is made of: columns with bounds, rows of columns, keywords."""

from dataclasses import dataclass
from math import inf
from typing import Literal

Kind = Literal["integer", "number", "word", "flag", "switch"]


@dataclass(frozen=True, slots=True)
class Bounds:
    """An interval of numbers; an open low end does not belong to it."""

    low: float = -inf
    high: float = inf
    open: bool = False

    def __contains__(self, value: float) -> bool:
        above = value > self.low if self.open else value >= self.low
        return above and value <= self.high

    def __str__(self) -> str:
        """In words, to follow "must be"; empty without bounds."""
        low, high = self.low > -inf, self.high < inf
        if low and high and not self.open:
            return f"{self.low:g} to {self.high:g}"
        first = [f"{'above' if self.open else 'at least'} {self.low:g}"] if low else []
        return " and ".join([*first, *([f"at most {self.high:g}"] if high else [])])


ANY = Bounds()
POSITIVE = Bounds(0.0, open=True)
NOT_NEGATIVE = Bounds(0.0)
IDS = Bounds(1, 999999)
IDS_OR_NONE = Bounds(0, 999999)


@dataclass(frozen=True, slots=True)
class Column:
    """One value of a row.

    key: the argument of the scene's dataclass, or the parameter of the curve, that it becomes.
    named: it is given by name or as an option after a comma, never by position.
    default: what stands in where it is left out; otherwise: in words, where nothing does. With
    neither of them it is required. none_at_zero: a value that is not positive is as none.
    A switch is ON or OFF, True or False in the scene. A unit of "deg" becomes radians there, one
    of "%" a share.
    """

    name: str
    meaning: str
    unit: str = ""
    bounds: Bounds = ANY
    key: str = ""
    kind: Kind = "number"
    choices: tuple[str, ...] = ()
    named: bool = False
    default: float | str | None = None
    otherwise: str = ""
    none_at_zero: bool = False

    @property
    def optional(self) -> bool:
        return self.default is not None or bool(self.otherwise) or self.kind == "flag"

    @property
    def rule(self) -> str:
        """What a value must be, in words; empty where anything goes."""
        if self.kind == "switch":
            return "ON, OFF"
        return ", ".join(self.choices) if self.choices else str(self.bounds)

    @property
    def explained(self) -> str:
        """Name, meaning and unit, in words."""
        return f"{self.name} is the {self.meaning}" + (
            f", {self.unit}" if self.unit not in ("", "-") else ""
        )


@dataclass(frozen=True, slots=True)
class Row:
    """One layout of a line: its columns in order, then a group that is repeated.

    law: the name of the law in the scene, for a line that describes one.
    """

    title: str
    columns: tuple[Column, ...]
    repeated: tuple[Column, ...] = ()
    law: str = ""

    @property
    def positional(self) -> tuple[Column, ...]:
        return tuple(c for c in self.columns if not c.named)

    @property
    def layout(self) -> str:
        """The row as it is written, optional columns in brackets: `IGR Z DOF ...`."""
        fixed = [f"[{c.name}]" if c.optional else c.name for c in self.positional]
        group = [c.name for c in self.repeated]
        return " ".join([*fixed, *group, *(["..."] if group else [])])

    def column(self, name: str) -> Column | None:
        """The column of an upper-case name."""
        return next((c for c in self.columns if c.name.upper() == name), None)


@dataclass(frozen=True, slots=True)
class Keyword:
    """A keyword that is read: its rows, and what the manual says of it.

    once: it stands once in a deck. optioned: its named columns also go on its own line, after a
    comma. planned: names and types of it that this version does not read.
    """

    name: str
    purpose: str
    rows: tuple[Row, ...]
    example: str
    notes: str = ""
    aliases: tuple[str, ...] = ()
    once: bool = False
    required: bool = False
    optioned: bool = False
    planned: tuple[str, ...] = ()
