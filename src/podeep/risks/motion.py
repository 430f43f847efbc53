"""Motions that are legal but risky: soil that would give more than it has."""

from collections.abc import Iterator

from .risk import Risk, rounded
from .site import Site


def doubled(site: Site) -> Iterator[Risk]:
    """Static and dynamic contributions of the soil in the same direction (IDRE = 0 or 1)."""
    scene = site.scene
    rule = scene.ground.dynamic_rule
    if scene.dynamics is None or rule > 1:
        return
    histories = {h.name for h in scene.harmonics} | {s.name for s in scene.series}
    own = [load for load in scene.loads if load.tube in site.foundation.tubes]
    moved = [load for load in own if load.name in histories]
    pairs = (
        ("across", site.load.lateral, any(any(m.force[:2]) or any(m.moment) for m in moved)),
        (
            "along the tubes",
            max(site.load.compression, site.load.tension),
            any(m.force[2] for m in moved),
        ),
    )
    for direction, still, moves in pairs:
        if still and moves:
            numbers = f"IDRE = {rule} with {rounded(still, 'N')} {direction} in statics"
            law = (
                "in motion the soil gives what it did at the end of statics and its whole curve on "
                "top: together these can exceed what it has"
            )
            remedy = "give IDRE = 2 for one curve in both, or see that motions are small"
            yield Risk(site.name, f"doubled {direction}", numbers, law, remedy)


CHECKS = (doubled,)
