"""METHOD=CONSERVE on foundations: energy, order, limits, and all that a run does with a method."""

from dataclasses import replace

import numpy as np
import pytest

from knocking import begun_knocking, energies, knocked, knocking
from moving_piles import elastic_pile, head_of, motion_of, start_of, swaying_pile
from podeep.beam.band import dense
from podeep.motion import Dynamics, Harmonic, Hysteresis, Start
from podeep.scene import Load, Scene, Sliding
from podeep.solve.adaptive import Adaptive
from podeep.solve.conserving import Conserving
from podeep.solve.dynamics import End, Motion, integrator, out_of_balance
from podeep.solve.integrators import Weighted
from podeep.solve.pace import adaptive
from podeep.solve.plan import simulation
from podeep.solve.resume import resume, state_of
from podeep.solve.simulate import Simulation
from podeep.solve.stage import NoBalance, Patience
from scenes import reference_ground

HHT, NEWMARK, CONSERVE = Weighted.hht(-0.05), Weighted(), Conserving()
PUSH = Load("PUSH", 1, 0.0, (1e6, 0.0, 0.0), (0.0, 0.0, 0.0))


# --- energy ---------------------------


@pytest.mark.parametrize("h", [0.05, 0.02, 0.005])
def test_knocks_give_no_energy_and_take_none(h: float) -> None:
    """The contact's own omega h is 9 to 90."""
    found = knocked(CONSERVE, h, 1.5)
    assert np.abs(found - 1.0).max() < 1e-8


def test_the_former_default_makes_energy_of_knocks() -> None:
    """100 times as much within 4 s, steps of 20 ms."""
    assert knocked(HHT, 0.02, 4.0).max() > 20.0


def test_knocks_in_two_planes() -> None:
    """To 1e-4: the way is straight, what resists along it is no polynomial."""
    assert np.abs(knocked(CONSERVE, 0.02, 1.0, 2) - 1.0).max() < 1e-4
    assert knocked(HHT, 0.02, 1.0, 2).max() > 1.3


def pulled(shape: str) -> Motion:
    """The reference pile with 200 t, let go from 0.2 m without a load."""
    scene = replace(
        swaying_pile(damped=False, step=0.05),
        ground=reference_ground(shape),
        starts=(Start(1, 10.0, "X", 0.2, 0.0),),
        harmonics=(),
    )
    return motion_of(scene)


@pytest.mark.parametrize(("shape", "kept"), [("2GEO", 1e-6), ("POWER", 1e-2)])
def test_soil_without_memory_keeps_energy(shape: str, kept: float) -> None:
    """Clay of straight lines beside sand of a smooth curve; the cube root, whose slope at rest is
    infinite, to what Gauss points see of it. With Newmark's it changes by 1 % and 2 %."""
    ours, other = (energies(m, pulled(shape), 0.05, 80, 1e-9) for m in (CONSERVE, NEWMARK))
    change, others = (np.abs(e / e[0] - 1.0).max() for e in (ours, other))
    assert change < kept
    assert others > 2.5 * change


def test_energy_with_a_load_is_its_work() -> None:
    scene = replace(
        swaying_pile(2e6, end=4.0, step=0.05, damped=False), ground=reference_ground("2GEO")
    )
    motion = motion_of(scene)
    left = energies(CONSERVE, motion, 0.05, 80, 1e-9)
    assert np.abs(left).max() < 1e-7 * abs(motion.work)


def test_on_linear_soil_it_is_the_trapezoidal_rule() -> None:
    start = Start(1, 0.0, "X", 0.1, 2.0)
    scene = elastic_pile(30.0, 20e6, Dynamics(0.0, 1.0), (PUSH,), starts=(start,))
    scene = replace(scene, harmonics=(Harmonic("PUSH", 0.7),))
    one = start_of(scene)
    ours, other = (head_of(motion_of(scene, one), m, 0.01, 60)[1] for m in (CONSERVE, NEWMARK))
    assert ours == pytest.approx(other, abs=1e-11)


