"""The soil profile: which laws act at which depth, and with which parameters."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from ..arrays import Array, Index
from ..errors import Fault, InvalidData, UserError
from ..scene import Curve, Foundation, Ground, Scene
from . import lateral
from .backbone import user_law
from .equivalent import EquivalentDepths
from .kinds import (
    BASE_MOMENT,
    BASE_SHEAR,
    LATERAL,
    MOMENT,
    SHAFT,
    SIDES,
    TIP,
    Kind,
    made,
    taken,
)
from .law import Law, LayeredLaw
from .layers import Layers
from .reaction import Reaction, Term
from .surroundings import WEIGHT, Family, Surroundings

#: options of a curve that no law takes: they are for the capacity
_OTHER_OPTIONS = frozenset({"plug"})

_T = TypeVar("_T", Array, Index)


@dataclass(frozen=True, slots=True, eq=False)
class _Piece:
    """Points under one law, of one layer before they join those of others."""

    curve: Curve
    ids: tuple[int, ...]
    layer: Index
    at: Index
    weight: Array
    depth: Array
    parameters: Mapping[str, Array]

    @classmethod
    def joined(cls, pieces: "Sequence[_Piece]") -> "_Piece":
        """Pieces of several layers as one, its points rising."""
        order = np.argsort(np.concatenate([piece.at for piece in pieces]))

        def whole(parts: list[_T]) -> _T:
            return np.concatenate(parts)[order]

        curve = pieces[0].curve
        return cls(
            curve,
            tuple(dict.fromkeys(i for piece in pieces for i in piece.ids)),
            whole([piece.layer for piece in pieces]),
            whole([piece.at for piece in pieces]),
            whole([piece.weight for piece in pieces]),
            whole([piece.depth for piece in pieces]),
            {n: whole([piece.parameters[n] for piece in pieces]) for n in curve.parameters},
        )


class Profile:
    """Reactions of a ground at any depth below the mudline (m, positive down) and diameter (m).

    A layer is an interval between two depths of the ground; a boundary belongs to the layer above
    it; under the last depth the last curve goes on. Between two curves of one type parameters
    vary linearly and the law is evaluated at the true depth; otherwise loads vary linearly.

    embedded_length: of the tube, m, for the laws that depend on it. axial: whether t-z and Q-z
    curves react. dynamic: in motion, for which user rows of p-y may have a curve of their own; by
    the ground's rule 2 it is the static one there too, by rule 3 the other one in statics too.
    Where a curve has no other, both are one: t-z and Q-z never have.
    Raises UserError where a curve cannot be evaluated, naming it and the remedy.
    """

    def __init__(
        self,
        ground: Ground,
        embedded_length: float | None = None,
        axial: bool = True,
        dynamic: bool = False,
    ) -> None:
        self.ground, self._axial = ground, axial
        rule = ground.dynamic_rule
        self._moving = rule == 3 or (dynamic and rule != 2)
        self._equivalent: EquivalentDepths | None = None
        self._layers = Layers(ground.depths)
        self.boundaries = self._layers.boundaries
        self._curves: Mapping[Family, tuple[Curve | None, ...]] = MappingProxyType(
            {
                "p-y": tuple(ground.lateral_curves[i] if i else None for i in ground.lateral),
                "t-z": tuple(ground.axial_curves[i] if i else None for i in ground.axial),
            }
        )
        self._dashpots = self._layers.spread([ground.dashpots.get(i, 0.0) for i in ground.lateral])
        around = Surroundings(ground, self._layers, self._curves, embedded_length)
        self._around, self._length = around, embedded_length
        if ground.layering == "GEORGIADIS":
            self._equivalent = EquivalentDepths(
                ground,
                self._layers,
                self._curves["p-y"],
                self._layered,
                self._bare,
                around,
            )

    def layer(self, depth: Array) -> Index:
        """Index of the layer of each depth, from 0; a boundary belongs to the layer above it."""
        return self._layers.index(depth)

    def lateral(self, depth: Array, diameter: Array) -> Reaction:
        """p-y of points along a tube, depth and diameter (n,); N/m."""
        return self._reaction(LATERAL, depth, diameter)

    def moment(self, depth: Array, diameter: Array) -> Reaction:
        """Moment against rotation of points along a tube, depth and diameter (n,); N m/m."""
        return self._reaction(MOMENT, depth, diameter)

    def base(self, depth: float, diameter: float) -> tuple[Reaction, Reaction]:
        """Shear (N) against displacement and moment (N m) against rotation of a tip, one point."""
        at, width = np.array([depth]), np.array([diameter])
        return self._reaction(BASE_SHEAR, at, width), self._reaction(BASE_MOMENT, at, width)

    def shaft(self, depth: Array, diameter: Array) -> Reaction:
        """t-z of points along a tube, depth and diameter (n,); N/m."""
        return self._reaction(SHAFT, depth, diameter)

    def tip(self, depth: float | Array, diameter: float | Array) -> Reaction:
        """Q-z of tips, one or (n,); N. At a boundary a tip rests in the layer above."""
        return self._reaction(TIP, np.atleast_1d(depth), np.atleast_1d(diameter))

    def dashpot(self, depth: Array, diameter: Array) -> Array:
        """Radiation damping along a tube, depth and diameter (n,); N s/m2.

        Linear between the depths of the ground, 0 for curves without a dashpot.
        """
        return np.multiply(self._dashpots.at(_below(depth)), diameter)

    def effective_overburden(self, depth: Array, family: Family = "p-y") -> Array:
        """s'v (Pa) at each depth, as `Surroundings.effective_overburden`."""
        return self._around.effective_overburden(np.asarray(depth, dtype=float), family)

    def _reaction(self, kind: Kind, depth: Array, diameter: Array) -> Reaction:
        depth, diameter = _below(depth), np.asarray(diameter, dtype=float)
        laws = {curve.law for curve in self._curves[kind.family] if curve}
        silent = kind.family == "t-z" and not self._axial
        if silent or (kind.columns is None and laws.isdisjoint(kind.laws)):
            return Reaction(len(depth), ())
        groups: dict[tuple[object, ...], list[_Piece]] = {}
        layer = self.layer(depth)
        for index in sorted(set(layer.tolist())):
            at = np.flatnonzero(layer == index)
            for key, piece in self._pieces(kind.family, index, at, depth[at]):
                groups.setdefault(key, []).append(piece)
        terms = (self._term(kind, pieces, diameter) for pieces in groups.values())
        return Reaction(len(depth), tuple(term for term in terms if term is not None))

    def _pieces(
        self, family: Family, layer: int, at: Index, depth: Array
    ) -> Iterator[tuple[tuple[object, ...], _Piece]]:
        """Laws in force at points `at` of a layer, with the key by which they may be joined."""
        upper, lower = (self._curves[family][node] for node in self._layers.ends[layer])
        top, thickness = self._layers.top[layer], self._layers.thickness[layer]
        share = (depth - top) / thickness
        if upper and lower and self._joined(upper, lower, bool(np.isinf(thickness))):
            parameters = {
                name: value + share * (lower.parameters[name] - value)
                for name, value in upper.parameters.items()
            }
            ids = tuple(dict.fromkeys((upper.id, lower.id)))
            layers = np.full(len(at), layer)
            piece = _Piece(upper, ids, layers, at, np.ones(len(at)), depth, parameters)
            yield (0, *_type_of(upper)), piece
            return
        for side, curve, weight, end in (
            (0, upper, 1.0 - share, top),
            (1, lower, share, top + thickness),
        ):
            keep = np.flatnonzero(weight)
            if curve is not None and len(keep):
                full = {name: np.full(len(keep), value) for name, value in curve.parameters.items()}
                where, layers = np.full(len(keep), end), np.full(len(keep), layer)
                piece = _Piece(curve, (curve.id,), layers, at[keep], weight[keep], where, full)
                yield (side, *_type_of(curve)), piece

    def _joined(self, upper: Curve, lower: Curve, last: bool) -> bool:
        """Whether one law with parameters in between acts between two curves, not a blend."""
        if last or (upper.rows and upper.id == lower.id):
            return True
        by_parameters = self.ground.interpolation == "PARAMETERS" and not upper.rows
        return by_parameters and _type_of(upper) == _type_of(lower)

    def _term(self, kind: Kind, pieces: list[_Piece], diameter: Array) -> Term | None:
        """The pieces of one law as one vectorised law; None if there is no reaction."""
        whole = pieces[0] if len(pieces) == 1 else _Piece.joined(pieces)
        curve, weight = whole.curve, whole.weight
        try:
            law = self._law(kind, whole, diameter[whole.at])
        except InvalidData as fault:
            where = f"{kind.family} curve {', '.join(map(str, whole.ids))}"
            raise UserError(Fault(f"{where}: {fault.message}", fault.remedy)) from fault
        if law is None:
            return None
        name = "user" if curve.rows else curve.law
        return Term(whole.at, None if (weight == 1.0).all() else weight, law, name, whole.ids)

    def _law(self, kind: Kind, piece: _Piece, diameter: Array) -> Law | None:
        curve, depth, parameters = piece.curve, piece.depth, piece.parameters
        if curve.rows:
            if kind.columns is None:
                return None
            options: dict[str, Any] = {**curve.options, **parameters}
            return user_law(
                kind.points(curve.rows, self._moving),
                kind.width(diameter),
                diameter if curve.rows_in_diameters else 1.0,
                options.get("multiplier", 1.0),
                kind.compression_only,
            )
        sides = SIDES[kind.family].get(curve.law)
        if sides is None:
            raise InvalidData(
                f"there is no {kind.family} law {curve.law!r} (without rows)",
                f"the laws are {', '.join(SIDES[kind.family])}",
                "ITYP",
            )
        if curve.law not in kind.laws:
            return None
        known = _known(sides)
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
        law = kind.laws[curve.law]
        if self._equivalent is not None and kind is LATERAL and issubclass(law, LayeredLaw):
            given |= self._equivalent.given(piece.layer, depth, diameter, parameters)
        for name in taken(law) - given.keys():
            around = self._around.values(name, kind.family, depth, diameter)
            if around is not None:
                given[name] = around
        return made(law, given)

    def _layered(self, curve: Curve, given: dict[str, Any]) -> LayeredLaw | None:
        """The p-y law of a curve, if soil above it counts by an equivalent depth."""
        sides = lateral.LAWS.get(curve.law)
        if curve.rows or sides is None or not issubclass(sides.resistance, LayeredLaw):
            return None
        return made(sides.resistance, given)

    def _bare(self, depth: Array, diameter: Array) -> Array:
        """Largest |p| without equivalent depths, (n,): for the curves that have none."""
        return (
            Profile(replace(self.ground, layering="NONE"), self._length, dynamic=self._moving)
            .lateral(depth, diameter)
            .capacity
        )


def profile_of(
    scene: Scene, foundation: Foundation, axial: bool | None = None, dynamic: bool = False
) -> Profile:
    """The ground as a foundation's tubes meet it, at rest or in motion.

    axial: as the scene says, or forced. dynamic: as for `Profile`.
    """
    curves = scene.numerics.axial_curves if axial is None else axial
    return Profile(scene.ground, foundation.mudline - scene.tip(foundation), curves, dynamic)


def _below(depth: Array) -> Array:
    """Depths as numbers; ValueError for one above the mudline, where there is no soil."""
    depth = np.asarray(depth, dtype=float)
    if (depth < 0.0).any():
        raise ValueError("a soil reaction is asked for above the mudline")
    return depth


@cache
def _known(sides: tuple[type[Law] | None, ...]) -> frozenset[str]:
    """What curves of these laws may give."""
    return _OTHER_OPTIONS.union([WEIGHT], *(taken(side) for side in sides if side))


def _type_of(curve: Curve) -> tuple[object, ...]:
    """What must agree for points of two curves to be under one vectorised law."""
    if curve.rows:
        return ("user", curve.id)
    return (curve.law, frozenset(curve.options.items()), frozenset(curve.parameters))
