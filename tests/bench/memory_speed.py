"""How long a soil with memory takes at 30 points, beside its backbone.

Run it as `python tests/bench/memory_speed.py`.
"""

import timeit

import numpy as np

from podeep.motion import Hysteresis
from podeep.soil.axial import CohesiveShaft
from podeep.soil.law import Law
from podeep.soil.memory_of import memory_of
from podeep.soil.reaction import Reaction, Term
from podeep.soil.sand import Sand
from podeep.soil.soft_clay import SoftClay

POINTS = 30
DEPTH = np.linspace(1.0, 30.0, POINTS)
CLAY = {"effective_overburden": 8e3 * DEPTH, "undrained_shear_strength": 20e3 + 1e3 * DEPTH}
PLACE = {"depth": DEPTH, "diameter": 1.0, "effective_unit_weight": 8e3, "j": 0.5}
LAWS: dict[str, Law] = {
    "sand": Sand(depth=DEPTH, diameter=1.0, effective_overburden=8e3 * DEPTH, friction_angle=0.6),
    "soft clay 2GEO": SoftClay(**CLAY, **PLACE, strain_50=0.01),
    "soft clay POWER": SoftClay(**CLAY, **PLACE, strain_50=0.01, shape="POWER"),
    "shaft 2GEO": CohesiveShaft(**CLAY, diameter=1.0, initial_stiffness=1e8, shape="2GEO"),
}
CYCLE, STEPS = 100, 1000
#: amplitudes and phases that differ along the pile
MOTION = np.linspace(0.3, 0.01, POINTS) * np.sin(
    2.0 * np.pi * np.arange(STEPS)[:, None] / CYCLE - np.linspace(0.0, 0.3, POINTS)
)


def run(law: Law, hysteresis: Hysteresis) -> list[tuple[float, float]]:
    """Microseconds of `evaluate` and `commit` in each step."""
    memory = memory_of(Reaction(POINTS, (Term(np.arange(POINTS), None, law, "", ()),)), hysteresis)
    times = []
    for u in MOTION:
        asked = min(timeit.repeat(lambda u=u: memory.evaluate(u), number=1, repeat=3))
        times.append((1e6 * asked, 1e6 * timeit.timeit(lambda u=u: memory.commit(u), number=1)))
    return times


if __name__ == "__main__":
    print(f"{'us at 30 points':18}{'backbone':>9}{'evaluate':>20}{'commit':>20}")
    for name, law in LAWS.items():
        alone = min(timeit.repeat(lambda law=law: law.evaluate(MOTION[20]), number=50, repeat=20))
        for hysteresis in ("MASING", "GAP"):
            times = np.array(run(law, hysteresis))
            shown = "".join(f"{np.median(t):8.1f} mean {t.mean():6.1f}" for t in times.T)
            print(f"{name:18}{hysteresis:8}{1e6 * alone / 50:6.1f}{shown}")
