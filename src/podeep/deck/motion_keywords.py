"""The keywords of motion: what loads do in time, damping, and how it is followed."""

from ..motion import METHODS
from .column import NOT_NEGATIVE, POSITIVE, Bounds, Column, Keyword, Row

_RATIO = Bounds(0.0, 1.0, open=True)
_FREQUENCY = Bounds(1e-6, 1e6)
_COUNT = Bounds(1, 100000)
_NAME = Column("NAME", "load or displacement", key="name", kind="word")

HARMONIC = Keyword(
    "HARMONIC",
    "a load that follows a sine",
    (
        Row(
            "histories",
            (
                _NAME,
                Column("PERIOD", "period", "s", POSITIVE, "period"),
                Column("PHASE", "phase at t = 0", "deg", key="phase"),
                Column(
                    "RAMP",
                    "time over which it grows, by half a cosine's wave",
                    "s",
                    NOT_NEGATIVE,
                    "ramp",
                    default=0.0,
                ),
            ),
        ),
    ),
    "*HARMONIC\nSTORM 12.5 90 25",
    "The factor is sin(2 pi t / PERIOD + PHASE), for RAMP seconds from TINI of *DYNAMIC on times "
    "(1 - cos(pi (t - TINI) / RAMP)) / 2, half a wave of a cosine from 0 to 1. A name has one "
    "history at most, and those that share it follow the same.",
)

TIMESERIES = Keyword(
    "TIMESERIES",
    "a load that follows a record",
    (
        Row(
            "the load, and the file with its rows",
            (
                _NAME,
                Column(
                    "FILE",
                    "text file, relative to the file that names it",
                    kind="word",
                    named=True,
                    otherwise="rows follow here",
                ),
            ),
        ),
        Row(
            "rows, in the file or below NAME",
            (
                Column("T", "time, rising from row to row", "s"),
                Column("FACTOR", "factor of the load", "-"),
            ),
        ),
    ),
    "*TIMESERIES PUSH           ! or PUSH, file=quay.txt and the rows there\n0   0\n2.5 1\n60  1",
    "The file's name ends the line: *TIMESERIES NAME, file=F. Comments in it are those of decks. "
    "Factors are joined by straight lines; the first and the last one are held. The deck in a "
    "database holds the rows.",
)

DAMPING = Keyword(
    "DAMPING",
    "damping of the tubes (Rayleigh)",
    (
        Row(
            "a ratio at two frequencies",
            (
                Column("RATIO", "share of critical damping at F1 and at F2", "-", Bounds(0.0, 1.0)),
                Column("F1", "frequency", "Hz", _FREQUENCY),
                Column("F2", "frequency", "Hz", _FREQUENCY),
            ),
        ),
        Row(
            "or factors, by name",
            (
                Column(
                    "ALPHA",
                    "factor on the mass",
                    "1/s",
                    NOT_NEGATIVE,
                    "mass_factor",
                    named=True,
                    default=0.0,
                ),
                Column(
                    "BETA",
                    "factor on the stiffness of the tubes",
                    "s",
                    NOT_NEGATIVE,
                    "stiffness_factor",
                    named=True,
                    default=0.0,
                ),
            ),
        ),
    ),
    "*DAMPING\n0.01 0.2 2",
    "Between F1 and F2 damping is below RATIO, beyond them above it. The soil has its own: see "
    "*RADIATION and HYSTERESIS of *MODEL.",
    once=True,
    optioned=True,
)

