"""``~/tare``: the biases of load cells from the newest readings of slack cables, over ROS."""

import math
import random

import pytest
from listener import reliable_input
from ros_programs import wait_for
from test_health import values

HELD = (1.0, 1.5)
OFFSETS = (0.3, -0.2)
TARE = ('-p', 'input_timeout:=60.0', '-p', 'tare_time:=60.0', *reliable_input())


def hang_slack(listener, count: int = 200, stddev: float = 0.01) -> None:
    """Say what load cells with offsets say of slack cables, and wait until all was taken."""

    def received() -> int:
        return int(values(listener.report())['messages received'])

    draw = random.Random(1)
    for _ in range(count):
        listener.publish(*(draw.gauss(offset, stddev) for offset in OFFSETS))
    wait_for('all readings', lambda: received() == count)


def test_it_sets_the_biases_and_says_so(listener):
    with listener.estimator(*TARE):
        hang_slack(listener)
        done = listener.tare()
        assert done.success, done.message
        biases = [listener.estimator_parameter(f'cable_{cable}.bias') for cable in 'ls']
        for bias, offset in zip(biases, OFFSETS, strict=True):
            assert bias == pytest.approx(-offset, abs=5 * 0.01 / math.sqrt(200))
        assert f'cable_l.bias was 0 N and is {biases[0]:.6g} N, from 2' in done.message
        # A slack cable reads slack from now on, and a taut one its tension.
        assert listener.answer(*OFFSETS) == 'slack'
        assert listener.answer(1.0 + OFFSETS[0], 1.5 + OFFSETS[1]) == 'held'
        assert listener.newest_estimate().tension_s == pytest.approx(1.5, abs=0.01)


@pytest.mark.parametrize(
    ('count', 'stddev', 'named'),
    [
        (1, 0.01, 'readings; 20 are needed'),
        (200, 0.1, 'was not still: its readings scatter by'),
    ],
)
def test_it_refuses_what_is_too_little_or_not_still(count, stddev, named, listener):
    with listener.estimator(*TARE):
        hang_slack(listener, count, stddev)
        refused = listener.tare()
        assert not refused.success
        assert named in refused.message
        assert 'both cables have to hang slack and still' in refused.message
        assert listener.estimator_parameter('cable_l.bias') == 0.0


def test_it_refuses_a_cable_that_may_be_taut(listener):
    with listener.estimator(*TARE):
        for _ in range(30):
            listener.answer(*HELD)
        refused = listener.tare()
        assert not refused.success
        assert 'cable_l reads 1 N, more than tare_limit, 0.5 N: is it taut?' in refused.message
