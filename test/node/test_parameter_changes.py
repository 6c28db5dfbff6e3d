"""Changes of parameters while the node runs: one by one, together, and as a file."""

import dataclasses
import re

import pytest
from designs import PRELIMINARY
from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.qos import QoSProfile
from ros_domain import in_domain
from ros_programs import ask, spinning, wait_for
from tendon_statics_interfaces.srv import Solve

from tendon_statics import DesignUncertainty, default_design_path, save_design, solve

SLIPPING = (1.0, 2.0)
FAR_ZONE = {'design__contact_start_angle': 1.6, 'design__contact_end_angle': 2.0}
"""Each fits only together with the other"""

OTHER = dataclasses.replace(
    PRELIMINARY, friction_coefficient=0.8, contact_start_angle=1.6, contact_end_angle=2.0
)


def in_force(running, design) -> bool:
    """Whether the node computes with a design."""
    answer, expected = running.solve(1.0, 3.0), solve(design, 1.0, 3.0)
    return (answer.regime, answer.pressure) == (expected.regime, expected.pressure)


def test_a_whole_design_set_one_by_one_is_taken_as_a_whole(running):
    """As `ros2 param load` sends it: the first angle alone would be refused."""
    results = running.set_one_by_one(**FAR_ZONE, design__friction_coefficient=0.8)
    assert [result.successful for result in results] == [True] * 3
    assert in_force(running, OTHER)


@pytest.mark.parametrize(
    ('bad', 'named'),
    [
        ({'design__mass': -1.0}, 'design.mass is -1.0, allowed is 0 to 100 kg'),
        ({'design__masss': 0.1}, 'design.masss is 0.1, but there is no such parameter'),
        ({'design__mass': 'heavy'}, "design.mass is 'heavy', which is not a number"),
    ],
    ids=['out of range', 'misspelt', 'no number'],
)
def test_of_a_design_with_a_bad_value_none_is_taken_and_the_rest_of_the_request_is(
    bad, named, running
):
    results = running.set_one_by_one(
        design__friction_coefficient=0.8, **bad, design__gravity=1.6, tension_stddev=0.05
    )
    assert [result.successful for result in results] == [False] * 3 + [True]
    for result in results[:3]:
        assert result.reason.startswith(named)
        assert 'none of the design is set that came with it' in result.reason
    assert in_force(running, PRELIMINARY)
    assert running.estimator_parameter('design.friction_coefficient') == 1.05
    assert running.estimator_parameter('tension_stddev') == 0.05


def test_what_does_not_fit_yet_waits_and_the_last_whole_design_stays_in_force(running):
    """As `ros2 param set` twice, or a slider."""
    since = len(running.diagnostics)
    (waits,) = running.set_one_by_one(design__contact_start_angle=1.6)
    assert waits.successful
    assert 'those before stay in force: design.contact_end_angle is 1.54' in waits.reason
    assert running.estimator_parameter('design.contact_start_angle') == 1.6

    def warned() -> bool:
        running.answer(*SLIPPING)  # Of an input that is stale, that would be the level.
        return any(
            status.level == DiagnosticStatus.WARN
            and 'parameters do not fit together' in status.message
            for status in running.diagnostics[since:]
        )

    wait_for('a warning', warned)
    assert in_force(running, PRELIMINARY)
    # What comes meanwhile waits as well; what is set together has to make a whole.
    (more,) = running.set_one_by_one(design__friction_coefficient=0.8)
    assert 'stay in force' in more.reason
    assert in_force(running, PRELIMINARY)
    refused = running.set_estimator_parameters(design__mass=0.02)
    assert 'the end must exceed the start' in refused.reason

    (rest,) = running.set_one_by_one(design__contact_end_angle=2.0)
    assert (rest.successful, rest.reason) == (True, '')
    assert in_force(running, OTHER)
    for _ in range(2):
        report = running.report()
    assert 'fit together' not in report.message


def test_a_stop_and_a_beginning_beyond_it_may_come_in_either_order(running):
    first, second = running.set_one_by_one(initial_bend_angle=0.6, design__max_bend_angle=0.7)
    assert (first.reason, second.reason) == ('', '')
    assert running.solve(1.0, 3.0).bend_angle == 0.7
    assert running.set_estimator_parameters(initial_bend_angle=0.0).successful


def types(running, *names):
    answer = running.call('get_parameters', GetParameters.Request(names=list(names)))
    return [value.type for value in answer.values]


