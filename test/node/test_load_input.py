"""Gravity's direction and the force on the tip, over real ROS: which load the estimates have."""

import math

import pytest
from designs import PRELIMINARY
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped, Quaternion, Vector3, Wrench, WrenchStamped
from ros_programs import wait_for
from sensor_msgs.msg import Imu
from std_msgs.msg import Header
from tendon_statics_interfaces.srv import Solve
from test_tension_input import latest_values

from tendon_statics import Load, solve

SLIPPING, STOP = (1.0, 2.0), (1.0, 3.0)
TILT = math.radians(10.0)
TILTED = Load.tilted(TILT)
UPRIGHT_QUATERNION = Quaternion()


def about_y(angle: float) -> Quaternion:
    return Quaternion(y=math.sin(0.5 * angle), w=math.cos(0.5 * angle))


def imu(**fields) -> Imu:
    """An IMU that measures what is given, and says that it measures nothing else."""
    message = Imu(**fields)
    if 'orientation' not in fields:
        message.orientation_covariance[0] = -1.0
    if 'linear_acceleration' not in fields:
        message.linear_acceleration_covariance[0] = -1.0
    return message


def pose(quaternion: Quaternion) -> PoseStamped:
    message = PoseStamped()
    message.pose.orientation = quaternion
    return message


def wrench(x: float, z: float, frame_id: str = 'joint') -> WrenchStamped:
    force = Vector3(x=x, y=5.0, z=z)
    return WrenchStamped(header=Header(frame_id=frame_id), wrench=Wrench(force=force))


@pytest.fixture
def sensors(listener):
    """Publishers of all that an estimator may be told of the load, by topic."""
    return {
        'imu': listener.create_publisher(Imu, 'imu', 10),
        'base_pose': listener.create_publisher(PoseStamped, 'base_pose', 10),
        'tip_wrench': listener.create_publisher(WrenchStamped, 'tip_wrench', 10),
    }


def assert_tilted(listener) -> None:
    """Assert that the published point is 10 degrees lower, as the statics have it."""
    listener.answer(*SLIPPING)
    estimate = listener.newest_estimate()
    assert math.degrees(estimate.bend_angle) == pytest.approx(7.140, abs=5e-4)
    assert estimate.bend_angle == pytest.approx(
        solve(PRELIMINARY, *SLIPPING, TILTED).bend_angle, abs=1e-9
    )
    assert estimate.load_assured
    direction = [getattr(estimate, f'gravity_direction_{axis}') for axis in 'xyz']
    assert direction == pytest.approx(TILTED.gravity_direction, abs=1e-12)
    assert estimate.contact_law == 'merged'


def load_taken(listener, publisher, message) -> bool:
    """Send a message again and tensions after it; return whether it is taken for the present."""
    publisher.publish(message)
    listener.answer(*SLIPPING)
    return listener.newest_estimate().load_assured


def test_ten_degrees_by_parameter(listener):
    direction = f'[{math.sin(TILT)}, 0.0, {-math.cos(TILT)}]'
    with listener.estimator('-p', f'gravity_direction:={direction}'):
        assert_tilted(listener)
        # The services have the same load, unless they are given another.
        assert math.degrees(listener.solve(*SLIPPING).bend_angle) == pytest.approx(7.14, abs=5e-4)
        request = Solve.Request(tension_l=1.0, tension_s=2.0, gravity_direction=[0.0, 0.0, -2.0])
        upright = listener.call('solve', request)
        assert math.degrees(upright.bend_angle) == pytest.approx(17.14, abs=5e-4)
        assert upright.load_assured
        refused = listener.call(
            'solve', Solve.Request(tension_l=1.0, tension_s=2.0, tip_force_x=1.0)
        )
        assert 'give the direction too' in refused.message
        inverse = listener.solve_inverse(math.radians(7.14), total_tension=3.0)
        assert inverse.tension_s == pytest.approx(2.0, abs=1e-3)
        # It may change, and has to be a direction.
        for value, named in (([0, 0, 0], 'length zero'), ([1, 2], 'three finite numbers')):
            result = listener.set_estimator_parameters(gravity_direction=value)
            assert not result.successful
            assert named in result.reason
        assert listener.set_estimator_parameters(gravity_direction=[0, 0, -1]).successful
        listener.answer(*SLIPPING)
        assert math.degrees(listener.newest_estimate().bend_angle) == pytest.approx(
            17.14, abs=1e-5
        )


