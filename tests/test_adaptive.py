"""Motions whose step follows the error: as exact as asked, in fewer steps, and blind to nothing."""

from dataclasses import replace

import numpy as np
import pytest

from moving_piles import start_of, swaying_pile
from podeep.arrays import Array
from podeep.motion import TimeSeries
from podeep.scene import Scene
from podeep.solve.adaptive import Adaptive
from podeep.solve.dynamics import End
from podeep.solve.pace import adaptive, pace_for
from podeep.solve.plan import onset, simulation, trial_span
from podeep.solve.simulate import Simulation

LOOSE = 1e6  # no error is as large as that


def knocked(
    factors: tuple[float, ...] = (0.0, 0.0, 1.0, 1.0, 0.0),
    times: tuple[float, ...] = (0.0, 1.0, 1.2, 1.5, 1.6),
    **more: object,
) -> Scene:
    """The pile with 200 t on its head, pushed by 4 MN for half a second; then it swings out."""
    scene = swaying_pile(**({"force": 4e6, "end": 20.0} | more))  # type: ignore[arg-type]
    series = (TimeSeries(scene.steps.names[0], times, factors),)
    return replace(scene, harmonics=(), series=series)


def way(one: Simulation) -> tuple[Array, Array]:
    """Times and the head's displacements."""
    blocks = list(one.blocks())
    return (
        np.concatenate([b.times for b in blocks]),
        np.concatenate([b.tracks[0][0].q[:, 0] for b in blocks]),
    )


def following(scene: Scene, added: float, until: float | None = None) -> Adaptive:
    """A scene in steps that follow the error."""
    assert scene.dynamics is not None
    return adaptive(scene, scene.dynamics, [start_of(scene)], added, until or scene.dynamics.end)


@pytest.mark.parametrize("hysteresis", ["ELASTIC", "MASING"])
def test_the_error_of_a_knock_is_within_the_accuracy(hysteresis):
    scene = knocked(accuracy=2e-3, hysteresis=hysteresis, end=4.0)
    assert scene.dynamics is not None
    start, dynamics = [start_of(scene)], replace(scene.dynamics, adaptive=True)
    pace = pace_for(scene, dynamics, start)
    one = adaptive(scene, dynamics, start, pace, 4.0)
    times, head = way(one)
    exact = simulation(scene, dynamics, start, 1e-3, 4.0, twins=False)
    true_times, true = way(exact)
    error = np.abs(head - np.interp(times, true_times, true)).max() / np.abs(true).max()
    assert error <= 2e-3
    assert error / 4 <= one.error <= 4 * error


def test_a_knock_takes_fewer_steps_than_steps_of_one_length():
    """The knock needs short steps, the swinging out does not."""
    scene = knocked(accuracy=1e-3, hysteresis="MASING", end=12.0)
    assert scene.dynamics is not None
    one = following(scene, 1e-5)
    same = simulation(scene, scene.dynamics, [start_of(scene)], 0.0085, 12.0)
    for each in (one, same):
        each.record_each(12.0)
        way(each)
    assert one.error <= 1.2 * same.error
    assert one.done < 0.85 * same.done
    assert one.shortest <= one.longest / 8


def test_without_a_bound_it_is_the_simulation_of_one_step():
    """The same bits, with memory: going back and forth with scouts leaves nothing behind."""
    scene = swaying_pile(hysteresis="MASING", accuracy=1e-2, end=2.0)
    assert scene.dynamics is not None
    dynamics = replace(scene.dynamics, recording=0.02)
    start = [start_of(scene)]
    one = adaptive(scene, dynamics, start, LOOSE, 2.0)
    one.level, one.h = 0, one.base
    fixed = simulation(scene, dynamics, start, one.base, 2.0)
    for (times, head), (same_times, same) in [(way(one), way(fixed))]:
        assert np.array_equal(times, same_times)
        assert np.array_equal(head, same)
    assert (one.error, one.done, one.anew) == (fixed.error, fixed.done, 0)
    assert one.motions[0].body.lateral.dissipated() == fixed.motions[0].body.lateral.dissipated()


def test_strides_taken_anew_leave_nothing_behind():
    """Work less what is lost and kept is the same small rest as with short steps from the start."""
    scene = replace(knocked(hysteresis="MASING", accuracy=1e-2, end=2.0), damping=None)
    rough = following(scene, 1e-6)
    rough.level, rough.h = 0, rough.base
    way(rough)
    assert rough.anew > 3
    fine = following(scene, 1e-6)
    way(fine)
    lost = [one.motions[0].body.lateral.dissipated() for one in (rough, fine)]
    assert lost[0] == pytest.approx(lost[1], rel=1e-3)
    assert rough.motions[0].work == pytest.approx(fine.motions[0].work, rel=1e-3)


def test_rows_stand_at_the_times_that_are_to_be_recorded():
    scene = knocked(accuracy=1e-2, end=3.0)
    assert scene.dynamics is not None
    scene = replace(scene, dynamics=replace(scene.dynamics, recording=0.25))
    one = following(scene, 1e-4)
    one.record_each(0.25)
    blocks = list(one.blocks(64))
    recorded = np.concatenate([b.times[b.recorded] for b in blocks])
    assert np.array_equal(recorded, 0.25 * np.arange(1, 13))
    assert len(recorded) + 1 <= one.records
    assert all(b.together[-1] for b in blocks)
    longer = following(replace(scene, dynamics=replace(scene.dynamics, recording=None)), LOOSE)
    longer.record_each(3.0 / 1000)
    spaced = np.concatenate([b.times[b.recorded] for b in longer.blocks()])
    assert len(spaced) == longer.done < longer.records
    known = np.concatenate([b.residual[b.recorded] for b in blocks])
    assert (known[recorded > 1.0] > 0.0).all()


def test_no_knock_is_so_short_that_a_stride_jumps_over_it():
    """A blow of 2 ms in the middle of 4 s of rest, with strides of 20 ms at most."""
    scene = knocked((0.0, 0.0, 1.0, 0.0), (0.0, 2.0, 2.001, 2.002), accuracy=1e-2, end=4.0)
    one = following(scene, LOOSE)
    one.level, one.h = 0, one.base
    times, _ = way(one)
    assert one.longest == 0.01
    assert one.shortest <= 1e-3
    inside = times[(times > 2.0) & (times < 2.002)]
    assert len(inside) >= 2
    assert one.reach[0] > 0.0


def test_trials_see_the_load_set_in():
    scene = knocked(end=40.0)
    assert scene.dynamics is not None
    assert onset(scene.series[0].times, scene.series[0].factors) == 1.0
    assert onset((0.0, 2.0), (1.0, 1.0)) == 2.0
    assert trial_span(scene, scene.dynamics, 1e-3) == pytest.approx(1.4)


def test_an_explicit_method_stays_below_its_limit():
    scene = swaying_pile(accuracy=1e-1, end=0.02)
    assert scene.dynamics is not None
    scene = replace(scene, dynamics=replace(scene.dynamics, method="CENTRAL", recording=0.02))
    one = following(scene, LOOSE)
    assert one.level == one.coarsest > 0
    way(one)
    assert one.ending is End.COMPLETE
    assert one.shortest == one.longest * 0.5**one.coarsest
