"""The installed node ``estimator`` over real ROS: topics, services, parameters, signals."""

import json
import math
import signal
import sys
import threading
import time
from importlib.metadata import version

import numpy as np
import pytest
from designs import PRELIMINARY
from forked_programs import ForkedProgram
from listener import reliable_input
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from ros_programs import Program, ask, spinning, wait_for
from std_msgs.msg import Float64, Float64MultiArray, String
from std_srvs.srv import Trigger
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import Regime, default_design_path, load_design, solve
from tendon_statics.files.driver_parameters import DRIVER_PARAMETERS
from tendon_statics.files.estimator_parameters import ESTIMATOR_PARAMETERS
from tendon_statics.files.view_parameters import VIEW_PARAMETERS
from tendon_statics.physics import (
    StickSlipTracker,
    admissible_angles,
    design_parameters,
    slip_margin,
)

HELD, SLIPPING, STOP, SLACK = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0), (0.0, 2.0)
TOPICS = (
    *('regime', 'bend_angle', 'joint_pressure', 'unit_pose', 'joint_state', 'slip_margin'),
    *('admissible_angles', 'estimate'),
)
MALFORMED = [
    (),
    (1.0,),
    (1.0, 2.0, 3.0),
    (math.nan, 2.0),
    (1.0, math.inf),
    (-1.0, 2.0),
    (0.05, 0.1),
    tuple(range(1000)),
]
TABLES = {
    'estimator': ESTIMATOR_PARAMETERS,
    'pulley_driver': DRIVER_PARAMETERS,
    'view': VIEW_PARAMETERS,
}
"""Program → its parameters"""


def test_the_published_case_on_every_topic(running):
    assert running.answer(*SLIPPING) == 'equilibrium'
    wait_for('the numbers', lambda: running.estimates and running.unit_poses)
    wait_for('the angle', lambda: running.bend_angles and running.joint_pressures)
    expected = solve(PRELIMINARY, *SLIPPING)
    assert running.bend_angles == [expected.bend_angle]
    assert running.joint_pressures == [expected.pressure]
    assert math.degrees(running.bend_angles[0]) == pytest.approx(17.14, abs=1e-5)
    assert running.joint_pressures[0] == pytest.approx(405.6, abs=1e-5)

    (pose,) = running.unit_poses
    stddev = expected.bend_angle_stddev(0.01)
    arm = PRELIMINARY.com_distance
    assert pose.header.frame_id == 'joint'
    assert pose.pose.pose.position.x == pytest.approx(arm * math.sin(expected.bend_angle))
    assert pose.pose.pose.position.z == pytest.approx(arm * math.cos(expected.bend_angle))
    assert pose.pose.pose.orientation.y == pytest.approx(math.sin(expected.bend_angle / 2))
    assert pose.pose.pose.orientation.w == pytest.approx(math.cos(expected.bend_angle / 2))
    covariance = pose.pose.covariance.reshape(6, 6)
    assert covariance[4, 4] == pytest.approx(stddev**2)
    assert covariance[0, 0] == pytest.approx((arm * math.cos(expected.bend_angle) * stddev) ** 2)
    assert (covariance == covariance.T).all()

    (estimate,) = running.estimates
    assert estimate.header == pose.header
    assert estimate.header.stamp.sec > 0
    assert estimate.regime == Estimate.EQUILIBRIUM
    assert (estimate.tension_l, estimate.tension_s) == SLIPPING
    assert estimate.bend_angle == expected.bend_angle
    assert estimate.bend_angle_stddev == pytest.approx(stddev)
    assert estimate.pressure == expected.pressure
    assert estimate.root_count == 1
    assert estimate.stable is False
    assert estimate.branch_consistent is True
    assert estimate.force_remainder_x == expected.force_remainder.x
    assert estimate.friction_force_z == expected.forces.friction_z
    assert estimate.bend_angle_by_tension_l == expected.bend_angle_gradient.tension_l
    assert estimate.pressure_by_tension_s == expected.pressure_gradient.tension_s


