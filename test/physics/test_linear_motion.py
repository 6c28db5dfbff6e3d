"""The closed form of a linear motion with a remainder, beside small steps."""

import numpy as np
import pytest

from tendon_statics.physics.arm.linear_motion import END, NODE, PARTS, SQUARES, LinearMotion

DEFECTIVE = np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0]])
"""One eigenvector only"""


def stepped(jacobian, velocity, remainder, end, time, steps=1000):
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
@pytest.mark.parametrize('end', [1e-3, 0.3, 2.0])
@pytest.mark.parametrize('part', [7, END])
def test_a_course_with_a_remainder_is_where_small_steps_lead(seed, end, part):
    jacobian, velocity, remainder = random_jacobian(seed)
    path = LinearMotion(jacobian, velocity).course(end).bent(remainder)
    way, at_end = stepped(jacobian, velocity, remainder, end, end * PARTS[part])
    assert path.times[part] == pytest.approx(end * PARTS[part])
    assert path.ways[:, 0] == pytest.approx(0.0 * way, abs=1e-15)
    assert path.ways[:, part] == pytest.approx(way, rel=1e-7, abs=1e-12)
    assert path.velocities[:, part] == pytest.approx(at_end, rel=1e-7, abs=1e-12)


@pytest.mark.parametrize('seed', range(4))
def test_a_way_between_two_times_of_a_path_is_where_small_steps_lead(seed):
    jacobian, velocity, remainder = random_jacobian(seed)
    path = LinearMotion(jacobian, velocity).course(0.5).bent(remainder)
    between = 0.3 * path.times[7] + 0.7 * path.times[8]
    way, _ = stepped(jacobian, velocity, remainder, 0.5, between)
    assert path.way(between, 8) == pytest.approx(way, abs=1e-6)


@pytest.mark.parametrize('seed', range(4))
@pytest.mark.parametrize('end', [1e-3, 0.3, 2.0])
def test_what_a_remainder_bends_is_the_way_with_it_less_that_without(seed, end):
    jacobian, velocity, remainder = random_jacobian(seed)
    linear = LinearMotion(jacobian, velocity)
    course = linear.course(end)
    bent = course.bent(remainder).ways[:, END] - linear.way(end)
    assert linear.bend(end, remainder) == pytest.approx(bent, rel=1e-7, abs=1e-12)


@pytest.mark.parametrize('seed', range(4))
def test_half_as_long_a_course_is_thirty_times_as_exact_with_the_remainder_at_its_node(seed):
    from scipy.integrate import solve_ivp  # Here, as each worker loads this file.

    matrix, start, swing = random_jacobian(seed)

    def rate(way):
        return start + matrix @ way + swing * np.sin(way) ** 2

    def amiss(end):
        linear = LinearMotion(matrix, start)
        course = linear.course(end)
        remainder = (rate(course.node) - linear.velocity_at(course.node)) / SQUARES[NODE]
        exact = solve_ivp(
            lambda _, way: rate(way), (0.0, end), 0.0 * start, rtol=1e-12, atol=1e-14
        )
        return abs(course.bent(remainder).ways[:, END] - exact.y[:, -1]).max()

    assert amiss(0.05) < amiss(0.1) / 20.0


@pytest.mark.parametrize('seed', range(4))
def test_it_is_far_when_it_has_gone_that_way(seed):
    jacobian, velocity, _ = random_jacobian(seed)
    linear = LinearMotion(jacobian, velocity)
    way = linear.way(linear.far(0.3))
    assert abs(way).max() == pytest.approx(0.3, rel=0.1)


def test_what_dies_away_before_is_never_far():
    linear = LinearMotion(np.diag([-2.0, -1.0]), np.array([0.1, 0.1]))
    assert linear.far(0.11) == np.inf
    assert linear.far(0.09) < np.inf


def test_what_neither_grows_nor_dies_away_goes_on_evenly():
    linear = LinearMotion(np.zeros((3, 3)), np.array([1.0, 1.0, -2.0]))
    way = linear.way(0.25)
    assert way == pytest.approx([0.25, 0.25, -0.5], rel=1e-12)
    assert linear.velocity_at(way) == pytest.approx([1.0, 1.0, -2.0], rel=1e-12)
    times = linear.times()
    assert times[0] == 0.0 < times[1] < 0.1 < times[-1] < np.inf


def test_what_only_swings_lives_on():
    swings = LinearMotion(np.array([[0.0, 1.0], [-1.0, 0.0]]), np.array([1.0, 0.5]))
    assert swings.lifetime > 1e6


def test_a_jacobian_with_too_few_eigenvectors_is_nearly_followed():
    velocity, nothing = np.array([1.0, -1.0, 2.0]), np.zeros(3)
    way = LinearMotion(DEFECTIVE, velocity).way(0.5)
    expected, _ = stepped(DEFECTIVE, velocity, nothing, 1.0, 0.5)
    assert way == pytest.approx(expected, abs=1e-3)


def test_a_motion_that_dies_away_ends_at_its_place_of_rest():
    jacobian = np.array([[-2.0, 0.5], [0.3, -1.0]])
    linear = LinearMotion(jacobian, np.array([1.0, 2.0]))
    assert linear.growth < 0.0
    assert jacobian @ linear.to_rest == pytest.approx([-1.0, -2.0])
    assert linear.way(60.0) == pytest.approx(linear.to_rest)
