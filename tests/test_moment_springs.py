"""Soil that resists rotation along a tube: closed form of a beam on a Pasternak foundation.

    EI w'''' - c w'' + k w = 0,  w = e^(-a x) (A cos b x + B sin b x)
    a^2 + b^2 = sqrt(k / EI),  a^2 - b^2 = c / (2 EI)

k resists displacement (N/m2), c rotation (N). A force H on the head of a long beam.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from podeep.beam.field import Field
from podeep.model.around import quadrature
from podeep.model.points import Points
from podeep.model.recover import Spread, end_forces, internal_forces
from podeep.model.system import System
from podeep.soil.law import Law
from podeep.soil.reaction import Reaction, Term
from podeep.solve.newton import Ending, Limits, newton

EI, K, C, H, LENGTH = 2e9, 8e6, 1e8, 1e6, 60.0


@dataclass(frozen=True, eq=False)
class Linear(Law):
    """A linear reaction at n points."""

    modulus: np.ndarray
    source = "a test"

    @property
    def capacity(self):
        return np.full(len(self.modulus), np.inf)

    def evaluate(self, u):
        return self.modulus * u, self.modulus * np.ones_like(u)


def reaction(modulus, n):
    law = Linear(np.full(n, modulus))
    return Reaction(n, (Term(np.arange(n), None, law, "linear", (1,)),))


def exact(x):
    """Deflection, slope and moment EI w''."""
    total, difference = np.sqrt(K / EI), C / (2.0 * EI)
    a, b = np.sqrt((total + difference) / 2.0), np.sqrt((total - difference) / 2.0)
    r = complex(-a, b)
    # w = Re(Z e^(r x)); w'' = 0 and EI w''' - c w' = H at the head
    rows = np.array(
        [
            [(r**2).real, -(r**2).imag],
            [(EI * r**3 - C * r).real, -(EI * r**3 - C * r).imag],
        ]
    )
    real, imaginary = np.linalg.solve(rows, [0.0, H])
    wave = complex(real, imaginary) * np.exp(r * x)
    return wave.real, (r * wave).real, EI * (r**2 * wave).real


@pytest.mark.parametrize("components", [1, 2])
def test_a_long_beam_is_pasternaks(components):
    edges = np.linspace(0.0, LENGTH, 61)
    field = Field(edges, np.full(60, EI), 5, 1, 1.0)
    every = np.arange(60)
    x, weight = quadrature(edges, every, 5)
    points = [
        Points(x, weight, reaction(K, len(x))),
        Points(x, weight, reaction(C, len(x)), motion="rotation"),
    ]
    system = System(field, components, points, [], np.zeros(0, dtype=np.intp))
    direction = np.array([1.0]) if components == 1 else np.array([0.6, 0.8])
    load = np.zeros((field.size, components))
    load[0] = H * direction
    found = newton(system, np.zeros(system.size), load.ravel(), Limits(1e-10))
    assert found.ending is Ending.CONVERGED
    q = found.q.reshape(-1, components) @ direction
    at = np.linspace(0.0, 20.0, 41)
    w, slope, moment = exact(at)
    np.testing.assert_allclose(field.interpolation(at) @ q, w, atol=1e-8 * abs(w).max())
    np.testing.assert_allclose(field.interpolation(at, 1) @ q, slope, atol=1e-7 * abs(slope).max())
    soil, couple = (
        p.reaction.evaluate(field.interpolation(x, d) @ q)[0] for d, p in enumerate(points)
    )
    pressed, turned = Spread(every, soil), Spread(every, couple, "rotation")
    ends = end_forces(field, q, [pressed, turned], 5)
    shear, bent = internal_forces(ends, at)
    np.testing.assert_allclose(bent, moment, atol=1e-7 * abs(moment).max())
    assert shear[0] == pytest.approx(H, rel=1e-9)
    without = internal_forces(end_forces(field, q, [pressed], 5), at)[1]
    assert abs(without - moment).max() > 1e-3 * abs(moment).max()  # the couple does count
