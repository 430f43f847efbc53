"""The figures of the pages on laws and on lines, drawn with the laws and samples themselves.

A figure is a function named as its file and listed here; the docs build writes them all into
docs/generated/laws.
"""

from pathlib import Path

from . import axial, clay, layers, lines, pisa, sand_rock, seabed, spudcan
from .canvas import png_of

FIGURES = {
    draw.__name__: draw
    for draw in (
        clay.soft_clay_shapes,
        clay.soft_clay_depths,
        clay.stiff_clay_free_water,
        clay.stiff_clay,
        clay.iso_clay_shapes,
        clay.iso_clay_factor,
        sand_rock.sand_factors,
        sand_rock.sand_depths,
        sand_rock.reese_sand,
        sand_rock.reese_sand_charts,
        sand_rock.weak_rock,
        pisa.pisa_lateral,
        pisa.pisa_reactions,
        axial.tz_qz,
        axial.unit_friction_bearing,
        axial.axial_capacity_depths,
        layers.user_curves,
        layers.layering,
        layers.groups,
        layers.lateral_capacity,
        spudcan.spudcan_yield,
        spudcan.spudcan_capacity,
        seabed.seabed_suction_cycle,
        seabed.seabed_suction_speed,
        seabed.seabed_friction,
        seabed.seabed_hyperbolic,
        lines.line_pipe_lifted,
        lines.line_riser_heaving,
    )
}


def write_figures(folder: Path) -> None:
    """Write every figure into a folder; a file that is the same already is left alone."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in FIGURES:
        path, picture = folder / f"{name}.png", png(name)
        if not path.exists() or path.read_bytes() != picture:
            path.write_bytes(picture)


def png(name: str) -> bytes:
    """A figure as the bytes of a PNG file."""
    return png_of(FIGURES[name])