def test_numbers_go_out_only_where_the_model_determines_them(running):
    rows = (HELD, SLACK, STOP, HELD, SLIPPING[::-1], SLACK, (0.05, 0.1))
    assert [running.answer(*row) for row in rows] == [
        'held',
        'slack',
        'driven_to_stop',
        'held',
        'equilibrium',
        'slack',
        'invalid',
    ]
    # A last message that has numbers: what was published before it has come by then.
    running.answer(*STOP)
    wait_for('the last numbers', lambda: len(running.estimates) == len(rows))
    wait_for('the last angle', lambda: len(running.bend_angles) >= 3)
    wait_for('the last pressure', lambda: len(running.joint_pressures) >= 3)
    wait_for('the last pose', lambda: len(running.unit_poses) >= 3)
    stop, slip = PRELIMINARY.max_bend_angle, solve(PRELIMINARY, *SLIPPING).bend_angle
    assert running.bend_angles == [stop, -slip, stop]
    assert len(running.joint_pressures) == len(running.unit_poses) == 3
    regimes = [estimate.regime for estimate in running.estimates]
    assert regimes == [
        *('held', 'slack', 'driven_to_stop', 'held', 'equilibrium', 'slack'),
        'driven_to_stop',
    ]
    for estimate in running.estimates:
        assert math.isnan(estimate.bend_angle) == (estimate.regime in ('held', 'slack'))
        assert math.isnan(estimate.pressure) == math.isnan(estimate.bend_angle)


def test_the_regimes_of_the_message_are_those_of_the_physics():
    names = ('EQUILIBRIUM', 'HELD', 'SLIPPING', 'DRIVEN_TO_STOP', 'SLACK')
    constants = {getattr(Estimate, name) for name in names}
    assert constants == {regime.value for regime in Regime}


def test_a_storm_of_malformed_messages_loses_nothing_of_the_good_ones(listener):
    """Bursts of 440 messages as fast as they can be sent, one in eleven of them good."""
    good = [(1.0, 2.9 + 0.001 * index) for index in range(400)]
    with listener.estimator(*reliable_input()) as program:
        for index, row in enumerate(good):
            for burst in range(10):
                listener.publish(*MALFORMED[(index + burst) % len(MALFORMED)])
            listener.publish(*row)
            if index % 40 == 39:
                expected = 11 * (index + 1)
                wait_for(f'answer {expected}', lambda n=expected: len(listener.regimes) >= n)
        wait_for('every estimate', lambda: len(listener.estimates) == len(good))
        wait_for('every angle', lambda: len(listener.bend_angles) == len(good))
        assert program.process.poll() is None
        output = program.output()
    assert listener.regimes.count('invalid') == 10 * len(good)
    assert listener.regimes.count('driven_to_stop') == len(good)
    assert [(e.tension_l, e.tension_s) for e in listener.estimates] == good
    # Warned about, but not once a message.
    assert 'Invalid message on /tensions (1 so far)' in output
    assert 1 <= output.count('Invalid message') < 40
    assert 'Traceback' not in output


@pytest.mark.parametrize('row', MALFORMED, ids=lambda row: str(row[:3]))
def test_a_malformed_message_gives_the_regime_invalid_and_nothing_else(row, running):
    assert running.answer(*row) == 'invalid'
    assert running.answer(*SLIPPING) == 'equilibrium'
    wait_for('the good one', lambda: running.estimates and running.bend_angles)
    assert len(running.estimates) == len(running.bend_angles) == 1


def test_solve_answers_every_regime_and_refuses_bad_input(running):
    answer = running.solve(*SLIPPING)
    expected = solve(PRELIMINARY, *SLIPPING)
    assert answer.success
    assert answer.message == ''
    assert answer.regime == 'equilibrium'
    assert answer.bend_angle == expected.bend_angle
    assert answer.pressure == expected.pressure
    assert answer.bend_angle_stddev == pytest.approx(expected.bend_angle_stddev(0.01))
    assert answer.root_count == 1
    assert answer.stable is False

    held = running.solve(*HELD)
    assert held.success
    assert held.regime == 'held'
    assert math.isnan(held.bend_angle)
    assert math.isnan(held.pressure)
    assert math.isnan(held.bend_angle_stddev)

    for bad, named in (
        ((math.nan, 1.0), 'nan'),
        ((-1.0, 1.0), '-1.0'),
        ((0.05, 0.1), 'weight'),
    ):
        refused = running.solve(*bad)
        assert not refused.success
        assert named in refused.message
        assert refused.regime == ''
        assert math.isnan(refused.bend_angle)
    assert running.solve(*STOP).success


