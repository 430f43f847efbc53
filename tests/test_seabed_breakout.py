"""A static pull through a spring: its states, its limit point, and what follows."""

import numpy as np
import pytest

from podeep.errors import InvalidData
from podeep.seabed.breakout import static_pull
from podeep.seabed.hyperbolic import Hyperbolic
from podeep.seabed.suction import Suction
from seabeds import SOIL, K, Power, fixed, mudline

FORCE, REACH = 4000.0, 0.2 / 0.7  # suction falls with 20000 N/m2


def test_a_pull_passes_its_limit_point_and_tells_it() -> None:
    law, z0 = mudline(FORCE, REACH)
    pull = static_pull(law, z0, 2000.0, 4.0, 401)
    (limit,) = pull.limits
    released = 0.3 * REACH
    assert limit.pull == pytest.approx(FORCE, rel=1e-12)
    assert limit.lift == pytest.approx(released + FORCE / 2000.0, rel=1e-12)
    assert limit.penetration == pytest.approx(z0 - released, rel=1e-9)
    assert (np.diff(pull.lift) > 0.0).all()
    before = pull.lift < limit.lift
    np.testing.assert_allclose(
        pull.pull[before], 2000.0 * (pull.lift + pull.penetration - z0)[before], atol=1e-6
    )
    assert not pull.pull[~before].any()
    np.testing.assert_allclose(pull.penetration[~before], z0 - pull.lift[~before])
    told = str(limit)
    assert told.startswith("limit point at a pull of 4000 N/m, the pulled end lifted by 2.08571 m")
    assert "jumps up by 2 m and sets 3600 J/m free" in told
    assert "arc length" in told


def test_the_law_is_left_as_it_was() -> None:
    law, z0 = mudline(FORCE, REACH)
    before = law.state()
    static_pull(law, z0, 2000.0, 4.0, 51)
    for name, value in law.state().items():
        np.testing.assert_array_equal(value, before[name])


@pytest.mark.parametrize("points", [41, 157])
def test_the_limit_does_not_depend_on_the_parts(points: int) -> None:
    law, z0 = mudline(FORCE, REACH)
    (limit,) = static_pull(law, z0, 2000.0, 4.0, points).limits
    assert limit.energy == pytest.approx(3600.0, rel=1e-9)
    assert limit.jump == pytest.approx(2.0, rel=1e-11)


def test_a_stiff_pull_has_every_state() -> None:
    law, z0 = mudline(FORCE, REACH)
    pull = static_pull(law, z0, 2.5e4, 0.5, 501)
    assert not pull.limits
    assert len(pull.lift) == 501
    assert pull.pull.max() == pytest.approx(FORCE)


def test_a_pipe_that_rests_under_its_weight() -> None:
    """The pull bears the weight on top; the jump is the same."""
    law = Suction(Power(), 1, K, fixed(FORCE, REACH))
    law.commit(np.array([0.06]))
    weight = law.evaluate(law.u)[0][0]
    (limit,) = static_pull(law, 0.06, 2000.0, 6.0, 301).limits
    assert limit.pull == pytest.approx(FORCE + weight)
    assert limit.jump == pytest.approx(2.0, rel=1e-9)
    assert limit.energy == pytest.approx(3600.0, rel=1e-8)


def test_a_pull_on_the_hyperbolic_seabed() -> None:
    """The limit is the corner where suction has come to its bound, and falls along it."""
    law = Hyperbolic(SOIL, 1)
    law.commit(np.array([0.15]))
    (limit,) = static_pull(law, 0.15, 3000.0, 2.0, 801).limits
    step = 1e-9 * np.array([1.0, -1.0])
    before, beyond = (law.evaluate(np.array([limit.penetration + s]))[1][0] for s in step)
    assert before > -3000.0 > beyond
    assert limit.jump > 0.1
    assert limit.energy > 0.0


@pytest.mark.parametrize(
    ("stiffness", "reach", "points", "words"),
    [
        (0.0, 1.0, 11, "stiffness of 0"),
        (np.inf, 1.0, 11, "stiffness of inf"),
        (1e3, -1.0, 11, "reach of a pull, m, of -1"),
        (1e3, 1.0, 1, "number of points of a pull of 1; give 2 or more"),
        (np.nan, 1.0, 11, "stiffness of nan"),
        (2000.0, 1.0, 101, "jumps at a pull of 4000 N/m, and beyond a reach of 1 m"),
    ],
)
def test_what_makes_no_pull(stiffness, reach, points, words: str) -> None:
    law, z0 = mudline(FORCE, REACH)
    with pytest.raises(InvalidData, match=words):
        static_pull(law, z0, stiffness, reach, points)
