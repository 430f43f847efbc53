"""Soils under pipes on the seabed that are legal but risky."""

from collections.abc import Iterator, Mapping

from ..seabed.parameters import PARAMETERS
from .ranges import BUOYANT, SLIPS
from .risk import Risk, Value, slips

_HEAVIEST = 13e3  # N/m3, of soil in water


def soil_risks(
    subject: str, parameters: Mapping[str, float], by_option: bool = False
) -> Iterator[Risk]:
    """Slips of units, and a weight that soil in water does not have.

    parameters: in SI, by their keys. They are named as columns of the deck, or as options.
    """
    for key, amount in parameters.items():
        one = PARAMETERS[key]
        value = Value(one.option if by_option else one.symbol, one.shown(amount), one.unit)
        if key in SLIPS:
            taker = "the command" if by_option else "the deck"
            yield from slips(subject, key, value, SLIPS[key], taker)
        if key == "effective_unit_weight" and amount > _HEAVIEST:
            remedy = "give the effective weight, without that of the water"
            yield Risk(subject, key, str(value), BUOYANT, remedy)
