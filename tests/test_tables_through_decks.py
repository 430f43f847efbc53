"""Tables as a user meets them: a deck, podeep-solve, and what it prints. Here those of clay.

Curves come from the CSV and are held to 1e-6. Derived values stand in the report in words alone,
which has six digits: they are held to 1e-5. Between the deck and the law stand units, keywords,
overburden, mean strength, lengths; the laws' own tests call the classes. The other tables are in
test_tables_through_decks_lateral.py and test_tables_through_decks_axial.py.
"""

import csv
import io
import re

import numpy as np
import pytest

from podeep.cli.solve import main
from test_soil_tables import KILO, close, table

HELD = "*SUPPORT\n1 {tip} Z\n"  # in place of an axial soil


class Solver:
    """podeep-solve on a deck of one tube from the mudline down, at elevation 0."""

    def __init__(self, folder, capsys):
        self.path, self.capsys = folder / "case.deck", capsys

    def deck(
        self,
        curves,
        *,
        depths="0",
        layering="",
        props="1 0",
        diameter=1.0,
        length=40.0,
        wall=0.05,
        density=7850.0,
        more=HELD,
    ):
        """more: keywords that hold and load the tube."""
        tip = -float(length)
        sizes = " ".join(repr(float(size)) for size in (tip, diameter, wall, 210e9, density))
        self.path.write_text(
            f"*DEPTH\n0\n*GROUNDEPTH{layering}\n{depths}\n{curves}\n"
            f"*GROUNDPROP\n{props}\n*CASING\n1 PILE\n0 {sizes}\n*FONDATION\n1 1\n"
            f"{more.format(tip=tip)}*EXEC\n",
            encoding="utf-8",
        )

    def __call__(self, command, *arguments):
        code = main([command, str(self.path), *arguments])
        out, err = self.capsys.readouterr()
        told = [line for line in err.splitlines() if "warning: " not in line]
        assert (code, told) == (0, [])  # some tables lie where a deck would be warned of
        return out

    def curve(self, name, depth, at):
        """Reaction of a curve at displacements, as the CSV has it."""
        texts = ",".join(repr(float(u)) for u in at)
        out = self("curves", "--depth", repr(float(depth)), f"--at={texts}", "--csv")
        rows = [row for row in csv.DictReader(io.StringIO(out)) if row["curve"] == name]
        assert [float(row["displacement"]) for row in rows] == np.asarray(at).tolist()
        return np.array([float(row["reaction"]) for row in rows])

    def derived(self, name, depth):
        """What the report in words derives on the way to a curve: numbers by their names."""
        text = self("curves", "--depth", repr(float(depth)))
        (part,) = re.findall(rf"^{name}, (.*?)(?:\n\n|\Z)", text, re.DOTALL | re.MULTILINE)
        listed = re.search(r"^    derived (.*?)^[^\n]* reaction \(", part, re.DOTALL | re.MULTILINE)
        items = " ".join(listed[1].split()).split(", ")
        return {
            found[1]: float(found[2])
            for found in (re.fullmatch(r"(.+?) (-?[\d.]+(?:e[-+]\d+)?)(?: \S+)*", i) for i in items)
        }


@pytest.fixture
def solver(tmp_path, capsys):
    return Solver(tmp_path, capsys)


def sets(number, *names, **equal):
    """The rows of a table as one test for each set of values in the columns of these names."""
    t = table(number, **equal)
    keys = list(dict.fromkeys(zip(*(t[name].tolist() for name in names), strict=True)))
    found = []
    for key in keys:
        at = np.all([t[name] == value for name, value in zip(names, key, strict=True)], axis=0)
        found.append({name: values[at] for name, values in t.items()})
    ids = [" ".join(f"{n}={v}" for n, v in zip(names, key, strict=True)) for key in keys]
    return pytest.mark.parametrize("t", found, ids=ids)


def first(t):
    """The first value of each column: of those that a set of rows shares, in the table's units."""
    return {name: values[0].item() for name, values in t.items()}


def near(derived, **expected):
    """Values of the report in words: SI, six digits."""
    for name, value in expected.items():
        assert derived[name.replace("_", " ")] == pytest.approx(value, rel=1e-5), name


def soft_clay(r, options):
    """A *PYCURVE, at a depth where its overburden is GAMMA z."""
    values = f"{r['su'] * KILO!r} {r['gam'] * KILO!r} {r['J']!r} {r['eps50']!r}"
    return f"*PYCURVE, {options}\n1\n1 {values}"


