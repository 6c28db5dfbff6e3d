"""The installed node with ``estimation: filtering``, and what the others learned from it."""

import itertools
import json
import math

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from filtered import FILTERING, noisy, smoothed
from forked_programs import ForkedProgram
from list_entities import alone
from listener import Listener, reliable_input
from own_estimator import own_estimator
from programs import run
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from ros_programs import wait_for
from stamps import stamp
from std_msgs.msg import Float64
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import solve
from tendon_statics.files.installed_files import installed_config
from tendon_statics.files.unit_file import load_unit
from tendon_statics.node.estimator import Estimator

HELD, SLIPPING, STOP, SLACK = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0), (0.0, 2.0)
REGIMES = ('equilibrium', 'held', 'slipping', 'driven_to_stop', 'slack')


class CommittedListener(Listener):
    """Keeps what is committed too."""

    def __init__(self, context):
        super().__init__(context)
        self.committed = []
        self.create_subscription(
            Estimate,
            'estimator/committed_estimate',
            self.committed.append,
            QoSProfile(depth=5000),
        )


@pytest.fixture(scope='module')
def filtering():
    """A listener and, in a domain that is theirs, an estimator that filters."""
    with own_estimator(CommittedListener, *FILTERING, *reliable_input()) as listener:
        yield listener


def stream(listener, pairs):
    """Send pairs one by one, each when the one before is answered; return their estimates."""
    listener.forget()
    for pair in pairs:
        listener.answer(*pair)
    wait_for('every estimate', lambda: len(listener.estimates) == len(pairs))
    return list(listener.estimates)


def probabilities(estimate):
    return [getattr(estimate, f'probability_{regime}') for regime in REGIMES]


def test_a_stream_has_interval_probabilities_pose_and_committed_estimates(filtering):
    assert filtering.reset().success
    filtering.committed.clear()
    estimates = stream(filtering, noisy(HELD, 60))
    for estimate in estimates:
        assert estimate.provisional
        assert sum(probabilities(estimate)) == pytest.approx(1.0)
        assert estimate.bend_angle_low <= estimate.bend_angle <= estimate.bend_angle_high
        assert math.isnan(estimate.consistency)
    assert estimates[-1].regime == Estimate.HELD
    assert estimates[-1].probability_held == 1.0
    wait_for('the poses', lambda: len(filtering.unit_poses) == len(estimates))
    for estimate, pose in zip(estimates, filtering.unit_poses, strict=True):
        variance = pose.pose.covariance.reshape(6, 6)[4, 4]
        assert variance == pytest.approx(estimate.bend_angle_stddev**2)
    latest = json.loads(filtering.solve_latest().message)
    assert latest['provisional'] is True
    assert latest['bend_angle_low'] == estimates[-1].bend_angle_low
    assert latest['regime_probabilities']['held'] == 1.0


def test_what_is_committed_is_smoothed_by_what_followed_within_the_lag(filtering):
    assert filtering.reset().success
    filtering.forget()
    filtering.committed.clear()
    pairs = itertools.cycle(noisy(HELD, 60))

    def followed():
        # Each is answered before the next, so that nothing comes when others count.
        filtering.answer(*next(pairs))
        filtering.answer(*next(pairs))
        return smoothed(filtering.committed, filtering.estimates)

    wait_for('some estimates', lambda: len(followed()) > 5)
    found = followed()
    wait_for('the rest', filtering.has_all_estimates)
    raw = {stamp(estimate): estimate.tension_s for estimate in filtering.estimates}
    for estimate in filtering.committed:
        assert not estimate.provisional
        assert stamp(estimate) in raw
    for estimate in found:
        assert estimate.tension_s not in raw.values()


def test_a_slack_cable_casts_doubt_and_a_measured_angle_ends_it(filtering):
    assert filtering.reset().success
    held, slack, after = stream(filtering, [HELD, SLACK, HELD])
    assert (held.angle_assured, slack.regime, after.angle_assured) == (True, 'slack', False)
    assert slack.probability_slack == 1.0
    assert math.isnan(after.bend_angle_low)
    filtering.forget()
    measured = 0.3

    def is_taken():
        filtering.measured_bend_angle.publish(Float64(data=measured))
        filtering.answer(*HELD)
        return any(estimate.angle_assured for estimate in filtering.estimates)

    wait_for('the measured angle', is_taken)
    found = next(estimate for estimate in filtering.estimates if estimate.angle_assured)
    assert found.bend_angle == pytest.approx(measured, abs=0.01)
    assert found.bend_angle_low < measured < found.bend_angle_high


