"""Curves that are legal but risky: out of their law's range, slips of units and the like."""

from collections.abc import Callable, Iterator, Mapping
from itertools import accumulate
from math import degrees, inf, isfinite, radians, tan

from ..deck.keywords import KEYWORDS
from ..scene import Curve
from ..soil.sand import default_subgrade_modulus as sand_modulus
from ..soil.stiff_clay import default_subgrade_modulus as clay_modulus
from ..soil.surroundings import Family
from ..units import PARAMETER_UNITS, short
from .ranges import CLAYS, NO_TESTS, RANGES, SANDS, SLIPS
from .risk import Risk, Value, readable, slips, written

Values = Mapping[str, Value]

_FAR = 3.0  # ratio from which a value is far from that of a table
_EDGE = 1e-9  # share of a bound that rounding may pass it by
_LARGEST_BETA = 0.7  # K = 1 with 35 degrees
_CLOSED = 2.0  # overconsolidation ratio up to which clay counts as normally consolidated

#: Sands by the largest beta of each: limits of friction and end bearing, Pa (RP 2GEO table 1).
_LIMITS = ((0.33, 67e3, 3e6), (0.415, 81e3, 5e6), (0.51, 96e3, 10e6), (inf, 115e3, 12e6))
#: Strengths (Pa) up to which a strain at half of it is the usual one.
_STRAINS = ((24e3, 0.02), (48e3, 0.01), (96e3, 0.007), (192e3, 0.005), (inf, 0.004))

_TO_DECK: Mapping[str, Callable[[float], float]] = {"deg": degrees, "%": lambda v: 100.0 * v}
_KEYWORDS: Mapping[Family, str] = {"p-y": "PYCURVE", "t-z": "TZCURVE"}
_COLUMNS = {
    (family, row.law, column.key): (column.name, column.unit)
    for family, keyword in _KEYWORDS.items()
    for row in KEYWORDS[keyword].rows
    for column in row.columns
    if row.law and column.key
}
#: Force and displacement in the rows of user curves that count in statics.
_ROWS: Mapping[Family, tuple[tuple[str, str], ...]] = {
    "p-y": (("P", "Y"),),
    "t-z": (("Tz", "yt"), ("Qz", "yq")),
}


def values_of(family: Family, curve: Curve) -> Values:
    """The parameters of a curve that have an effect, in the units of the deck."""
    found = {}
    for key, amount in curve.parameters.items():
        idle = curve.rows and key not in ("effective_unit_weight", "multiplier")
        if not idle and amount is not None and isfinite(amount):
            unnamed = (key.replace("_", " "), PARAMETER_UNITS.get(key, "-"))
            name, unit = _COLUMNS.get((family, curve.law, key), unnamed)
            found[key] = Value(name, _TO_DECK.get(unit, float)(amount), unit)
    return found


def curve_risks(family: Family, curve: Curve) -> Iterator[Risk]:
    """All that is risky of a curve by itself."""
    values, subject = values_of(family, curve), f"{family} curve {curve.id}"
    for key, value in values.items():
        if key in SLIPS:
            yield from slips(subject, key, value, SLIPS[key])
    for check in _CHECKS:
        yield from check(subject, family, curve, values)


def _ranges(subject: str, _: Family, curve: Curve, values: Values) -> Iterator[Risk]:
    """Values out of the range of their law."""
    for r in RANGES:
        if r.parameter in values and (not r.laws or curve.law in r.laws):
            value = values[r.parameter]
            if not r.low * (1.0 - _EDGE) <= value.amount <= r.high * (1.0 + _EDGE):
                yield Risk(subject, r.parameter, str(value), r.rule, r.remedy)


def _strain(subject: str, _: Family, curve: Curve, values: Values) -> Iterator[Risk]:
    """A strain at half the strength that clay of this strength hardly has."""
    if curve.law not in CLAYS or "strain_50" not in values:
        return
    strength, strain = values["undrained_shear_strength"], values["strain_50"]
    usual = next(e for limit, e in _STRAINS if strength.amount <= limit)
    if not usual / _FAR <= strain.amount <= usual * _FAR:
        rule = f"clay of that strength has about {short(usual)}, by the usual defaults (LPILE)"
        yield Risk(subject, "strain_50", f"{strain} with {strength}", rule, NO_TESTS)


