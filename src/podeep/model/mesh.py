"""Element boundaries: where something changes, and between these as fine as the soil asks.

A deflected pile lives on the length (4 EI / k)^(1/4), k being the soil's modulus (Hetenyi 1946), a
stretched one on (EA / k)^(1/2): the size of an element is a share of the lesser of both. Free tube
needs one element a stretch.
"""

import itertools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..scene import Section, Tube
from ..soil.profile import Profile
from ..soil.reaction import Reaction

TOUCH = 2e-3  # boundaries closer than this are one, m: shorter elements are mere rounding
_PROBE = 0.01  # displacement at which the soil's modulus is taken, in diameters
_SAMPLES = 16  # soil moduli taken in each stretch
_COARSEN = 0.1  # growth of the element per characteristic length below the mudline


@dataclass(frozen=True, slots=True)
class Stretch:
    """Tubes of one section each in one soil layer, between the depths top and bottom, m.

    sections: of the foundation's tubes in their order, None for a tube that is not there.
    """

    top: float
    bottom: float
    sections: tuple[Section | None, ...]

    @property
    def outermost(self) -> int:
        """Number of the outermost tube."""
        return next(i for i, section in enumerate(self.sections) if section is not None)

    @property
    def section(self) -> Section:
        """That of the outermost tube."""
        return next(section for section in self.sections if section is not None)

    def total(self, stiffness: Callable[[Section], float]) -> float:
        """A stiffness of all tubes together."""
        return sum(stiffness(section) for section in self.sections if section is not None)

    @property
    def embedded(self) -> bool:
        return self.bottom > TOUCH

    @property
    def length(self) -> float:
        return self.bottom - self.top


def stretches(
    tubes: Sequence[Tube], mudline: float, profile: Profile, others: Iterable[float]
) -> tuple[Stretch, ...]:
    """Cut tubes where section or soil change and at `others` (depths of loads and holds).

    The tubes stand beside each other without a gap between the highest top and the lowest tip.
    """
    top = min(mudline - tube.top for tube in tubes)
    tip = max(mudline - tube.tip for tube in tubes)
    ends = [mudline - z for t in tubes for s in t.sections for z in (s.top, s.bottom)]
    wanted = [0.0, *profile.boundaries, *others, *ends]
    cuts = [top]
    for x in sorted(wanted):
        if cuts[-1] + TOUCH < x < tip - TOUCH:
            cuts.append(x)
    cuts.append(tip)
    pieces = []
    for a, b in itertools.pairwise(cuts):
        pieces.append(Stretch(a, b, tuple(_section(t, mudline - 0.5 * (a + b)) for t in tubes)))
    return tuple(pieces)


def _section(tube: Tube, elevation: float) -> Section | None:
    return next((s for s in tube.sections if s.top >= elevation >= s.bottom), None)


def bent_lengths(pieces: Sequence[Stretch], profile: Profile) -> Array:
    """(4 EI / k)^(1/4) at the samples of stretches in soil, (stretches, samples), m."""
    stiffness = [p.total(lambda section: section.bending_stiffness) for p in pieces]
    with np.errstate(divide="ignore"):  # inf where the soil does not react
        ratio = 4.0 * np.array(stiffness)[:, None] / _modulus(pieces, profile.lateral)
        return np.asarray(ratio**0.25)


def stretched_lengths(pieces: Sequence[Stretch], profile: Profile) -> Array:
    """(EA / k)^(1/2) at the samples of stretches in soil, (stretches, samples), m."""
    stiffness = [p.total(lambda section: section.axial_stiffness) for p in pieces]
    with np.errstate(divide="ignore"):
        ratio = np.array(stiffness)[:, None] / _modulus(pieces, profile.shaft)
        return np.asarray(ratio**0.5)


