"""*MODEL LENGTH=ACTIVE: fewer elements where a long pile does not move, the same answer."""

import json

import numpy as np
import pytest

from podeep.cli.solve import main
from podeep.database.read import open_database

PILE = """*DEPTH
-20
*GROUNDEPTH
0 -100
*PYCURVE, SHAPE=POWER
1
1 20e3 8e3 0.5 0.01
*PYCURVE, SHAPE=POWER
2
1 90e3 8e3 0.5 0.01
*GROUNDPROP
1 0 2 0
*CASING
1 PILE
-20 -{tip} 1 0.03 210e9 7850
*FONDATION
1 1
*SUPPORT
1 -{tip} Z
*LOAD
PUSH 1 -20 200e3 0 0
*MODEL, LENGTH={length}
*EXEC
"""


def run(folder, capsys, tip, length):
    path = folder / f"{length}.deck"
    path.write_text(PILE.format(tip=tip, length=length), encoding="utf-8")
    assert main(["run", str(path), "-o", str(folder), "--force", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["foundations"][0]
    with open_database(path.with_suffix(".dss")) as database:
        data = database.foundation("F1")
        x = np.linspace(0.0, tip - 20.0, 200)
        return told, np.interp(x, data.depth, data.read("lateral_displacement", -1)[0])


def test_a_long_pile_has_an_active_length(tmp_path, capsys):
    (full, deflection), (active, reduced) = (
        run(tmp_path, capsys, 120, length) for length in ("FULL", "ACTIVE")
    )
    assert reduced == pytest.approx(deflection, abs=1e-3 * deflection.max())
    assert active["elements"] < full["elements"]
    (told,) = (d for d in active["decisions"] if d.startswith("active length"))
    assert "of 100 m: below it, less than 1e-04 of that at the mudline" in told


def test_a_short_pile_is_active_all_along(tmp_path, capsys):
    told, _ = run(tmp_path, capsys, 35, "ACTIVE")
    assert any(
        d.startswith("full length: the deflection reaches the tip") for d in told["decisions"]
    )