def test_solve_latest_gives_the_newest_valid_pair(listener):
    # Reliable, so that not even the first message is lost.
    override = 'qos_overrides./tensions.subscription.reliability:=reliable'
    with listener.estimator('-p', override):
        nothing = listener.solve_latest()
        assert not nothing.success
        assert 'no valid tensions' in nothing.message

        listener.answer(math.nan, 1.0)
        assert (
            'the newest message was invalid: tension_l is nan' in listener.solve_latest().message
        )

        listener.answer(*HELD)
        listener.answer(*SLIPPING)
        listener.answer(1.0)
        answer = listener.solve_latest()
        assert answer.success
        result = json.loads(answer.message)
        expected = solve(PRELIMINARY, *SLIPPING)
        assert {key: result[key] for key in expected.as_dict()} == json.loads(
            json.dumps(expected.as_dict())
        )
        assert result['bend_angle_stddev'] == pytest.approx(expected.bend_angle_stddev(0.01))
        assert result['invalid_since'] == 1
        assert 0.0 <= result['age'] < 60.0

        # The pair was valid for the design of then.
        assert listener.set_estimator_parameters(design__mass=1.0).successful
        refused = listener.solve_latest()
        assert not refused.success
        assert 'weight' in refused.message


def test_a_changed_design_applies_to_the_next_message(running):
    assert running.answer(*SLIPPING) == 'equilibrium'
    assert running.set_estimator_parameters(design__max_bend_angle=0.2).successful
    assert running.answer(*STOP) == 'driven_to_stop'
    wait_for('the angle', lambda: len(running.bend_angles) == 2)
    assert running.bend_angles[1] == 0.2
    # A whole number is a number.
    assert running.set_estimator_parameters(design__friction_coefficient=1).successful
    assert running.solve(*SLIPPING).success
    assert running.set_estimator_parameters(tension_stddev=0).successful
    assert running.solve(1.0, 3.0).bend_angle_stddev == 0.0


@pytest.mark.parametrize(
    ('changes', 'named'),
    [
        ({'design__mass': -1.0}, 'mass'),
        ({'design__mass': math.nan}, 'mass'),
        ({'design__mass': -1}, 'design.mass is -1.0, allowed is 0 to 100 kg'),
        ({'design__mass': 'heavy'}, "design.mass is 'heavy', which is not a number"),
        ({'design__mass': None}, 'mass'),
        ({'design__contact_end_angle': 0.5}, 'the end must exceed the start'),
        # The first of the two would do alone.
        (
            {'design__mass': 0.05, 'design__ball_radius': 0.0},
            'ball_radius',
        ),
        ({'design__mass': 0.05, 'design__masss': 0.1}, 'there is no such parameter'),
        ({'design__mass': 0.05, 'tension_stddev': -1.0}, 'tension_stddev'),
        ({'design__mass': 0.05, 'tension_stddev': 'x'}, 'tension_stddev'),
    ],
    ids=lambda value: value if isinstance(value, str) else 'rejected',
)
def test_a_change_that_is_not_valid_is_rejected_as_a_whole(changes, named, running):
    result = running.set_estimator_parameters(**changes)
    assert not result.successful
    assert named in result.reason
    assert running.estimator_parameter('design.mass') == PRELIMINARY.mass
    assert running.answer(*SLIPPING) == 'equilibrium'
    wait_for('the angle', lambda: running.bend_angles)
    assert running.bend_angles == [solve(PRELIMINARY, *SLIPPING).bend_angle]


def test_two_angles_that_only_fit_together_change_together(running):
    result = running.set_estimator_parameters(
        design__contact_start_angle=1.6, design__contact_end_angle=2.0
    )
    assert result.successful, result.reason


def test_every_design_parameter_is_described_with_unit_and_range(running):
    known = design_parameters()
    described = running.describe_estimator_parameters(*(f'design.{p.name}' for p in known))
    for parameter, descriptor in zip(known, described, strict=True):
        assert f'[{parameter.unit}]' in descriptor.description or not parameter.unit
        (limits,) = descriptor.floating_point_range
        assert (limits.from_value, limits.to_value) == (parameter.minimum, parameter.maximum)


