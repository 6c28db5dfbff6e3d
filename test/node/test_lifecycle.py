"""The estimator as a managed node: what it does, and does not do, in every state."""

import math
import signal
import threading

import pytest
from designs import PRELIMINARY
from diagnostic_msgs.msg import DiagnosticStatus
from ros_programs import wait_for

HELD, SLIPPING, STOP = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0)
NOT_STARTED = ('-p', 'autostart:=false')
WAYS = {
    'unconfigured': (),
    'inactive': ('configure',),
    'active': ('configure', 'activate'),
    'finalized': ('shutdown',),
}
"""State → the transitions that lead there."""


def everything(listener) -> list:
    """All that came of results, the regime first."""
    return [listener.regimes, listener.bend_angles, listener.estimates, listener.joint_states]


def test_it_starts_itself(listener):
    with listener.estimator():
        assert listener.estimator_state() == 'active'


@pytest.mark.parametrize('state', ['unconfigured', 'inactive', 'finalized'])
def test_unless_active_it_publishes_nothing_and_services_refuse(state, listener):
    with listener.estimator(*NOT_STARTED) as program:
        for transition in WAYS[state]:
            assert listener.change_state(transition)
        assert listener.estimator_state() == state
        before = len(listener.diagnostics)
        for _ in range(100):
            listener.publish(*STOP)
            listener.publish(math.nan, 1.0)
        for refused in (
            listener.solve(*SLIPPING),
            listener.solve_inverse(0.1, pressure=400.0),
            listener.solve_latest(),
            listener.reset(),
        ):
            assert not refused.success
            assert f'/estimator is {state}; it answers when it is active' in refused.message
        if state != 'finalized':
            for transition in ('configure', 'activate')[len(WAYS[state]) :]:
                assert listener.change_state(transition)
            # What was sent before is let be, also if it was still waiting.
            wait_for(
                'an answer',
                lambda: listener.publish(*SLIPPING) or 'equilibrium' in listener.regimes,
            )
            wait_for('an estimate', lambda: listener.estimates and listener.bend_angles)
            assert set(listener.regimes) == {'equilibrium'}
            assert {estimate.tension_s for estimate in listener.estimates} == {SLIPPING[1]}
        else:
            assert not any(everything(listener))
            assert len(listener.diagnostics) == before
        assert program.process.poll() is None


def test_deactivated_it_stops_and_says_so_and_goes_on_when_activated(listener):
    with listener.estimator('-p', 'input_timeout:=600.0') as program:
        assert listener.answer(*SLIPPING) == 'equilibrium'
        wait_for('all of the answer', listener.hears_all)
        said = len(listener.stale_regimes)
        since = len(listener.diagnostics)
        assert listener.change_state('deactivate')
        # So that nobody goes on reading an OK.
        status = listener.wait_for_status(DiagnosticStatus.STALE, 'deactivated', since=since)
        wait_for('stale to be said', lambda: len(listener.stale_regimes) > said)
        assert len(listener.stale_regimes) == said + 1
        assert status is listener.diagnostics[-1]
        for store in everything(listener):
            store.clear()
        for _ in range(100):
            listener.publish(*STOP)
        assert listener.solve(*SLIPPING).message.startswith('/estimator is inactive')
        assert not any(everything(listener))
        assert status is listener.diagnostics[-1]
        assert listener.change_state('activate')
        assert listener.answer(*SLIPPING) == 'equilibrium'
        assert listener.solve(*SLIPPING).success
        for transition, state in (
            *(('deactivate', 'inactive'), ('cleanup', 'unconfigured'), ('configure', 'inactive')),
            *(('activate', 'active'), ('shutdown', 'finalized')),
        ):
            assert listener.change_state(transition)
            assert listener.estimator_state() == state
        assert program.end() == 0


