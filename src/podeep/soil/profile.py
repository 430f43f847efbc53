"""The soil profile: which laws act at which depth, and with which parameters."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from math import pi
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

from ..arrays import Array, Index
from ..errors import Fault, InvalidData, UserError
from ..scene import Curve, Ground
from . import axial, lateral
from .backbone import user_law
from .law import Law
from .reaction import Reaction, Term

Family = Literal["p-y", "t-z"]

_WEIGHT = "effective_unit_weight"
#: options of a curve that no law takes: they are for the capacity
_OTHER_OPTIONS = frozenset({"plug"})


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of reaction: its curves, its laws, and what user rows mean for it."""

    family: Family
    laws: Mapping[str, type[Law]]
    columns: slice  # of a user's row: reaction and displacement
    width: Callable[[Array], Array]  # what a pressure acts on, from the diameter
    compression_only: bool = False


_LATERAL = _Kind("p-y", lateral.LAWS, slice(0, 2), lambda diameter: diameter)
_SHAFT = _Kind(
    "t-z",
    {name: laws.shaft for name, laws in axial.LAWS.items()},
    slice(0, 2),
    lambda diameter: pi * diameter,
)
_TIP = _Kind(
    "t-z",
    {name: laws.tip for name, laws in axial.LAWS.items()},
    slice(2, 4),
    lambda diameter: 0.25 * pi * diameter**2,
    compression_only=True,
)


@dataclass(frozen=True, slots=True, eq=False)
class _Piece:
    """Points of one layer under one law, before they join those of other layers."""

    curve: Curve
    ids: tuple[int, ...]
    at: Index
    weight: Array
    depth: Array
    parameters: Mapping[str, Array]