def test_the_design_comes_from_the_file_that_load_design_reads(tmp_path, listener):
    """Also with whole numbers and with exponents that lack a point."""
    path = tmp_path / 'unit.yaml'
    source = default_design_path().read_text()
    path.write_text(
        source.replace('friction_coefficient: 1.05', 'friction_coefficient: 1').replace(
            'com_distance: 0.008', 'com_distance: 8e-3'
        )
    )
    design = load_design(path)
    assert design != PRELIMINARY
    with listener.estimator('--params-file', str(path)):
        for parameter in design_parameters():
            value = getattr(design, parameter.name)
            assert listener.estimator_parameter(f'design.{parameter.name}') == value


def test_a_part_of_a_design_is_completed_with_a_warning(listener):
    with listener.estimator('-p', 'design.mass:=0.03') as program:
        assert listener.estimator_parameter('design.mass') == 0.03
        assert 'design.ball_radius = 0.0078' in program.output()


@pytest.mark.parametrize(
    ('argument', 'named'),
    [
        ('design.mass:=-1.0', 'design.mass is -1.0, allowed is 0 to 100 kg'),
        ('design.mass:=.nan', 'design.mass is nan'),
        ('design.mass:=heavy', "design.mass is 'heavy', which is not a number"),
        ('design.masss:=1.0', 'design.masss is 1.0, but there is no such design parameter'),
        ('design.contact_end_angle:=0.1', 'the end must exceed the start'),
        ('design:=3', 'its parameters have names'),
        ('qos_overrides./tensions.subscription.reliability:=foo', 'QoS'),
        ('tension_stddev:=-1.0', 'tension_stddev'),
        ('tension_stddev:=lots', 'tension_stddev'),
        ('frame_id:=1', 'frame_id'),
        ('estimation:=guessing', "estimation is 'guessing', allowed is equilibrium or tracking"),
        ('initial_bend_angle:=0.6', 'initial_bend_angle is 0.6'),
        ('initial_bend_angle:=left', "initial_bend_angle is 'left'"),
    ],
)
def test_a_bad_parameter_at_the_start_is_one_line_and_exit_code_1(argument, named):
    with ForkedProgram.running('estimator', '--ros-args', '-p', argument) as program:
        assert program.wait() == 1
        line = program.output().splitlines()[-1]
        assert line.startswith('estimator cannot start: ')
        assert named in line
        assert 'Traceback' not in program.output()


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        ('/**:\n  ros__parameters: [', 'it is not valid YAML in line 2'),
        ('design:\n  mass: 1.0\n', 'mass in line 2 is not below ros__parameters'),
    ],
)
def test_a_corrupt_parameter_file_is_one_line_that_names_file_and_line(text, named, tmp_path):
    path = tmp_path / 'corrupt.yaml'
    path.write_text(text)
    with ForkedProgram.running('estimator', '--ros-args', '--params-file', str(path)) as program:
        assert program.wait() == 1
        (line,) = program.output().splitlines()
        assert line.startswith(f'estimator cannot start: {path}: {named}')


