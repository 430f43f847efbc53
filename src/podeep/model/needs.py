"""How much model a scene needs: each decision with its reason."""

from dataclasses import dataclass, replace
from math import atan2, cos, degrees, hypot, pi, radians, sin

from ..errors import Fault, UserError
from ..scene import Foundation, Scene


@dataclass(frozen=True, slots=True)
class Decision:
    """One choice of model, in words for the run's report."""

    choice: str
    reason: str

    def __str__(self) -> str:
        return f"{self.choice}: {self.reason}"


@dataclass(frozen=True, slots=True)
class Needs:
    """The model of one foundation.

    lateral_axis: direction of the common plane of all loads, degrees from x in (-90, 90]; None
    where they share none. components: deflections that are solved, 1 along the axis or 2. axial:
    something drives the tubes along z.
    """

    lateral_axis: float | None
    components: int
    decisions: tuple[Decision, ...]
    second_order: bool = False
    shear: bool = False
    axial: bool = True

    def told(self, *more: Decision) -> "Needs":
        """The same with decisions that are not among its own yet."""
        own = self.decisions
        return replace(self, decisions=(*own, *(d for d in more if d not in own)))

    @property
    def direction(self) -> tuple[tuple[float, float], ...]:
        """Unit vector (x, y) of each component."""
        if self.components == 2:
            return ((1.0, 0.0), (0.0, 1.0))
        assert self.lateral_axis is not None
        angle = radians(self.lateral_axis)
        exact = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0)}
        return (exact.get(self.lateral_axis, (cos(angle), sin(angle))),)


def lateral_vectors(scene: Scene, foundation: Foundation) -> list[tuple[float, float]]:
    """What drives the tube sideways, as vectors in the plane of the deflection (x, y).

    A moment about y drives the deflection in x, with the sign of the slope it works on.
    """
    vectors = []
    for load in scene.loads:
        if load.tube in foundation.tubes:
            vectors.append((load.force[0], load.force[1]))
            vectors.append((-load.moment[1], load.moment[0]))
    imposed: dict[tuple[str, int, float, bool], list[float]] = {}
    for d in scene.displacements:
        if d.tube in foundation.tubes and d.dof in ("X", "Y", "RX", "RY"):
            rotation = d.dof.startswith("R")
            pair = imposed.setdefault((d.name, d.tube, d.elevation, rotation), [0.0, 0.0])
            pair[0] += {"X": d.value, "RY": -d.value}.get(d.dof, 0.0)
            pair[1] += {"Y": d.value, "RX": d.value}.get(d.dof, 0.0)
    for start in scene.starts:
        if start.tube in foundation.tubes and start.dof in ("X", "Y", "RX", "RY"):
            amount = (-1.0 if start.dof == "RY" else 1.0) * (start.value or start.velocity)
            vectors.append((amount, 0.0) if start.dof in ("X", "RY") else (0.0, amount))
    vectors.extend((pair[0], pair[1]) for pair in imposed.values())
    return [v for v in vectors if v != (0.0, 0.0)]


def axially_driven(scene: Scene, foundation: Foundation) -> bool:
    """Whether a load, an imposed displacement or where they start drives the tubes along z."""
    loads = any(load.force[2] for load in scene.loads if load.tube in foundation.tubes)
    moved = (d for d in scene.displacements if d.tube in foundation.tubes)
    starts = any(s.dof == "Z" for s in scene.starts if s.tube in foundation.tubes)
    return loads or starts or any(d.value for d in moved if d.dof == "Z")


def common_axis(vectors: list[tuple[float, float]]) -> float | None:
    """Angle from x, degrees in (-90, 90], of the line that all vectors share; None if none."""
    if not vectors:
        return 0.0
    first = max(vectors, key=lambda v: abs(v[0]) + abs(v[1]))
    for v in vectors:
        if abs(first[0] * v[1] - first[1] * v[0]) > 1e-12 * hypot(*first) * hypot(*v):
            return None
    angle = atan2(first[1], first[0])
    angle -= pi * round(angle / pi - 1e-12)
    return round(degrees(angle), 12) + 0.0


def isotropic(scene: Scene, foundation: Foundation) -> bool:
    """Whether everything that holds the tube sideways, or weighs it down, is alike in x and y."""
    hold: dict[tuple[int, float, bool, str], list[float]] = {}

    def add(kind: str, tube: int, elevation: float, dof: str, amount: float) -> None:
        if tube in foundation.tubes and dof in ("X", "Y", "RX", "RY"):
            pair = hold.setdefault((tube, elevation, dof.startswith("R"), kind), [0.0, 0.0])
            pair[dof in ("Y", "RX")] += amount

    for support in scene.supports:
        for dof in support.dofs:
            add("held", support.tube, support.elevation, dof, 1.0)
    for spring in scene.springs:
        add("spring", spring.tube, spring.elevation, spring.dof, spring.stiffness)
    for mass in scene.masses:
        add("mass", mass.tube, mass.elevation, "RX", mass.inertia[0])
        add("mass", mass.tube, mass.elevation, "RY", mass.inertia[1])
    for d in scene.displacements:
        add("moved", d.tube, d.elevation, d.dof, 1.0)
    return all(pair[0] == pair[1] for pair in hold.values())


def needs(scene: Scene, foundation: Foundation) -> Needs:
    """Decide on the model of one foundation."""
    numerics = scene.numerics
    driven = numerics.weight or axially_driven(scene, foundation)
    held = "t-z along the shaft and Q-z at the tip", "curves of the deck"
    if not numerics.axial_curves:
        held = "supports alone along z", "t-z and Q-z curves are left out (*MODEL TZ=OFF)"
    elif not driven:
        held = "no axial part", "nothing drives it"
    asked_for = (
        Decision(*held),
        *((Decision("P-delta", "asked"),) if numerics.second_order else ()),
        *((Decision("small displacements", "asked"),) if numerics.second_order is False else ()),
        *((Decision("shear", "asked"),) if numerics.shear else ()),
        *((Decision("own weight", "asked"),) if numerics.weight else ()),
    )

    def made(lateral_axis: float | None, components: int, lateral: Decision) -> Needs:
        both = (bool(numerics.second_order), numerics.shear)
        return Needs(lateral_axis, components, (lateral, *asked_for), *both, driven)

    vectors = lateral_vectors(scene, foundation)
    axis = common_axis(vectors)
    asked = numerics.components
    shared = axis is not None and (axis in (0.0, 90.0) or isotropic(scene, foundation))
    if asked == 1 and not shared:
        raise UserError(
            Fault(
                f"{foundation.name}: PLANAR, but its loads, supports and springs share no plane",
                "leave PLANAR out, or give all loads one plane",
            )
        )
    if asked == 2:
        return made(axis, 2, Decision("spatial", "asked"))
    if axis is None:
        return made(None, 2, Decision("spatial", "the loads share no plane"))
    if axis in (0.0, 90.0) or isotropic(scene, foundation):
        reason = (
            f"all loads share the plane at {axis:g} degrees from x"
            if vectors
            else ("no lateral load")
        )
        return made(axis, 1, Decision("planar", reason))
    return made(axis, 2, Decision("spatial", "supports, springs or masses differ in x and y"))
