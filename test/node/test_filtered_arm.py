"""The installed estimator of an arm with ``estimation: filtering``."""

import itertools
from contextlib import ExitStack

import numpy as np
import pytest
from arm_client import ArmClient
from rclpy.qos import QoSProfile
from rclpy.time import Time
from ros_domain import free_domain, in_domain
from ros_programs import spinning, wait_for
from tendon_statics_interfaces.msg import ArmEstimate
from visualization_msgs.msg import Marker, MarkerArray

from tendon_statics import load_arm
from tendon_statics.files.installed_files import installed_config

ARM = load_arm(installed_config('arm.yaml'))
NOISE = 0.02
LAG = 0.05
"""s"""


@pytest.fixture(scope='module')
def filtering():
    """A client and, in a domain that is theirs, an estimator that filters."""
    with free_domain() as domain, ExitStack() as stack:
        with in_domain(domain):
            client = stack.enter_context(
                spinning(lambda context: ArmClient(context, ARM.cable_names))
            )
            client.committed, client.drawings = [], []
            for kind, topic, store in (
                (ArmEstimate, 'committed_estimate', client.committed),
                (MarkerArray, 'markers', client.drawings),
            ):
                client.create_subscription(
                    kind, f'arm_estimator/{topic}', store.append, QoSProfile(depth=5000)
                )
            stack.enter_context(
                client.estimator(
                    *('-p', 'estimation:=filtering', '-p', f'tension_stddev:={NOISE}'),
                    *('-p', f'filter_lag:={LAG}', '-p', 'markers:=true'),
                    *('-p', 'input_timeout:=60.0'),
                )
            )
        yield client


@pytest.fixture
def arm(filtering):
    """The same, with the arm where it began and nothing received."""
    assert filtering.trigger('reset').success
    filtering.forget()
    filtering.committed.clear()
    filtering.drawings.clear()
    return filtering


def noisy():
    """Tensions that hold the arm, with noise, over and over."""
    noise = np.random.default_rng(4).normal(0.0, NOISE, (60, len(ARM.cables)))
    return itertools.cycle(
        [dict(zip(ARM.cable_names, row, strict=True)) for row in (1.0 + noise).tolist()]
    )


def stamp(message):
    return Time.from_msg(message.header.stamp).nanoseconds


def test_the_newest_is_provisional_and_stays_a_lag_later_with_smoothed_tensions(arm):
    samples = noisy()

    def followed():
        """Those committed that other tensions followed in time, which a machine may delay."""
        arm.send(next(samples))
        arm.answer(next(samples))
        later = [stamp(estimate) for estimate in arm.estimates]
        return [
            one
            for one in arm.committed
            if any(0 < other - stamp(one) < 1e9 * LAG for other in later)
        ]

    wait_for('some estimates that stay', lambda: len(followed()) > 5)
    smoothed = followed()
    newest = {stamp(estimate): estimate for estimate in arm.estimates}
    assert all(estimate.provisional for estimate in newest.values())
    wait_for('the estimates of those', lambda: len(arm.estimates) >= len(arm.committed))
    newest |= {stamp(estimate): estimate for estimate in arm.estimates}
    for estimate in arm.committed:
        assert not estimate.provisional
        assert stamp(estimate) in newest
        assert list(estimate.cable_names) == list(ARM.cable_names)
    for estimate in smoothed:
        assert list(estimate.tensions) != list(newest[stamp(estimate)].tensions)
        for low, angle, high in zip(
            *(estimate.bend_angle_lows, estimate.bend_angles, estimate.bend_angle_highs),
            strict=True,
        ):
            assert low <= angle <= high


def test_a_doubt_ends_what_waits_to_stay(arm):
    samples = noisy()
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
    samples = noisy()

    def bands():
        arm.answer(next(samples))
        return arm.drawings and [
            marker for marker in arm.drawings[-1].markers if marker.ns == 'bands'
        ]

    wait_for('a drawing', bands)
    found = bands()
    assert len(found) == len(ARM.units)
    assert all(marker.action == Marker.ADD and marker.points for marker in found)