@pytest.mark.parametrize('name', TABLES)
def test_a_parameter_file_for_another_node_is_refused_by_every_program(name, tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text('# whose\nwinch:\n  ros__parameters: {rate: 5.0}\n')
    with ForkedProgram.running(name, '--ros-args', '--params-file', str(path)) as program:
        assert program.wait() == 1
        (line,) = [line for line in program.output().splitlines() if 'cannot start' in line]
    named = f'{path}: it is addressed to /winch in line 2, so /{name} takes nothing from it'
    assert line.startswith(f'{name} cannot start: {named}')


@pytest.mark.parametrize('name', [name for name in TABLES if name != 'estimator'])
def test_a_parameter_file_for_an_estimator_may_be_given_to_what_runs_beside_it(name, tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text('left:\n  estimator:\n    ros__parameters: {design: {mass: 0.1}}\n')
    arguments = ('-r', '__ns:=/left', '-p', 'port:=0', '--params-file', str(path))
    with ForkedProgram.running(name, '--ros-args', *arguments) as program:
        wait_for('it to run', lambda: '[INFO]' in program.output())
        assert program.end() == 0


def test_what_ros_itself_refuses_is_said_without_its_sources():
    with ForkedProgram.running('estimator', '--ros-args', '-p', 'mass') as program:
        assert program.wait() == 1
        line = program.output().splitlines()[-1]
        assert line.startswith('estimator cannot start: ')
        assert 'mass' in line
        assert '.c:' not in line


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
@pytest.mark.parametrize('under_load', [False, True], ids=['idle', 'under load'])
def test_a_signal_ends_it_within_two_seconds_with_exit_code_0(number, under_load, listener):
    with listener.estimator() as program:
        ended = threading.Event()

        def stream() -> None:
            for index in range(200_000):
                if ended.is_set():
                    return
                listener.publish(1.0, 1.9 + 0.0001 * (index % 2000))

        thread = threading.Thread(target=stream)
        if under_load:
            thread.start()
            wait_for('the load', lambda: len(listener.regimes) > 200)
        try:
            assert program.end(number, within=2.0) == 0, program.output()
        finally:
            ended.set()
            if under_load:
                thread.join()
        assert 'Traceback' not in program.output()
        assert 'terminate' not in program.output()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
@pytest.mark.parametrize(
    'moment',
    [
        'tendon_statics.node.program.import_module',
        'rclpy.init',
        'tendon_statics.node.outputs.publishers.output_publisher',
    ],
    ids=lambda moment: moment.rsplit('.', 1)[-1],
)
def test_a_signal_before_the_node_runs_ends_it_with_exit_code_0(number, moment):
    """The program sends the signal to itself: while it imports, before the node, in its making."""
    code = (
        'import os, sys, rclpy, tendon_statics.node.estimator\n'
        'from tendon_statics.node import program\n'
        f'original = {moment}\n'
        'def interrupted(*arguments, **options):\n'
        f'    os.kill(os.getpid(), {int(number)})\n'
        '    return original(*arguments, **options)\n'
        f'{moment} = interrupted\n'
        'sys.exit(program.estimator())\n'
    )
    with Program.running_command([sys.executable, '-c', code]) as program:
        assert program.wait() == 0, program.output()
        assert 'Traceback' not in program.output()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM], ids=lambda n: n.name)
def test_a_second_signal_while_it_ends_changes_nothing(number, listener):
    """As launch sends one after the terminal's."""
    with listener.estimator() as program:
        for _ in range(200):
            if program.process.poll() is not None:
                break
            program.process.send_signal(number)
            time.sleep(0.005)
        assert program.wait() == 0, program.output()
        assert 'Traceback' not in program.output()


def test_admissible_angles_and_margin_go_out_with_every_result(running):
    rows = (HELD, SLIPPING, STOP, SLACK)
    assert [running.answer(*row) for row in rows] == [
        *('held', 'equilibrium', 'driven_to_stop', 'slack')
    ]
    wait_for('the estimates', lambda: len(running.estimates) == 4)
    wait_for('the intervals', lambda: len(running.admissible_angles) == 3)
    wait_for('the margins', lambda: len(running.slip_margins) == 2)
    for message, row in zip(running.admissible_angles, rows[:3], strict=True):
        intervals = admissible_angles(PRELIMINARY, *row)
        assert [tuple(pair) for pair in np.reshape(message.data, (-1, 2))] == intervals
        rows_dim, ends_dim = message.layout.dim
        assert (rows_dim.label, rows_dim.size, rows_dim.stride) == (
            *('interval', len(intervals)),
            2 * len(intervals),
        )
        assert (ends_dim.label, ends_dim.size, ends_dim.stride) == ('end', 2, 2)
    assert running.slip_margins == [
        slip_margin(PRELIMINARY, *row, solve(PRELIMINARY, *row).bend_angle) for row in rows[1:3]
    ]
    assert running.estimates[1].slip_margin == running.slip_margins[0]
    assert list(running.estimates[0].admissible_angles) == [
        end for interval in admissible_angles(PRELIMINARY, *HELD) for end in interval
    ]
    assert math.isnan(running.estimates[0].slip_margin)


