"""Scenes at which other programs fail, as decks with the right answers.

A tube of 2 m by 50 mm, 10 m free and 40 m embedded, in clay of 20 to 60 kPa over 15 m and sand of
35 degrees, with t-z and Q-z of API RP 2GEO. OpenSees' hyperbolic springs never reach what the soil
has, so that it ends without a word near the axial capacity; its springs in x and y are independent,
so that a load between the axes meets too soft a soil.
"""

from math import cos, pi, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from decks import solved
from podeep.cli.solve import main
from podeep.errors import ExitCode

DIAMETER, EA, HEAD, TIP, CLAY = 2.0, 210e9 * pi / 4 * (2.0**2 - 1.9**2), -10.0, 40.0, 15.0
BEARING = 10e6 * pi / 4 * DIAMETER**2  # of the tip, at its limit, N


def deck(loads: str, more: str = "", steps: int = 10) -> str:
    return (
        "*TITLE\nwhere others fail\n*DEPTH\n0\n*GROUNDEPTH\n0 -15 -15 -40\n"
        "*PYCURVE\n1 1 20e3 8e3 0.5 0.01\n*PYCURVE\n2 1 60e3 8e3 0.5 0.01\n"
        "*PYCURVE\n3 2 10e3 35 22e6\n"
        "*TZCURVE, SHAPE=2GEO, RESIDUAL=1\n1 0\n1 20e3 8e3\n"
        "*TZCURVE, SHAPE=2GEO, RESIDUAL=1\n2 0\n1 60e3 8e3\n"
        "*TZCURVE, SHAPE=2GEO\n3 0\n2 0.46 10e3 45 40 96e3 10e6\n*GROUNDPROP\n1 1 2 2 3 3 3 3\n"
        "*CASING\n1 PILE\n10 -40 2 0.05 210e9 7850\n*FONDATION\n1 1\n"
        f"*LOAD\nHEAD 1 10 {loads}\n*QUASISTATIC\n{steps}\n{more}*EXEC\n"
    )


def friction(z: np.ndarray) -> np.ndarray:
    """Peak friction per metre of shaft, N/m: alpha of the clay, beta of the sand."""
    su = 20e3 + 40e3 * z / CLAY
    overburden = np.where(z < CLAY, 8e3 * z, 8e3 * CLAY + 10e3 * (z - CLAY))
    psi = su / np.maximum(overburden, 1e-9)
    alpha = np.minimum(1.0, 0.5 / np.where(psi > 1.0, psi**0.25, psi**0.5))
    unit = np.where(z < CLAY, alpha * su, np.minimum(0.46 * overburden, 96e3))
    return np.asarray(pi * DIAMETER * unit)


DEPTH = np.concatenate((np.linspace(0.0, CLAY, 4001)[:-1], np.linspace(CLAY, TIP, 4001)))
SHAFT = cumulative_simpson(friction(DEPTH), x=DEPTH, initial=0.0)  # down to each depth, N
CAPACITY = float(SHAFT[-1]) + BEARING


def run(folder: Path, text: str, *arguments: str) -> int:
    path = folder / "case.deck"
    path.write_text(text)
    return main(["run", str(path), "-o", str(folder), "--force", *arguments])


def test_the_capacity_is_that_of_the_peers() -> None:
    assert pytest.approx(47.66e6, rel=1e-4) == CAPACITY


def test_a_load_just_below_the_capacity_is_solved(tmp_path: Path) -> None:
    """47.6 MN of 47.66: all the shaft at its peak, the tip on the last line of its table.

    Of the shaft nothing depends on the displacement any more, so that the tip's settlement and the
    shortening above it are sums.
    """
    force = 47.6e6
    share = (force - SHAFT[-1]) / BEARING
    assert 0.9 < share < 1.0
    tip = DIAMETER * (0.073 + (share - 0.9) / 0.1 * 0.027)
    shortening = (force * (TIP - HEAD) - np.trapezoid(SHAFT, DEPTH)) / EA
    with solved(tmp_path, deck(f"1e5 0 {-force!r}")) as database:
        tube = database.foundation("F1")
        settled = -tube.read_tube(1, "displacement_z", -1)[0]
        assert database.status == "complete"
    assert settled[-1] == pytest.approx(tip, rel=2e-4)
    assert settled[0] - settled[-1] == pytest.approx(shortening, rel=1e-4)


@pytest.mark.parametrize("force", [48e6, 50e6, 60e6])
def test_a_load_above_the_capacity_is_told_what_it_is(tmp_path, capsys, force):
    assert run(tmp_path, deck(f"1e5 0 {-force!r}")) == ExitCode.FAILED
    printed, told = capsys.readouterr()
    whole = int(CAPACITY / (force / 10))
    assert f"{whole} steps" in " ".join(printed.split())
    assert "F1: no axial equilibrium beyond" in told
    assert f"of step {whole + 1}" in told
    factor = float(told.split("load factors reached: HEAD ")[1].split()[0])
    assert factor * force == pytest.approx(CAPACITY, rel=2e-4)
    assert f"capacity in compression: shaft {SHAFT[-1]:.4g} N, tip {BEARING:.4g} N" in told
    assert "the shaft friction is fully mobilised at depths 0.205 to 39.9 m" in told
    assert "remedy: a longer or wider tube, a smaller axial load" in told


@pytest.fixture(scope="module")
def along(tmp_path_factory):
    return resultants(tmp_path_factory.mktemp("along"), 0.0, "PDELTA")


@pytest.mark.parametrize("asked", ["PDELTA", "PDELTA, SPATIAL"])
@pytest.mark.parametrize("angle", [22.5, 45.0, 30.0 * sqrt(2.0), 90.0, 200.0])
def test_a_load_between_the_axes_has_the_same_resultants(tmp_path, along, angle, asked):
    """2 MN across at any angle, 5 MN down: displacement and moment at every depth to 1e-10."""
    turned = resultants(tmp_path, angle, asked)
    for name, (x, y) in turned.items():
        size = np.abs(along[name][0]).max()
        c, s = cos(radians(angle)), sin(radians(angle))
        np.testing.assert_allclose(c * x + s * y, along[name][0], atol=1e-10 * size, rtol=0.0)
        np.testing.assert_allclose(c * y - s * x, 0.0, atol=1e-10 * size)


def resultants(folder: Path, angle: float, asked: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Displacements and moments in x and y (of the bending there) over the tube."""
    x, y = 2e6 * cos(radians(angle)), 2e6 * sin(radians(angle))
    more = f"*MODEL, {asked}, ELEMENTS=30\n*NEWTONSTAT\n60 1e-12 1e-12\n"
    text = deck(f"{x!r} {y!r} -5e6", more, steps=3)
    with solved(folder, text) as database:
        tube = database.foundation("F1")
        names = {"displacement": ("_x", "_y"), "moment": ("_y", "_x")}
        found = {n: [tube.read_tube(1, n + e, -1)[0] for e in ends] for n, ends in names.items()}
    return {
        "displacement": (found["displacement"][0], found["displacement"][1]),
        "moment": (found["moment"][0], -found["moment"][1]),
    }
