"""The keywords of the ground: depths, and the curves at each of them."""

from .column import IDS, IDS_OR_NONE, NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

GROUNDEPTH = Keyword(
    "GROUNDEPTH",
    "the soil depths at which curves are given",
    (
        Row(
            "depths, on one line or more",
            (
                Column(
                    "LOADS", "loads vary between depths, not parameters", kind="flag", named=True
                ),
                Column(
                    "LAYERING",
                    "layers by equivalent depth",
                    key="layering",
                    kind="word",
                    choices=("NONE", "GEORGIADIS"),
                    named=True,
                    default="NONE",
                ),
                Column(
                    "OVERBURDEN",
                    "in an equivalent depth: of the layer's own soil, or the actual one",
                    key="layering_overburden",
                    kind="word",
                    choices=("OWN", "ACTUAL"),
                    named=True,
                    default="OWN",
                ),
            ),
            (
                Column(
                    "Z",
                    "soil depth: 0, then negative, never rising; given twice, a jump of layers",
                    "m from the mudline",
                    Bounds(high=0.0),
                ),
            ),
        ),
    ),
    "*GROUNDEPTH\n0 -9 -9 -24",
    "Between two depths whose curves are of one predefined type, parameters vary linearly and the "
    "law is evaluated at the true depth; otherwise, and with *GROUNDEPTH, LOADS, loads vary "
    "linearly. With LAYERING=GEORGIADIS the law is evaluated at the equivalent depth, at which a "
    "layer's own soil would resist as much in all as the layers above it do; k z keeps the actual "
    "depth. Rock, ISO's clay, PISA and user curves keep theirs.",
    aliases=("GROUNDDEPTH",),
    once=True,
    required=True,
    optioned=True,
)

GROUNDPROP = Keyword(
    "GROUNDPROP",
    "the curves at each depth of *GROUNDEPTH",
    (
        Row(
            "a pair for each depth, then [IKTSO [IDRE]], on one line or more",
            (
                Column(
                    "IKTSO",
                    "slope of friction against displacement (SHAPE=EP)",
                    "Pa/m",
                    POSITIVE,
                    named=True,
                    default=1e8,
                ),
                Column(
                    "IDRE",
                    "soil force in dynamics: 0 static and dynamic, 1 dynamic alone, "
                    "2 total on the static curve, 3 total on the dynamic curve",
                    kind="integer",
                    choices=("0", "1", "2", "3"),
                    named=True,
                    default=0,
                ),
            ),
            (
                Column("IY", "p-y curve, 0 for none", bounds=IDS_OR_NONE, kind="integer"),
                Column("IZ", "t-z curve, 0 for none", bounds=IDS_OR_NONE, kind="integer"),
            ),
        ),
    ),
    "*GROUNDPROP\n1 1  3 1  2 2  2 2  1e8 0",
    "N depths take 2N values, 2N+1 with IKTSO or 2N+2 with IKTSO and IDRE, which may also go by "
    "name. Under the last depth its curves go on.",
    once=True,
    required=True,
    optioned=True,
)

RADIATION = Keyword(
    "RADIATION",
    "dashpots of p-y curves, for waves in the soil",
    (
        Row(
            "dashpots",
            (
                Column("NCUR", "p-y curve", bounds=IDS, kind="integer"),
                Column("C", "damping", "N s/m2 per metre of width", NOT_NEGATIVE),
            ),
        ),
    ),
    "*RADIATION\n1 4e5",
    "C times the width of the tube resists its velocity. It varies linearly between the depths of "
    "*GROUNDEPTH, and is 0 for a curve that is not named.",
)
