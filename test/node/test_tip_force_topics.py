"""``~/tip_force``, ``~/tip_wrench`` and ``~/solve_tip_force``, over real ROS."""

import math
import time

import pytest
from designs import PRELIMINARY
from geometry_msgs.msg import WrenchStamped
from list_entities import alone, entities
from ros_programs import ask, wait_for
from stamps import stamp
from std_msgs.msg import Float64
from tendon_statics_interfaces.msg import TipForce
from tendon_statics_interfaces.srv import SolveTipForce

from tendon_statics import tip_force, tip_force_intervals
from tendon_statics.node.estimator import Estimator

OWN = {'~/tip_force', '~/tip_wrench', '~/solve_tip_force'}
PAIR = (1.0, 1.9)
ACROSS = {'direction': (1.0, 0.0), 'distance': 0.02}
NOISE = {'tension_stddev': 0.01, 'bend_angle_stddev': 5e-4}
ARGUMENTS = (
    *('tip_force:=true', 'tip_distance:=0.02', 'input_timeout:=60.0'),
    'measured_bend_angle_stddev:=0.0005',
)


def names(alias, *arguments):
    # A name of its own, since one of the same name that has ended may still be in the graph.
    with alone(Estimator, '-r', f'__node:={alias}', *arguments) as node:
        return {name for of_kind in entities(node).values() for name in of_kind}


def test_none_of_it_is_there_unless_asked_for():
    assert not OWN & names('without_tip_force')
    asked = names('with_tip_force', '-p', 'tip_force:=true')
    assert asked >= OWN
    assert '/measured_bend_angle' in asked


@pytest.fixture
def pushed(listener):
    """The listener with an estimator that looks for a tip force, and what comes of it."""
    forces, wrenches = [], []
    listener.create_subscription(TipForce, 'estimator/tip_force', forces.append, 100)
    listener.create_subscription(WrenchStamped, 'estimator/tip_wrench', wrenches.append, 100)
    with listener.estimator(*(part for value in ARGUMENTS for part in ('-p', value))):
        yield listener, forces, wrenches


def told(listener, angle: float, said) -> bool:
    """Say a measured angle and tensions once more; return whether it has come of it."""
    listener.measured_bend_angle.publish(Float64(data=angle))
    listener.answer(*PAIR)
    return said()


def test_a_set_at_rest_and_a_force_while_the_measured_angle_moves(pushed):
    listener, forces, wrenches = pushed
    wait_for(
        'a set',
        lambda: told(listener, 0.1, lambda: forces and forces[-1].bend_angle_measured),
    )
    message = forces[-1]
    expected = tip_force(PRELIMINARY, *PAIR, bend_angle=0.1, **ACROSS, **NOISE)
    assert list(message.intervals) == pytest.approx(
        [end for interval in expected.intervals for end in interval], abs=1e-6
    )
    assert message.probability_free == pytest.approx(expected.probability_free)
    assert (message.level, message.at_limit) == (0.95, False)
    assert math.isnan(message.force)
    assert message.header.frame_id == 'joint'
    assert (message.direction_x, message.direction_z, message.tip_distance) == (1.0, 0.0, 0.02)
    assert message.load_assured
    assert wrenches == []

    # As slowly as a busy machine needs it, and from the beginning again before the stop.
    start = time.monotonic()

    def moving() -> float:
        return 0.1 + 0.02 * (time.monotonic() - start) % 0.4

    wait_for('a force', lambda: told(listener, moving(), lambda: wrenches))
    wait_for('the same as a set', lambda: any(one.at_limit for one in forces))
    (first, *_) = (one for one in forces if one.at_limit)
    slipping = tip_force(
        PRELIMINARY, *PAIR, bend_angle=first.bend_angle, slipping='s', **ACROSS, **NOISE
    )
    assert first.force == pytest.approx(slipping.force, abs=1e-9)
    assert first.force_stddev == pytest.approx(slipping.force_stddev, rel=1e-6)
    assert wrenches[0].wrench.force.x == first.force
    assert wrenches[0].wrench.force.z == 0.0
    assert wrenches[0].header == first.header

    # A slack cable and an angle beyond the stop tell nothing: the next set is of what came later.
    assert listener.answer(0.0, 1.9) == 'slack'
    listener.measured_bend_angle.publish(Float64(data=3.0))
    assert listener.answer(0.0, 1.9) == 'slack'
    listener.newest_estimate()
    slack = [stamp(one) for one in listener.estimates if one.regime == 'slack']
    assert len(slack) == 2
    wait_for('a set', lambda: told(listener, 0.2, lambda: stamp(forces[-1]) > slack[-1]))
    assert not {*slack} & {stamp(one) for one in forces}


def test_the_service_answers_for_any_line_and_refuses_with_the_reason(pushed):
    listener, _, _ = pushed
    client = listener.create_client(SolveTipForce, 'estimator/solve_tip_force')

    def answer(**fields):
        request = SolveTipForce.Request(tension_l=PAIR[0], tension_s=PAIR[1], bend_angle=0.1)
        for name, value in fields.items():
            setattr(request, name, value)
        return ask(client, request)

    of_node = answer()
    expected = tip_force(PRELIMINARY, *PAIR, bend_angle=0.1, **ACROSS, **NOISE)
    assert of_node.success, of_node.message
    assert list(of_node.intervals) == pytest.approx(list(expected.intervals[0]), abs=1e-6)
    assert math.isnan(of_node.force)
    number = answer(slipping='s')
    ((_, high),) = tip_force_intervals(PRELIMINARY, *PAIR, bend_angle=0.1, **ACROSS)
    assert number.force == pytest.approx(high, abs=1e-9)
    other = answer(direction=[0.6, 0.0, 0.8], tip_distance=0.03)
    line = {'direction': (0.6, 0.8), 'distance': 0.03}
    along = tip_force(PRELIMINARY, *PAIR, bend_angle=0.1, **line, **NOISE)
    assert list(other.intervals) == pytest.approx(list(along.intervals[0]), abs=1e-6)
    for fields, reason in (
        ({'direction': [0.0, 1.0, 0.0]}, 'out of the plane'),
        ({'direction': [1.0, 0.0, 1.0]}, 'unit vector'),
        ({'tip_distance': 0.03}, 'give the direction too'),
        ({'bend_angle': 0.6}, 'allowed is'),
        ({'tension_l': 0.0}, 'slack'),
        ({'slipping': 'x'}, 'slipping'),
    ):
        refused = answer(**fields)
        assert not refused.success
        assert reason in refused.message
        assert '\n' not in refused.message
        assert list(refused.intervals) == []
    for value, reason in (([0, 0, 0], 'length zero'), ([0, 1, 0], 'out of the plane')):
        result = listener.set_estimator_parameters(tip_direction=value)
        assert not result.successful
        assert reason in result.reason
        assert result.reason.startswith('tip_direction')
