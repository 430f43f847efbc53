"""What tests of the seabed share: its tables, a backbone, laws of suction, small motions."""

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np

from podeep.seabed.hyperbolic import Hyperbolic, HyperbolicSoil
from podeep.seabed.pull_out import PullOut, Wear, force_factor, reach_factor
from podeep.seabed.suction import Suction
from podeep.soil.memory import Memory
from podeep.study.oscillator import Law

DATA = Path(__file__).parent / "data" / "seabed"
D, SU = 0.3, 5000.0
K = 3e5  # unloading stiffness, N/m2
SOIL = HyperbolicSoil(diameter=D, undrained_shear_strength=1500.0, strength_gradient=1500.0)


class Power:
    """A force c (z/D)^b, N/m: that of Dunlap unless told otherwise; asked for z > 0 alone."""

    def __init__(self, force: float = 7.32 * D * SU, exponent: float = 0.64) -> None:
        self.force, self.exponent = force, exponent

    def evaluate(self, z):
        assert (z > 0.0).all()
        force = self.force * (z / D) ** self.exponent
        return force, self.exponent * force / z


def bridge(**more) -> PullOut:
    """The laws of the theory page."""
    return PullOut(force_factor=force_factor(D, SU), reach_factor=reach_factor(D), **more)


def fixed(force: float, reach: float, **more) -> PullOut:
    """Suction of one force and reach, whatever the velocity."""
    powers = {"force_exponent": 0.0, "reach_exponent": 0.0}
    return PullOut(force_factor=force, reach_factor=reach, **powers, **more)


def mudline(force: float, reach: float, **more) -> tuple[Suction, float]:
    """A seabed of one point with fixed suction, whose pipe lies where its contact force is nil."""
    law = Suction(Power(), 1, K, fixed(force, reach, **more))
    law.commit(np.array([0.06]))
    law.commit(law.lift_off)
    return law, float(law.lift_off[0])


#: Seabeds of three points that remember.
SEABEDS: dict[str, Callable[[], Memory]] = {
    "suction": lambda: Suction(Power(), 3, K, bridge(), speed=0.1),
    "slow suction": lambda: Suction(Power(), 3, K, bridge(mobilised=0.1, released=0.7), speed=1e-3),
    "steep suction": lambda: Suction(Power(), 3, 2e4, fixed(3000.0, 0.05, mobilised=1e-3)),
    "brittle suction": lambda: Suction(Power(), 3, K, fixed(2000.0, 0.04, released=0.95)),
    "worn suction": lambda: Suction(
        Power(), 3, K, bridge(), speed=0.01, wear=Wear(diameter=D, remaining=0.3, travel_95=1.0)
    ),
    "convex suction": lambda: Suction(Power(1e4, 1.5), 3, 1e3, fixed(100.0, 0.04)),
    "hyperbolic": lambda: Hyperbolic(SOIL, 3),
    "hyperbolic, rejoining": lambda: Hyperbolic(SOIL, 3, rejoins=True),
}


def rows(pattern: str) -> list[dict[str, str]]:
    """Rows of a check table below its comments."""
    (path,) = DATA.glob(pattern)
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def cycle(case: str) -> list[tuple[str, float, float]]:
    """Branch, penetration and reaction of each row of a case of the table of cycles, in order."""
    (path,) = DATA.glob("10_*.csv")
    cells = (line.split(",") for line in path.read_text(encoding="utf-8").splitlines())
    return [(c[2], float(c[3]), float(c[4])) for c in cells if c[1:2] == [case] and len(c) == 5]


def felt(law: Memory, h: float | None = None) -> tuple[Law, Callable[[np.ndarray], None]]:
    """A memory as the spring of oscillators, whose displacement is the penetration: law, commits.

    h: step, for a law that asks for the time.
    """
    if h is None:
        return law.evaluate, law.commit
    assert isinstance(law, Suction)
    return law.evaluate, lambda q: law.commit(q, h)