def test_tracking_remembers_where_the_unit_was(listener):
    """The node's path is the tracker's; the angle goes out for every valid message."""
    cycle = [(1.0, 1.5), (1.0, 2.04), (1.0, 2.1), (1.0, 1.5), (1.0, 0.6), (1.0, 0.4), (1.0, 1.5)]
    # With so much time that it is not lost from sight on a busy machine.
    tracking = ('estimation:=tracking', 'initial_bend_angle:=0.1', 'input_timeout:=600.0')
    with listener.estimator(*(part for value in tracking for part in ('-p', value))):
        assert listener.reset().success
        tracker = StickSlipTracker(PRELIMINARY, 0.1)
        states = [tracker.update(*row) for row in cycle]
        for row, state in zip(cycle, states, strict=True):
            assert listener.answer(*row) == state.regime.value
        wait_for('the angles', lambda: len(listener.bend_angles) == len(cycle))
        wait_for('the estimates', lambda: len(listener.estimates) == len(cycle))
        wait_for('the poses', lambda: len(listener.unit_poses) == len(cycle))
        assert listener.bend_angles == [state.bend_angle for state in states]
        assert {'held', 'driven_to_stop'} == set(listener.regimes)
        pressures = [state.pressure for state in states if state.pressure is not None]
        wait_for('the pressures', lambda: len(listener.joint_pressures) == len(pressures))
        assert listener.joint_pressures == pressures
        assert listener.slip_margins == [state.slip_margin for state in states]
        for estimate, state in zip(listener.estimates, states, strict=True):
            assert estimate.regime == state.regime.value
            assert estimate.bend_angle == state.bend_angle
            assert estimate.angle_assured

        # Asking does not move the unit.
        result = json.loads(listener.solve_latest().message)
        assert result['bend_angle'] == states[-1].bend_angle
        assert result['regime'] == 'held'


@pytest.mark.parametrize('row', [(math.nan, 1.0), (1.0,), (0.02, 2.0), (-0.02, 2.0), (0.05, 0.1)])
def test_what_cannot_vouch_for_a_tracked_unit_casts_doubt_until_a_stop(row, listener):
    """What is no pair of tensions, or that of a cable which is slack but for noise."""
    with listener.estimator('-p', 'estimation:=tracking', '-p', 'input_timeout:=60.0'):
        listener.answer(*HELD)
        assert listener.reset().success
        listener.answer(*HELD)
        assert listener.newest_estimate().angle_assured
        assert listener.answer(*row) == ('slack' if 2.0 in row else 'invalid')
        listener.answer(*HELD)
        estimate = listener.newest_estimate()
        assert (estimate.bend_angle, estimate.angle_assured) == (0.0, False)
        listener.answer(*STOP)
        assert listener.newest_estimate().angle_assured


def test_a_tracked_unit_is_corrected_by_an_encoder_and_put_back_by_reset(listener):
    with listener.estimator(
        '-p', 'estimation:=tracking', '-p', 'initial_bend_angle:=0.1'
    ) as program:
        assert listener.reset().message == 'the unit is at 0.1 rad'
        listener.answer(*HELD)
        wait_for('the angle', lambda: listener.bend_angles == [0.1])

        def corrected(angle: float) -> bool:
            """Sent until it is taken, since the first message may be lost."""
            listener.measured_bend_angle.publish(Float64(data=angle))
            listener.answer(*HELD)
            return listener.bend_angles[-1] == 0.2

        wait_for('the correction', lambda: corrected(0.2))
        for bad in (math.nan, 0.6, -math.inf):
            listener.measured_bend_angle.publish(Float64(data=bad))
        wait_for('the rejection', lambda: 'Rejected a measured bend angle' in program.output())
        assert 'bend_angle is nan rad, allowed is -0.523599 to 0.523599' in program.output()
        listener.answer(*HELD)
        assert listener.bend_angles[-1] == 0.2

        assert listener.set_estimator_parameters(initial_bend_angle=-0.3).successful
        rejected = listener.set_estimator_parameters(initial_bend_angle=0.55)
        assert 'initial_bend_angle is 0.55' in rejected.reason
        both = {'initial_bend_angle': 0.3, 'design__max_bend_angle': 0.25}
        assert not listener.set_estimator_parameters(**both).successful
        assert listener.reset().success
        listener.answer(*HELD)
        wait_for('the angle', lambda: listener.bend_angles[-1] == -0.3)


