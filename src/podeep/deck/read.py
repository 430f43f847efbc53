"""A deck becomes a scene: every paragraph read, every reference resolved, every fault told."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..scene import (
    NO_GROUND,
    Curve,
    Foundation,
    Ground,
    Line,
    Newton,
    Numerics,
    Scene,
    Sea,
    SoilStiffness,
    Suction,
    Support,
)
from .actions import ACTING, HOLDING, Actions, likely_data, read_actions
from .curves import axial_curve, lateral_curve
from .dynamics import read_damping, read_dynamics
from .faults import Faults
from .foundations import ReadFoundation, check_foundations, read_foundations
from .ground import (
    Depths,
    reacts_axially,
    read_dashpots,
    read_depths,
    read_ground,
    unused_curves,
)
from .histories import read_histories
from .keywords import KEYWORDS
from .line_motions import read_line_motions
from .lines import read_pipes
from .paragraphs import Sorted, sort_paragraphs
from .registry import Registry
from .scan import Paragraph, scan
from .seabed import read_soil_stiffnesses, read_suctions, unused_soils
from .seabed_contacts import Contacts, check_held, read_contacts, seabed_notes, split_contacts
from .steps import idle_names, read_steps
from .structure import ReadTube, read_tube
from .ties import Ties, read_ties


@dataclass(frozen=True)
class Deck:
    """A deck that was read.

    text: the deck with the files it includes in their places. solve: it ends in *EXEC, not *STOP.
    notes: assumptions and oddities worth telling.
    """

    scene: Scene
    text: str
    solve: bool
    notes: tuple[str, ...]


def read_deck(path: Path) -> Deck:
    """Read a deck and the files it includes.

    Raises UserError with all faults of the deck (20 at most), or if it cannot be read at all.
    """
    faults = Faults()
    scanned = scan(path, faults)
    given = sort_paragraphs(scanned, faults)
    notes: list[str] = []

    title = _title(given, faults)
    ground = NO_GROUND if given.lines_alone else _ground(given, notes, faults)
    tubes: Registry[ReadTube] = Registry(
        "tube", "CASING", faults, complete=given.complete("CASING")
    )
    for paragraph in given.of["CASING"]:
        read_tube(paragraph, tubes, faults)
    lines = read_pipes(given, tubes, faults)
    foundations = _foundations(given, tubes, faults)
    soils: Registry[SoilStiffness] = Registry(
        "soil stiffness", "SOILSTIFF", faults, complete=given.complete("SOILSTIFF")
    )
    read_soil_stiffnesses(given.of["SOILSTIFF"], soils, faults)
    suctions: Registry[Suction] = Registry(
        "suction", "SUCTION", faults, complete=given.complete("SUCTION")
    )
    read_suctions(given.of["SUCTION"], suctions, faults)
    in_tubes, on_seabed = split_contacts(given.of["TYPCONTACT"], faults)
    contacts = _contacts(given, on_seabed, lines, soils, suctions, faults)

    acting = [p for p in scanned.paragraphs if p.keyword in ACTING]
    actions = read_actions(acting, tubes, faults)
    moved = read_line_motions(given.of["MOTION"], lines, actions, faults)
    actions.complete &= given.complete("LOAD", "DISPLACE", "MOTION")
    _check_uses(given, foundations, tubes, actions, faults)
    numerics = _arguments(given, "ACCURACY") | _model(given, faults)
    if not numerics.get("axial_curves", True):
        notes += _tip_supports(foundations, tubes, actions)
    elif ground is not None and actions.sound and given.complete(*HOLDING):
        _check_axial(foundations, tubes, ground, actions, faults)
    tied = _ties(given, in_tubes, foundations, tubes, actions, notes, faults)
    dynamics = read_dynamics(given, notes, faults)
    damping = read_damping(given.one("DAMPING"), faults)
    histories = read_histories(given.of["HARMONIC"], given.of["TIMESERIES"], actions, faults)
    # a history has no effect without motion: then its load is stepped like the others
    driven = histories.places if given.of["DYNAMIC"] else {}
    if not (actions.names or given.of["LINE"]):
        notes.append("there is no *LOAD and no *DISPLACE: nothing moves")
    steps = read_steps(given.one("QUASISTATIC"), actions, driven, notes, faults)
    newton = _arguments(given, "NEWTONSTAT")
    faults.check()

    if ground is None or steps is None:  # whatever stands in their way is a fault
        raise RuntimeError(f"{path}: no ground or no steps, and no fault")
    scene = Scene(
        title,
        MappingProxyType({i: t.tube for i, t in tubes.sound.items() if t.tube is not None}),
        tuple(f.foundation for f in foundations if f.foundation is not None),
        ground,
        tuple(actions.supports),
        tuple(actions.springs),
        tuple(actions.spudcans),
        tuple(actions.loads),
        tuple(actions.displacements),
        steps,
        Newton(**newton),
        Numerics(**numerics),
        Sea(**_arguments(given, "SEA")),
        tied.ties,
        tied.slidings,
        tuple(actions.masses),
        tuple(actions.coupled_springs),
        tuple(actions.starts),
        tuple(histories.harmonics),
        tuple(histories.series),
        damping,
        dynamics,
        MappingProxyType(soils.sound),
        MappingProxyType(lines.sound),
        tuple(contacts.contacts),
        MappingProxyType(suctions.sound),
        moved,
    )
    notes += actions.notes
    in_time = any(one.moves_in_time for one in moved)
    if in_time and not given.of["DYNAMIC"]:
        notes.append("waves and records of *MOTION have no effect without *DYNAMIC")
    if dynamics and not (histories.places or actions.starts or in_time):
        notes.append("no history and no start: in motion the loads stay as the steps leave them")
    notes += [*unused_curves(ground), *_unused_tubes(scene), *idle_names(steps, driven)]
    notes += unused_soils(scene.soil_stiffnesses, [c.soil_stiffness for c in contacts.contacts])
    notes += seabed_notes(scene.lines, contacts, scene.suctions)
    notes += likely_data(acting)
    return Deck(scene, scanned.text, bool(given.of["EXEC"]), tuple(notes))


def _title(given: Sorted, faults: Faults) -> str:
    paragraph = given.one("TITLE")
    if paragraph is None:
        return ""
    if not paragraph.lines:
        faults.add(paragraph.place, "*TITLE has no text", "write it on the next line")
        return ""
    for line in paragraph.lines[1:2]:
        message = "the title is one line, but more follows"
        faults.add(line[0].place, message, "start a comment with C or !")
    return paragraph.lines[0][0].text


def _ground(given: Sorted, notes: list[str], faults: Faults) -> Ground | None:
    """The ground with its curves; None, for which there is a fault."""
    lateral: Registry[Curve] = Registry(
        "p-y curve", "PYCURVE", faults, complete=given.complete("PYCURVE")
    )
    axial: Registry[Curve] = Registry(
        "t-z curve", "TZCURVE", faults, complete=given.complete("TZCURVE")
    )
    for keyword, read, registry in (
        ("PYCURVE", lateral_curve, lateral),
        ("TZCURVE", axial_curve, axial),
    ):
        for paragraph in given.of[keyword]:
            found = read(paragraph, faults)
            registry.add(found.id, found.place, found.curve)
            notes += found.notes
    depths, curves = given.one("GROUNDEPTH"), given.one("GROUNDPROP")
    known = read_depths(depths, faults) if depths else Depths((), "PARAMETERS", False)
    dashpots = read_dashpots(given.of["RADIATION"], lateral, faults)
    return read_ground(curves, known, lateral, axial, dashpots, faults) if curves else None


def _foundations(given: Sorted, tubes: Registry[ReadTube], faults: Faults) -> list[ReadFoundation]:
    depth = given.line("DEPTH")
    mudline = depth.cells["Z"] if depth else None
    found = [
        foundation
        for paragraph in given.of["FONDATION"]
        for foundation in read_foundations(paragraph, mudline, tubes, faults)
    ]
    check_foundations(found, faults)
    return found


def _check_uses(
    given: Sorted,
    foundations: Sequence[ReadFoundation],
    tubes: Registry[ReadTube],
    actions: Actions,
    faults: Faults,
) -> None:
    """Tell of actions on a tube that stands in no foundation: nothing would come of them."""
    named = {igr for f in foundations for igr, _ in f.tubes}
    if not named or not all(f.tubes for f in foundations) or not given.complete("FONDATION"):
        return
    for igr, place in actions.uses:
        if igr in tubes.places and igr not in named:
            message = f"tube {igr} stands in no *FONDATION"
            faults.add(place, message, "name it in one, or take this out")


def _contacts(
    given: Sorted,
    paragraphs: Sequence[Paragraph],
    lines: Registry[Line],
    soils: Registry[SoilStiffness],
    suctions: Registry[Suction],
    faults: Faults,
) -> Contacts:
    """The lines on the seabed; all lines are held by it or by their ends."""
    depth, shared = given.line("DEPTH"), _arguments(given, "CONTACT")
    mudline = depth.cells["Z"] if depth else None
    found = read_contacts(paragraphs, mudline, shared, lines, soils, suctions, faults)
    if found.sound and given.complete("TYPCONTACT"):
        check_held(lines, found, faults)
    return found


def _ties(
    given: Sorted,
    contacts: Sequence[Paragraph],
    foundations: Sequence[ReadFoundation],
    tubes: Registry[ReadTube],
    actions: Actions,
    notes: list[str],
    faults: Faults,
) -> Ties:
    """How the tubes of each foundation hold each other."""
    shared = _arguments(given, "CONTACT")
    sound = [f.foundation for f in foundations if f.foundation is not None]
    complete = len(sound) == len(foundations) and given.complete("FONDATION", "SLAVE")
    slaves, known = given.of["SLAVE"], sound if complete else []
    found = read_ties(slaves, contacts, shared, known, tubes, actions, faults)
    notes += found.notes
    return found


def _check_axial(
    foundations: Sequence[ReadFoundation],
    tubes: Registry[ReadTube],
    ground: Ground,
    actions: Actions,
    faults: Faults,
) -> None:
    """Tell of foundations that nothing holds along z."""
    for read in foundations:
        if read.foundation is None:
            continue
        tube, tip = _deepest(read.foundation, tubes)
        length = read.foundation.mudline - tip
        if not (reacts_axially(ground, length) or actions.act_axially_on(read.foundation.tubes)):
            faults.add(
                read.place,
                f"nothing holds foundation {read.foundation.id} along z: no t-z curve resists on "
                f"its {length:g} m, no support or spring does",
                f"give t-z curves, or *SUPPORT with the line {tube} {tip:g} Z",
            )


def _tip_supports(
    foundations: Sequence[ReadFoundation], tubes: Registry[ReadTube], actions: Actions
) -> Iterator[str]:
    """Hold the lowest tip of what nothing else holds along z, and tell of it."""
    for read in foundations:
        if read.foundation is None or actions.act_axially_on(read.foundation.tubes):
            continue
        tube, tip = _deepest(read.foundation, tubes)
        actions.supports.append(Support(tube, tip, ("Z",)))
        yield f"TZ=OFF: tube {tube} is held along z at its tip, {tip:g} m, alone"


def _deepest(foundation: Foundation, tubes: Registry[ReadTube]) -> tuple[int, float]:
    """The tube that reaches deepest, the outermost of several, and the elevation of its tip."""
    spans = {igr: tubes.items[igr] for igr in foundation.tubes}
    tips = {igr: t.span[1] for igr, t in spans.items() if t is not None and t.span is not None}
    igr = min(tips, key=lambda i: tips[i])
    return igr, tips[igr]


#: words of *MODEL that exclude each other: what the scene calls their choice, and its values
_CHOICES = (
    ("SMALL", "PDELTA", "second_order", (False, True)),
    ("PLANAR", "SPATIAL", "components", (1, 2)),
)


def _model(given: Sorted, faults: Faults) -> dict[str, Any]:
    """What *MODEL forces."""
    values = given.line("MODEL")
    forced = _arguments(given, "MODEL")
    if "length" in forced:
        forced["active_length"] = forced.pop("length") == "ACTIVE"
    for first, second, name, choices in _CHOICES:
        one, other = (bool(forced.pop(word.lower(), False)) for word in (first, second))
        if one and other and values is not None:
            message = f"{first} and {second} exclude each other"
            faults.add(values.places[first], message, "give one")
        elif one or other:
            forced[name] = choices[other]
    return forced


def _arguments(given: Sorted, keyword: str) -> dict[str, Any]:
    """The values of a keyword by what the scene calls them; empty if it is missing."""
    values = given.line(keyword)
    return values.arguments(KEYWORDS[keyword].rows[0].columns) if values else {}


def _unused_tubes(scene: Scene) -> Iterator[str]:
    used = {tube for foundation in scene.foundations for tube in foundation.tubes}
    for id_ in scene.tubes:
        if id_ not in used:
            yield f"tube {id_} stands in no *FONDATION and is left out"
