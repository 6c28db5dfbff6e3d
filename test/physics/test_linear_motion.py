"""The closed form of a linear motion with a remainder, beside small steps."""

import numpy as np
import pytest

from tendon_statics.physics.arm.linear_motion import LinearMotion

DEFECTIVE = np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0]])
"""One eigenvector only"""


def stepped(jacobian, velocity, remainder, end, time, steps=4000):
    """Return way and velocity at a time, by small steps of Runge and Kutta."""
    step = time / steps

    def slope(at, way):
        return velocity + jacobian @ way + (at / end) ** 2 * remainder

    way = np.zeros(len(velocity))
    for index in range(steps):
        at = index * step
        one = slope(at, way)
        two = slope(at + 0.5 * step, way + 0.5 * step * one)
        three = slope(at + 0.5 * step, way + 0.5 * step * two)
        four = slope(at + step, way + step * three)
        way = way + step / 6.0 * (one + 2.0 * (two + three) + four)
    return way, slope(time, way)


def random_jacobian(seed, size=4):
    draw = np.random.default_rng(seed)
    return draw.normal(size=(size, size)), draw.normal(size=size), draw.normal(size=size)


@pytest.mark.parametrize('seed', range(4))
@pytest.mark.parametrize('time', [1e-3, 0.3, 2.0])
def test_a_path_is_where_small_steps_lead(seed, time):
    jacobian, velocity, remainder = random_jacobian(seed)
    linear = LinearMotion(jacobian, velocity)
    path = linear.path(np.array([0.0, time]), remainder, 1.5)
    way, at_end = stepped(jacobian, velocity, remainder, 1.5, time)
    assert path.ways[:, 0] == pytest.approx(0.0 * way, abs=1e-15)
    assert path.ways[:, 1] == pytest.approx(way, rel=1e-8, abs=1e-12)
    assert path.velocities[:, 1] == pytest.approx(at_end, rel=1e-8, abs=1e-12)
    slope = jacobian @ at_end + 2.0 * time / 1.5**2 * remainder
    assert path.accelerations[:, 1] == pytest.approx(slope, rel=1e-8)


@pytest.mark.parametrize('seed', range(4))
def test_a_bend_is_what_the_path_is_longer_by_at_its_end(seed):
    jacobian, velocity, remainder = random_jacobian(seed)
    linear = LinearMotion(jacobian, velocity)
    way, at_end = linear.at(0.7)
    bend, faster = linear.bend(0.7, remainder)
    expected, expected_velocity = stepped(jacobian, velocity, remainder, 0.7, 0.7)
    assert way + bend == pytest.approx(expected, rel=1e-8)
    assert at_end + faster == pytest.approx(expected_velocity, rel=1e-8)


@pytest.mark.parametrize('seed', range(4))
def test_it_is_far_when_it_has_gone_that_way(seed):
    jacobian, velocity, _ = random_jacobian(seed)
    linear = LinearMotion(jacobian, velocity)
    way, _ = linear.at(linear.far(0.3))
    assert abs(way).max() == pytest.approx(0.3, rel=0.1)


def test_what_dies_away_before_is_never_far():
    linear = LinearMotion(np.diag([-2.0, -1.0]), np.array([0.1, 0.1]))
    assert linear.far(0.11) == np.inf
    assert linear.far(0.09) < np.inf


def test_what_neither_grows_nor_dies_away_goes_on_evenly():
    linear = LinearMotion(np.zeros((3, 3)), np.array([1.0, 1.0, -2.0]))
    way, velocity = linear.at(0.25)
    assert way == pytest.approx([0.25, 0.25, -0.5], rel=1e-12)
    assert velocity == pytest.approx([1.0, 1.0, -2.0], rel=1e-12)
    times = linear.times(1e9, 1.2)
    assert times[0] < 0.1 < times[-1] < np.inf


def test_a_jacobian_with_too_few_eigenvectors_is_nearly_followed():
    velocity, nothing = np.array([1.0, -1.0, 2.0]), np.zeros(3)
    way, _ = LinearMotion(DEFECTIVE, velocity).at(0.5)
    expected, _ = stepped(DEFECTIVE, velocity, nothing, 1.0, 0.5)
    assert way == pytest.approx(expected, abs=1e-3)


def test_a_motion_that_dies_away_ends_at_its_place_of_rest():
    jacobian = np.array([[-2.0, 0.5], [0.3, -1.0]])
    linear = LinearMotion(jacobian, np.array([1.0, 2.0]))
    assert linear.growth < 0.0
    assert jacobian @ linear.to_rest == pytest.approx([-1.0, -2.0])
    assert linear.at(60.0)[0] == pytest.approx(linear.to_rest)