def test_without_memory_there_is_nothing_to_reset(running):
    answer = running.reset()
    assert not answer.success
    assert 'estimation is equilibrium' in answer.message
    running.wait_for_node('estimator')
    assert 'measured_bend_angle' not in str(
        running.get_subscriber_names_and_types_by_node('estimator', '/')
    )


def test_solve_inverse_answers_or_says_why_not(running):
    angle = solve(PRELIMINARY, *SLIPPING).bend_angle
    answer = running.solve_inverse(angle, pressure=405.6)
    assert answer.success, answer.message
    assert (answer.tension_l, answer.tension_s) == pytest.approx(SLIPPING, abs=1e-8)
    answer = running.solve_inverse(-angle, total_tension=3.0)
    assert (answer.tension_l, answer.tension_s) == pytest.approx(SLIPPING[::-1], abs=1e-8)
    for angle, given, named in (
        (0.1, {}, 'give one of the two'),
        (0.1, {'pressure': 400.0, 'total_tension': 3.0}, 'give one of the two'),
        (0.1, {'pressure': -1.0}, 'pressure is -1.0'),
        (0.1, {'pressure': math.nan}, 'pressure is nan'),
        (0.1, {'total_tension': 0.1}, 'weight'),
        (0.6, {'pressure': 400.0}, 'bend_angle is 0.6'),
        (math.nan, {'pressure': 400.0}, 'bend_angle is nan'),
    ):
        refused = running.solve_inverse(angle, **given)
        assert not refused.success
        assert named in refused.message
        assert math.isnan(refused.tension_l)
        assert math.isnan(refused.tension_s)


def test_without_the_interfaces_it_runs_and_says_how_to_build_them(listener):
    """The interfaces package made not to be there, in the program's own process."""
    code = (
        'import sys; sys.modules["tendon_statics_interfaces"] = None\n'
        'from tendon_statics.node.program import estimator\n'
        'sys.exit(estimator())\n'
    )
    with Program.running_command([sys.executable, '-c', code]) as program:
        listener.connect(program, without='estimate')
        assert listener.answer(*SLIPPING) == 'equilibrium'
        wait_for('the angle', lambda: listener.bend_angles)
        answer = listener.solve_latest()
        assert answer.success
        assert json.loads(answer.message)['regime'] == 'equilibrium'
        listener.wait_for_node('estimator')
        services = [
            name for name, _ in listener.get_service_names_and_types_by_node('estimator', '/')
        ]
        assert '/estimator/solve' not in services
        assert program.output().count('colcon build --base-paths . interfaces') == 1
        assert program.end() == 0


def test_inputs_are_best_effort_outputs_reliable_and_both_can_be_overridden(listener):
    def reliability(infos) -> ReliabilityPolicy:
        (info,) = [info for info in infos if info.node_name == 'estimator']
        return info.qos_profile.reliability

    with listener.estimator():
        listener.wait_for_node('estimator')
        taken = listener.get_subscriptions_info_by_topic('/tensions')
        assert reliability(taken) == ReliabilityPolicy.BEST_EFFORT
        for topic in TOPICS:
            given = listener.get_publishers_info_by_topic(f'/estimator/{topic}')
            assert reliability(given) == ReliabilityPolicy.RELIABLE
    overrides = (
        'qos_overrides./tensions.subscription.reliability:=reliable',
        'qos_overrides./estimator/regime.publisher.durability:=volatile',
    )
    with listener.estimator(*(part for rule in overrides for part in ('-p', rule))):
        wait_for(
            'the estimator that went to be forgotten',
            lambda: len(listener.get_subscriptions_info_by_topic('/tensions')) == 1,
        )
        listener.wait_for_node('estimator')
        (taken,) = listener.get_subscriptions_info_by_topic('/tensions')
        assert taken.qos_profile.reliability == ReliabilityPolicy.RELIABLE
        (given,) = listener.get_publishers_info_by_topic('/estimator/regime')
        assert given.qos_profile.durability == DurabilityPolicy.VOLATILE


def test_who_joins_later_hears_the_regime(listener):
    """Said once, ``stale`` holds until tensions come again; nobody has to have been there."""
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)

    def late_regimes() -> list[str]:
        heard = []
        with spinning(lambda context: Node('late', context=context)) as late:
            late.create_subscription(
                String, 'estimator/regime', lambda message: heard.append(message.data), latched
            )
            wait_for('the regime', lambda: heard)
        return heard

    with listener.estimator('-p', 'input_timeout:=0.2'):
        listener.answer(*STOP)
        wait_for('that it is stale', lambda: listener.stale_regimes)
        assert late_regimes() == ['stale']


