"""Figures of lines on the seabed, from the sample databases."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from podeep.arrays import Array
from podeep.database.read import open_database
from podeep.deck.read import read_deck
from podeep.line.peel import peeled
from podeep.picture import ZERO
from podeep.seabed.pull_out import pull_out_of

from .canvas import DASHED, INKS, KILO, SOLID, frame, legend, legend_and_styles, new_panels

HEAVING = Path(__file__).parents[2] / "sample_dbs" / "riser_heaving.dst"
LIFTED = Path(__file__).parents[2] / "sample_dbs" / "pipe_lifted.deck"


def lifted() -> tuple[Array, Array, Array]:
    """Of the sample: distances (n,), heights of its end (steps,) and moments (steps, n)."""
    height = read_deck(LIFTED).scene.line_motions[0].target
    with open_database(LIFTED.with_suffix(".dss")) as database:
        line = database.line("L1")
        factor = line.read("load_factor")[:, 0]
        return line.points, height * factor, line.read("line/bending_moment")


def closed(heights: Array) -> tuple[Array, Array]:
    """Its largest moment in closed form: without suction, and with as much work of it as it has.

    Suction of the closed form is rigid-plastic, on a rigid seabed.
    """
    scene = read_deck(LIFTED).scene
    (pipe,) = scene.lines[1].sections
    weight = pipe.submerged_weight(scene.sea.density, scene.sea.gravity)
    suction = scene.suctions[1]
    law = pull_out_of(suction, pipe.outer_diameter)
    force, share = float(law.force(suction.speed)), 0.5 * (1.0 + law.released - law.mobilised)
    reach = share * float(law.reach(suction.speed))
    free, held = (
        [peeled(h, pipe.bending_stiffness, weight, q, reach).largest_moment for h in heights]
        for q in (0.0, force)
    )
    return np.array(free), np.array(held)


def line_pipe_lifted() -> Figure:
    """Bending moments of a pipe as its end is lifted against suction, and as it is laid down."""
    s, up, moment = lifted()
    moment, top = KILO * moment, int(up.argmax())
    figure, (along, most) = new_panels(2, 4.4, width_ratios=(1.6, 1.0))
    for ink, step in zip(INKS, range(top, 0, -1), strict=True):
        along.plot(s, moment[step], color=ink, ls=SOLID, lw=1.6, label=f"{up[step]:g} m")
        if step < top:
            along.plot(s, moment[2 * top - step], color=ink, ls=DASHED, lw=1.6)
    frame(along, "Distance along the line (m)", "Bending moment (kN m)", title="Along the pipe")
    along.set_xlim(30.0, float(s[-1]))
    along.axhline(0.0, color=ZERO, lw=0.8)
    legend_and_styles(along, "upper left", "lifted", "laid down", title="Height of its end")
    heights = np.linspace(1e-3, up[top], 200)
    free, held = closed(heights)
    most.plot(heights, KILO * held, color=INKS[1], lw=1.6, label="suction, closed form")
    most.plot(heights, KILO * free, color=INKS[1], ls=DASHED, lw=1.6, label="none, closed form")
    largest = moment.max(axis=1)
    most.plot(up[: top + 1], largest[: top + 1], "o", color=ZERO, label="lifted")
    most.plot(up[top + 1 :], largest[top + 1 :], "o", color=ZERO, mfc="w", label="laid down")
    frame(most, "Height of the end (m)", "Largest moment (kN m)", title="Largest of each state")
    most.set_ylim(-0.6)
    legend(most, "lower right", fontsize=8)
    return figure


def line_riser_heaving() -> Figure:
    """Where a heaving riser touches down, and what the seabed gives along it in half a wave."""
    with open_database(HEAVING) as database:
        line = database.line("L1")
        time, s = line.read("time"), line.points
        touchdown, reaction = line.read("touchdown_distance"), line.read("normal_reaction")
    figure, (when, where) = new_panels(2, 4.0, width_ratios=(1.0, 1.2))
    when.plot(time, touchdown, color=INKS[0], ls=SOLID, lw=1.6)
    frame(when, "Time (s)", "Touchdown from end 1 (m)", float(time[-1]), title="In time")
    for ink, at in zip(INKS, (31.5, 34.5, 36.0), strict=False):
        row = int(np.abs(time - at).argmin())
        where.plot(s, KILO * reaction[row], color=ink, ls=SOLID, lw=1.6, label=f"{time[row]:g} s")
    frame(where, "Distance along the line (m)", "Normal reaction (kN/m)", title="Along the line")
    where.set_xlim(0.0, 50.0)
    where.axhline(0.0, color=ZERO, lw=0.8)
    legend(where, "upper right", title="Time")
    return figure
