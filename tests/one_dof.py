"""Small recursions that the rows of the one-degree tests describe, beside our own methods."""

from collections.abc import Callable
from dataclasses import dataclass
from math import atan, factorial, pi

import numpy as np
from scipy.optimize import brentq

from podeep.arrays import Array
from podeep.solve.equations import State
from podeep.solve.integrators import CentralDifference, Weighted
from podeep.solve.stage import Effort, Patience
from podeep.study.oscillator import Law, Oscillators, history, linear, nothing, one, wall


def longest_step(mass: float, spring: Law, drag: Law, guess: float) -> float:
    """The largest step, s, with which our central differences do not grow, by bisection.

    drag is met half a step behind, as an explicit method has it. Linear laws: the growth is the
    spectral radius of what a step makes of displacement, velocity and acceleration.
    """
    basis, method = np.eye(3), CentralDifference()
    masses = np.full(3, mass)

    def grows(h: float) -> bool:
        equations = Oscillators(masses, np.zeros(3), spring, drag=drag)
        start = State(0.0, basis[0], basis[1], basis[2], None)
        end = method.step(equations, start, h, Patience(1e-14), Effort())
        made = np.linalg.eigvals(np.array([end.q, end.velocity, end.acceleration]))
        return bool(np.abs(made).max() > 1.0 + 1e-6)

    low, high = 0.1 * guess, 10.0 * guess
    assert not grows(low)
    assert grows(high)
    while high / low > 1.0 + 1e-9:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low


def runge_kutta(order: int) -> Callable[[complex], complex]:
    """Growth in a step of y' = lambda y, z = lambda h, of explicit methods with `order` stages."""
    return lambda z: sum(z**i / factorial(i) for i in range(order + 1))


def first_exit(growth: Callable[[complex], complex], zeta: float) -> float:
    """omega h at which a free vibration with damping zeta first grows; 0: from the start."""
    root = np.emath.sqrt(zeta * zeta - 1.0)

    def over(h: float) -> float:
        return max(abs(growth(h * r)) for r in (-zeta + root, -zeta - root)) - 1.0

    grid = np.linspace(1e-3, 4.0, 4000)
    beyond = next(i for i, h in enumerate(grid) if over(h) > 1e-13)
    return brentq(over, grid[beyond - 1], grid[beyond], xtol=1e-14) if beyond else 0.0


def release_gain(stiff: float) -> float:
    """Largest energy ratio of the trapezoidal rule, h = 1, where a mass leaves a wall: a scan."""
    phase = np.linspace(0.0, min(stiff, 0.5 * pi), 20001)[:-1]
    equations = Oscillators(np.ones(20000), np.zeros(20000), wall(stiff**2))
    q, v = -np.cos(phase) / stiff, np.sin(phase)
    states, _ = history(Weighted(), equations, q, v, 1.0, int(pi / stiff) + 3)
    assert (states[-1].q > 0.0).all()
    return float(np.square(states[-1].velocity).max())


def bounced(stiff: float, gap: Array) -> Array:
    """Energy ratios after one contact by the trapezoidal rule: v = -1, h = 1, so far away."""
    n = len(gap)
    equations = Oscillators(np.ones(n), np.zeros(n), wall(stiff**2))
    states, _ = history(Weighted(), equations, gap, -np.ones(n), 1.0, int(pi / stiff) + 4)
    assert (states[-1].q >= 0.0).all()
    return np.asarray(np.square(states[-1].velocity))


def rigid_growth(mass: float, velocity: float, h: float) -> float:
    """Growth in a step of the force of a rigid contact by the trapezoidal rule: 0 = v0 + v1."""
    acceleration, forces = 0.0, []
    for _ in range(10):
        velocity, before = -velocity, velocity
        acceleration = 2.0 * (velocity - before) / h - acceleration
        forces.append(mass * acceleration)
    assert (np.diff(np.sign(forces)) != 0).all()
    return float(np.diff(np.abs(forces)).mean())


@dataclass
class StickSlip:
    """Period, s, time at rest, s, and largest force of the spring, N."""

    period: float
    stuck: float
    force: float