def _samples(pieces: Sequence[Stretch]) -> Array:
    """Evenly spread depths in each stretch, (stretches, samples), m."""
    top, length = (np.array([getattr(p, name) for p in pieces]) for name in ("top", "length"))
    return np.asarray(top[:, None] + length[:, None] * (np.arange(_SAMPLES) + 0.5) / _SAMPLES)


def _modulus(pieces: Sequence[Stretch], react: Callable[[Array, Array], Reaction]) -> Array:
    """Secant modulus at a share of the diameters at each sample, (stretches, samples), N/m2."""
    width = np.repeat([p.section.outer_diameter for p in pieces], _SAMPLES)
    probe = _PROBE * width
    force = react(_samples(pieces).ravel(), width).evaluate(probe)[0]
    return np.asarray(np.maximum(force / probe, 0.0)).reshape(len(pieces), _SAMPLES)


def active_length(pieces: Sequence[Stretch], profile: Profile, fade: float) -> float:
    """Depth below which a deflection has faded to a share of what it was at the mudline, m.

    It fades as exp(-x) over characteristic lengths.
    """
    gone, wet = 0.0, [piece for piece in pieces if piece.embedded]
    for piece, lengths in zip(wet, bent_lengths(wet, profile), strict=True):
        step = piece.length / _SAMPLES
        far = gone + step * np.cumsum(1.0 / lengths)
        if far[-1] > -np.log(fade):
            return piece.top + step * (1 + int(np.searchsorted(far, -np.log(fade))))
        gone = float(far[-1])
    return pieces[-1].bottom


def densities(pieces: Sequence[Stretch], profile: Profile, active: float) -> list[Array]:
    """Elements per metre, up to a common factor, at the samples of each stretch.

    active: depth below which the deflection asks for none, m.
    """
    wet = [piece for piece in pieces if piece.embedded]
    bent = np.where(_samples(wet) < active, 1.0 / bent_lengths(wet, profile), 0.0)
    density = np.maximum(bent, 1.0 / stretched_lengths(wet, profile))
    passed = density * np.array([piece.length / _SAMPLES for piece in wet])[:, None]
    gone = np.cumsum(passed).reshape(passed.shape) - 0.5 * passed
    found = iter(density / (1.0 + _COARSEN * gone))
    return [next(found) if piece.embedded else np.zeros(_SAMPLES) for piece in pieces]


def divide(piece: Stretch, density: Array, count: int) -> Array:
    """Boundaries of `count` elements of equal share of the density, the top one included."""
    if count == 1 or not density.any():
        return np.linspace(piece.top, piece.bottom, count + 1)[:-1]
    share = np.concatenate([[0.0], np.cumsum(density + 1e-3 * density.max())])
    grid = np.linspace(piece.top, piece.bottom, len(share))
    return np.interp(np.linspace(0.0, share[-1], count + 1)[:-1], share, grid)


def edges(
    pieces: Sequence[Stretch],
    profile: Profile,
    size: float,
    elements: int | None = None,
    active: float = np.inf,
) -> Array:
    """Element boundaries, rising, m.

    size: length of an element in characteristic lengths. `elements`, when given, is the number of
    elements of the whole tube instead; each stretch has at least one. active: depth below which the
    deflection asks for no elements, m.
    """
    density = densities(pieces, profile, active)
    amount = np.array([d.mean() * p.length for d, p in zip(density, pieces, strict=True)])
    counts = np.maximum(np.ceil(amount / size - 1e-9), 1.0).astype(int)
    if elements is not None:
        counts = apportion(amount, max(elements, len(pieces)))
    cut = [divide(p, d, int(n)) for p, d, n in zip(pieces, density, counts, strict=True)]
    return np.concatenate([*cut, [pieces[-1].bottom]])


def apportion(amount: Array, total: int) -> Array:
    """Whole numbers of at least one in the proportion of `amount` that add up to `total`."""
    counts = np.ones(len(amount), dtype=int)
    for _ in range(total - len(amount)):
        counts[int(np.argmax(amount / counts))] += 1
    return counts