def test_a_bad_design_keeps_it_from_configuring_until_it_is_mended(listener):
    with listener.estimator(*NOT_STARTED, '-p', 'design.mass:=-1.0') as program:
        assert not listener.change_state('configure')
        assert listener.estimator_state() == 'unconfigured'
        reason = 'Not configured: design.mass is -1.0, allowed is 0 to 100 kg'
        assert reason in program.output()
        assert listener.set_estimator_parameters(design__mass=0.02).successful
        assert listener.change_state('configure')
        # From now on a change is checked as a whole.
        refused = listener.set_estimator_parameters(design__contact_end_angle=0.5)
        assert 'the end must exceed the start' in refused.reason
        assert listener.change_state('activate')
        assert listener.answer(*STOP) == 'driven_to_stop'


def test_unconfigured_parameters_may_be_set_one_by_one(listener):
    with listener.estimator(*NOT_STARTED) as program:
        assert listener.set_estimator_parameters(design__contact_start_angle=1.6).successful
        assert not listener.change_state('configure')
        assert 'the end must exceed the start' in program.output()
        assert listener.set_estimator_parameters(design__contact_end_angle=2.0).successful
        assert listener.change_state('configure')


@pytest.mark.parametrize('state', WAYS)
def test_parameters_can_be_set_in_every_state(state, listener):
    """One cannot be deleted, which would leave the node without it."""
    with listener.estimator(*NOT_STARTED):
        for transition in WAYS[state]:
            assert listener.change_state(transition)
        assert listener.set_estimator_parameters(design__mass=0.02).successful
        assert listener.estimator_parameter('design.mass') == 0.02
        deleted = listener.set_estimator_parameters(design__mass=None)
        assert not deleted.successful
        assert 'design.mass cannot be deleted' in deleted.reason
        assert listener.estimator_state() == state


def test_a_transition_that_does_not_exist_is_refused_and_harms_nothing(listener):
    with listener.estimator() as program:
        for transition in ('activate', 'configure', 'cleanup', 'nonsense'):
            assert not listener.change_state(transition)
            assert listener.estimator_state() == 'active'
        assert listener.answer(*SLIPPING) == 'equilibrium'
        assert program.process.poll() is None
        assert 'Traceback' not in program.output()


def test_a_tracked_unit_may_move_while_nobody_looks(listener):
    # With so much time that it is not lost from sight on a busy machine.
    tracking = ('estimation:=tracking', 'initial_bend_angle:=0.1', 'input_timeout:=600.0')
    with listener.estimator(*(part for value in tracking for part in ('-p', value))):
        assert listener.reset().success
        listener.answer(*HELD)
        wait_for('the estimate', lambda: listener.estimates)
        assert listener.newest_estimate().angle_assured
        assert listener.change_state('deactivate')
        assert listener.change_state('activate')
        listener.answer(*HELD)
        wait_for('the estimate', lambda: len(listener.estimates) == 2)
        assert listener.newest_estimate().bend_angle == 0.1
        assert not listener.newest_estimate().angle_assured
        assert math.isnan(listener.newest_estimate().bend_angle_stddev)
        listener.answer(*STOP)
        wait_for('the estimate', lambda: len(listener.estimates) == 3)
        assert listener.newest_estimate().angle_assured
        assert listener.newest_estimate().bend_angle == PRELIMINARY.max_bend_angle


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
@pytest.mark.parametrize('state', WAYS)
def test_a_signal_under_load_ends_it_in_every_state(number, state, listener):
    with listener.estimator(*NOT_STARTED) as program:
        for transition in WAYS[state]:
            assert listener.change_state(transition)
        ended = threading.Event()
        sent = [0]

        def stream() -> None:
            for index in range(200_000):
                if ended.is_set():
                    return
                listener.publish(1.0, 1.9 + 0.0001 * (index % 2000))
                sent[0] = index

        thread = threading.Thread(target=stream)
        thread.start()
        wait_for('the load', lambda: sent[0] > 2000)
        try:
            assert program.end(number, within=2.0) == 0, program.output()
        finally:
            ended.set()
            thread.join()
        assert 'Traceback' not in program.output()
        assert 'terminate' not in program.output()
