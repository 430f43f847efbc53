"""Lines set in motion by hand, which several tests share."""

from collections.abc import Callable

import numpy as np

from podeep.arrays import Array
from podeep.line.equations import LineSystem
from podeep.line.motion import MovingLine
from podeep.line.moving import LineInertia, LineMoving
from podeep.scene import Damping
from podeep.solve.conserving import Conserving
from podeep.solve.integrators import Integrator, initial
from podeep.solve.stage import Effort

NO_DAMPING = Damping()


def moving_line(
    system: LineSystem,
    q: Array,
    mass: float,
    *,
    added: float = 0.0,
    drag: float = 0.0,
    velocity: Array | None = None,
    method: Integrator | None = None,
    damping: Damping = NO_DAMPING,
    path: Callable[[float], Array] | None = None,
) -> MovingLine:
    """A line at its start, held where q has it, or as a path of the held unknowns leads."""
    method = method or Conserving()
    every = np.ones(len(system.field.lengths))

    def given(time: float) -> tuple[Array, Array, Array]:
        if path is None:
            still = np.zeros(len(system.held))
            return q[system.held], still, still
        d = 1e-4
        before, now, after = (path(time + step) for step in (-d, 0.0, d))
        return now, (after - before) / (2.0 * d), (after - 2.0 * now + before) / d**2

    mean = method.mean
    inertia = LineInertia(mass * every, added * every, drag * every)
    equations = LineMoving(system, inertia, given, damping, q, mean=mean)
    if system.bed is not None:
        system.bed.commit(q)
    effort = Effort()
    start = np.zeros_like(q) if velocity is None else velocity
    return MovingLine(equations, method, initial(equations, 0.0, q, start, effort), 1e-3, effort)


def stored(line: MovingLine) -> float:
    """Energy of motion, of stretching and bending, of the weight, and in the seabed, J."""
    equations, system, q = line.equations, line.equations.system, line.now.q
    a, b = system.curve(q)
    A, B, C = (np.einsum("ni,ni->n", x, y) for x, y in ((a, a), (b, b), (a, b)))
    stretch, bend = np.sqrt(A) - 1.0, B / A - (C / A) ** 2
    elastic = float(system.weight @ (0.5 * (system.axial * stretch**2 + system.bending * bend)))
    kept = equations.energy(line.now.velocity) + elastic - float(system.load @ q)
    if system.bed is not None:
        kept += float(system.bed.weight @ system.bed.normal.energy(system.bed.penetration(q)))
    return kept


def go(line: MovingLine, h: float, count: int, share: float = 1e-9) -> list[float]:
    """Take it so many steps further; what is stored after each."""
    found = []
    for _ in range(count):
        line.step(h, line.time + h, share, 60)
        found.append(stored(line))
    return found
