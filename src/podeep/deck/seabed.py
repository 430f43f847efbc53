"""The paragraphs of the seabed under lines: its soils and its suction."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from types import MappingProxyType

from ..scene import SoilStiffness, Suction
from ..seabed.models import MODELS
from ..seabed.pull_out import pull_out_of
from .cells import Values, no_data, option_fields, read_lines, read_row
from .column import Row
from .faults import Faults, nearest
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph

_KEYWORD = KEYWORDS["SOILSTIFF"]
_ROWS: Mapping[str, Row] = MappingProxyType({row.law: row for row in _KEYWORD.rows})


def read_soil_stiffnesses(
    paragraphs: Sequence[Paragraph], soils: Registry[SoilStiffness], faults: Faults
) -> None:
    """Take in the soils of all *SOILSTIFF."""
    for paragraph in paragraphs:
        option_fields(paragraph, _KEYWORD, _KEYWORD.rows[0], faults)
        if not paragraph.lines:
            no_data(paragraph, _KEYWORD.rows[0], faults)
        for line in paragraph.lines:
            _take(paragraph, line, soils, faults)


def _take(
    paragraph: Paragraph, line: Sequence[Field], soils: Registry[SoilStiffness], faults: Faults
) -> None:
    """Take in one line; one at fault still names its soil."""
    row = _row(line, faults)
    # without a model the id is read all the same, by any layout, and nothing told of the rest
    values = read_row(
        line, row or _KEYWORD.rows[0], _KEYWORD, paragraph.place, faults if row else Faults()
    )
    soil = None
    if row is not None and values.sound:
        arguments = values.arguments(row.columns)
        law = faults.guarded(
            lambda: MODELS[row.law].at(1.0, arguments), values.places, values.place
        )
        if law is not None:
            soil = SoilStiffness(values.cells["ID"], row.law, MappingProxyType(arguments))
    soils.add(values.cells.get("ID"), values.places.get("ID", values.place), soil)


def _row(line: Sequence[Field], faults: Faults) -> Row | None:
    """The layout of a line's model; None is told."""
    positional = [f for f in line if not f.name]
    given = next((f for f in line if f.name == "MODEL"), None)
    given = given or (positional[1] if len(positional) > 1 else None)
    if given is None:
        faults.add(line[-1].place, "*SOILSTIFF lacks MODEL", f"models are {', '.join(_ROWS)}")
        return None
    if given.text.upper() not in _ROWS:
        remedy = nearest(given.text, _ROWS)
        faults.add(given.place, f"there is no model '{given.text}' of *SOILSTIFF", remedy)
        return None
    return _ROWS[given.text.upper()]


def unused_soils(soils: Mapping[int, SoilStiffness], used: Collection[int | None]) -> Iterator[str]:
    """A note on soils that no line lies on."""
    ids = ", ".join(str(id_) for id_ in soils if id_ not in used)
    if ids:
        yield f"soil stiffness {ids} under no line: podeep-solve stiffness shows it under a pipe"


def read_suctions(
    paragraphs: Sequence[Paragraph], suctions: Registry[Suction], faults: Faults
) -> None:
    """Take in the lines of all *SUCTION; one at fault still names itself."""
    for paragraph in paragraphs:
        for values in read_lines(paragraph, KEYWORDS["SUCTION"], faults):
            made = _suction(values, faults) if values.sound else None
            suctions.add(values.cells.get("ID"), values.places.get("ID", values.place), made)


def _suction(values: Values, faults: Faults) -> Suction | None:
    """A suction whose law is within its bounds; a diameter cannot make it go beyond them."""
    arguments = values.arguments(KEYWORDS["SUCTION"].rows[0].columns)

    def make() -> Suction:
        suction = Suction(**arguments)
        pull_out_of(suction, 1.0)
        return suction

    return faults.guarded(make, values.places, values.place)
