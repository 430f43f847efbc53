"""What a chart of a line varies, as data, its errors, and the lines of a deck that ask for it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..arrays import Array
from ..deck.line_keywords import LINE
from ..line.assemble import mesh
from ..lines import Form, Line, LineSection
from ..scene import Scene, SeabedContact
from .chart import RelativeErrors, Setting, Words
from .settings import PRESETS


@dataclass(frozen=True, slots=True)
class LineSeries:
    """Settings that differ in their number of elements alone.

    form: of the contact with the seabed. graded: elements are as the program grades them, all
    shorter or longer; or of even length, as a run halves those that NEL of each section gives.
    """

    form: Form
    graded: bool

    @property
    def name(self) -> str:
        return f"{self.cells[0]}, {self.form}"

    @property
    def in_deck(self) -> bool:
        return not self.graded

    @property
    def cells(self) -> tuple[str, ...]:
        return "graded" if self.graded else "even", self.form

    def mesh(self, elements: int) -> str:
        return f"{elements} elements, {self.name}"


@dataclass(frozen=True, slots=True)
class LineErrors(RelativeErrors):
    """Errors of a line, each the largest of all states.

    tension, moment: at any place, over the largest one of any state; touchdown: of its distance,
    over the length of the line; reaction: of the largest normal force per length, over that of any
    state.
    """

    tension: float
    moment: float
    touchdown: float
    reaction: float


LINE_WORDS = Words(
    subject="Line",
    drawn=(
        ("moment", "Error of the moment at any place, over the largest"),
        ("tension", "Error of the tension at any place, over the largest"),
    ),
    margin=0.1,
    legend="Errors are the largest of tension, moment, touchdown and normal force, at any place "
    "and step. graded: lengths of elements as the program grades them, all longer or shorter; "
    "even: by NEL, whose elements a run halves; integrated: the seabed's reaction inside the "
    "elements; nodal: lumped at their ends",
    columns=("lengths", "reaction"),
    replaced="*ACCURACY and *LINE",
    unreached="no NEL that was measured reaches it",
)


@dataclass(frozen=True, slots=True)
class LinePlan:
    """How much is measured.

    series: each with how often the elements are halved, from the coarsest to the finest mesh; a
    negative number joins them. runs: of each setting that are timed, at most. seconds: of CPU
    time that all may take, about.
    """

    accuracies: tuple[float, ...]
    series: tuple[tuple[LineSeries, range], ...]
    runs: int
    seconds: float


_GRADED = LineSeries("integrated", graded=True)
_EVEN = LineSeries("integrated", graded=False)
_GRADED_NODAL = LineSeries("nodal", graded=True)
_EVEN_NODAL = LineSeries("nodal", graded=False)

FULL = LinePlan(
    PRESETS[:3],
    (
        (_GRADED, range(-2, 3)),
        (_EVEN, range(-1, 3)),
        (_GRADED_NODAL, range(-1, 3)),
        (_EVEN_NODAL, range(-1, 4)),
    ),
    runs=5,
    seconds=55.0,
)
QUICK = LinePlan(
    PRESETS[:2], ((_EVEN, range(-1, 2)), (_EVEN_NODAL, range(-1, 2))), runs=3, seconds=12.0
)


def free_of_numbers(line: Line) -> Line:
    """The line with its mesh left to the program."""
    return replace(line, sections=tuple(replace(one, elements=None) for one in line.sections))


def with_numbers(line: Line, elements: int) -> Line:
    """The line by the NEL of which a run makes so many elements, as even as sections allow.

    A run halves what NEL gives, once: there are two or more in a section, and an even number.
    """
    ends = np.cumsum([0.0, *(section.length for section in line.sections)]) / line.length
    more = max(round(0.5 * elements) - len(line.sections), 0)
    counts = 1 + np.diff(np.round(more * ends).astype(int))
    pairs = zip(line.sections, counts.tolist(), strict=True)
    return replace(line, sections=tuple(replace(one, elements=n) for one, n in pairs))


def meshes(scene: Scene, line: Line, plan: LinePlan) -> Iterator[tuple[Setting[LineSeries], Array]]:
    """Settings with their element boundaries, m, from coarse to fine."""
    contact = scene.seabed_under(line)
    base = mesh(scene, free_of_numbers(line), contact, 0)
    for halved in range(min(r.start for _, r in plan.series), max(r.stop for _, r in plan.series)):
        for series, wanted in plan.series:
            if halved not in wanted or (contact is None and series.form == "nodal"):
                continue
            if not series.graded:
                count = round((len(base) - 1) * 2.0**halved)
                edges = mesh(scene, with_numbers(line, count), contact, 1)
            elif halved >= 0:
                edges = mesh(scene, free_of_numbers(line), contact, halved)
            else:
                edges = _thinned(line, base, 2**-halved)
            yield Setting(series, len(edges) - 1), edges


def _thinned(line: Line, edges: Array, step: int) -> Array:
    """Every so-many-th boundary, and those of sections."""
    bounds = np.cumsum([0.0, *(section.length for section in line.sections)])
    at = np.abs(edges[:, None] - bounds).argmin(axis=0)
    kept = [edges[i:j:step] for i, j in pairwise(at.tolist())]
    return np.concatenate([*kept, edges[-1:]])


def line_deck_lines(
    line: Line, contact: SeabedContact | None, accuracy: float, setting: Setting[LineSeries] | None
) -> str:
    """The lines of a deck that ask for an accuracy and a setting, None: the program's own choice.

    What has to change in *TYPCONTACT is told in a comment.
    """
    lines = ["*ACCURACY", f"{accuracy:g}"]
    if setting is not None or any(section.elements is not None for section in line.sections):
        meshed = with_numbers(line, setting.elements) if setting else free_of_numbers(line)
        lines += ["*LINE", f"{line.id} {line.name}".rstrip(), *map(_row, meshed.sections)]
    form = setting.series.form if setting else "integrated"
    if contact is not None and contact.form != form:
        lines.append(f"C with FORM={form.upper()} for line {line.id} in *TYPCONTACT")
    return "\n".join(lines)


def _row(section: LineSection) -> str:
    """A section as *LINE has it."""
    cells = []
    for column in LINE.rows[1].columns:
        value = getattr(section, column.key)
        if value is not None and value != column.default:
            cells.append(f"{column.name}=" * column.named + _shortest(value))
    return " ".join(cells)


def _shortest(value: float) -> str:
    """The number in few signs that are read as the same one."""
    every = (f"{value:.{digits}g}" for digits in range(1, 18))
    return min((text for text in every if float(text) == value), key=len)
