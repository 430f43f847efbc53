"""The keywords of tubes and of the foundations they make."""

from .column import IDS, IDS_OR_NONE, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row


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
    "*CASING\n1 PILE\n-58 -75  2.134 0.070 210e9 7850\n-75 -110 2.134 0.045 210e9 7850 EI=50e9\n"
    "*CASING\n2 INSERT\n-58 -100 1.6 0.04 210e9 7850",
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
    "*FONDATION\n1 1 2 -60",
    "Soil acts on the outermost tube at each level. An inner tube that *SLAVE does not name is "
    "cemented to the outermost one over all of their common length.",
    aliases=("FOUNDATION",),
    required=True,
)

SLAVE = Keyword(
    "SLAVE",
    "an inner tube that takes the motion of an outer one",
    (
        Row(
            "ties",
            (
                Column("OUTER", "outer tube", bounds=IDS, key="outer", kind="integer"),
                Column("INNER", "inner tube", bounds=IDS, key="inner", kind="integer"),
                Column(
                    "HOW",
                    "all along, or at the two ends alone",
                    key="how",
                    kind="word",
                    choices=("CEMENTED", "ENDS"),
                ),
                Column(
                    "ZTOP",
                    "elevation at which it begins",
                    "m",
                    key="top",
                    otherwise="where both tubes are",
                ),
                Column(
                    "ZBOT",
                    "elevation at which it ends",
                    "m",
                    key="bottom",
                    otherwise="where both tubes are",
                ),
            ),
        ),
    ),
    "*SLAVE\n1 2 CEMENTED -70 -100\n1 2 ENDS",
    "Tied are displacements, rotations and stretch. Where nothing ties two tubes, *TYPCONTACT says "
    "how one slides in the other.",
)


def _idle(name: str, meaning: str = "no effect here") -> Column:
    return Column(name, meaning, default=0.0)


def _unread(name: str, meaning: str, *choices: str) -> Column:
    """A value of the original that this version does not read, but as that of no effect."""
    return Column(
        name, f"{meaning}, not read by this version", choices=choices or ("0",), default=0.0
    )


def _threshold(name: str, direction: str) -> Column:
    return Column(
        name,
        f"slip {direction} at which friction is reached",
        "m",
        Bounds(0.0, 1e6),
        f"{'axial' if name == 'XSEUIL2' else 'lateral'}_threshold",
        otherwise="0.001, for 0 as well: rigid friction is not solved",
        none_at_zero=True,
    )


