"""Interrupted runs: what stands in a partial, and whether a deck's run may go on from it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import __version__
from .arrays import Array
from .database.read import Database, open_database
from .database.schema import MAJOR, MINOR, PARTIAL
from .errors import AnalysisFailed, Fault, UserError


@dataclass(frozen=True)
class Options:
    """What of a motion's run the deck does not say.

    accuracy: that was asked on the command line, None for that of the deck. double: values in
    float64 instead of float32. compress: gzip them.
    """

    accuracy: float | None = None
    double: bool = False
    compress: bool = False

    @property
    def state(self) -> dict[str, Array]:
        """The options as a part of a run's state."""
        asked = self.accuracy or 0.0
        return {"options": np.array([asked, self.double, self.compress], dtype=np.float64)}

    @classmethod
    def of(cls, state: Mapping[str, Array]) -> "Options":
        """The options of a run that came to a state."""
        asked, double, compress = map(float, state["options"])
        return cls(asked or None, double != 0.0, compress != 0.0)


def state_in(target: Path, deck_text: str) -> dict[str, Array] | None:
    """What a run of this deck goes on from; None where its database is complete already.

    Raises UserError where there is no partial, or one of another deck or program; AnalysisFailed
    where the run has stopped for good.
    """
    partial = target.with_name(target.name + PARTIAL)
    if partial.exists():
        with open_database(partial) as database:
            check_same(database, deck_text)
            state = database.state
        if state is None or "options" not in state or state["options"].size != 3:
            raise UserError(
                Fault(f"{partial} holds no state to go on from", "run again without --resume")
            )
        return state
    if not target.exists():
        raise UserError(
            Fault(f"there is nothing to resume: {partial} does not exist", "run without --resume")
        )
    with open_database(target) as database:
        check_same(database, deck_text)
        if database.status != "complete":
            raise AnalysisFailed(
                f"{target} is finished, there is nothing to resume: {database.stop_reason}"
            )
    return None


def check_same(database: Database, deck_text: str) -> None:
    """Raises UserError unless a database is of this deck and of this very program."""
    path, anew = database.path, "run the deck again without --resume"
    if database.deck_text != deck_text:
        raise UserError(
            Fault(
                f"{path} is of another deck, or the deck or a file that it includes has changed",
                f"give back the deck that stands in it, or {anew}",
            )
        )
    made, now = (database.schema_version, database.version), (f"{MAJOR}.{MINOR}", __version__)
    if made != now:
        raise UserError(
            Fault(
                f"{path} is of version {made[1]} of the program, schema {made[0]}; this is "
                f"{now[1]}, schema {now[0]}, and might not go on to the same values",
                f"use that version, or {anew}",
            )
        )


def is_of(path: Path, deck_text: str) -> bool:
    """Whether a database is there, complete, and of this deck and program."""
    if not path.exists():
        return False
    try:
        with open_database(path) as database:
            check_same(database, deck_text)
            return database.status == "complete"
    except UserError:
        return False