@pytest.mark.parametrize(("hysteresis", "components"), [("GAP", None), ("MASING", 2)])
def test_what_soil_that_remembers_loses(hysteresis: Hysteresis, components: int | None) -> None:
    """As with steps a fifth as long, to 1 %; in one plane and in two."""
    scene = swaying_pile(4e6, end=2.0, step=0.05, hysteresis=hysteresis)
    scene = replace(scene, numerics=replace(scene.numerics, components=components))
    one, lost = start_of(scene), []
    for h in (0.05, 0.01):
        motion = motion_of(scene, one)
        head_of(motion, CONSERVE, h, round(2.0 / h))
        lost.append(motion.body.lateral.dissipated())
    assert lost[0] == pytest.approx(lost[1], rel=1e-2)


# --- order ---------------------------


def test_it_is_of_second_order_on_a_pile() -> None:
    scene = replace(
        swaying_pile(1e6, end=1.6, step=0.04, damped=False), ground=reference_ground("2GEO")
    )
    one = start_of(scene)
    ends = [
        head_of(motion_of(scene, one), m, 1.6 / n, n, 1e-9)[1][-1]
        for m, n in ((NEWMARK, 1280), (CONSERVE, 40), (CONSERVE, 80), (CONSERVE, 160))
    ]
    errors = np.abs(np.array(ends[1:]) - ends[0])
    assert errors[:-1] / errors[1:] == pytest.approx(4.0, rel=0.1)


def test_a_normal_force_that_changes_is_met_halfway() -> None:
    """As Newmark's method has it at both ends: with that at the end alone they are 1 % apart."""
    scene = swaying_pile(1e6, end=1.6, step=0.04, damped=False)
    name = scene.steps.names[0]
    down = Load("DOWN", 1, 10.0, (0.0, 0.0, -4e6), (0.0, 0.0, 0.0))
    scene = replace(
        scene,
        ground=reference_ground("2GEO"),
        loads=(*scene.loads, down),
        steps=replace(scene.steps, names=(name, "DOWN"), factors=((0.0, 1.0),)),
        harmonics=(Harmonic(name, 4.0), Harmonic("DOWN", 1.0, 1.5)),
        numerics=replace(scene.numerics, elements=8, second_order=True),
    )
    one = start_of(scene)
    ours, other = (
        head_of(motion_of(scene, one), m, 0.02, 80, 1e-9)[1] for m in (CONSERVE, NEWMARK)
    )
    assert ours[-1] == pytest.approx(other[-1], rel=1e-4)


@pytest.mark.parametrize("planes", [1, 2])
def test_the_tangent_is_that_of_the_mean_force(planes: int) -> None:
    """By differences, a normal force among them; in two planes to what Gauss points miss of it."""
    motion = motion_of(*begun_knocking(planes))
    equations, q = motion.body.lateral, motion.lateral.q
    random = np.random.default_rng(1)
    equations.begin = q
    equations.press(1e3 * equations.mass)
    equations.weigh(0.0, 0.0, 0.0)
    for size in (1e-3, 1.0):
        end = q + 0.1 * size * random.normal(size=len(q))
        equations.internal(end, None)
        tangent = dense(equations._weighed.system.tangent())
        move = 1e-8 * random.normal(size=len(q))
        move[equations.held] = 0.0
        change = equations.internal(end + move, None) - equations.internal(end - move, None)
        free = np.delete(np.arange(len(q)), equations.held)
        difference = (2.0 * tangent @ move - change)[free]
        assert np.abs(difference).max() < (1e-5 if planes == 1 else 1e-3) * np.abs(change).max()


# --- runs ---------------------------


def simulated(scene: Scene, step: float = 0.02, end: float = 1.0) -> Simulation:
    assert scene.dynamics is not None
    planes = scene.numerics.components or 1
    return simulation(scene, scene.dynamics, [begun_knocking(planes)[1]], step, end)