def _modulus(subject: str, _: Family, curve: Curve, values: Values) -> Iterator[Risk]:
    """A subgrade modulus far from the standard's, or one of an angle that its table lacks."""
    given = values.get("subgrade_modulus")
    if curve.law in SANDS:
        beside, source = values["friction_angle"], "API RP 2GEO 8.5.7, below water"
        usual = float(sand_modulus(radians(beside.amount)))
    elif curve.law == "stiff_clay_free_water":
        beside, source = values["undrained_shear_strength"], "FHWA GEC-9"
        usual = float(clay_modulus(beside.amount, bool(curve.options.get("cyclic"))))
    else:
        return
    table = f"{readable(usual, 'N/m3')} ({source})"
    if given is not None and not usual / _FAR <= given.amount <= usual * _FAR:
        rule, remedy = f"the table has {table} there", "leave K out for it, or back K by tests"
        yield Risk(subject, "subgrade_modulus", f"{given} with {beside}", rule, remedy)
    elif given is None and curve.law in SANDS and beside.amount < 25.0 * (1.0 - _EDGE):
        rule = f"the table that stands in starts at 25 degrees, {table}"
        yield Risk(subject, "subgrade_modulus", f"{beside} without K", rule, "give K from tests")


def _friction(subject: str, _: Family, curve: Curve, values: Values) -> Iterator[Risk]:
    """Friction of sand that is too large, or grows without a limit."""
    if curve.law != "cohesionless" or curve.rows:
        return
    factor = values["earth_pressure_coefficient"]
    beta, numbers = factor.amount, f"beta = {factor}"
    if curve.options.get("method", "BETA") != "DIRECT":
        angle = values["interface_friction_angle"]
        beta *= tan(radians(angle.amount))
        numbers = f"{factor} with {angle}, beta = {beta:.3g}"
    if beta > _LARGEST_BETA * (1.0 + 1e-3):  # 0.7002, as the figures that make it are rounded
        rule = (
            "very dense sand has 0.56 (API RP 2GEO table 1), on a closed or plugged pile 0.7 "
            "(K = 1 with 35 degrees, API RP 2A-WSD 6.4.3)"
        )
        remedy = "lower either, or back the friction by tests"
        yield Risk(subject, "earth_pressure_coefficient", numbers, rule, remedy)
    friction, bearing = next(row[1:] for row in _LIMITS if beta <= row[0])
    lacking = {}
    if beta > 0.0 and "friction_limit" not in values:
        lacking["F5"] = friction
    if values["bearing_factor"].amount > 0.0 and "end_bearing_limit" not in values:
        lacking["F6"] = bearing
    if lacking:
        numbers = f"no {' and no '.join(lacking)} with beta = {beta:.3g}"
        rule = "what sand bears would grow with depth without bound (limits: API RP 2GEO table 1)"
        remedy = f"give {' and '.join(f'{name}={written(v)}' for name, v in lacking.items())} (Pa)"
        yield Risk(subject, "limits", numbers, rule, remedy)


def _gap(subject: str, _: Family, curve: Curve, values: Values) -> Iterator[Risk]:
    """Clay that is taken to follow the pile, though it is overconsolidated."""
    ratio = values.get("overconsolidation_ratio")
    if curve.options.get("no_gap") and ratio and ratio.amount > _CLOSED * (1.0 + _EDGE):
        rule = "normally consolidated clay alone follows a pile (ISO 19901-4, third edition)"
        remedy = "leave NOGAP out, which gives less resistance"
        yield Risk(subject, "no_gap", f"NOGAP with {ratio}", rule, remedy)


def _softening(subject: str, family: Family, curve: Curve, _: Values) -> Iterator[Risk]:
    """User rows that fall behind a peak."""
    for place, (force, displacement) in enumerate(_ROWS[family]):
        rows = [(row[2 * place + 1], abs(row[2 * place])) for row in curve.rows]
        for way in ([r for r in rows if r[0] > 0.0], [r for r in rows[::-1] if r[0] < 0.0]):
            tops = accumulate((p for _, p in way), max)
            if any(p < top * (1.0 - _EDGE) for (_, p), top in zip(way, tops, strict=True)):
                at, peak = max(way, key=lambda row: row[1])
                unit = "diameters" if curve.rows_in_diameters else "m"
                numbers = (
                    f"{force} falls from its peak, {readable(peak, 'Pa')} at {displacement} = "
                    f"{short(at)} {unit}, to {readable(way[-1][1], 'Pa')} in the last row"
                )
                rule = "behind a peak equilibrium can be lost, and what was lost does not return"
                remedy = "look that the results stay short of it, or give rows without the peak"
                yield Risk(subject, f"rows of {force}", numbers, rule, remedy)


_Check = Callable[[str, Family, Curve, Values], Iterator[Risk]]
_CHECKS: tuple[_Check, ...] = (_ranges, _strain, _modulus, _friction, _gap, _softening)