def test_a_double_stays_a_double_and_a_number_may_be_written_as_ros_reads_it(running):
    """`ros2 param set` makes an integer of 1, and text of 1e-2."""
    names = ('design.mass', 'max_skew', 'imu_mounting', 'gravity_direction')
    results = running.set_one_by_one(
        design__mass=1, max_skew='1e-2', imu_mounting=[0, 0, 1], gravity_direction=[0, 0, -2]
    )
    assert all(result.successful for result in results), results
    assert types(running, *names) == [
        *[ParameterType.PARAMETER_DOUBLE] * 2,
        *[ParameterType.PARAMETER_DOUBLE_ARRAY] * 2,
    ]
    assert running.estimator_parameter('max_skew') == 0.01
    assert running.set_estimator_parameters(design__mass='2e-2').successful
    assert running.estimator_parameter('design.mass') == 0.02
    for text in ('1e-2 s', '0x10', 'nan', '1_0'):
        (refused,) = running.set_one_by_one(max_skew=text)
        assert f"max_skew is '{text}', which is not a number" in refused.reason
    running.set_one_by_one(
        max_skew=0.005, imu_mounting=[0.0] * 3, gravity_direction=[0.0, 0.0, -1.0]
    )


def test_what_is_fixed_may_be_set_to_what_it_is(running):
    """As a unit's own file does, when it is loaded again."""
    same, other = running.set_one_by_one(estimation='equilibrium', frame_id='other')
    assert same.successful
    assert 'read-only' in other.reason


def test_a_double_is_one_from_the_start(listener):
    with listener.estimator('-p', 'design.friction_coefficient:=1', '-p', 'cable_l.gain:=1'):
        assert types(listener, 'design.friction_coefficient', 'cable_l.gain') == [
            *[ParameterType.PARAMETER_DOUBLE] * 2
        ]


def test_load_design_takes_a_file_or_its_text_as_a_whole(tmp_path, running):
    path = tmp_path / 'unit.yaml'
    save_design(path, OTHER, parameters={'tension_stddev': 0.02, 'estimation': 'tracking'})
    for given in ({'file': str(path)}, {'text': path.read_text()}):
        answer = running.load_design(**given)
        assert answer.success, answer.message
        assert 'design.friction_coefficient was 1.05 and is 0.8' in answer.message
        assert "only a new start of the node takes estimation = 'tracking'" in answer.message
        assert in_force(running, OTHER)
        assert running.estimator_parameter('tension_stddev') == 0.02
        again = running.load_design(**given)
        assert again.message.startswith('nothing in it differs from before')
        assert running.load_design(file=str(default_design_path())).success
        assert in_force(running, PRELIMINARY)


def test_load_design_takes_the_text_of_a_number_as_the_start_does(tmp_path, running):
    path = tmp_path / 'unit.yaml'
    save_design(path, OTHER, parameters={'tension_stddev': '2e-2'})
    path.write_text(re.sub(r'(friction_coefficient|mass): (\S+)', r'\1: "\2"', path.read_text()))
    answer = running.load_design(file=str(path))
    assert answer.success, answer.message
    assert in_force(running, OTHER)
    assert running.estimator_parameter('tension_stddev') == 0.02
    assert running.load_design(file=str(default_design_path())).success


@pytest.mark.parametrize(
    ('old', 'new', 'named'),
    [
        ('mass: ', 'mass: -', 'design.mass is -0.0'),
        ('mass: ', 'masss: ', 'design.masss is 0.0'),
        ('      mass: ', '#', 'design.mass is missing'),
        ('contact_end_angle: 2.0', 'contact_end_angle: 0.1', 'the end must exceed the start'),
        ('/**:', '/other:', 'it is addressed to /other in line 1, so /estimator takes nothing'),
        ('design:', 'unit:', 'there is no design in it'),
        ('friction', ': [', 'it is not valid YAML in line'),
        ('tension_stddev: 0.02', 'tension_stddev: -1.0', 'tension_stddev is -1.0'),
    ],
    ids=lambda text: text.strip(),
)
def test_load_design_refuses_a_file_of_which_anything_is_wrong(old, new, named, tmp_path, running):
    path = tmp_path / 'unit.yaml'
    save_design(path, OTHER, parameters={'tension_stddev': 0.02})
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    answer = running.load_design(file=str(path))
    assert not answer.success
    assert answer.message.startswith(f'{path}: ')
    assert named in answer.message
    assert '\n' not in answer.message
    assert in_force(running, PRELIMINARY)
    assert running.estimator_parameter('tension_stddev') == 0.01


