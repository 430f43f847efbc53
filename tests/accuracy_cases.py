"""Every static case and sample as a deck with its oracle, for the table of accuracies.

Deviations are those of a solved deck's database from what the case is named after; `asked` is the
case's own bar. The leg pile of a jacket and the casings of a well have no oracle.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import test_lpile_piles as lpile
import test_pisa_piles as pisa
import test_second_order as column
import test_shear as shear
from casing_cases import CASING_CASES
from closed_forms import CASES, ClosedForm, Profile
from podeep.database.read import Database
from static_cases import STATIC_CASES, Deviation, Deviations, StaticCase, heads, rows

SAMPLES = Path(__file__).parents[1] / "sample_dbs"
HEAD, PROFILE, PROFILE_CF04 = 1e-6, 2e-6, 1e-5


def near(what: str, found: float, exact: float, asked: float) -> Deviation:
    return Deviation(what, abs(abs(found / exact) - 1.0), asked)


def closed_form(name: str, case: ClosedForm) -> StaticCase:
    """A closed form on linear soil: its head and the worst of its profiles."""
    asked = PROFILE_CF04 if name.startswith("CF04") else PROFILE

    def compare(database: Database) -> Deviations:
        errors = case.compare(Profile(database))
        head = Deviation("head", errors.pop("head"), HEAD)
        return [head, Deviation("profiles", max(errors.values()), asked)]

    return StaticCase(case.text, compare)


def beam_column(row: dict[str, float], load: str) -> StaticCase:
    """CF13: head of a pile under a constant normal force."""
    force, held, names = column.HEADS[load]

    def compare(database: Database) -> Deviations:
        y, slope, moment = heads(database)
        other = moment if held else slope
        found = {names[0]: y[-1], names[1]: other[-1]}
        return [near(n.split("_")[0], v, row[n], 1e-6) for n, v in found.items()]

    return StaticCase(column.column(row["N_N"], force, held), compare)


def soft_in_shear(load: str) -> StaticCase:
    """CF15: Timoshenko's beam."""

    def compare(database: Database) -> Deviations:
        return [Deviation("profiles", max(shear.errors(database, load).values()), 1e-5)]

    return StaticCase(shear.pile(*shear.LOADS[load]), compare)


def micropile(name: str) -> StaticCase:
    """PR02: LPILE's printed head and largest moment."""
    held, load, y, moment = lpile.MICROPILES[name]

    def compare(database: Database) -> Deviations:
        found = heads(database)
        return [
            near("y", found[0][-1], y, 3e-2),
            near("moment", found[2][-1], moment, 2e-2),
        ]

    return StaticCase(lpile.micropile(held, load) + lpile.SECOND_ORDER, compare)


def abutment(multiplier: float) -> StaticCase:
    """PR03: LPILE's printed heads and moments under eight loads."""
    given = lpile.loads(multiplier)

    def compare(database: Database) -> Deviations:
        y, _, moment = heads(database)
        exact = (np.array([abs(r[n]) for r in given]) for n in ("y_m_printed", "M_head_Nm_printed"))
        return [
            Deviation(what, float(np.abs(v / e - 1.0).max()), asked)
            for what, v, e, asked in zip(("y", "moment"), (y, moment), exact, (1e-2, 5e-3))  # noqa: B905
        ]

    return StaticCase(lpile.abutment(multiplier) + lpile.SECOND_ORDER, compare)


def monopile(name: str) -> StaticCase:
    """PR13: load at the ground displacements of a converged solution of the same springs."""
    loads, exact = pisa.given(name)

    def compare(database: Database) -> Deviations:
        found = database.foundation("F1").read("lateral_displacement")[1:, 0]
        at = np.interp(exact, found, loads)
        return [Deviation("load", float(np.abs(at / loads - 1.0).max()), 2e-2)]

    return StaticCase(pisa.monopile(name), compare)


def oc3(database: Database) -> Deviations:
    """PR06: the same springs converged, and the coupled springs that stand for them."""
    y, slope, _ = heads(database)
    found = []
    for row, who, asked in zip(rows("PR06_results.csv"), ("coupled", "same"), (6e-3, 1e-3)):  # noqa: B905
        for what, value, name in (("y", y, "y_design_m"), ("slope", slope, "rot_design_rad")):
            found.append(near(f"{what} {who}", value[-1], float(row[name]), asked))
    return found


def opensees(database: Database) -> Deviations:
    """PR01: OpenSees with springs at nodes, here spread: 1 %."""
    y, slope, moment = heads(database)
    exact = {"y": (y, 0.468638688), "slope": (slope, 0.084524407), "moment": (moment, 15954.16e3)}
    return [near(what, v[-1], e, 1e-2) for what, (v, e) in exact.items()]


SAMPLE_ORACLES: dict[str, Callable[[Database], Deviations]] = {
    "combined_casings": lambda database: [],
    "jacket_pile": lambda database: [],
    "oc3_monopile": oc3,
    "opensees_pile": opensees,
}


def without_accuracy(case: StaticCase) -> StaticCase:
    """The same deck with the accuracy left to whoever asks."""
    words = ("*ACCURACY\n1e-7\n", "*ACCURACY\n1e-5\n")
    text = case.text
    for word in words:
        text = text.replace(word, "")
    return StaticCase(text, case.compare)


def every() -> dict[str, StaticCase | Path]:
    """All cases by name; a sample is the path of its deck."""
    found: dict[str, StaticCase] = {n: closed_form(n, c) for n, c in CASES.items()}
    for row in column.ROWS:
        for load in column.HEADS:
            found[f"CF13 N {row['N_over_Ncr']:g} {load}"] = beam_column(row, load)
    found |= {f"CF15 {load}": soft_in_shear(load) for load in shear.LOADS}
    found |= STATIC_CASES | CASING_CASES
    found |= {f"PR02 {n}": micropile(n) for n in lpile.MICROPILES}
    found |= {f"PR03 {m:g}": abutment(m) for m in lpile.MULTIPLIERS}
    found |= {f"PR13 {n}": monopile(n) for n in pisa.PILES}
    ordered = dict(sorted(found.items(), key=lambda pair: pair[0][:4]))
    return {n: without_accuracy(c) for n, c in ordered.items()} | {
        n: SAMPLES / f"{n}.deck" for n in SAMPLE_ORACLES
    }