def stick_slip(m: float, k: float, speed: float, static: float, kinetic: float) -> StickSlip:
    """A mass pulled by a spring over a rough ground: slips are followed by the trapezoidal rule.

    static, kinetic: friction, N. The slip ends where the mass stops; it then rests until the
    spring's force, which grows by k speed, is that of static friction again.
    """
    h = 2e-4
    equations = one(linear(k), m, push=lambda t: np.array([static - kinetic + k * speed * t]))
    steps = int(pi / np.sqrt(k / m) * 2.0 / h)
    states, _ = history(Weighted(), equations, np.zeros(1), np.zeros(1), h, steps)
    v = np.array([s.velocity[0] for s in states])
    end = int(np.flatnonzero(v[1:] < 0.0)[0])
    slip = h * (end + v[end] / (v[end] - v[end + 1]))
    q, t = np.array([s.q[0] for s in states[: end + 2]]), h * np.arange(end + 2)
    force = static + k * (speed * t - q)
    stuck = (static - np.interp(slip, t, force)) / (k * speed)
    return StickSlip(slip + stuck, stuck, float(force.max()))


def stick_slip_exact(m: float, k: float, speed: float, fall: float) -> float:
    """Its period by the formula; fall: of the friction, N."""
    d, w = fall / k, np.sqrt(k / m)
    return float(2.0 * d / speed + (2.0 * pi - 2.0 * atan(d * w / speed)) / w)


def sign_friction(mu: float, g: float, h: float) -> Array:
    """Velocities between the steps of central differences under friction by the sign of v."""
    drag = lambda v: (mu * g * np.sign(v), np.zeros_like(v))  # noqa: E731
    equations = one(nothing, drag=drag)
    states, _ = history(CentralDifference(), equations, np.zeros(1), np.array([0.5]), h, 200)
    return np.diff([s.q[0] for s in states]) / h


def bouncing(stiff: float, drop: float, method: Weighted | None, time: float = 200.0) -> float:
    """E_max/E_0 of a mass of 1 kg on a wall of 1e4 N/m under 9.81 m/s2; stiff: omega h.

    method: a member of Newmark's family; None: the discrete gradient, whose force is the
    difference of potential over that of displacement.
    """
    h, k, g = 1e-2 * stiff, 1e4, 9.81
    x, v, a, first, most = drop, 0.0, -g, g * drop, 0.0
    for _ in range(round(time / h)):
        if method is None:
            x, v = _by_gradient(x, v, h, k, g)
        else:
            am, af, beta, gamma = method.mass_lag, method.force_lag, method.beta, method.gamma
            ahead = x + h * v + h * h * (0.5 - beta) * a
            inertia = (1.0 - am) / (beta * h * h)
            right = inertia * ahead - am * a - g - af * k * min(x, 0.0)
            x = right / inertia
            if x < 0.0:
                x = right / (inertia + (1.0 - af) * k)
            new = (x - ahead) / (beta * h * h)
            v, a = v + h * ((1.0 - gamma) * a + gamma * new), new
        most = max(most, 0.5 * v * v + g * x + 0.5 * k * min(x, 0.0) ** 2)
    return most / first


def _by_gradient(x: float, v: float, h: float, k: float, g: float) -> tuple[float, float]:
    """A step of x1 = x + h/2 (v + v1), v1 = v - h (g + (U1 - U0)/(x1 - x0))."""
    free = x + h * v - 0.5 * h * h * g

    def left(y: float) -> float:
        low, end = min(x, 0.0), min(y, 0.0)
        slope = low if y == x else 0.5 * (end * end - low * low) / (y - x)
        return y - free + 0.5 * h * h * k * slope

    end = free
    if left(free) != 0.0:
        reach = abs(h * v) + h * h * (g + k * abs(min(x, 0.0))) + 1e-9
        end = brentq(left, free - reach, free + reach + h * h * k * reach, xtol=1e-16, rtol=1e-15)
    return end, 2.0 * (end - x) / h - v