def test_the_default_by_the_scene() -> None:
    """Room by its number or by diameters; no room and no contact leave the original's method."""
    scene = knocking()
    for clearance, method in ((0.05, CONSERVE), (None, CONSERVE), (0.0, HHT)):
        other = replace(scene, slidings=(Sliding(1, 2, 1e9, clearance),))
        assert simulated(other).motions[0].method == method
        assert (
            adaptive(other, other.dynamics, [begun_knocking(1)[1]], 1.0, 1.0).scouts[0].method
            == method
        )  # type: ignore[arg-type]
    assert swaying_pile().default_method == "HHT"
    named = replace(scene, dynamics=Dynamics(0.0, 1.0, 0.02, method="HHT"))
    assert simulated(named).motions[0].method == HHT
    assert integrator(Dynamics(0.0, 1.0, method="CONSERVE")) == CONSERVE


def test_recorded_accelerations_balance_at_their_time() -> None:
    one = simulated(knocking())
    one.every = 5
    (block,) = one.blocks()
    track, lateral = block.tracks[0][0], one.motions[0].body.lateral
    assert block.recorded.sum() == 10
    for row in np.flatnonzero(block.recorded):
        state = replace(
            one.motions[0].lateral,
            time=block.times[row],
            q=track.q[row],
            velocity=track.velocity[row],
            acceleration=track.acceleration[row],
        )
        left, size = out_of_balance(lateral, state)
        assert left < 1e-9 * size
    assert block.residual.max() < 1e-9
    assert one.error < 1.0
    assert (one.twins[0].lateral.acceleration != one.motions[0].lateral.acceleration).any()


def test_the_last_row_before_a_failure_balances_too(monkeypatch: pytest.MonkeyPatch) -> None:
    one = simulated(knocking())
    one.every, step = 1000, Motion.step

    def failing(motion: Motion, *given: object) -> None:
        if motion is one.motions[0] and one.done == 7:
            raise NoBalance
        step(motion, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(Motion, "step", failing)
    (block,) = one.blocks()
    assert one.ending is End.NO_BALANCE
    assert block.recorded.tolist() == [False] * 6 + [True]
    motion = one.motions[0]
    acceleration = block.tracks[0][0].acceleration[-1]
    left, size = out_of_balance(
        motion.body.lateral, replace(motion.lateral, acceleration=acceleration)
    )
    assert left < 1e-9 * size


def test_it_goes_on_from_where_it_was_kept() -> None:
    """To the same bits, twins too."""
    whole, first = simulated(knocking()), simulated(knocking())
    for one in (whole, first):
        one.every = 7
    kept = None
    rows = first.blocks(size=26)
    next(rows)
    kept = {name: np.array(value) for name, value in state_of(first).items()}
    again = simulated(knocking())
    again.every = 7
    resume(again, kept)
    for one in (whole, again):
        for _ in one.blocks():
            pass
    for a, b in zip(whole.motions, again.motions, strict=True):
        assert np.array_equal(a.lateral.q, b.lateral.q)
        assert np.array_equal(a.lateral.velocity, b.lateral.velocity)
    assert np.array_equal(whole.twins[0].lateral.q, again.twins[0].lateral.q)
    assert whole.error == again.error


def test_steps_that_follow_the_error() -> None:
    scene = knocking(end=0.2)
    assert scene.dynamics is not None
    one = adaptive(scene, scene.dynamics, [begun_knocking(1)[1]], 1e-3, 0.2)
    assert isinstance(one, Adaptive)
    for _ in one.blocks():
        pass
    assert one.ending is End.COMPLETE
    assert one.anew > 0
    assert one.shortest < one.longest


def test_a_step_without_balance_leaves_the_forces_at_a_time() -> None:
    motion = motion_of(*begun_knocking(1))
    motion.method = CONSERVE
    with pytest.raises(NoBalance):
        motion._stepped(motion.body.lateral, motion.lateral, 0.02, Patience(0.0, 1))
    assert motion.body.lateral.begin is None
