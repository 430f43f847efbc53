"""The paragraphs of what holds and drives the tubes, and of the steps in which it does."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import radians

from ..errors import Place
from ..scene import Displacement, Load, Spring, Spudcan, Steps, Support
from .cells import Values, no_data, read_lines, read_row
from .faults import Faults, nearest
from .keywords import KEYWORDS
from .registry import Registry
from .scan import Paragraph
from .structure import ReadTube

_QUASISTATIC = KEYWORDS["QUASISTATIC"]
_COUNT, _STEP = _QUASISTATIC.rows
_FORCES, _MOMENTS = ("FX", "FY", "FZ"), ("MX", "MY", "MZ")


@dataclass(slots=True)
class Actions:
    """What holds and drives the tubes, as it is read.

    names: spelling of the loads' names by upper case, in the order of the deck; complete: every
    name could be read. sound: nothing was wrong, but for loads. uses: tubes referred to, with
    places. held, moved: degrees of freedom (tube, elevation, dof) of supports, displacements.
    """

    supports: list[Support] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    spudcans: list[Spudcan] = field(default_factory=list)
    loads: list[Load] = field(default_factory=list)
    displacements: list[Displacement] = field(default_factory=list)
    names: dict[str, str] = field(default_factory=dict)
    complete: bool = True
    sound: bool = True
    uses: list[tuple[int, Place]] = field(default_factory=list)
    held: dict[tuple[int, float, str], Place] = field(default_factory=dict)
    moved: dict[tuple[int, float, str], Place] = field(default_factory=dict)

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
    """All of *SUPPORT, *SPRING, *SPUDCAN, *LOAD and *DISPLACE."""
    actions = Actions()
    for paragraph in paragraphs:
        lines = read_lines(paragraph, KEYWORDS[paragraph.keyword], faults)
        for values in lines or [Values(paragraph.place, sound=False)]:
            _take(paragraph.keyword, values, actions, tubes, faults)
    for key, place in actions.moved.items():
        if key in actions.held:
            tube, elevation, dof = key
            faults.add(
                place,
                f"{dof} of tube {tube} at {elevation:g} m is held by *SUPPORT at "
                f"{actions.held[key]} and moved here",
                "take one of them out",
            )
            actions.sound = False
    return actions


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
    if not values.sound or not _on_tube(values, actions, tubes, faults):
        actions.sound &= keyword == "LOAD"
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
        case "LOAD":
            fx, fy, fz = (cells[c] for c in _FORCES)
            mx, my, mz = (cells[c] for c in _MOMENTS)
            actions.loads.append(Load(name, tube, elevation, (fx, fy, fz), (mx, my, mz)))
        case _:
            dof = cells["DOF"]
            value = radians(cells["VALUE"]) if dof.startswith("R") else cells["VALUE"]
            actions.displacements.append(Displacement(name, tube, elevation, dof, value))
            actions.moved.setdefault((tube, elevation, dof), values.places["DOF"])


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


def _on_tube(values: Values, actions: Actions, tubes: Registry[ReadTube], faults: Faults) -> bool:
    """Whether a line's tube exists and its elevation lies on it; otherwise it is told."""
    before = len(faults.found)
    igr, place = values.cells["IGR"], values.places["IGR"]
    known = tubes.get(igr, place)
    actions.uses.append((igr, place))
    if known is None or known.span is None:
        return False
    top, tip = known.span
    if not tip <= values.cells.get("Z", tip) <= top:
        faults.add(
            values.places["Z"],
            f"Z is {values.cells['Z']:g} m, but tube {igr} stands from {tip:g} to {top:g} m",
            "give an elevation from sea level, on the tube",
        )
    return len(faults.found) == before


def read_steps(paragraph: Paragraph, actions: Actions, faults: Faults) -> Steps | None:
    """The steps of *QUASISTATIC; None if they are at fault."""
    before = len(faults.found)
    names = tuple(actions.names.values())
    for option in paragraph.options:
        faults.add(option.place, "*QUASISTATIC has no options", "leave it out")
    if not paragraph.lines:
        no_data(paragraph, _STEP, faults)
        return None
    first, *more = paragraph.lines
    if len(first) == 1 and not more:
        values = read_row(first, _COUNT, _QUASISTATIC, paragraph.place, faults)
        if not values.sound:
            return None
        count = values.cells["NSTEPS"]
        return Steps(names, tuple((i / count,) * len(names) for i in range(1, count + 1)))
    now = dict.fromkeys(names, 0.0)
    factors = []
    misnumbered = False
    for expected, line in enumerate(paragraph.lines, start=1):
        values = read_row(line, _STEP, _QUASISTATIC, paragraph.place, faults)
        if not misnumbered and values.sound and values.cells["STEP"] != expected:
            misnumbered = True
            message = f"step {values.cells['STEP']} stands where step {expected} is expected"
            faults.add(values.places["STEP"], message, "steps are numbered from 1 without gaps")
        now |= dict(_factors(values, actions, faults))
        factors.append(tuple(now.values()))
    return Steps(names, tuple(factors)) if len(faults.found) == before else None


def _factors(values: Values, actions: Actions, faults: Faults) -> Iterator[tuple[str, float]]:
    """The names of a step with their factors."""
    seen = set()
    for cells, places in zip(values.group, values.group_places, strict=True):
        name = cells.get("NAME")
        if name is None:
            continue
        known = actions.names.get(name.upper())
        if name.upper() in seen:
            faults.add(places["NAME"], f"{name} is given twice in this step", "give it once")
        elif known is not None and "FACTOR" in cells:
            yield known, cells["FACTOR"]
        elif known is None and actions.complete and faults.complete:
            message = f"there is no load or displacement named {name}"
            faults.add(places["NAME"], message, nearest(name, actions.names.values()))
        seen.add(name.upper())


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


def idle_names(steps: Steps) -> Iterator[str]:
    """Notes on loads that no step applies."""
    for name, factors in zip(steps.names, zip(*steps.factors, strict=True), strict=True):
        if not any(factors):
            yield f"{name} has the factor 0 in all steps"
