"""The memory of a reaction under a rule of hysteresis, and what cannot have one."""

from collections.abc import Sequence

from ..arrays import Array
from ..errors import InvalidData
from ..motion import Hysteresis
from . import lateral
from .backbone import SignedUserCurve, UserCurve
from .degrading import Degrading
from .energy import gives_back, half_way, held, softens
from .gap import DRAG, Gap
from .iwan import Iwan
from .law import Law
from .masing import Masing
from .memory import Elastic, Memory
from .reaction import Reaction
from .tip_memory import Settling

_FIELD = "HYSTERESIS"
#: laws beside which a gap can open; rows may be anything
_OPEN: tuple[type[Law], ...] = (
    UserCurve,
    *(laws.resistance for laws in lateral.LAWS.values()),
)


def memory_of(reaction: Reaction, hysteresis: Hysteresis, drag: Array | float = DRAG) -> Memory:
    """The memory of a reaction at its points.

        ELASTIC     none: up and down along the curve
        MASING      `Masing`, `Degrading` where a law falls after a peak
        GAP         the same behind a `Gap` of its own capacity and y50, drag Cd, where p-y resists;
                    shafts, moments and bases have none. Rows of the user may be either: ask for
                    MASING where they are t-z

    What resists compression alone is `Settling` in both. A reaction whose memory is not known
    raises InvalidData with the reason in words.
    """
    if hysteresis == "ELASTIC":
        return Elastic(reaction, reaction.size)
    laws = [term.law for term in reaction.laws]
    _check_known(laws, hysteresis)
    if laws and not reaction.odd:
        _check_secant(reaction, hysteresis)
        return Settling(reaction, reaction.size)
    envelope = held(reaction)
    _check_secant(envelope, hysteresis)
    falls = softens(reaction)
    memory = Degrading(reaction) if falls else Masing(reaction, reaction.size)
    if hysteresis == "MASING" or not all(isinstance(law, _OPEN) for law in laws):
        return memory
    peak = envelope.capacity
    return Gap(memory, peak, half_way(envelope, peak), drag)


def memory_in_space(reaction: Reaction) -> Iwan:
    """The memory under MASING of a reaction across a tube that moves in two planes.

    Raises InvalidData as `memory_of`, and for curves whose slope rises on the way.
    """
    _check_known([term.law for term in reaction.laws], "MASING")
    _check_secant(held(reaction), "MASING")
    return Iwan(reaction)


def _check_known(laws: Sequence[Law], hysteresis: Hysteresis) -> None:
    for law in laws:
        if law.follows_lateral:
            raise InvalidData(
                f"{type(law).__name__} comes for each unit of another reaction: what it would "
                f"remember under {hysteresis} is not known",
                "leave it elastic",
                _FIELD,
            )
        if isinstance(law, SignedUserCurve) and law.polyline.nodes[0] < 0.0:
            raise InvalidData(
                f"a curve with sides of its own has no branches under {hysteresis}: Masing's rules "
                "need the same curve both ways",
                "give its rows for positive displacements alone, or choose ELASTIC",
                _FIELD,
            )
    if len({law.odd for law in laws}) > 1:
        raise InvalidData(
            f"a curve for both directions and one for compression alone share a point under "
            f"{hysteresis}",
            "give them points of their own",
            _FIELD,
        )


def _check_secant(reaction: Reaction, hysteresis: Hysteresis) -> None:
    if reaction.laws and gives_back(reaction):
        raise InvalidData(
            f"a curve grows stiffer on its way: its loops under {hysteresis} would give energy",
            "give rows whose slope falls from row to row, or choose ELASTIC",
            _FIELD,
        )
