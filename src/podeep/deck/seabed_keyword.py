"""The keyword of the soil under pipes on the seabed: a layout for each model in its table."""

from ..seabed.models import MODELS, NOT_FOUND, Model
from ..seabed.parameters import Parameter
from .column import IDS, Bounds, Column, Keyword, Row


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