def test_a_measured_angle_that_the_model_does_not_explain_is_a_warning(filtering):
    """The unit is said to stay where it cannot stay under these tensions."""
    assert filtering.reset().success
    filtering.forget()
    since, random = len(filtering.diagnostics), np.random.default_rng(6)

    def is_warned():
        return any(
            status.level == DiagnosticStatus.WARN
            and 'the model does not explain the measured angle' in status.message
            for status in filtering.diagnostics[since:]
        )

    def is_warned_after_one_more():
        angle = 0.1 + random.normal(0.0, 0.01)
        filtering.measured_bend_angle.publish(Float64(data=angle))
        filtering.answer(*STOP)
        return is_warned()

    # It goes on, since what no longer comes is said to be stale.
    wait_for('the warning', is_warned_after_one_more)
    wait_for(
        'the estimate that it is of',
        lambda: any(estimate.consistency < 1e-9 for estimate in filtering.estimates),
    )
    assert filtering.reset().success


def test_without_noise_there_is_nothing_to_filter_and_that_is_refused(filtering):
    result = filtering.set_estimator_parameters(tension_stddev=0.0)
    assert not result.successful
    assert 'estimation is filtering, which needs the noise of each tension' in result.reason


def test_each_pair_by_itself_has_probabilities_too(running):
    equilibrium, held = stream(running, [SLIPPING, HELD])
    for estimate in (equilibrium, held):
        assert sum(probabilities(estimate)) == pytest.approx(1.0)
        assert not estimate.provisional
    assert 0.5 < equilibrium.probability_equilibrium < 1.0
    assert equilibrium.bend_angle_low < equilibrium.bend_angle < equilibrium.bend_angle_high
    assert held.probability_held == pytest.approx(1.0)
    assert math.isnan(held.bend_angle_low)


def test_tracking_warns_where_noise_alone_can_slip_the_unit(listener):
    with listener.estimator('-p', 'estimation:=tracking') as program:
        said = 'noise of tension_stddev alone can slip the unit'
        listener.reset()
        assert listener.answer(1.0, 2.03) == 'held'
        listener.wait_for_status(DiagnosticStatus.WARN, said, since=0)
        listener.answer(1.0, 2.031)
        listener.answer(1.0, 2.032)
        (estimate, *_) = listener.estimates
        assert math.isnan(estimate.probability_held)
        output = program.output()
    assert output.count('Noise of tension_stddev alone') == 1


def test_the_node_takes_a_fitted_file_as_it_is_and_its_deviations_cover_the_design(
    listener, tmp_path
):
    fitted, session = tmp_path / 'fitted.yaml', installed_config('recorded_session.mcap')
    done = run('calibrate', session, '--motion-step-deg', 3, '--output', fitted)
    assert done.returncode == 0, done.stderr
    unit = load_unit(fitted)
    assert unit.uncertainty is not None
    with listener.estimator('--params-file', str(fitted)) as program:
        tensions = next(
            pair
            for pair in ((1.0, 1.5 + 0.01 * step) for step in range(100))
            if solve(unit.design, *pair).regime == 'equilibrium'
        )
        assert listener.answer(*tensions) == 'equilibrium'
        estimate = listener.newest_estimate()
        assert 'does not have' not in program.output()
    answer = solve(unit.design, *tensions)
    assert estimate.bend_angle_stddev == answer.bend_angle_stddev(
        unit.settings.tension_stddev, unit.uncertainty
    )
    assert estimate.bend_angle_stddev > answer.bend_angle_stddev(unit.settings.tension_stddev)


def test_what_is_no_covariance_of_the_design_is_refused_while_the_node_runs():
    names, covariance = 'design_uncertainty.parameters', 'design_uncertainty.covariance'
    with alone(Estimator) as node:

        def change(*values):
            return node.set_parameters_atomically(
                [
                    Parameter(name, value=value)
                    for name, value in zip((names, covariance), values, strict=True)
                ]
            )

        assert change(['mass', 'friction_coefficient'], [4e-6, 0.0, 0.0, 9e-4]).successful
        assert node.core.settings.design_uncertainty.stddev('friction_coefficient') == 0.03
        refused = change(['mass'], [4e-6, 0.0])
        assert not refused.successful
        assert 'design_uncertainty.covariance has 2 numbers; 1 parameters need 1' in refused.reason
        assert not change(['weight'], [1.0]).successful
        assert node.core.settings.design_uncertainty.stddev('friction_coefficient') == 0.03
        assert change([], []).successful
        assert node.core.settings.design_uncertainty is None


@pytest.mark.parametrize('given', [True, False])
def test_a_filter_whose_noise_nobody_gave_says_what_it_takes_for_it(given):
    noise = ('-p', 'tension_stddev:=0.01') if given else ()
    with ForkedProgram.running(
        'estimator', '--ros-args', '-p', 'estimation:=filtering', *noise
    ) as program:
        wait_for('it to be ready', lambda: 'Ready: filtering' in program.output())
        assert ('no tension_stddev came: 0.01 N is taken' in program.output()) != given
