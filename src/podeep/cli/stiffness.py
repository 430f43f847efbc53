"""podeep-solve stiffness: what the soil under spudcans and under pipes gives, by every model."""

import argparse
import csv
import sys
from collections.abc import Mapping
from pathlib import Path

from ..errors import ExitCode, Fault, InvalidData, UserError
from ..scene import Scene, SoilStiffness
from ..seabed.parameters import PARAMETERS, PIPE, require
from .common import number

_LAY = ("bending_stiffness", "lay_tension")
_OPTIONS = {key: one for key, one in PARAMETERS.items() if one.option}


def add_stiffness(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command and its options."""
    one = commands.add_parser(
        "stiffness",
        help="stiffness under spudcans and under pipes on the seabed, every model",
        description="Stiffness under the spudcans of a deck; or, with --diameter and --weight, of "
        "the seabed under a pipe: of the soils of a deck's *SOILSTIFF, or without a deck of --clay "
        "or --sand and what is known of it.",
    )
    one.add_argument("deck", type=Path, nargs="?")
    soil = one.add_mutually_exclusive_group()
    for name in ("clay", "sand"):
        text = f"the soil is {name}"
        soil.add_argument(
            f"--{name}", dest="soil", action="store_const", const=name.upper(), help=text
        )
    for key, parameter in _OPTIONS.items():
        unit = "" if parameter.unit == "-" else f", {parameter.unit}"
        one.add_argument(parameter.option, dest=key, type=number, help=f"{parameter.meaning}{unit}")
    one.add_argument("--csv", action="store_true", help="SI units and full precision")
    one.set_defaults(command=stiffness)


def stiffness(options: argparse.Namespace) -> ExitCode:
    """Show the stiffness under spudcans, or under a pipe where one is given."""
    given = _given(options)
    if options.deck is None:
        _need(given, options)
        _show(given, options, None)
        return ExitCode.DONE
    from ..deck.read import read_deck

    idle = [PARAMETERS[key].option for key in given if key not in (*PIPE, *_LAY)]
    idle += [f"--{options.soil.lower()}"] if options.soil else []
    if idle:
        message = f"{', '.join(idle)} beside a deck, whose *SOILSTIFF gives the soil"
        raise UserError(Fault(message, "leave out one of them"))
    scene = read_deck(options.deck).scene
    if given:
        _need(given, options)
        if not scene.soil_stiffnesses:
            message = f"{options.deck} has no *SOILSTIFF for the pipe to lie on"
            raise UserError(Fault(message, "add one, or give the soil by options without a deck"))
        _show(given, options, tuple(scene.soil_stiffnesses.values()))
    else:
        _spudcans(scene, options)
    return ExitCode.DONE


def _given(options: argparse.Namespace) -> dict[str, float]:
    """What the options give, in SI by the keys of parameters; what is out of bounds is told."""
    given, faults = {}, []
    for key, one in _OPTIONS.items():
        if (value := getattr(options, key)) is not None:
            given[key] = one.taken(value)
            try:
                require(**{key: given[key]})
            except InvalidData as error:
                faults.append(_fault(error))
    if faults:
        raise UserError(*faults)
    return given


def _fault(error: InvalidData) -> Fault:
    """Bad data as a fault that names the option."""
    option = next(one.option for one in _OPTIONS.values() if one.symbol == error.field)
    return Fault(f"{option}: {error.message}", error.remedy)


def _need(given: Mapping[str, float], options: argparse.Namespace) -> None:
    """Tell of a pipe, a soil or a laying of which a part is missing."""
    missing = [PARAMETERS[key].option for key in PIPE if key not in given]
    if options.deck is None and options.soil is None:
        missing.append("--clay or --sand")
    if len(given.keys() & set(_LAY)) == 1:
        missing += [PARAMETERS[key].option for key in _LAY if key not in given]
    if not given and options.deck is None and options.soil is None:
        remedy = f"name a deck, or give {', '.join(missing)}, and what the soil is like"
        raise UserError(Fault("there is nothing to show a stiffness of", remedy))
    if missing:
        raise UserError(Fault(f"the pipe on the seabed lacks {', '.join(missing)}", "give it"))


def _show(
    given: Mapping[str, float],
    options: argparse.Namespace,
    soils: tuple[SoilStiffness, ...] | None,
) -> None:
    """Show the table of a pipe on the soils of a deck, or of the options."""
    from ..risks.seabed import soil_risks
    from ..seabed_report import COLUMNS, csv_rows, lay_warnings, table_of, table_of_deck, text

    pipe = {key: value for key, value in given.items() if key not in _LAY}
    lay = (given["bending_stiffness"], given["lay_tension"]) if _LAY[0] in given else None
    try:
        table = (
            table_of(options.soil, pipe, lay) if soils is None else table_of_deck(soils, pipe, lay)
        )
    except InvalidData as error:
        raise UserError(_fault(error)) from None
    if not table.rows:
        lines = (f"{m.name} lacks {', '.join(p.option for p in ps)}" for m, ps in table.lacking)
        raise UserError(*(Fault(line) for line in lines))
    remedy = f"leave out {' and '.join(PARAMETERS[key].option for key in _LAY)}"
    if lay is not None and not any(row.laid for row in table.rows):
        raise UserError(Fault("the lay factor goes with the model F114, which is not here", remedy))
    for risk in soil_risks("pipe on the seabed", pipe, by_option=True):
        _warn(str(risk))
    for warning in lay_warnings(table, lay[1]) if lay else ():
        _warn(warning)
    if options.csv:
        csv.writer(sys.stdout, lineterminator="\n").writerows((COLUMNS, *csv_rows(table)))
    else:
        print(text(table))


def _warn(warning: str) -> None:
    print(f"podeep-solve: warning: {warning}", file=sys.stderr)


def _spudcans(scene: Scene, options: argparse.Namespace) -> None:
    """Show the stiffness under every spudcan of a deck."""
    from ..stiffness import COLUMNS, csv_rows, text

    hint = (
        f"*SOILSTIFF is shown for a pipe: give {' and '.join(PARAMETERS[k].option for k in PIPE)}"
    )
    if not scene.spudcans:
        remedy = hint if scene.soil_stiffnesses else "add one, or a *SOILSTIFF for pipes"
        message = f"{options.deck} has no *SPUDCAN: there is no stiffness to show"
        raise UserError(Fault(message, remedy))
    if options.csv:
        csv.writer(sys.stdout, lineterminator="\n").writerows((COLUMNS, *csv_rows(scene)))
    else:
        print(text(scene))
    if scene.soil_stiffnesses:
        _warn(hint)
