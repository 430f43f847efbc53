"""The keywords of the soil under pipes on the seabed: its stiffness by models, and suction."""

from ..seabed.models import MODELS, NOT_FOUND, Model
from ..seabed.parameters import Parameter
from .column import IDS, POSITIVE, Bounds, Column, Keyword, Row


def _column(model: Model, parameter: Parameter) -> Column:
    """A parameter; one with a default goes by name."""
    optional = parameter.key in model.optional
    default = model.default(parameter.key) if optional else None
    return Column(
        parameter.symbol,
        parameter.meaning,
        parameter.unit,
        Bounds(parameter.low, parameter.high),
        parameter.key,
        named=default is not None,
        default=default,
        otherwise=parameter.otherwise if optional else "",
    )


def _row(model: Model) -> Row:
    return Row(
        f"{model.name}: {model.title}",
        (
            Column("ID", "id of the soil", bounds=IDS, kind="integer"),
            Column("MODEL", "model", kind="word", choices=(model.name,)),
            *(_column(model, parameter) for parameter in model.parameters),
        ),
        law=model.name,
    )


SOILSTIFF = Keyword(
    "SOILSTIFF",
    "stiffness of the soil under a pipe on the seabed",
    tuple(_row(model) for model in MODELS.values()),
    "*SOILSTIFF\n"
    "1 DNV14CLAY 5e3 5e3 2.0 0.45\n"
    "2 DNV14SAND 9.1e3 30 0.7 0.35 NG=1.5\n"
    "3 DIRECT 160e3 500e3        ! KS KD",
    "A line for each soil. podeep-solve stiffness shows what it makes of a pipe. Not found in "
    f"public text: {'; '.join(NOT_FOUND)}. AUDIBERTCLAY and AUDIBERTSAND are reconstructed from "
    "other papers and not the formula of DeepLines.",
)


def _named(name: str, meaning: str, unit: str, bounds: Bounds, key: str, otherwise: str) -> Column:
    return Column(name, meaning, unit, bounds, key, named=True, otherwise=otherwise)


_EXPONENT = Bounds(0.0, 1.0)
_CUT = Bounds(1e-6, 0.95)

SUCTION = Keyword(
    "SUCTION",
    "how the seabed holds a line that is pulled out",
    (
        Row(
            "suction",
            (
                Column("ID", "id of the suction", bounds=IDS, key="id", kind="integer"),
                Column(
                    "ALPHAF",
                    "factor of the force per length",
                    "N/m at 1 m/s",
                    Bounds(0.0, 1e12),
                    "force_factor",
                    otherwise="0, for 1.12 OD CU / OD^NF",
                    none_at_zero=True,
                ),
                Column(
                    "NF", "exponent of the force", "-", _EXPONENT, "force_exponent", default=0.18
                ),
                Column(
                    "ALPHAD",
                    "factor of the way to breakout",
                    "m at 1 m/s",
                    Bounds(0.0, 1e6),
                    "reach_factor",
                    otherwise="0, for 0.98 OD",
                    none_at_zero=True,
                ),
                Column("ND", "exponent of the way", "-", _EXPONENT, "reach_exponent", default=0.26),
                Column(
                    "XC1",
                    "share of the way at which the force is full",
                    "-",
                    _CUT,
                    "mobilised",
                    default=0.12,
                ),
                Column(
                    "XC2",
                    "share of the way from which it fades",
                    "-",
                    _CUT,
                    "released",
                    default=0.30,
                ),
                _named(
                    "CU",
                    "undrained shear strength, in place of ALPHAF",
                    "Pa",
                    Bounds(1.0, 1e8),
                    "undrained_shear_strength",
                    "by ALPHAF",
                ),
                Column(
                    "V",
                    "velocity of pull-out where statics have no time",
                    "m/s",
                    Bounds(0.0, 1e3),
                    "speed",
                    named=True,
                    default=0.0,
                ),
                Column(
                    "SMOOTH",
                    "time over which the velocity is smoothed in motion",
                    "s",
                    POSITIVE,
                    "smoothing",
                    named=True,
                    default=1.0,
                ),
                _named(
                    "REMAIN",
                    "share of the force that wear leaves",
                    "-",
                    Bounds(0.0, 1.0),
                    "remaining",
                    "no wear",
                ),
                _named(
                    "TRAVEL",
                    "way over OD by which 95 % of wear has come",
                    "-",
                    POSITIVE,
                    "travel_95",
                    "no wear",
                ),
            ),
        ),
    ),
    "*SUCTION\n1 0 0.18 0 0.26 0.12 0.30 CU=5e3\n2 1600 XC2=0.5",
    "Force ALPHAF v^NF and way ALPHAD v^ND, v in m/s: the defaults of the theory page of DeepLines "
    "after Bridge et al. (2004). That page gives no numbers for XC1 and XC2: these are RIFLEX's, "
    "and the straight lines between them a reconstruction. *TYPCONTACT names it as ID2.",
)
