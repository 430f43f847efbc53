"""Laws that soften, in the solver under imposed displacement, up to their peak and past it.

A rigid tube that cannot turn moves every point of the soil by the same displacement: the force on
its head is the integral of the law over depth.
"""

from pathlib import Path

import numpy as np
import pytest

from decks import solved
from podeep.deck.read import read_deck
from podeep.soil.profile import profile_of

LENGTH, DIAMETER, STIFF = 8.0, 1.0, 1e14
PUSHED = (0.001, 0.002, 0.005, 0.01, 0.02, 0.04, 0.06, 0.09, 0.15, 0.3, 0.6)  # m
CURVES = {
    "cyclic soft clay": "*PYCURVE, CYCLIC\n1 1 40e3 8e3 0.5 0.01\n",
    "cyclic soft clay, cube root": "*PYCURVE, CYCLIC, SHAPE=POWER\n1 1 40e3 8e3 0.5 0.01\n",
    "stiff clay": "*PYCURVE\n1 3 150e3 9e3 0.005 0\n",
    "cyclic stiff clay": "*PYCURVE, CYCLIC\n1 3 150e3 9e3 0.005 0\n",
    "user curve that breaks": "*PYCURVE\n1 0 0\n200e3 0.01\n20e3 0.05\n",
}


def deck(curve: str, stiffness: float, moves: str) -> str:
    steps = "".join(f"{i} PUSH {y!r}\n" for i, y in enumerate(PUSHED, start=1))
    return (
        f"*DEPTH\n0\n*GROUNDEPTH\n0\n{curve}*GROUNDPROP\n1 0\n*CASING\n1 PILE\n"
        f"0 {-LENGTH!r} {DIAMETER!r} 0.05 210e9 7850 EI={stiffness!r}\n*FONDATION\n1 1\n"
        f"*SUPPORT\n1 0 RY\n1 {-LENGTH!r} Z\n*DISPLACE\nPUSH 1 0 {moves} 1\n"
        f"*QUASISTATIC\n{steps}*ACCURACY\n1e-4\n*EXEC\n"
    )


def head_force(folder: Path, text: str, quantity: str) -> np.ndarray:
    """Force on the head at each step, N."""
    with solved(folder, text) as database:
        return np.abs(database.foundation("F1").read_tube(1, quantity)[1:, 0])


def integral(folder: Path) -> np.ndarray:
    """Integral of p over the tube at each displacement, by fine panels, N."""
    scene = read_deck(folder / "case.deck").scene
    edges = np.linspace(0.0, LENGTH, 4001)
    z = 0.5 * (edges[:-1] + edges[1:])
    reaction = profile_of(scene, scene.foundations[0]).lateral(z, np.full(len(z), DIAMETER))
    force = reaction.evaluate(np.array(PUSHED)[:, None] * np.ones(len(z)))[0]
    return force.sum(axis=1) * LENGTH / len(z)


@pytest.mark.parametrize("name", CURVES)
def test_a_rigid_tube_follows_the_law_past_its_peak(tmp_path, name):
    force = head_force(tmp_path, deck(CURVES[name], STIFF, "X"), "shear_x")
    expected = integral(tmp_path)
    assert expected.argmax() not in (0, len(PUSHED) - 1)  # the peak lies inside
    np.testing.assert_allclose(force, expected, rtol=6e-4)  # what is left of the bending


@pytest.mark.parametrize("name", CURVES)
def test_a_real_tube_passes_the_peak(tmp_path, name):
    """A steel tube bends: its force stays below what the soil has in all, and falls at last."""
    force = head_force(tmp_path, deck(CURVES[name], 2.9e9, "X"), "shear_x")
    assert np.isfinite(force).all()
    assert len(force) == len(PUSHED)
    bound = integral(tmp_path).max()
    assert (force <= bound * (1.0 + 1e-6)).all()
