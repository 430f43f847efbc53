"""The keywords of tubes and of the foundations they make."""

from .column import IDS, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row


def _override(name: str, meaning: str, unit: str, key: str) -> Column:
    return Column(
        name,
        meaning,
        unit,
        POSITIVE,
        key,
        named=True,
        otherwise="from OD, WT, E" if name != "MASS" else "from OD, WT, RHO",
    )


CASING = Keyword(
    "CASING",
    "a tube, section by section",
    (
        Row(
            "first line",
            (
                Column("IGR", "id of the tube", bounds=IDS, kind="integer"),
                Column("NAME", "name of the tube", kind="word", otherwise="none"),
            ),
        ),
        Row(
            "sections from top to bottom",
            (
                Column("ZTOP", "elevation of the top, from sea level", "m", key="top"),
                Column("ZBOT", "elevation of the bottom", "m", key="bottom"),
                Column(
                    "OD", "outer diameter, the width in the soil", "m", POSITIVE, "outer_diameter"
                ),
                Column(
                    "WT", "wall thickness, OD/2 for a solid bar", "m", POSITIVE, "wall_thickness"
                ),
                Column("E", "Young's modulus", "Pa", POSITIVE, "youngs_modulus"),
                Column("RHO", "density", "kg/m3", NOT_NEGATIVE, "density"),
                Column(
                    "NU", "Poisson's ratio", "-", Bounds(0.0, 0.5), "poisson_ratio", default=0.3
                ),
                _override("EI", "bending stiffness", "N m2", "bending_stiffness_override"),
                _override("EA", "axial stiffness", "N", "axial_stiffness_override"),
                _override("GAS", "shear stiffness", "N", "shear_stiffness_override"),
                _override("MASS", "mass per length", "kg/m", "mass_override"),
                Column(
                    "CA",
                    "added-mass coefficient",
                    "-",
                    NOT_NEGATIVE,
                    "added_mass_coefficient",
                    named=True,
                    default=0.0,
                ),
                Column(
                    "FILL",
                    "density of what stands inside",
                    "kg/m3",
                    NOT_NEGATIVE,
                    "fill_density",
                    named=True,
                    default=0.0,
                ),
            ),
        ),
    ),
    "*CASING\n1 PILE\n-58 -75  2.134 0.070 210e9 7850\n-75 -110 2.134 0.045 210e9 7850 EI=50e9",
    "A tube may stand above the mudline. RHO and MASS give its weight, for capacities; NU and GAS "
    "its stiffness in shear, for *MODEL, SHEAR=ON; CA and FILL are kept for dynamics.",
    required=True,
)

FONDATION = Keyword(
    "FONDATION",
    "tubes that stand in the soil",
    (
        Row(
            "foundations",
            (
                Column("ID", "id of the foundation", bounds=IDS, kind="integer"),
                Column(
                    "Z",
                    "elevation of its mudline; a negative last value is it, too",
                    "m",
                    Bounds(high=0.0),
                    named=True,
                    otherwise="that of *DEPTH",
                ),
            ),
            (Column("IGR", "tube, the outermost first", bounds=IDS, kind="integer"),),
        ),
    ),
    "*FONDATION\n1 1 -60",
    "This version reads foundations of one tube.",
    aliases=("FOUNDATION",),
    required=True,
)
