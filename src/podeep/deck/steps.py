"""The steps in which loads are applied: *QUASISTATIC."""

from collections.abc import Collection, Iterator

from ..scene import Steps
from .actions import Actions
from .cells import Values, no_data, read_row
from .faults import Faults, nearest
from .keywords import KEYWORDS
from .scan import Paragraph

_QUASISTATIC = KEYWORDS["QUASISTATIC"]
_COUNT, _STEP = _QUASISTATIC.rows


def read_steps(
    paragraph: Paragraph | None,
    actions: Actions,
    driven: Collection[str],
    notes: list[str],
    faults: Faults,
) -> Steps | None:
    """The steps; one with all loads in full without *QUASISTATIC; None if they are at fault.

    driven: names of loads whose histories begin after the steps, which they leave alone unless they
    name them.
    """
    names = tuple(actions.names.values())
    if paragraph is not None:
        return _given_steps(paragraph, actions, driven, faults)
    if names:
        which = "all loads without a history" if driven else "all loads"
        notes.append(f"without *QUASISTATIC there is one step with {which} at factor 1")
    return Steps(names, (_ramped(names, driven, 1.0),))


def _ramped(names: Collection[str], driven: Collection[str], factor: float) -> tuple[float, ...]:
    """One factor for all loads but those that have a history."""
    return tuple(0.0 if name in driven else factor for name in names)


def _given_steps(
    paragraph: Paragraph, actions: Actions, driven: Collection[str], faults: Faults
) -> Steps | None:
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
        return Steps(names, tuple(_ramped(names, driven, i / count) for i in range(1, count + 1)))
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


def idle_names(steps: Steps, driven: Collection[str]) -> Iterator[str]:
    """Notes on loads that no step applies and that have no history."""
    for name, factors in zip(steps.names, zip(*steps.factors, strict=True), strict=True):
        if not any(factors) and name not in driven:
            yield f"{name} has the factor 0 in all steps"
