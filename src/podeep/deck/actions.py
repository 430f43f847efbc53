"""The paragraphs of what holds and drives the tubes, and of where these start."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import radians

from ..errors import Place
from ..scene import CoupledSpring, Displacement, Load, Mass, Spring, Spudcan, Start, Support
from .cells import Values, read_lines
from .faults import Faults
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Paragraph
from .structure import ReadTube

#: keywords that may hold a tube along z, and all that act on tubes
HOLDING = ("SUPPORT", "SPRING", "SPUDCAN", "DISPLACE")
ACTING = (*HOLDING, "LOAD", "MASS", "STIFFNESS", "INITIAL")

_FORCES, _MOMENTS = ("FX", "FY", "FZ"), ("MX", "MY", "MZ")
_INERTIAS = ("JXX", "JYY", "JZZ")

#: a degree of freedom: tube, elevation, DOF
_Dof = tuple[int, float, str]


@dataclass(slots=True)
class Actions:
    """What holds and drives the tubes, as it is read.

    names: spelling of the loads' names by upper case, in the order of the deck; complete: every
    name could be read. sound: nothing was wrong with what may hold a tube. uses: tubes referred to,
    with places. held, moved, started: degrees of freedom of supports, displacements, starts.
    """

    supports: list[Support] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    coupled_springs: list[CoupledSpring] = field(default_factory=list)
    spudcans: list[Spudcan] = field(default_factory=list)
    masses: list[Mass] = field(default_factory=list)
    loads: list[Load] = field(default_factory=list)
    displacements: list[Displacement] = field(default_factory=list)
    starts: list[Start] = field(default_factory=list)
    names: dict[str, str] = field(default_factory=dict)
    complete: bool = True
    sound: bool = True
    uses: list[tuple[int, Place]] = field(default_factory=list)
    held: dict[_Dof, Place] = field(default_factory=dict)
    moved: dict[_Dof, Place] = field(default_factory=dict)
    started: dict[_Dof, Place] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def act_axially_on(self, tubes: Sequence[int]) -> bool:
        """Whether a support, spring, spudcan or displacement holds one of the tubes along z."""
        held = [s.tube for s in self.spudcans]
        held += [s.tube for s in self.supports if "Z" in s.dofs]
        held += [s.tube for s in self.springs if s.dof == "Z"]
        held += [d.tube for d in self.displacements if d.dof == "Z"]
        return any(tube in tubes for tube in held)


def read_actions(
    paragraphs: Sequence[Paragraph], tubes: Registry[ReadTube], faults: Faults
) -> Actions:
    """All that acts on tubes, in the order of the deck."""
    actions = Actions()
    for paragraph in paragraphs:
        lines = read_lines(paragraph, KEYWORDS[paragraph.keyword], faults)
        for values in lines or [Values(paragraph.place, sound=False)]:
            _take(paragraph.keyword, values, actions, tubes, faults)
    _check_apart(actions.moved, "moved", actions.held, "held by *SUPPORT", actions, faults)
    _check_apart(actions.started, "started", actions.held, "held by *SUPPORT", actions, faults)
    _check_apart(actions.started, "started", actions.moved, "moved by *DISPLACE", actions, faults)
    return actions


def _check_apart(
    dofs: Mapping[_Dof, Place],
    what: str,
    others: Mapping[_Dof, Place],
    how: str,
    actions: Actions,
    faults: Faults,
) -> None:
    """Tell of degrees of freedom that two keywords give a motion of their own."""
    for key, place in dofs.items():
        if key in others:
            tube, elevation, dof = key
            faults.add(
                place,
                f"{dof} of tube {tube} at {elevation:g} m is {how} at {others[key]} and {what} "
                "here",
                "take one of them out",
            )
            actions.sound = False


def _take(
    keyword: str,
    values: Values,
    actions: Actions,
    tubes: Registry[ReadTube],
    faults: Faults,
) -> None:
    """Take in one line; one at fault still names its load."""
    name: str = values.cells.get("NAME", "")
    if name:
        name = actions.names.setdefault(name.upper(), name)
    elif keyword in ("LOAD", "DISPLACE"):
        actions.complete = False
    if not values.sound or not _on_tube(keyword, values, actions, tubes, faults):
        actions.sound &= keyword not in HOLDING
        return
    cells = values.cells
    if keyword == "SPUDCAN":
        _spudcan(values, actions, faults)
        return
    tube, elevation = cells["IGR"], cells["Z"]
    match keyword:
        case "SUPPORT":
            dofs = tuple(dict.fromkeys(one["DOF"] for one in values.group))
            actions.supports.append(Support(tube, elevation, dofs))
            for dof, where in zip(values.group, values.group_places, strict=True):
                actions.held.setdefault((tube, elevation, dof["DOF"]), where["DOF"])
        case "SPRING":
            actions.springs.append(Spring(tube, elevation, cells["DOF"], cells["K"]))
        case "STIFFNESS":
            arguments = values.arguments(KEYWORDS[keyword].rows[0].columns)
            spring = faults.guarded(lambda: CoupledSpring(**arguments), values.places, values.place)
            actions.coupled_springs += [spring] if spring else []
        case "MASS":
            jxx, jyy, jzz = (cells[c] for c in _INERTIAS)
            actions.masses.append(Mass(tube, elevation, cells["M"], (jxx, jyy, jzz)))
        case "LOAD":
            fx, fy, fz = (cells[c] for c in _FORCES)
            mx, my, mz = (cells[c] for c in _MOMENTS)
            actions.loads.append(Load(name, tube, elevation, (fx, fy, fz), (mx, my, mz)))
        case "INITIAL":
            _start(values, actions, faults)
        case _:
            dof = cells["DOF"]
            value = _turned(dof, cells["VALUE"])
            actions.displacements.append(Displacement(name, tube, elevation, dof, value))
            actions.moved.setdefault((tube, elevation, dof), values.places["DOF"])


def _turned(dof: str, value: float) -> float:
    """A value of a degree of freedom as the scene has it: rotations in radians."""
    return radians(value) if dof.startswith("R") else value


def _start(values: Values, actions: Actions, faults: Faults) -> None:
    """Take in where a degree of freedom starts; a second one of the same is told."""
    cells, place = values.cells, values.places["DOF"]
    tube, elevation, dof = (cells[name] for name in ("IGR", "Z", "DOF"))
    first = actions.started.setdefault((tube, elevation, dof), place)
    if first is not place:
        message = f"{dof} of tube {tube} at {elevation:g} m starts twice, first at {first}"
        faults.add(place, message, "give it once")
        return
    value, velocity = (_turned(dof, cells[name]) for name in ("VALUE", "VELOCITY"))
    actions.starts.append(Start(tube, elevation, dof, value, velocity))


def _spudcan(values: Values, actions: Actions, faults: Faults) -> None:
    """Take in a spudcan; a second one under the same tube is told."""
    columns = KEYWORDS["SPUDCAN"].rows[0].columns
    arguments, tube = values.arguments(columns), values.cells["IGR"]
    if any(known.tube == tube for known in actions.spudcans):
        message = f"tube {tube} already has a spudcan"
        faults.add(values.places["IGR"], message, "a tube has one tip: take one out")
        return
    made = faults.guarded(lambda: Spudcan(**arguments), values.places, values.place)
    if made is not None:
        actions.spudcans.append(made)


def _on_tube(
    keyword: str, values: Values, actions: Actions, tubes: Registry[ReadTube], faults: Faults
) -> bool:
    """Whether a line's tube exists and its elevation lies on it; otherwise it is told.

    A mass may also stand above the tube, which is noted.
    """
    before = len(faults.found)
    igr, place = values.cells["IGR"], values.places["IGR"]
    known = tubes.get(igr, place)
    actions.uses.append((igr, place))
    if known is None or known.span is None:
        return False
    top, tip = known.span
    z = values.cells.get("Z", tip)
    if keyword == "MASS" and z > top:
        actions.notes.append(
            f"the mass of tube {igr} at {z:g} m stands {z - top:g} m above its top, on a rigid arm"
        )
    elif keyword == "MASS" and z < tip:
        message = f"Z is {z:g} m, but tube {igr} ends at {tip:g} m"
        faults.add(values.places["Z"], message, "give an elevation from sea level, above its tip")
    elif not tip <= z <= top:
        faults.add(
            values.places["Z"],
            f"Z is {z:g} m, but tube {igr} stands from {tip:g} to {top:g} m",
            "give an elevation from sea level, on the tube",
        )
    return len(faults.found) == before


def likely_data(paragraphs: Sequence[Paragraph]) -> Iterator[str]:
    """Notes on comment lines that look like loads whose name starts with C."""
    for paragraph in paragraphs:
        for place in paragraph.comments:
            name, *values = place.text.partition("!")[0].split()
            if len(name) > 1 and name.isalnum() and len(values) >= 4 and values[0].isdigit():
                yield (
                    f"{place.file}:{place.line} starts with C and is a comment; "
                    f"indent it if {name} is the name of a load"
                )
