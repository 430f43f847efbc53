"""Figures of the seabed: the cycle of suction, its cut-offs, friction, the hyperbolic seabed."""

import numpy as np
from matplotlib.figure import Figure

from podeep.arrays import Array
from podeep.seabed.friction import Friction, limit_pull
from podeep.seabed.hyperbolic import Hyperbolic, HyperbolicSoil
from podeep.seabed.pull_out import PullOut, force_factor, reach_factor
from podeep.seabed.suction import Suction
from podeep.soil.memory import Memory

from .canvas import DASHED, INKS, KILO, SOLID, frame, legend, new_panels

D, SU = 0.3, 5e3
UNLOADING = 3e5
DEEP = 0.06


class _Backbone:
    """Dunlap's force of clay of 5 kPa under a pipe of 0.3 m."""

    def evaluate(self, u: Array) -> tuple[Array, Array]:
        force = 7.32 * D * SU * (u / D) ** 0.64
        return force, 0.64 * force / u


def bridge(speed: float) -> Suction:
    """The cycle that the figure shows: the page's velocity laws, RIFLEX's cut-offs."""
    law = PullOut(force_factor=force_factor(D, SU), reach_factor=reach_factor(D))
    return Suction(_Backbone(), 1, UNLOADING, law, speed=speed)


def _walk(law: Memory, goals: list[float]) -> list[tuple[Array, Array]]:
    """Penetration (mm) and force (kN/m) on the straight ways to each goal, m."""
    at, ways = 0.0, []
    for goal in goals:
        path = np.linspace(at, goal, 400)
        force = []
        for z in path:
            force.append(law.evaluate(np.array([z]))[0][0])
            law.commit(np.array([z]))
        ways.append((1e3 * path, KILO * np.array(force)))
        at = goal
    return ways


def seabed_suction_cycle() -> Figure:
    figure, (cycle, cut) = new_panels(2, 4.2)
    law = bridge(0.1)
    legs = _walk(law, [DEEP, -0.14, 0.08])
    names = "first penetration", "unloading, suction, breakout", "loading after breakout"
    for ink, name, (z, force) in zip((INKS[0], INKS[1], INKS[4]), names, legs, strict=True):
        cycle.plot(z, force, color=ink, linewidth=1.8, label=name)
    back = bridge(0.1)
    _walk(back, [DEEP, 0.01])
    (turned,) = _walk_on(back, 0.01, 0.03)
    cycle.plot(
        *turned, color=INKS[3], linestyle=DASHED, linewidth=1.6, label="reversal before breakout"
    )
    cycle.axvline(1e3 * float(back.lift_off[0]), color="#999999", linewidth=0.8)
    cycle.text(1e3 * float(back.lift_off[0]) - 4.0, 3.3, "$z_0$", ha="right")
    frame(cycle, "Penetration $z$ (mm)", "$R$ (kN/m)", title="A cycle at 0.1 m/s")
    legend(cycle, "upper left", fontsize=8)
    x = np.linspace(0.0, 1.1, 1101)
    for ink, cuts in ((INKS[1], (0.12, 0.30)), (INKS[4], (0.10, 0.70))):
        shape = PullOut(force_factor=1.0, reach_factor=1.0, mobilised=cuts[0], released=cuts[1])
        label = f"$x_{{c1}}$ = {cuts[0]:g}, $x_{{c2}}$ = {cuts[1]:g}"
        cut.plot(x, shape.share(x, np.ones_like(x))[0], color=ink, linewidth=1.8, label=label)
    frame(cut, r"$x = (z_0 - z)/\Delta_B$ (-)", "$F/F_{max}$ (-)", 1.1, 1.25, "Cut-offs")
    legend(cut, "upper right")
    return figure


def _walk_on(law: Memory, start: float, goal: float) -> list[tuple[Array, Array]]:
    path = np.linspace(start, goal, 200)
    force = [law.evaluate(np.array([z]))[0][0] for z in path]
    return [(1e3 * path, KILO * np.array(force))]


def seabed_suction_speed() -> Figure:
    figure, (force, reach) = new_panels(2)
    speed = np.logspace(-7.0, 0.0, 200)
    law = PullOut(force_factor=force_factor(D, SU), reach_factor=reach_factor(D))
    force.plot(speed, KILO * law.force(speed), color=INKS[1], linewidth=1.8)
    reach.plot(speed, 1e3 * law.reach(speed), color=INKS[1], linewidth=1.8)
    for axes, label in ((force, "$F_{max}$ (kN/m)"), (reach, r"$\Delta_B$ (mm)")):
        axes.set_xscale("log")
        axes.set_xticks([1e-6, 1e-4, 1e-2, 1.0])
        axes.axvline(law.least_speed, color="#999999", linewidth=0.8)
        frame(axes, "Velocity of pull-out $v$ (m/s)", label)
        axes.set_ylim(bottom=0.0)
    return figure


def seabed_friction() -> Figure:
    figure, (limits, loop) = new_panels(2, 4.2)
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    mu = np.array([0.4, 0.7])
    for ink, style, surface in ((INKS[1], SOLID, "box"), (INKS[4], DASHED, "ellipse")):
        pull = limit_pull(mu, angle, surface)  # type: ignore[arg-type]
        x, y = pull * np.cos(angle), pull * np.sin(angle)
        limits.plot(x, y, color=ink, ls=style, lw=1.8, label=surface)
    limits.set_aspect("equal")
    frame(limits, "Axial $F_1/F_n$ (-)", "Lateral $F_2/F_n$ (-)", title="Limits")
    legend(limits, "center", fontsize=8)
    for ink, normal in ((INKS[1], 1000.0), (INKS[4], 500.0)):
        law, at, path = Friction(1, 0.5, stiffness=5e4), 0.0, [0.0]
        force = [0.0]
        for goal in (0.03, -0.03, 0.03):
            for x in np.linspace(at, goal, 100)[1:]:
                law.commit(np.array([[x - path[-1], 0.0]]), np.array([normal]))
                path.append(float(x))
                force.append(float(law.force[0, 0]))
            at = goal
        label = f"$F_n$ = {normal:g} N/m"
        loop.plot(1e3 * np.array(path), force, color=ink, linewidth=1.8, label=label)
    frame(loop, "Slip (mm)", "Friction (N/m)", title="Back and forth")
    loop.set_ylim(-560.0, 760.0)
    legend(loop, "upper left")
    return figure


def seabed_hyperbolic() -> Figure:
    figure, (axes,) = new_panels(1, 4.2)
    soil = HyperbolicSoil(diameter=D, undrained_shear_strength=1500.0, strength_gradient=1500.0)
    legs = _walk(Hyperbolic(soil, 1), [0.09, 0.06, 0.12, -0.02, 0.16])
    names = "first", "uplift", "again", "uplift to lift-off", "again"
    for ink, name, (z, force) in zip(INKS, names, legs, strict=True):
        axes.plot(z, force, color=ink, linewidth=1.8, label=name)
    first = np.linspace(0.0, 0.16, 200)
    axes.plot(
        1e3 * first,
        KILO * soil.evaluate(first)[0],
        color=INKS[0],
        ls=DASHED,
        lw=1.0,
        label="first, going on",
    )
    frame(axes, "Penetration $z$ (mm)", "$P$ (kN/m)")
    legend(axes, "upper left")
    return figure