def test_the_regime_is_there_for_who_joins_later_though_nobody_heard_it():
    heard = []
    latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    with (
        spinning(lambda context: Node('driver', context=context)) as driver,
        ForkedProgram.running('estimator', '--ros-args', '-p', 'input_timeout:=600.0'),
    ):
        tensions = driver.create_publisher(Float64MultiArray, 'tensions', 10)
        latest = driver.create_client(Trigger, 'estimator/solve_latest')

        def taken() -> bool:
            tensions.publish(Float64MultiArray(data=list(SLIPPING)))
            return ask(latest, Trigger.Request()).success

        wait_for('tensions to be taken', taken)
        with spinning(lambda context: Node('late', context=context)) as late:
            late.create_subscription(
                String, 'estimator/regime', lambda message: heard.append(message.data), latched
            )
            wait_for('the regime', lambda: heard)
    assert heard == ['equilibrium']


def test_what_came_by_mistake_is_said(tmp_path, listener):
    """A design that does not arrive, and parameters that the node does not have."""
    with listener.estimator() as program:
        assert "this is the paper's preliminary design" in program.output()
        assert 'Ready: equilibrium from /tensions' in program.output()
    path = tmp_path / 'unit.yaml'
    path.write_text(
        '/**:\n  ros__parameters:\n    tension_stdev: 0.005\n    desing:\n      mass: 0.1\n'
    )
    with listener.estimator('--params-file', str(path)) as program:
        ignored = 'Parameters that this node does not have, ignored: '
        (line,) = [line for line in program.output().splitlines() if ignored in line]
        assert 'tension_stdev' in line
        assert 'desing.mass' in line
        assert listener.set_estimator_parameters(design__mass=0.03).successful
        assert 'Changed: design.mass = 0.03' in program.output()


@pytest.mark.parametrize(
    'arguments', [('--help',), ('-h',), ('--ros-args', '-p', 'joint_name:=a', '--', '--help')]
)
@pytest.mark.parametrize('program', TABLES)
def test_help_says_what_it_takes_and_exits_with_0(program, arguments):
    with Program.running(program, *arguments) as running:
        assert running.wait() == 0
        output = running.output()
    assert output.startswith(f'usage: {program} ')
    for parameter in TABLES[program]:
        assert f'  {parameter.name} (' in output


@pytest.mark.parametrize('name', TABLES)
def test_the_version_is_said_in_every_place(name):
    for arguments in (('--version',), ('--ros-args', '--version')):
        with Program.running(name, *arguments) as program:
            assert program.wait() == 0
            assert program.output().splitlines() == [f'{name} {version("tendon_statics")}']


@pytest.mark.parametrize('argument', ['--params-file', 'unit.yaml'])
def test_an_argument_that_is_not_for_ros_is_refused(argument):
    with ForkedProgram.running('estimator', argument) as program:
        assert program.wait() == 1
        (line,) = program.output().splitlines()
        assert line.startswith(f'estimator cannot start: {argument} is not known here')
        assert '--ros-args --params-file' in line


def test_a_unit_of_next_to_no_weight_does_not_end_the_node(listener):
    """Its angle would have a deviation beyond all numbers; the answer is that there is none."""
    with listener.estimator('-p', 'design.friction_coefficient:=1.0') as program:
        assert listener.set_estimator_parameters(design__mass=1e-310).successful
        assert listener.answer(1.0, 3.0) in ('held', 'driven_to_stop')
        assert listener.solve_latest().success
        assert program.process.poll() is None


def test_every_name_can_be_remapped(listener):
    arguments = ('-r', '__ns:=/left', '-r', 'tensions:=/tensions', '-r', '__node:=joint_1')
    moved = (f'~/{own}:=/estimator/{own}' for own in (*TOPICS, 'get_state'))
    with listener.estimator(*arguments, *(part for rule in moved for part in ('-r', rule))):
        assert listener.answer(*SLIPPING) == 'equilibrium'
        listener.wait_for_node('joint_1', '/left')
