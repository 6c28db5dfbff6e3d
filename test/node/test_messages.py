"""Messages that are filled again hold nothing of what they held before."""

import dataclasses
import math
import random

import pytest
from designs import PRELIMINARY
from estimates import estimate_of
from geometry_msgs.msg import PoseWithCovarianceStamped
from std_msgs.msg import Float64MultiArray, Header

from tendon_statics.estimation.estimate import KnownLoad, Sample
from tendon_statics.estimation.filtering import Filtering
from tendon_statics.estimation.settings import Settings
from tendon_statics.node.outputs import messages
from tendon_statics.physics import UPRIGHT as UPRIGHT_LOAD
from tendon_statics.physics import Regime, StickSlipTracker, solve

NOISE = 0.01
HELD, STOP, SLACK = (1.0, 1.5), (1.0, 3.0), (0.0, 1.5)


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
    return messages.fill_estimate(message, estimate_of(result), Header())


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
    regimes = ('equilibrium', 'held', 'slipping', 'driven_to_stop', 'slack')
    of_regimes = {f'probability_{regime}' for regime in regimes}
    assert known == {'tension_l', 'tension_s', *of_load, *of_regimes}


def filtered_estimates():
    """Estimates of a filter: through a slip, with a measured angle, through a slack cable."""
    settings = Settings(PRELIMINARY, tension_stddev=0.01)
    method, found = Filtering(settings), []
    for place, pair in enumerate([HELD] * 20 + [STOP] * 20 + [SLACK, HELD]):
        known = KnownLoad(UPRIGHT_LOAD, is_assured=place != 10)
        found.append(method.update(Sample(pair, known, 0.01 * place, 0.01 * place)))
        found += method.take_committed()
        if place == 15:
            method.measure(0.1)
    return found


def test_an_estimate_of_a_filter_has_band_and_probabilities_and_nothing_of_the_one_before():
    used, regimes, provisional = messages.Estimate(), set(), set()
    exact = [estimate_of(result) for result in results(UPRIGHT)[:40]]
    for estimate in [*filtered_estimates(), *exact, *filtered_estimates()]:
        messages.fill_estimate(used, estimate, Header())
        assert str(used) == str(messages.fill_estimate(messages.Estimate(), estimate, Header()))
        if estimate.exact is not None:
            continue
        regimes.add(used.regime)
        provisional.add(used.provisional)
        probabilities = [getattr(used, f'probability_{regime.value}') for regime in Regime]
        assert sum(probabilities) == pytest.approx(1.0)
        if used.angle_assured:
            assert used.bend_angle_low <= used.bend_angle <= used.bend_angle_high
            assert used.bend_angle_stddev >= 0.0
        else:
            assert math.isnan(used.bend_angle_low)
            assert math.isnan(used.bend_angle_stddev)
        assert math.isnan(used.pressure_force_x)
        assert math.isnan(used.bend_angle_by_tension_l)
    assert regimes == {'held', 'driven_to_stop', 'slack'}
    assert provisional == {True, False}


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