class Profile:
    """Reactions of a ground at any depth below the mudline (m, positive down) and diameter (m).

    A layer is an interval between two depths of the ground; a boundary belongs to the layer above
    it; under the last depth the last curve goes on. Between two curves of one type parameters
    vary linearly and the law is evaluated at the true depth; otherwise loads vary linearly.

    Raises UserError where a curve cannot be evaluated, naming the curve and the remedy.
    """

    def __init__(self, ground: Ground) -> None:
        self.ground = ground
        self._top = np.unique(np.array(ground.depths))
        self._thickness = np.append(np.diff(self._top), np.inf)
        self.boundaries: tuple[float, ...] = tuple(self._top[1:].tolist())
        # of a depth given twice, the second entry heads the layer below, the first ends the upper
        first = np.searchsorted(ground.depths, self._top, side="left")
        last = np.searchsorted(ground.depths, self._top, side="right") - 1
        self._ends: list[tuple[int, int]] = list(
            zip(last.tolist(), [*first[1:].tolist(), int(last[-1])], strict=True)
        )
        self._curves: Mapping[Family, tuple[Curve | None, ...]] = MappingProxyType(
            {
                "p-y": tuple(ground.lateral_curves[i] if i else None for i in ground.lateral),
                "t-z": tuple(ground.axial_curves[i] if i else None for i in ground.axial),
            }
        )
        self._weights = {family: self._unit_weights(family) for family in self._curves}

    def layer(self, depth: Array) -> Index:
        """Index of the layer of each depth, from 0; a boundary belongs to the layer above it."""
        return np.asarray(np.searchsorted(self._top[1:], depth, side="left"), dtype=np.intp)

    def lateral(self, depth: Array, diameter: Array) -> Reaction:
        """p-y of points along a tube, depth and diameter (n,); N/m."""
        return self._reaction(_LATERAL, depth, diameter)

    def shaft(self, depth: Array, diameter: Array) -> Reaction:
        """t-z of points along a tube, depth and diameter (n,); N/m."""
        return self._reaction(_SHAFT, depth, diameter)

    def tip(self, depth: float, diameter: float) -> Reaction:
        """Q-z of a tip, one point; N. At a boundary it rests in the layer above."""
        return self._reaction(_TIP, np.array([depth]), np.array([diameter]))

    def effective_overburden(self, depth: Array, family: Family = "p-y") -> Array:
        """s'v (Pa) at each depth: the integral of the unit weights that the curves give.

        The weights are those of the family's own curves, or where they give none of the other's;
        they vary linearly within a layer.
        """
        depth = np.asarray(depth, dtype=float)
        weights, thickness = self._weights[family], self._thickness
        rise = (weights[1] - weights[0]) / thickness
        whole = weights.mean(axis=0)[:-1] * thickness[:-1]
        above = np.concatenate(([0.0], np.cumsum(whole)))
        layer = self.layer(depth)
        inside = depth - self._top[layer]
        mean = weights[0, layer] + 0.5 * rise[layer] * inside
        partial = np.multiply(inside, mean, out=np.zeros(depth.shape), where=inside > 0.0)
        overburden = above[layer] + partial
        if np.isnan(overburden).any():
            raise self._unknown_weight(family, float(np.min(depth[np.isnan(overburden)])))
        return np.asarray(overburden)

    def _unit_weights(self, family: Family) -> Array:
        """Unit weight at the top and at the bottom of each layer, (2, layers); NaN if unknown."""
        other: Family = "t-z" if family == "p-y" else "p-y"
        given = []
        for own, fallback in zip(self._curves[family], self._curves[other], strict=True):
            found = [
                c.parameters[_WEIGHT] for c in (own, fallback) if c and _WEIGHT in c.parameters
            ]
            given.append(found[0] if found else np.nan)
        return np.asarray(np.array(given)[np.array(self._ends).T])

    def _unknown_weight(self, family: Family, depth: float) -> UserError:
        """The error of an overburden that needs a unit weight which no curve gives."""
        layer, side = np.argwhere(np.isnan(self._weights[family].T))[0].tolist()
        node = self._ends[layer][side]
        ids = {"p-y": self.ground.lateral[node], "t-z": self.ground.axial[node]}
        return UserError(
            Fault(
                f"the effective overburden at {depth:g} m below the mudline, which a {family} law "
                f"needs, is unknown: at {self.ground.depths[node]:g} m neither p-y curve "
                f"{ids['p-y']} nor t-z curve {ids['t-z']} gives an effective unit weight",
                "give GAMMA= by name on the first line of one of them (where both are 0, of a user "
                "curve without reaction)",
            )
        )

    def _reaction(self, kind: _Kind, depth: Array, diameter: Array) -> Reaction:
        depth, diameter = np.asarray(depth, dtype=float), np.asarray(diameter, dtype=float)
        if (depth < 0.0).any():
            raise ValueError("a soil reaction is asked for above the mudline")
        groups: dict[tuple[object, ...], list[_Piece]] = {}
        layer = self.layer(depth)
        for index in np.unique(layer).tolist():
            at = np.flatnonzero(layer == index)
            for key, piece in self._pieces(kind.family, index, at, depth[at]):
                groups.setdefault(key, []).append(piece)
        terms = (self._term(kind, pieces, diameter) for pieces in groups.values())
        return Reaction(len(depth), tuple(term for term in terms if term is not None))

    def _pieces(
        self, family: Family, layer: int, at: Index, depth: Array
    ) -> Iterator[tuple[tuple[object, ...], _Piece]]:
        """Laws in force at points `at` of a layer, with the key by which they may be joined."""
        upper, lower = (self._curves[family][node] for node in self._ends[layer])
        top, thickness = self._top[layer], self._thickness[layer]
        share = (depth - top) / thickness
        if upper and lower and self._joined(upper, lower, bool(np.isinf(thickness))):
            parameters = {
                name: value + share * (lower.parameters[name] - value)
                for name, value in upper.parameters.items()
            }
            ids = tuple(dict.fromkeys((upper.id, lower.id)))
            piece = _Piece(upper, ids, at, np.ones(len(at)), depth, parameters)
            yield (0, *_type_of(upper)), piece
            return
        for side, curve, weight, end in (
            (0, upper, 1.0 - share, top),
            (1, lower, share, top + thickness),
        ):
            keep = np.flatnonzero(weight)
            if curve is not None and len(keep):
                full = {name: np.full(len(keep), value) for name, value in curve.parameters.items()}
                where = np.full(len(keep), end)
                piece = _Piece(curve, (curve.id,), at[keep], weight[keep], where, full)
                yield (side, *_type_of(curve)), piece

    def _joined(self, upper: Curve, lower: Curve, last: bool) -> bool:
        """Whether one law with parameters in between acts between two curves, not a blend."""
        if last or (upper.rows and upper.id == lower.id):
            return True
        by_parameters = self.ground.interpolation == "PARAMETERS" and not upper.rows
        return by_parameters and _type_of(upper) == _type_of(lower)

    def _term(self, kind: _Kind, pieces: list[_Piece], diameter: Array) -> Term | None:
        """The pieces of one law as one vectorised law; None if there is no reaction."""
        at = np.concatenate([piece.at for piece in pieces])
        order = np.argsort(at)
        at, curve = at[order], pieces[0].curve
        depth = np.concatenate([piece.depth for piece in pieces])[order]
        weight = np.concatenate([piece.weight for piece in pieces])[order]
        parameters = {
            name: np.concatenate([piece.parameters[name] for piece in pieces])[order]
            for name in curve.parameters
        }
        ids = tuple(dict.fromkeys(i for piece in pieces for i in piece.ids))
        try:
            law = self._law(kind, curve, depth, diameter[at], parameters)
        except InvalidData as fault:
            where = f"{kind.family} curve {', '.join(map(str, ids))}"
            raise UserError(Fault(f"{where}: {fault.message}", fault.remedy)) from fault
        if law is None:
            return None
        name = "user" if curve.rows else curve.law
        return Term(at, None if (weight == 1.0).all() else weight, law, name, ids)

    def _law(
        self, kind: _Kind, curve: Curve, depth: Array, diameter: Array, parameters: dict[str, Array]
    ) -> Law | None:
        if curve.rows:
            options: dict[str, Any] = {**curve.options, **parameters}
            return user_law(
                [row[kind.columns] for row in curve.rows],
                kind.width(diameter),
                diameter if curve.rows_in_diameters else 1.0,
                options.get("multiplier", 1.0),
                kind.compression_only,
            )
        if curve.law not in kind.laws:
            raise InvalidData(
                f"there is no {kind.family} law {curve.law!r} (without rows)",
                f"the laws are {', '.join(kind.laws)}",
                "ITYP",
            )
        law = kind.laws[curve.law]
        taken = {field.name for field in fields(law)}  # type: ignore[arg-type]  # as above
        known = taken | _PARTNERS.get(curve.law, frozenset()) | {_WEIGHT} | _OTHER_OPTIONS
        given: dict[str, Any] = {
            "depth": depth,
            "diameter": diameter,
            "initial_stiffness": self.ground.friction_stiffness,
            **parameters,
            **curve.options,
        }
        if strange := sorted((curve.parameters.keys() | curve.options.keys()) - known):
            raise InvalidData(
                f"the law {curve.law!r} does not take {', '.join(strange)}",
                f"it takes {', '.join(sorted(known))}",
            )
        if "effective_overburden" in taken:
            given["effective_overburden"] = self.effective_overburden(depth, kind.family)
        return law(**{name: value for name, value in given.items() if name in taken})


#: All that the laws of one t-z curve take: shaft and tip share the curve.
_PARTNERS: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        name: frozenset(field.name for law in laws for field in fields(law))
        for name, laws in axial.LAWS.items()
    }
)


def _type_of(curve: Curve) -> tuple[object, ...]:
    """What must agree for points of two curves to be under one vectorised law."""
    if curve.rows:
        return ("user", curve.id)
    return (curve.law, frozenset(curve.options.items()), frozenset(curve.parameters))