@pytest.mark.parametrize("shape", ["POWER", "WSD", "2GEO"])
@sets("02", "D", "X")
def test_02_soft_clay_static(solver, t, shape):
    r = first(t)
    solver.deck(soft_clay(r, f"SHAPE={shape}"), diameter=r["D"])
    close(solver.curve("py", r["X"], t["y"]), t[f"p_ref_{shape.lower()}"] * KILO)
    near(solver.derived("py", r["X"]), ultimate_resistance=r["pu_ref"] * KILO, y50=r["y50_ref"])


@pytest.mark.parametrize("shape", ["POWER", "2GEO"])
@sets("03", "D", "X")
def test_03_soft_clay_cyclic(solver, t, shape):
    r = first(t)
    solver.deck(soft_clay(r, f"CYCLIC, SHAPE={shape}"), diameter=r["D"])
    close(solver.curve("py", r["X"], t["y"]), t[f"p_ref_{shape.lower()}"] * KILO)
    near(
        solver.derived("py", r["X"]),
        ultimate_resistance=r["pu_ref"] * KILO,
        transition_depth=r["XR_api"],
    )


@pytest.mark.parametrize("given", ["SU0 and SU1", "CU over depth"])
@sets("04", "Ip_class", "gap", "z")
def test_04_iso_clay(solver, t, given):
    """su = su0 + su1 z: as values of one curve at this depth, or from two curves 40 m apart."""
    r = first(t)
    plasticity = {"gt30": "HIGH", "le30": "LOW"}[r["Ip_class"]]
    options = f"IP={plasticity}, ALPHA={r['alpha']!r}" + ", NOGAP" * (r["gap"] == "nogap")
    su0, su1 = r["su0"] * KILO, r["su1"] * KILO

    def curve(id_, z, more=""):
        own = f"{su0 + su1 * z!r} {r['gam'] * KILO!r} {r['OCR']!r}"
        return f"*PYCURVE, {options}\n{id_} 6 {own} {more}\n"

    if given == "CU over depth":
        solver.deck(
            curve(1, 0.0) + curve(2, 40.0), depths="0 -40", props="1 0 2 0", diameter=r["D"]
        )
    else:
        solver.deck(curve(1, r["z"], f"SU0={su0!r} SU1={su1!r}"), diameter=r["D"])
    close(solver.curve("py", r["z"], t["y_over_D"] * t["D"]), t["p"] * KILO)
    near(
        solver.derived("py", r["z"]),
        Np0=r["Np0"],
        Np=r["Np"],
        ultimate_resistance=r["pu"] * KILO,
    )


@sets("06", "z", "kind")
def test_06_stiff_clay_with_free_water(solver, t):
    """The law jumps at a few displacements of the table; there one of its two sides is meant."""
    r = first(t)
    cyclic = r["kind"] == "cyclic"
    keyword = "*PYCURVE, CYCLIC" if cyclic else "*PYCURVE"
    values = f"{r['c'] * KILO!r} {r['gam'] * KILO!r} {r['eps50']!r} {r['k'] * KILO!r}"
    solver.deck(f"{keyword}\n1\n3 {values}", diameter=r["D"])
    at, y50 = t["y"], r["eps50"] * r["D"]
    jumps = [0.6 * 4.1 * r["Ac"] * y50] if cyclic else [n * r["As"] * y50 for n in (6.0, 18.0)]
    jump = np.any([np.isclose(at, y, rtol=1e-6) for y in jumps], axis=0)
    assert jump.sum() == len(jumps)
    below, found, beyond = (solver.curve("py", r["z"], at * (1.0 + s)) for s in (-2e-8, 0.0, 2e-8))
    close(found[~jump], t["p_ref"][~jump] * KILO)
    for sides, reference in zip(
        np.array([below, beyond])[:, jump].T, t["p_ref"][jump] * KILO, strict=True
    ):
        close(sides[np.abs(sides - reference).argmin()], reference)
    near(
        solver.derived("py", r["z"]),
        A=r["Ac"] if cyclic else r["As"],
        ultimate_resistance=r["pc"] * KILO,
    )


@sets("07", "z")
def test_07_stiff_clay_without_free_water(solver, t):
    """Cyclic: the same reaction at the displacement that cycles make of the static one."""
    r = first(t)
    values = f"{r['c'] * KILO!r} {r['gam'] * KILO!r} {r['eps50']!r} J={r['J']!r}"
    solver.deck(f"*PYCURVE\n1\n4 {values}", diameter=r["D"])
    close(solver.curve("py", r["z"], t["y"]), t["p_ref"] * KILO)
    near(solver.derived("py", r["z"]), ultimate_resistance=r["pu"] * KILO)
    for cycles, column in ((100, "y_cyc_N100_ref"), (1, "y")):
        solver.deck(f"*PYCURVE, CYCLIC\n1\n4 {values} CYCLES={cycles}", diameter=r["D"])
        close(solver.curve("py", r["z"], t[column]), t["p_ref"] * KILO)
