"""What an integrator needs to know of what it moves.

    M a + C v + F(q, v) = P(t)

F is the internal force of beams, springs and soil; what follows a path is remembered from one
`commit` to the next.
"""

from dataclasses import dataclass
from typing import Protocol

from ..arrays import Array, Index


@dataclass(frozen=True, slots=True)
class State:
    """Where the unknowns are, (n,), how fast they move and speed up, at a time, s.

    resisting: C v + F there, as the equations have it; None where the method does not ask for it.
    """

    time: float
    q: Array
    velocity: Array
    acceleration: Array
    resisting: Array | None


class Equations(Protocol):
    """Equations of motion of n unknowns; feels_velocity: F depends on v."""

    feels_velocity: bool

    @property
    def held(self) -> Index:
        """Unknowns whose motion is given."""

    def load(self, time: float) -> Array:
        """P, (n,), N."""

    def given(self, time: float) -> tuple[Array, Array, Array]:
        """Values, velocities and accelerations of the held unknowns."""

    def mass_times(self, x: Array) -> Array:
        """M x."""

    def damping_times(self, x: Array) -> Array:
        """C x."""

    def weigh(self, inertia: float, damping: float, rate: float) -> None:
        """Set D = inertia M + damping C for what follows; rate: of v with q, 1/s."""

    def weighed_times(self, q: Array) -> Array:
        """D q."""

    def internal(self, q: Array, velocity: Array | None) -> Array:
        """F on the way from the last commit to q; `solve` uses its tangent there.

        velocity: None where F does not depend on it.
        """

    def solve(self, right: Array) -> Array | None:
        """x of (D + dF/dq + rate dF/dv) x = right, 0 at held unknowns; None without one.

        The tangent is that of the last `internal`, or the kept one.
        """

    def keep_tangent(self, kept: bool) -> None:
        """Keep the tangent of the last `internal` for what follows, or no longer."""

    def solve_weighed(self, right: Array) -> Array:
        """x of D x = right, 0 at held unknowns."""

    def fastest(self) -> float:
        """Largest natural frequency with the tangent of the last `internal`, rad/s."""

    def commit(self, q: Array) -> None:
        """The unknowns have come to q."""