TYPCONTACT = Keyword(
    "TYPCONTACT",
    "a tube sliding inside another, or a line on the seabed",
    (
        Row(
            "a tube inside another",
            (
                Column("IGR1", "outer tube", bounds=IDS, key="outer", kind="integer"),
                Column("IGR2", "tube inside it", bounds=IDS, key="inner", kind="integer"),
                Column("ITYP12", "2: IGR2 slides inside IGR1", kind="integer", choices=("2",)),
                Column(
                    "MU2", "friction along the tubes", "-", NOT_NEGATIVE, "friction", default=0.0
                ),
                Column(
                    "MU3",
                    "friction across, none here",
                    "-",
                    NOT_NEGATIVE,
                    default=0.0,
                ),
                Column(
                    "KN",
                    "stiffness of a contact, 0: rigid",
                    "N/m",
                    NOT_NEGATIVE,
                    "stiffness",
                    default=0.0,
                ),
                Column(
                    "XSEUIL2",
                    "displacement at which friction is reached",
                    "m",
                    POSITIVE,
                    "threshold",
                    default=1e-3,
                ),
                Column("XSEUIL3", "the same across", "m", NOT_NEGATIVE, default=0.0),
                Column("DENSITY", "contacts per length", "1/m", POSITIVE, "density", default=1.0),
                *(
                    _idle(name)
                    for name in (
                        *("CRIT_PROX", "L_MINI", "ID1", "ID2", "FRICTMOM", "IDSTIFFAMP"),
                        *("RADRATIO", "IDTREN", "XMUO", "IDFAX", "IDFLAT", "INOR", "ISHELTER"),
                    )
                ),
                Column(
                    "GAP",
                    "room between the tubes on either side; negative: what their diameters leave",
                    "m",
                    key="clearance",
                    named=True,
                    default=0.0,
                ),
            ),
        ),
        Row(
            "a line on the seabed",
            (
                Column(
                    "IGR1",
                    "seabed at the elevation of *DEPTH, with ITYP12 = 3",
                    kind="integer",
                    choices=("0",),
                ),
                Column("IGR2", "line", bounds=IDS, key="line", kind="integer"),
                Column("ITYP12", "3: line IGR2 lies on the seabed", kind="integer", choices=("3",)),
                Column(
                    "MU2",
                    "friction along the line",
                    "-",
                    Bounds(0.0, 1e6),
                    "axial_friction",
                    default=0.0,
                ),
                Column(
                    "MU3",
                    "friction across it",
                    "-",
                    Bounds(0.0, 1e6),
                    "lateral_friction",
                    default=0.0,
                ),
                Column(
                    "KN",
                    "stiffness of a contact, 0: by ID1, or KN_SOL of *CONTACT",
                    "N/m",
                    Bounds(0.0, 1e15),
                    default=0.0,
                ),
                _threshold("XSEUIL2", "along"),
                _threshold("XSEUIL3", "across"),
                Column("DENSITY", "contacts per length", "1/m", Bounds(1e-6, 1e6), default=1.0),
                _idle("CRIT_PROX", "distance of the original's search, no effect here"),
                _unread("L_MINI", "value of the original"),
                Column(
                    "ID1",
                    "*SOILSTIFF of the seabed, 0: KN",
                    bounds=IDS_OR_NONE,
                    kind="integer",
                    default=0,
                ),
                Column(
                    "ID2",
                    "*SUCTION of the seabed, 0: none",
                    bounds=IDS_OR_NONE,
                    kind="integer",
                    default=0,
                ),
                _unread("FRICTMOM", "friction against torsion"),
                _unread("IDSTIFFAMP", "stiffness by amplitude"),
                _unread("RADRATIO", "value of the original, 0.2 by default", "0", "0.2"),
                _unread("IDTREN", "trench"),
                _unread("XMUO", "friction before a ramp"),
                _unread("IDFAX", "law of axial friction"),
                _unread("IDFLAT", "law of lateral friction"),
                _unread("INOR", "value of the original"),
                _unread("ISHELTER", "value of the original"),
                Column(
                    "SURFACE",
                    "limits of friction: BOX along and across separately, as the original; ELLIPSE "
                    "together",
                    key="surface",
                    kind="word",
                    choices=("BOX", "ELLIPSE"),
                    named=True,
                    default="BOX",
                ),
                Column(
                    "FORM",
                    "reaction INTEGRATED along the elements, or NODAL, lumped at nodes as the "
                    "original",
                    key="form",
                    kind="word",
                    choices=("INTEGRATED", "NODAL"),
                    named=True,
                    default="INTEGRATED",
                ),
            ),
        ),
    ),
    "*TYPCONTACT\n1 2 2 0.2 0 1e8 GAP=0.02\n"
    "0 11 3 0.3 0.6 5e4 0.01 0.03 1 10 0 0 1 SURFACE=ELLIPSE",
    "The original's 22 values; ITYP12 tells which of the two layouts they have. KN times DENSITY "
    "is the stiffness per length. Of tubes: those without use may be 0 or left out; without gap "
    "and friction, a rigid contact lets the tubes deflect as one and stretch apart. Of the seabed: "
    "ID1 names a *SOILSTIFF, in place of KN, and ID2 a *SUCTION; what is not read has to be 0 or "
    "left out. Lines on lines, ITYP12 = 1, are not read by this version.",
)

CONTACT = Keyword(
    "CONTACT",
    "what all contacts share",
    (
        Row(
            "contact",
            (
                *(_idle(name) for name in ("NBE", "NITCON", "NITNOR")),
                Column(
                    "KN",
                    "stiffness where *TYPCONTACT has none",
                    "N/m",
                    NOT_NEGATIVE,
                    "stiffness",
                    default=0.0,
                ),
                Column(
                    "DISCON",
                    "penetration over which a contact takes hold",
                    "m",
                    Bounds(0.0, 1e6, open=True),
                    "tolerance",
                    default=1e-4,
                ),
                *(_idle(name) for name in ("XL_MIN", "NBE_SOL")),
                Column(
                    "KN_SOL",
                    "stiffness of the seabed where *TYPCONTACT has none",
                    "N/m",
                    Bounds(0.0, 1e15),
                    "seabed_stiffness",
                    default=0.0,
                ),
                _idle("IT_EXIT"),
            ),
        ),
    ),
    "*CONTACT\n20 5 2 1e8 1e-4 0 0 5e4",
    "Contacts of tubes need KN and DISCON of its nine values, lines on the seabed KN_SOL and "
    "DISCON; the counts of the original's loops have no meaning here. KN_SOL times DENSITY of "
    "*TYPCONTACT is the stiffness per length.",
    once=True,
)
