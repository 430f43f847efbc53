"""The chart of the reference pile with OpenSees in it, for the manual.

    pip install "podeep[bench]" && python tests/bench/chart_reference.py

Writes docs/images/reference_pile_race.png and .csv: error against CPU time of the ten steps, for
series of meshes of both programs, planar and spatial.
"""

import one_thread  # noqa: F401, I001  # before numpy


import argparse
import csv
import io
import statistics
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from sys import path
from typing import TYPE_CHECKING, Any

import openseespy.opensees as ops

path.insert(0, str(Path(__file__).parent))
from opensees_pile import build_opensees, opensees_values
from our_pile import DEGREES, STEPS, Mesh, cpu, error, machine, our_values, steps_of

from podeep.picture import PALETTE, ZERO, new_figure, save_picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

IMAGES = Path(__file__).parents[2] / "docs" / "images"
STEM = "reference_pile_race"
OURS = (3, 4, 5, 6, 7, 8, 9, 11, 13, 16, 20, 26, 34, 48, 64, 96)  # elements of the whole tube
THEIRS = (24, 32, 48, 64, 96, 136, 192, 272, 384, 544, 768)  # embedded elements
PRESETS = (1.5e-4, 3e-5, 1e-6)  # errors that are marked
_LEAST = 2e-9  # smaller errors are those of the converged solution
_COLOURS = {3: PALETTE[4], 5: PALETTE[1], 7: PALETTE[0]}


@dataclass
class Point:
    """A mesh of one program: dimensions 2 (planar) or 3 (spatial), error, CPU times, s."""

    series: str
    dimensions: int
    elements: int
    error: float
    prepare: Callable[[], object]
    body: Callable[[], object]
    times: list[float]

    @property
    def milliseconds(self) -> float:
        return 1e3 * statistics.median(self.times)


def points() -> list[Point]:
    """All meshes that have an equilibrium in every step."""
    found = []
    for dimensions in (2, 3):
        for degree in DEGREES:
            for n in OURS:
                mesh = Mesh(dimensions - 1, n, degree)
                miss = error(our_values(mesh))
                name = f"podeep, degree {degree}"
                found.append(Point(name, dimensions, n, miss, lambda: None, steps_of(mesh), []))
        for n in THEIRS:
            miss = error(opensees_values(n, dimensions))
            name = "OpenSees, springs at nodes"
            found.append(Point(name, dimensions, n, miss, builder(n, dimensions), analyse, []))
    return [point for point in found if _LEAST < point.error < 1.0]


def builder(elements: int, dimensions: int) -> Callable[[], object]:
    return lambda: build_opensees(elements, dimensions)


def analyse() -> object:
    return ops.analyze(STEPS)


def draw(found: list[Point]) -> "Figure":
    """CPU time against error, planar left and spatial right."""
    figure = new_figure(11.0, 5.5)
    both = figure.subplots(1, 2, sharey=True)
    titles = ("planar, OpenSees in 2-D", "spatial, OpenSees in 3-D")
    for axes, dimensions, title in zip(both, (2, 3), titles, strict=True):
        panel(axes, [p for p in found if p.dimensions == dimensions])
        axes.set_title(title, loc="left", fontsize=10)
    both[0].set_ylabel("CPU time of ten steps (ms)")
    head = "Reference pile: speed against accuracy, with OpenSees"
    lines, labels = both[0].get_legend_handles_labels()
    place: dict[str, Any] = {"loc": "outside lower left", "ncols": len(labels)}
    figure.legend(lines, labels, frameon=False, fontsize=9, **place)
    figure.suptitle(f"{head}\n{machine()}", x=0.01, ha="left", fontsize=9)
    return figure


def panel(axes: "Axes", found: list[Point]) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.grid(color="#e4e4e4", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.set_xlabel("Larger relative error of head displacement and largest moment")
    for number, preset in enumerate(PRESETS):
        label = "_" if number else "errors 1.5e-4, 3e-5, 1e-6"  # matplotlib lists no "_"
        axes.axvline(preset, color=ZERO, linewidth=1.1, linestyle=":", label=label)
    for series in dict.fromkeys(p.series for p in found):
        places = [(p.error, p.milliseconds) for p in found if p.series == series]
        pen: dict[str, Any] = {"color": PALETTE[8], "marker": "s"}
        if series.startswith("podeep"):
            pen = {"color": _COLOURS[int(series[-1])], "marker": "o"}
        axes.plot(*zip(*places, strict=True), label=series, markersize=4.0, linewidth=1.5, **pen)


def table(found: list[Point]) -> str:
    """The same figures as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["series", "dimensions", "elements", "error", "cpu_ms"])
    for p in found:
        cells = (f"{p.error:.2e}", f"{p.milliseconds:.3f}")
        writer.writerow([p.series, p.dimensions, p.elements, *cells])
    return text.getvalue()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    found = points()
    for number in range(rounds):
        for point in found if number % 2 == 0 else reversed(found):
            point.prepare()
            point.times.append(cpu(point.body))
    for name in (f"{STEM}.png", f"{STEM}.csv"):
        (IMAGES / name).unlink(missing_ok=True)
    print(save_picture(lambda: draw(found), IMAGES, STEM))
    (IMAGES / f"{STEM}.csv").write_text(table(found), encoding="utf-8")


if __name__ == "__main__":
    main()