@pytest.mark.parametrize(
    ('source', 'mounting', 'message'),
    [
        ('pose', 0.0, pose(about_y(TILT))),
        ('imu', 0.0, imu(orientation=about_y(TILT))),
        (
            *('imu', 0.0),
            imu(
                linear_acceleration=Vector3(x=-9.7 * math.sin(TILT), y=0.0, z=9.7 * math.cos(TILT))
            ),
        ),
        # Turned in the joint frame by as much as its own orientation is more.
        ('imu', -0.3, imu(orientation=about_y(TILT - 0.3))),
    ],
    ids=['pose', 'orientation', 'acceleration', 'mounting'],
)
def test_ten_degrees_by_a_sensor(source, mounting, message, listener, sensors):
    publisher = sensors['base_pose' if source == 'pose' else 'imu']
    arguments = (
        *('-p', f'gravity_source:={source}', '-p', f'imu_mounting:=[0.0, {mounting}, 0.0]'),
        *('-p', 'load_timeout:=60.0', '-p', 'input_timeout:=60.0'),
    )
    with listener.estimator(*arguments):
        listener.answer(*SLIPPING)
        before = listener.newest_estimate()
        # Nothing has come yet: upright, and not assured.
        assert math.degrees(before.bend_angle) == pytest.approx(17.14, abs=1e-5)
        assert not before.load_assured
        listener.wait_for_status(DiagnosticStatus.WARN, 'came yet')
        wait_for('the tilt', lambda: load_taken(listener, publisher, message))
        assert_tilted(listener)


@pytest.mark.parametrize('source', ['imu', 'pose'])
def test_what_is_no_orientation_is_dropped_and_counted(source, listener, sensors):
    publisher = sensors['base_pose' if source == 'pose' else 'imu']
    make = pose if source == 'pose' else lambda quaternion: imu(orientation=quaternion)
    nan = math.nan
    bad = [
        make(Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)),
        make(Quaternion(x=nan, y=0.0, z=0.0, w=1.0)),
        make(Quaternion(x=0.0, y=0.0, z=0.0, w=1.1)),
    ]
    what = 'pose of the base'
    if source == 'imu':
        what = 'orientation of the IMU'
        bad += [
            imu(),
            imu(linear_acceleration=Vector3(z=1.0)),
            imu(linear_acceleration=Vector3(z=nan)),
        ]
    arguments = (
        *('-p', f'gravity_source:={source}', '-p', 'load_timeout:=60.0'),
        *('-p', 'input_timeout:=60.0'),
    )
    with listener.estimator(*arguments) as program:
        wait_for('the tilt', lambda: load_taken(listener, publisher, make(about_y(TILT))))
        since = len(listener.diagnostics)
        for message in bad:
            publisher.publish(message)
        wait_for('the count', lambda: latest_values(listener)[f'dropped: {what}'] == str(len(bad)))
        listener.wait_for_status(DiagnosticStatus.WARN, f'dropped {what}', since=since)
        assert_tilted(listener)
        assert (
            f'Dropped a message on {publisher.topic_name.lstrip("/")} (1 so far)'
            in program.output()
        )


def test_an_orientation_that_stops_coming_is_a_warning_and_its_load_not_assured(listener, sensors):
    arguments = ('gravity_source:=imu', 'load_timeout:=0.3', 'input_timeout:=60.0')
    arguments += ('estimation:=tracking',)
    tilted = imu(orientation=about_y(TILT))
    given = (part for value in arguments for part in ('-p', value))
    with listener.estimator(*given):
        # A tracked unit is where it began until the load is known.
        listener.answer(*STOP)
        assert not listener.newest_estimate().angle_assured
        wait_for('the tilt', lambda: load_taken(listener, sensors['imu'], tilted))
        estimate = listener.newest_estimate()
        assert estimate.angle_assured
        since = len(listener.diagnostics)
        listener.wait_for_status(
            DiagnosticStatus.WARN, 'no orientation of the IMU for', since=since
        )
        listener.answer(1.0, 1.5)
        estimate = listener.newest_estimate()
        assert not estimate.load_assured
        assert not estimate.angle_assured
        assert estimate.gravity_direction_x == pytest.approx(math.sin(TILT))


def test_a_force_on_the_tip_is_taken_with_its_distance(listener, sensors):
    arguments = ('tip_wrench:=true', 'tip_distance:=0.03', 'load_timeout:=60.0')
    with listener.estimator(*(part for value in arguments for part in ('-p', value))):
        listener.answer(*SLIPPING)
        assert not listener.newest_estimate().load_assured
        force = wrench(0.02, -0.01)
        wait_for('the force', lambda: load_taken(listener, sensors['tip_wrench'], force))
        estimate = listener.newest_estimate()
        load = Load(tip_force=(0.02, -0.01), tip_distance=0.03)
        expected = solve(PRELIMINARY, *SLIPPING, load)
        assert estimate.regime == expected.regime.value
        assert estimate.bend_angle == expected.bend_angle or math.isnan(estimate.bend_angle)
        taken = (estimate.tip_force_x, estimate.tip_force_z, estimate.tip_distance)
        assert taken == (0.02, -0.01, 0.03)
        for bad in (wrench(math.nan, 0.0), wrench(1.0, 0.0, frame_id='world')):
            sensors['tip_wrench'].publish(bad)
        wait_for('the count', lambda: latest_values(listener)['dropped: force on the tip'] == '2')
        listener.answer(*SLIPPING)
        assert listener.newest_estimate().tip_force_x == 0.02
