"""The page on soil with memory: the numbers that it tells of two planes are those of the code."""

import re

import numpy as np
import pytest

from manual import DOCS
from memories import LAWS, reaction
from podeep.soil.memory_of import memory_in_space, memory_of
from podeep.soil.sliders import TOLERANCE

PAGE = (DOCS / "hysteresis.md").read_text(encoding="utf-8")
LAW, HALF = LAWS["soft clay"], 2.5 * 0.01 * 1.0  # m, its y50


def test_springs_of_two_planes() -> None:
    found = [len(memory_in_space(reaction(LAWS[n])).yields) for n in LAWS if n.startswith("soft")]
    assert found == [7, 90]
    assert f"within {TOLERANCE:g} of the\ncapacity".replace("0.00025", "2.5e-4") in PAGE
    assert "7 springs make the static table of soft clay, about 90 its cube root" in PAGE


def test_round_on_a_circle() -> None:
    """The table, by memories that go round in 360 steps a turn, and to and fro."""
    (table,) = re.findall(r"^\| \$R/y_\{50\}\$.*?\n\n", PAGE, re.M | re.S)
    rows = [[float(c) for c in line.split("|")[1:-1]] for line in table.splitlines()[2:] if line]
    assert [row[0] for row in rows] == [0.3, 1.0, 3.0, 8.0, 16.0]
    angles = np.radians(np.arange(1.0, 1081.0))
    path = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, None]
    for share, curve, size, against, inwards, loss in rows:
        radius, capacity = share * HALF, LAW.capacity[0]
        assert LAW.force(np.full(3, radius))[0] / capacity == pytest.approx(curve, abs=5e-3)
        memory = memory_in_space(reaction(LAW))
        lost = []
        for turn in np.split(radius * np.broadcast_to(path, (1080, 3, 2)), 3):
            before = memory.dissipated
            for place in turn:
                memory.commit(place)
            lost.append(memory.dissipated - before)
        x, y = memory.evaluate(memory.u)[0][0] / capacity
        assert [np.hypot(x, y), y, x] == pytest.approx([size, against, inwards], abs=8e-3)
        planar = memory_of(reaction(LAW), "MASING")
        for sign in (1.0, -1.0, 1.0):
            before = planar.dissipated
            planar.commit(np.full(3, sign * radius))
        half = planar.dissipated - before
        assert (lost[-1] / half)[0] / 2.0 == pytest.approx(loss, abs=1e-2)
