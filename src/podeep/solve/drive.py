"""What drives a motion: the factors of the named loads in time, and how fast they change."""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from ..arrays import Array
from ..scene import Harmonic, LineMotion, Scene, TimeSeries

Change = tuple[float, float, float]  # a value, its first and its second derivative in time


@dataclass(frozen=True)
class Drive:
    """Factors of named loads at a time, s.

    still: those of all loads at the end of statics, (names,). moving: the places of those that
    have a history, and it. start: time at which ramps begin, s.
    """

    still: Array
    moving: Sequence[tuple[int, Harmonic | TimeSeries]]
    start: float

    def __call__(self, time: float) -> tuple[Array, Array, Array]:
        """Values, first and second derivatives, (names,) each."""
        value, rate, second = self.still.copy(), *np.zeros((2, len(self.still)))
        for place, history in self.moving:
            if isinstance(history, Harmonic):
                found = harmonic(history, time, self.start)
            else:
                found = straight(history.times, history.factors, time)
            value[place], rate[place], second[place] = found
        return value, rate, second


def drive(scene: Scene, start: float) -> Drive:
    """The drive of a scene's loads from the end of its static steps on."""
    names, factors = scene.steps.names, scene.steps.factors
    still = np.array(factors[-1] if factors else np.zeros(len(names)), dtype=float)
    histories: list[Harmonic | TimeSeries] = [*scene.harmonics, *scene.series]
    return Drive(still, [(names.index(h.name), h) for h in histories], start)


def harmonic(history: Harmonic, time: float, start: float) -> Change:
    """ramp(t) sin(2 pi t / period + phase); the ramp is half a cosine's wave from 0 to 1."""
    w = 2.0 * pi / history.period
    angle = w * time + history.phase
    f, df, ddf = sin(angle), w * cos(angle), -w * w * sin(angle)
    since = time - start
    if since >= history.ramp:
        return f, df, ddf
    g = pi / history.ramp
    r, dr, ddr = 0.5 - 0.5 * cos(g * since), 0.5 * g * sin(g * since), 0.5 * g * g * cos(g * since)
    return r * f, dr * f + r * df, ddr * f + 2.0 * dr * df + r * ddf


def straight(times: Sequence[float], values: Sequence[float], time: float) -> Change:
    """Straight lines between the times, held before and after; the slope is that after a time."""
    after = bisect_right(times, time)
    if after == 0 or after == len(times):
        return values[min(after, len(times) - 1)], 0.0, 0.0
    slope = (values[after] - values[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + slope * (time - times[after - 1]), slope, 0.0


def change_of(
    motion: LineMotion, factors: Drive, names: Sequence[str], start: float
) -> Callable[[float], Change]:
    """How far a motion has moved its end since the end of statics, m, and how fast."""
    place = names.index(motion.name) if motion.name in names else None
    waves = [(w.amplitude, Harmonic("", w.period, w.phase, w.ramp)) for w in motion.waves]

    def change(time: float) -> Change:
        found = np.zeros(3)
        if place is not None:
            value, rate, second = (each[place] for each in factors(time))
            found += motion.target * np.array((value - factors.still[place], rate, second))
        for amplitude, wave in waves:
            found += amplitude * np.array(harmonic(wave, time, start))
        if motion.times:
            found += straight(motion.times, motion.values, time)
        value, rate, second = found.tolist()
        return value, rate, second

    return change
