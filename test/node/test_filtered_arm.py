"""The installed estimator of an arm with ``estimation: filtering``."""

import itertools

import pytest
from arm_client import ArmClient
from filtered import FILTERING, noisy, smoothed
from own_estimator import own_estimator
from ros_programs import wait_for
from stamps import stamp
from tendon_statics_interfaces.msg import ArmEstimate
from visualization_msgs.msg import Marker, MarkerArray

from tendon_statics import load_arm
from tendon_statics.files.installed_files import installed_config

ARM = load_arm(installed_config('arm.yaml'))


class CommittedClient(ArmClient):
    """Keeps what is committed and drawn too."""

    def __init__(self, context):
        super().__init__(context, ARM.cable_names)
        self.committed, self.drawings = [], []
        self._keep(ArmEstimate, 'arm_estimator/committed_estimate', self.committed)
        self._keep(MarkerArray, 'arm_estimator/markers', self.drawings)


@pytest.fixture(scope='module')
def filtering():
    """A client and, in a domain that is theirs, an estimator that filters."""
    more = ('-p', 'markers:=true', '-p', 'input_timeout:=60.0')
    with own_estimator(CommittedClient, *FILTERING, *more) as client:
        yield client


@pytest.fixture
def arm(filtering):
    """The same, with the arm where it began and nothing received."""
    assert filtering.trigger('reset').success
    filtering.forget()
    filtering.committed.clear()
    filtering.drawings.clear()
    return filtering


def holding():
    """Tensions that hold the arm, with noise, over and over."""
    names = ARM.cable_names
    readings = noisy([1.0] * len(names), 60)
    return itertools.cycle([dict(zip(names, row, strict=True)) for row in readings])


def test_the_newest_is_provisional_and_stays_a_lag_later_with_smoothed_tensions(arm):
    samples = holding()

    def followed():
        arm.send(next(samples))
        arm.answer(next(samples))
        return smoothed(arm.committed, arm.estimates)

    wait_for('some estimates that stay', lambda: len(followed()) > 5)
    found = followed()
    newest = {stamp(estimate): estimate for estimate in arm.estimates}
    assert all(estimate.provisional for estimate in newest.values())
    wait_for('the estimates of those', lambda: len(arm.estimates) >= len(arm.committed))
    newest |= {stamp(estimate): estimate for estimate in arm.estimates}
    for estimate in arm.committed:
        assert not estimate.provisional
        assert stamp(estimate) in newest
        assert list(estimate.cable_names) == list(ARM.cable_names)
    for estimate in found:
        assert list(estimate.tensions) != list(newest[stamp(estimate)].tensions)
        for low, angle, high in zip(
            *(estimate.bend_angle_lows, estimate.bend_angles, estimate.bend_angle_highs),
            strict=True,
        ):
            assert low <= angle <= high


def test_a_doubt_ends_what_waits_to_stay(arm):
    samples = holding()
    last = arm.answer(next(samples))
    slack = arm.answer(dict.fromkeys(ARM.cable_names, 0.0))
    assert set(slack.regimes) == {'slack'}
    since = stamp(slack)

    def later():
        arm.answer(next(samples))
        return [one for one in arm.committed if stamp(one) > since]

    wait_for('an estimate that stays, after the doubt', later)
    assert stamp(last) not in [stamp(one) for one in arm.committed]
    assert not any(one.angles_assured[0] for one in later())


def test_markers_show_the_band_of_each_joint_while_it_filters(arm):
    samples = holding()

    def bands():
        arm.answer(next(samples))
        return arm.drawings and [
            marker for marker in arm.drawings[-1].markers if marker.ns == 'bands'
        ]

    wait_for('a drawing', bands)
    found = bands()
    assert len(found) == len(ARM.units)
    assert all(marker.action == Marker.ADD and marker.points for marker in found)
