"""Lines on the seabed: *TYPCONTACT with ITYP12 = 3."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from ..errors import Place
from ..scene import TRANSLATIONS, Line, SeabedContact, SoilStiffness, Suction
from .cells import Values, plain_number, read_lines
from .faults import Faults
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Field, Paragraph

_TYPCONTACT = KEYWORDS["TYPCONTACT"]


@dataclass(slots=True)
class Contacts:
    """Lines on the seabed as they are read, and what was assumed."""

    contacts: list[SeabedContact] = field(default_factory=list)
    places: dict[int, Place] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    sound: bool = True


def split_contacts(
    paragraphs: Sequence[Paragraph], faults: Faults
) -> tuple[list[Paragraph], list[Paragraph]]:
    """The paragraphs of *TYPCONTACT with tubes alone, and with lines on the seabed alone.

    Other kinds of contact are told.
    """
    tubes: list[Paragraph] = []
    seabed: list[Paragraph] = []
    for paragraph in paragraphs:
        kinds = [(_kind(line, faults), line) for line in paragraph.lines]
        for found, kind in ((tubes, 2), (seabed, 3)):
            lines = tuple(line for its, line in kinds if its == kind)
            if lines or not (paragraph.lines or kind == 3):  # without data it is told once
                found.append(replace(paragraph, lines=lines))
    return tubes, seabed


def _kind(line: Sequence[Field], faults: Faults) -> int:
    """ITYP12 of a line; 2 where it has none, and 0, which is told, for what is not read."""
    positional = [f for f in line if not f.name]
    given = next((f for f in line if f.name == "ITYP12"), None)
    given = given or (positional[2] if len(positional) > 2 else None)
    number = plain_number(given.text) if given else None
    if given is None or number is None or number in (2, 3):
        return int(number or 2)
    what = "lines on lines" if number == 1 else "such a contact"
    message = f"ITYP12 is {given.text}: {what} {'are' if number == 1 else 'is'} not read"
    faults.add(given.place, message, "2 is a tube inside a tube, 3 a line on the seabed")
    return 0


def read_contacts(
    paragraphs: Sequence[Paragraph],
    mudline: float | None,
    shared: Mapping[str, float],
    lines: Registry[Line],
    soils: Registry[SoilStiffness],
    suctions: Registry[Suction],
    faults: Faults,
) -> Contacts:
    """The lines on the seabed.

    mudline: of *DEPTH, None if it is at fault; shared: what *CONTACT gives.
    """
    found = Contacts()
    for paragraph in paragraphs:
        for values in read_lines(paragraph, _TYPCONTACT, faults, layout=1):
            if not values.sound:
                found.sound = False
                continue
            igr, place = values.cells["IGR2"], values.places["IGR2"]
            lines.get(igr, place)
            if found.places.setdefault(igr, place) is not place:
                message = f"line {igr} lies on the seabed already, at {found.places[igr]}"
                faults.add(place, message, "give it one contact with the seabed")
                continue
            for name, registry in (("ID1", soils), ("ID2", suctions)):
                if values.cells[name]:
                    registry.get(values.cells[name], values.places[name])
            contact = _contact(values, mudline, shared, faults) if mudline is not None else None
            found.contacts += [contact] if contact else []
            found.notes += _unused(values, igr)
    return found


def _contact(
    values: Values, mudline: float, shared: Mapping[str, float], faults: Faults
) -> SeabedContact | None:
    cells = values.cells
    arguments = values.arguments(_TYPCONTACT.rows[1].columns)
    arguments |= {name: arguments[name].lower() for name in ("surface", "form")}
    stiffness = cells["DENSITY"] * (cells["KN"] or shared.get("seabed_stiffness", 0.0))
    arguments |= {
        "stiffness": (stiffness or None) if not cells["ID1"] else None,
        "soil_stiffness": cells["ID1"] or None,
        "suction": cells["ID2"] or None,
    }
    if "tolerance" in shared:
        arguments["tolerance"] = shared["tolerance"]
    return faults.guarded(
        lambda: SeabedContact(mudline=mudline, **arguments), values.places, values.place
    )


def _unused(values: Values, igr: int) -> Iterator[str]:
    """Notes on values that have no effect."""
    if values.cells["ID1"] and values.cells["KN"]:
        yield f"KN has no effect on line {igr}: its seabed is soil stiffness {values.cells['ID1']}"
    if values.cells["CRIT_PROX"] not in (0.0, 10.0):
        yield f"CRIT_PROX has no effect on line {igr}: all of it is looked at"


def check_held(lines: Registry[Line], found: Contacts, faults: Faults) -> None:
    """Tell of lines that nothing holds along an axis: no end, no seabed, no friction."""
    contacts = {contact.line: contact for contact in found.contacts}
    for id_, line in lines.sound.items():
        if id_ in found.places and id_ not in contacts:
            continue  # its contact is at fault
        contact = contacts.get(id_)
        rubs = contact is not None and min(contact.axial_friction, contact.lateral_friction) > 0.0
        for dof in TRANSLATIONS:
            by_seabed = contact is not None if dof == "Z" else rubs
            if not by_seabed and not any(end.holds(dof) for end in line.ends):
                what = "no end and no seabed" if dof == "Z" else "no end and no friction"
                remedy = f"hold {dof} in *END, or lay the line on the seabed by *TYPCONTACT"
                remedy += "" if dof == "Z" else " with MU2 and MU3"
                faults.add(lines.places[id_], f"{what} holds line {id_} along {dof}", remedy)


def seabed_notes(
    lines: Mapping[int, Line], found: Contacts, suctions: Mapping[int, Suction]
) -> Iterator[str]:
    """Notes on lines without a seabed and suctions without a line."""
    yield from found.notes
    for id_ in lines:
        if id_ not in found.places:
            yield f"line {id_} hangs free of the seabed: no *TYPCONTACT names it"
    used = {contact.suction for contact in found.contacts}
    idle = ", ".join(str(id_) for id_ in suctions if id_ not in used)
    if idle:
        yield f"suction {idle} under no line"
