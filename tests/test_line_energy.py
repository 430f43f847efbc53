"""Energy of lines in motion: what drives them, what they store, what they lose."""

import numpy as np
import pytest

from lines_on_seabed import LIMITS, straight, system_of
from moving_lines import go, moving_line, stored
from podeep.line.statics import laid
from podeep.scene import Damping
from podeep.seabed.normal import Winkler
from podeep.solve.integrators import Bathe, Integrator, Weighted


def heaving(drag: float, damping: Damping, method: Integrator | None = None):
    """A pipe on the seabed whose end heaves: it lifts off, and slams down again."""
    bed = Winkler(2e4, 1e-3)
    system = system_of(
        np.linspace(0.0, 60.0, 7), 5, (1e8, 1e5, 600.0), bed, held={0.0: "xz", 60.0: "xz"}
    )
    q = laid(system, straight(system), LIMITS).q
    still = q[system.held]

    def path(time):
        return still + np.array([0.0, 0.0, 0.0, 0.5 * min(time, 1.0) * np.sin(2.1 * time)])

    return moving_line(system, q, 80.0, drag=drag, damping=damping, path=path, method=method)


@pytest.mark.parametrize(
    ("drag", "damping"),
    [(0.0, Damping()), (100.0, Damping()), (100.0, Damping(0.05, 2e-3))],
    ids=["nothing lost", "drag", "drag and damping"],
)
def test_work_is_stored_or_lost(drag, damping):
    """To rounding in steps of any length, the kink of the path and the seabed's corner included."""
    line, h = heaving(drag, damping), 0.05
    equations, system = line.equations, line.equations.system

    def kept():
        return stored(line) + float(system.load @ line.now.q)  # the weight is among what drives

    begin, lost, work, gap = kept(), 0.0, [], []
    for _ in range(60):
        place = line.standing()
        line.step(h, line.time + h, 1e-11, 60)
        velocity, end = (line.now.q - place.lateral.q) / h, line.standing()
        line.stand(place)
        dragged = equations.internal(line.now.q, velocity) - equations.internal(line.now.q, None)
        lost += h * float(velocity @ (dragged + equations.damping_times(velocity)))
        line.stand(end)
        work.append(line.work)
        gap.append(line.work - (kept() - begin) - lost)
    assert np.max(work) > 500.0
    assert lost == 0.0 if not drag else lost > 100.0
    assert np.abs(gap).max() < 1e-9 * np.max(work)


@pytest.mark.parametrize("method", [Weighted(), Bathe()])
def test_work_by_other_methods_comes_to_the_same(method):
    """To the second order in the step, before the path has its kink."""
    ends = []
    for one in (None, method):
        line = heaving(100.0, Damping(), one)
        go(line, 0.02, 45, 1e-11)
        ends.append(line.work)
    assert ends[1] == pytest.approx(ends[0], rel=0.01)