def test_load_design_reads_nothing_that_is_no_file(tmp_path, running):
    for given, named in (
        ({}, 'give one of the two, file or text'),
        ({'file': 'a', 'text': 'b'}, 'give one of the two'),
        ({'file': '/dev/zero'}, 'it is not a file'),
        ({'file': str(tmp_path)}, 'it is not a file'),
        ({'file': str(tmp_path / 'missing.yaml')}, 'it cannot be read: No such file'),
        ({'text': 'x' * 10}, 'it is no parameter file'),
        ({'text': '/**: {ros__parameters: {a: 1}}'}, 'there is no design in it'),
        ({'file': 300 * 'x'}, 'it cannot be read'),
        ({'text': 100_001 * 'x'}, 'it is longer than 100000 characters'),
        *(
            ({'text': f'/**: {{ros__parameters: {{tension_stddev: {value}}}}}'}, 'ROS takes')
            for value in (
                '[~]',
                '[{a: 1}]',
                '!!binary aGk=',
                '!!set {a}',
                '!!timestamp 2026-01-01',
            )
        ),
    ):
        answer = running.load_design(**given)
        assert not answer.success
        assert named in answer.message


def test_a_burst_of_requests_is_answered_to_the_last(running):
    """As several clients send it while the node is busy; with ROS's depth of 10 most are lost."""
    assert running.estimator_parameter('service_depth') == 1000
    domain = running.context.get_domain_id()
    with in_domain(domain), spinning(lambda context: Node('asker', context=context)) as asker:
        client = asker.create_client(Solve, 'estimator/solve', qos_profile=QoSProfile(depth=1000))
        request = Solve.Request(tension_l=1.0, tension_s=2.0)

        ask(client, request)  # So that it knows the client.
        asked = [client.call_async(request) for _ in range(500)]
        wait_for('every answer', lambda: all(one.done() for one in asked))


NAMES, COVARIANCE = 'design_uncertainty__parameters', 'design_uncertainty__covariance'
KNOWN = {NAMES: ['mass', 'friction_coefficient'], COVARIANCE: [4e-6, 0.0, 0.0, 9e-4]}


def stddev(running) -> float:
    """Return the deviation in rad that the node gives an angle."""
    running.forget()
    assert running.answer(*SLIPPING) == 'equilibrium'
    return running.newest_estimate().bend_angle_stddev


def expected_stddev(names, covariance) -> float:
    uncertainty = DesignUncertainty.of_flat(names, covariance) if names else None
    return solve(PRELIMINARY, *SLIPPING).bend_angle_stddev(0.01, uncertainty)


def test_how_well_a_design_is_known_is_judged_as_a_whole_too(running):
    exact, whole = expected_stddev([], []), expected_stddev(*KNOWN.values())
    assert exact < whole
    assert [of.successful for of in running.set_one_by_one(**KNOWN)] == [True, True]
    assert stddev(running) == whole
    # Fewer names wait for the numbers that belong to them.
    (waits,) = running.set_one_by_one(**{NAMES: ['mass']})
    assert waits.successful
    assert 'design_uncertainty.covariance has 4 numbers; 1 parameters need 1' in waits.reason
    assert stddev(running) == whole
    (fits,) = running.set_one_by_one(**{COVARIANCE: [4e-6]})
    assert (fits.successful, fits.reason) == (True, '')
    assert stddev(running) == expected_stddev(['mass'], [4e-6])
    # What is none by itself is refused at once.
    for bad, named in (
        ({NAMES: ['weight']}, "'weight', which is no design parameter"),
        ({COVARIANCE: [-1.0]}, 'a variance below 0'),
        ({COVARIANCE: ['much']}, "has 'much', a finite number is needed"),
    ):
        (refused,) = running.set_one_by_one(**bad)
        assert not refused.successful
        assert named in refused.reason


def test_a_list_keeps_its_type_also_where_it_is_empty(running):
    kinds = [ParameterType.PARAMETER_STRING_ARRAY, ParameterType.PARAMETER_DOUBLE_ARRAY]
    names = [name.replace('__', '.') for name in KNOWN]

    def types() -> list[int]:
        answer = running.call('get_parameters', GetParameters.Request(names=names))
        return [value.type for value in answer.values]

    assert types() == kinds
    assert running.set_estimator_parameters(**{NAMES: ['mass'], COVARIANCE: [1]}).successful
    assert types() == kinds
    assert running.set_estimator_parameters(**{NAMES: [], COVARIANCE: []}).successful
    assert types() == kinds


def test_load_design_takes_how_well_the_design_is_known_and_leaves_none_of_another(
    tmp_path, running
):
    path = tmp_path / 'fitted.yaml'
    uncertainty = DesignUncertainty.of_flat(*KNOWN.values())
    save_design(path, PRELIMINARY, uncertainty=uncertainty)
    answer = running.load_design(file=str(path))
    assert answer.success, answer.message
    assert stddev(running) == expected_stddev(*KNOWN.values())
    assert running.load_design(file=str(path)).message == 'nothing in it differs from before'
    answer = running.load_design(file=str(default_design_path()))
    assert answer.success, answer.message
    assert stddev(running) == expected_stddev([], [])
