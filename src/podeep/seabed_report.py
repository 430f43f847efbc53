"""Penetration of a pipe and stiffness of the soil under it by every model, side by side."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .errors import InvalidData
from .report import folded
from .scene import SoilStiffness
from .seabed.law import SeabedLaw
from .seabed.lay import Laid, laid
from .seabed.models import MODELS, NOT_FOUND, Model, Soil
from .seabed.parameters import PARAMETERS, PIPE, Parameter
from .seabed.stiffness import PipeStiffness, pipe_stiffness
from .units import short

_LAID = "F114"  # the model that the lay factor belongs to
_NO_DYNAMIC = "-"


@dataclass(frozen=True)
class Row:
    """What one model says. id: of the soil in a deck."""

    id: int | None
    model: Model
    law: SeabedLaw
    found: PipeStiffness
    laid: Laid | None = None

    @property
    def name(self) -> str:
        return self.model.name if self.id is None else f"{self.id} {self.model.name}"


@dataclass(frozen=True)
class Table:
    """A pipe of a diameter (m) and a submerged weight (N/m), and what the models say of it.

    soil: what it lies on, in words. lacking: models of this soil that could not be evaluated, with
    the parameters that they need.
    """

    diameter: float
    weight: float
    soil: str
    rows: tuple[Row, ...]
    lacking: tuple[tuple[Model, tuple[Parameter, ...]], ...] = ()


#: Bending stiffness, N m2, and lay tension, N.
Lay: TypeAlias = tuple[float, float]


def table_of(soil: Soil, given: Mapping[str, float], lay: Lay | None = None) -> Table:
    """Every model of a soil that the parameters given are enough for, by their keys and in SI.

    Raises InvalidData, as the models do, and for parameters that no model of this soil takes.
    """
    models = [m for m in MODELS.values() if m.soil == soil]
    known = {p.key for m in models for p in m.parameters} | {*PIPE}
    for key in given.keys() - known:
        one = PARAMETERS[key]
        message = f"the {one.name} has no effect on {soil.lower()}"
        raise InvalidData(message, "leave it out", one.symbol)
    lacks = [(m, m.lacks(given)) for m in models]
    rows = tuple(_row(None, m, given, given, lay) for m, missing in lacks if not missing)
    soil_words = [PARAMETERS[key].words(v) for key, v in given.items() if key not in PIPE]
    return Table(
        given["diameter"],
        given["weight"],
        f"{soil.lower()}: {', '.join(soil_words)}",
        rows,
        tuple((m, missing) for m, missing in lacks if missing),
    )


def table_of_deck(
    soils: Sequence[SoilStiffness], pipe: Mapping[str, float], lay: Lay | None = None
) -> Table:
    """The soils of a deck under a pipe of a diameter (m) and a submerged weight (N/m)."""
    rows = (_row(s.id, MODELS[s.model], s.parameters, pipe, lay) for s in soils)
    return Table(pipe["diameter"], pipe["weight"], "the soils of *SOILSTIFF", tuple(rows))


def _row(
    id_: int | None,
    model: Model,
    parameters: Mapping[str, float],
    pipe: Mapping[str, float],
    lay: Lay | None,
) -> Row:
    law = model.at(pipe["diameter"], parameters)
    weight = pipe["weight"]
    deeper = laid(law, weight, *lay) if lay and model.name == _LAID else None
    return Row(id_, model, law, pipe_stiffness(law, weight), deeper)


# --- text -------------------------------------------------------------------------------------


def text(table: Table) -> str:
    """The table in words, 80 columns wide."""
    lines = folded(
        f"pipe of {short(table.diameter)} m and {short(table.weight)} N/m in water, on {table.soil}"
    )
    notes: dict[str, int] = {}
    heads = ("model", "source", "z mm", "z/D", "B mm", "Ks kPa", "Kd kPa", "")
    cells = [heads, *(_cells(row, table.diameter, notes) for row in table.rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines.append("")
    for name, mark, *numbers, marks in cells:
        words = (name.ljust(widths[0]), mark.ljust(widths[1]))
        aligned = (n.rjust(w) for n, w in zip(numbers, widths[2:], strict=False))
        lines.append(" ".join((*words, *aligned, marks)).rstrip())
    lines.append("")
    lines += folded(
        "z penetration, B contact width; Ks = W/z, a secant, and Kd, in small quick motions, per "
        "metre of pipe. Source of z and Ks: printed in public text, or reconstructed, a guess."
    )
    for note, number in notes.items():
        lines += folded(f"{number} {note}")
    for line in (*_sideways(table), *_laid_lines(table), *_missing(table)):
        lines += folded(line)
    return "\n".join(lines)


def _cells(row: Row, diameter: float, notes: dict[str, int]) -> tuple[str, ...]:
    """A row of the table; what has to be known of it is added to the notes, by their numbers."""
    found = row.found
    about = [*found.warnings]
    if found.dynamic is None:
        about.append(f"no Kd: {row.law.no_dynamic}")
    elif row.model.remark:
        about.append(row.model.remark)
    numbers = [notes.setdefault(note, len(notes) + 1) for note in about]
    return (
        row.name,
        row.model.static,
        _four(1e3 * found.penetration),
        _four(found.penetration / diameter),
        _four(1e3 * found.contact_width),
        _four(1e-3 * found.static),
        _NO_DYNAMIC if found.dynamic is None else _four(1e-3 * found.dynamic),
        ",".join(map(str, sorted(numbers))),
    )


def _four(value: float) -> str:
    """To four digits, without an exponent where that is not longer."""
    return short(float(f"{value:.4g}"))


def _sideways(table: Table) -> Iterator[str]:
    for row in table.rows:
        if row.found.lateral is not None:
            yield (
                f"KL of {row.name}, sideways in small quick motions: "
                f"{_four(1e-3 * row.found.lateral)} kPa (DNV-RP-F105, from memory)"
            )


def _laid_lines(table: Table) -> Iterator[str]:
    for row in table.rows:
        if row.laid is None:
            continue
        yield (
            f"laid on {row.name}: k_lay {_four(row.laid.factor)}, z "
            f"{_four(1e3 * row.laid.penetration)} mm, z/D "
            f"{_four(row.laid.penetration / table.diameter)}"
        )


def _missing(table: Table) -> Iterator[str]:
    for model, missing in table.lacking:
        yield f"{model.name} lacks {', '.join(p.option for p in missing)}"
    yield f"no formula found in public text: {'; '.join(NOT_FOUND)}"


def lay_warnings(table: Table, lay_tension: float) -> Iterator[str]:
    """A lay tension below the range of the lay factor."""
    for row in table.rows:
        if row.laid is not None and lay_tension < row.laid.least_tension:
            yield (
                f"{row.name}: a lay tension of {short(lay_tension)} N is below "
                f"{_four(row.laid.least_tension)} N: the lay factor is for more (DNV-RP-F114)"
            )


# --- CSV --------------------------------------------------------------------------------------

#: Columns of `csv_rows`.
COLUMNS = (
    *(
        "soil",
        "model",
        "source",
        "penetration [m]",
        "penetration over diameter",
        "contact width [m]",
    ),
    *("static stiffness [Pa]", "tangent stiffness [Pa]", "dynamic stiffness [Pa]"),
    *("lateral dynamic stiffness [Pa]", "lay factor", "penetration as laid [m]"),
    *("warnings", "about the dynamic stiffness"),
)


def csv_rows(table: Table) -> Iterator[tuple[str, ...]]:
    """The table in SI and full precision, by COLUMNS; empty where a model has no such number."""
    for row in table.rows:
        found = row.found
        numbers = (
            *(found.penetration, found.penetration / table.diameter, found.contact_width),
            *(found.static, found.tangent, found.dynamic, found.lateral),
            *((row.laid.factor, row.laid.penetration) if row.laid else (None, None)),
        )
        cells = ("" if n is None else repr(n) for n in numbers)
        id_ = "" if row.id is None else str(row.id)
        about = (row.law.no_dynamic if found.dynamic is None else row.model.remark,)
        yield (id_, row.model.name, row.model.static, *cells, "; ".join(found.warnings), *about)
