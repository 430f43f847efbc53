"""The page on laws of the seabed: its numbers are those of the code."""

import re
from inspect import signature

import numpy as np
import pytest

from manual import SEABED_LAWS
from podeep.seabed import pull_out
from podeep.seabed.breakout import LimitPoint, static_pull
from podeep.seabed.hyperbolic import Hyperbolic, HyperbolicSoil
from podeep.seabed.pull_out import PullOut
from podeep.seabed.suction import Suction
from seabeds import SOIL, D, bridge, mudline

TEXT = re.sub(r"\s+", " ", SEABED_LAWS)


def says(*parts: str) -> None:
    for part in parts:
        assert part in TEXT, part


def pull() -> LimitPoint:
    law, z0 = mudline(4000.0, 0.2 / 0.7)
    return static_pull(law, z0, 2000.0, 4.0, 401).limits[0]


def test_the_table_of_velocities() -> None:
    rows = re.findall(r"^\| ([\d.e-]+) \| ([\d.]+) \| ([\d.]+) \|$", SEABED_LAWS, re.M)
    assert len(rows) == 4
    for speed, force, reach in rows:
        assert force == f"{float(bridge().force(float(speed))):.1f}"
        assert reach == f"{float(bridge().reach(float(speed))):.4f}"


def test_defaults() -> None:
    law = PullOut(force_factor=1.0, reach_factor=1.0)
    says(
        f"$x_{{c1}} = {law.mobilised:.2f}$ and $x_{{c2}} = {law.released:.2f}$",
        f"$x_{{c2}}$ above {pull_out._SHARPEST:g} is refused",
        f"n_f = {law.force_exponent:g}",
        f"n_D = {law.reach_exponent:g}",
        f"{pull_out._FORCE:g}\\, D s_u",
        f"{pull_out._REACH:g}\\, D,",
        f"**A floor** of {law.least_speed:g} m/s",
        f"{bridge().force(1.0) / bridge().force(1e-3):.2f} and "
        f"{bridge().reach(1.0) / bridge().reach(1e-3):.2f} times as large",
        f"low-pass, {signature(Suction).parameters['smoothing'].default:g} s unless",
    )
    soil = HyperbolicSoil(diameter=1.0, undrained_shear_strength=1.0)
    numbers = (
        soil.factor, soil.exponent, soil.normalised_stiffness, soil.suction_ratio,
        soil.suction_decay, soil.repenetration_offset,
    )  # fmt: skip
    says(", ".join(f"{n:g}" for n in numbers), f"= {np.exp(-soil.repenetration_offset):.2f}$")


def test_the_limit_point_as_it_is_printed() -> None:
    (block,) = re.findall(r"^```text\n(.*?)^```", SEABED_LAWS, re.M | re.S)
    assert all(len(line) <= 80 for line in block.splitlines())
    assert " ".join(block.split()) == str(pull())
    rate, speed = pull().growth_rate(1500.0), pull().peak_speed(1500.0)
    says(f"a rate of {rate:.3f} 1/s and is {speed:.3f} m/s fast")


def test_shallow_touches_of_the_hyperbolic_seabed() -> None:
    depths = np.linspace(2e-4, 2.4e-3, 45)
    law = Hyperbolic(SOIL, len(depths))
    for share in np.linspace(0.0, 1.0, 300)[1:]:
        law.commit(share * depths)
    worst, gives = -law.dissipated.min(), depths[law.dissipated < 0.0]
    assert 3.5e-3 < worst < 4.5e-3
    assert gives.max() < 2e-3
    says("below 2 mm here, 4 mJ/m at most")


def test_the_soil_of_the_text_is_that_of_the_figures() -> None:
    from manual import figures

    assert (figures.seabed.D, figures.seabed.SU) == (D, 5000.0)
    law = figures.seabed.bridge(0.1)
    assert law.pull_out.force(0.1) == pytest.approx(float(bridge().force(0.1)))
    says("clay of 5 kPa under a pipe of 0.3 m", "pushed in to 60 mm")
    assert figures.seabed.DEEP == 0.06
