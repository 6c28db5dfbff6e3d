"""Messages that are filled again hold nothing of what they held before."""

import dataclasses
import math
import random

import pytest
from designs import PRELIMINARY
from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header

from tendon_statics.node.outputs import messages
from tendon_statics.physics import Regime, StickSlipTracker, solve

NOISE = 0.01


UPRIGHT, HANGING = PRELIMINARY, dataclasses.replace(PRELIMINARY, com_distance=-0.02)


def results(design):
    """Results of all regimes, untracked and tracked, in no order."""
    draw = random.Random(1)
    ramp = [(1.0, 1.9 + 0.001 * step) for step in range(300)]
    tracker = StickSlipTracker(design)
    found = []
    for pair in [*ramp, *((strong, weak) for weak, strong in ramp), (0.0, 1.0), (1.0, 1.0)]:
        found += [solve(design, *pair), tracker.update(*pair)]
    draw.shuffle(found)
    return found


def estimate_in(message, result):
    ends = [(0.1, 0.2)] * len(result.regime.value)
    return messages.fill_estimate(message, result, result.bend_angle, ends, NOISE, Header())


@pytest.mark.skipif(bool(messages.INTERFACES_MISSING), reason=messages.INTERFACES_MISSING)
def test_an_estimate_holds_nothing_of_the_one_before():
    used = messages.Estimate()
    of_all_regimes = results(UPRIGHT) + results(HANGING)
    assert {result.regime for result in of_all_regimes} == set(Regime)
    for result in of_all_regimes:
        estimate_in(used, result)
        # NaN is not equal to itself, but is written alike.
        assert str(used) == str(estimate_in(messages.Estimate(), result))


def test_what_is_not_known_is_not_a_number_in_an_estimate():
    used = estimate_in(messages.Estimate(), solve(PRELIMINARY, 1.0, 2.0))
    assert used.bend_angle_stddev == solve(PRELIMINARY, 1.0, 2.0).bend_angle_stddev(NOISE)
    estimate_in(used, solve(PRELIMINARY, 1.0, 1.5))
    numbers = {name: getattr(used, name) for name in used.get_fields_and_field_types()}
    known = {name for name in numbers if isinstance(numbers[name], float)}
    known -= {name for name in known if math.isnan(numbers[name])}
    of_load = {f'gravity_direction_{axis}' for axis in 'xyz'}
    of_load |= {'tip_force_x', 'tip_force_z', 'tip_distance'}
    assert known == {'tension_l', 'tension_s', *of_load}


def test_intervals_and_poses_hold_nothing_of_those_before():
    array, pose = Float64MultiArray(), PoseWithCovarianceStamped()
    for intervals in ([(-0.5, -0.2), (0.1, 0.3)], [], [(0.0, 0.5)]):
        messages.fill_intervals(array, intervals)
        assert array == messages.fill_intervals(Float64MultiArray(), intervals)
        assert list(array.data) == [end for pair in intervals for end in pair]
        assert [(row.label, row.size, row.stride) for row in array.layout.dim] == [
            ('interval', len(intervals), 2 * len(intervals)),
            ('end', 2, 2),
        ]
    for angle in (0.5, -0.2, 0.0):
        messages.fill_unit_pose(pose, PRELIMINARY, angle, NOISE, Header())
        fresh = messages.fill_unit_pose(
            PoseWithCovarianceStamped(), PRELIMINARY, angle, NOISE, Header()
        )
        assert str(pose) == str(fresh)