DYNAMIC = Keyword(
    "DYNAMIC",
    "motion after the statics",
    (
        Row(
            "the run",
            (
                Column("TINI", "time at which motion begins", "s", NOT_NEGATIVE, "start"),
                Column("TFIN", "time at which it ends", "s", key="end"),
                Column(
                    "DT",
                    "time step, 0 for what *ACCURACY asks for",
                    "s",
                    NOT_NEGATIVE,
                    "step",
                    otherwise="0",
                    none_at_zero=True,
                ),
                Column(
                    "INTEG", "integrator, 7: implicit", kind="integer", choices=("7",), default=7
                ),
                Column(
                    "IOPDYN",
                    "0 damped, 1 plain Newmark, 2 to 4 Newmark with a predictor",
                    kind="integer",
                    choices=("0", "1", "2", "3", "4"),
                    default=0,
                ),
                Column(
                    "METHOD",
                    "integrator by name, in place of IOPDYN",
                    key="method",
                    kind="word",
                    choices=METHODS,
                    named=True,
                    otherwise="by IOPDYN",
                ),
            ),
        ),
    ),
    "*DYNAMIC\n0 60 0.05 7 1",
    "Statics come first. The damped method of IOPDYN 0 is HHT with alpha = -0.05: the original's "
    "formula is not public. IOPDYN 2 to 4, with the predictors X, X + V DT and X + V DT + A DT2/2, "
    "are plain Newmark: where a step starts to iterate is the solver's choice. By name: NEWMARK; "
    "HHT; GALPHA, generalised alpha; BATHE, two stages a step; ROS2, Rosenbrock's of two stages; "
    "CENTRAL, explicit differences; CONSERVE, which keeps energy in contacts: the default where "
    "*TYPCONTACT leaves tubes room.",
    once=True,
    optioned=True,
)

DYNIMP = Keyword(
    "DYNIMP",
    "how an implicit step is taken",
    (
        Row(
            "the step",
            (
                Column(
                    "ITEMAX",
                    "largest number of iterations",
                    "-",
                    _COUNT,
                    "iterations",
                    "integer",
                    default=30,
                ),
                Column("DELTA", "Newmark's gamma", "-", Bounds(0.5, 1.0), "gamma", default=0.5),
                Column(
                    "ALPHA",
                    "Newmark's beta",
                    "-",
                    Bounds(0.0, 1.0, open=True),
                    "beta",
                    default=0.25,
                ),
                Column(
                    "IOPTDT",
                    "1: the step follows the error",
                    key="adaptive",
                    kind="integer",
                    choices=("0", "1"),
                    default=0,
                ),
                Column(
                    "ITMIN",
                    "iterations under which the original lengthens its step, no effect here",
                    bounds=_COUNT,
                    kind="integer",
                    default=1,
                ),
            ),
        ),
    ),
    "*DYNIMP\n30 0.5 0.25 1",
    once=True,
)


def _limit(number: int, meaning: str) -> Column:
    return Column(f"PMAXD{number}", f"largest {meaning}, as a ratio", "-", _RATIO, default=0.1)


NEWTONDYN = Keyword(
    "NEWTONDYN",
    "limits of the iteration in motion",
    (
        Row(
            "limits",
            (
                Column(
                    "ITEMAX",
                    "largest number of iterations, before that of *DYNIMP",
                    "-",
                    _COUNT,
                    "iterations",
                    "integer",
                ),
                _limit(1, "out-of-balance force"),
                _limit(2, "out-of-balance moment"),
                _limit(3, "increment of translation"),
                _limit(4, "increment of rotation"),
                Column(
                    "IKRIG",
                    "-1 full, 0 modified Newton; no effect here",
                    kind="integer",
                    choices=("-1", "0"),
                    default=-1,
                ),
                Column(
                    "IKDIV",
                    "how often the original halves its step, no effect here",
                    bounds=Bounds(0, 100000),
                    kind="integer",
                    default=2,
                ),
            ),
        ),
    ),
    "*NEWTONDYN\n40 0.01 0.01 0.01 0.01",
    "The tightest of the four ratios holds for all.",
    once=True,
)

DTREC = Keyword(
    "DTREC",
    "the time between two records of motion",
    (
        Row(
            "recording",
            (Column("DT", "time between records in the database", "s", POSITIVE, "recording"),),
        ),
    ),
    "*DTREC\n0.1",
    "Without it, it is DT of *DYNAMIC or a thousandth of the run, whichever is longer.",
    once=True,
)
