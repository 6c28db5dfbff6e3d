"""Parameters that estimators of a unit and of an arm share, but for those of the cables."""

from __future__ import annotations

from ..estimation.measuring import Measuring
from ..tensions.watch import Plausibility
from .parameter_kinds import (
    ChoiceParameter,
    NumberParameter,
    SwitchParameter,
    VectorParameter,
)

GRAVITY_SOURCES = ('fixed', 'imu', 'pose')
EXECUTORS = ('single', 'events')

_BELIEVED = Plausibility()

TENSION_STDDEV = NumberParameter(
    'tension_stddev',
    Measuring.tension_stddev,
    'standard deviation of each measured tension, the two independent',
    minimum=0.0,
    maximum=1000.0,
    unit='N',
)
CONFIDENCE = NumberParameter(
    'confidence',
    Measuring.confidence,
    'probability with which `bend_angle_low` and `bend_angle_high` in `~/estimate` enclose '
    'the angle',
    minimum=0.01,
    maximum=0.999,
)
FILTER_LAG = NumberParameter(
    'filter_lag',
    Measuring.filter_lag,
    '`filtering`: time after which an estimate is final',
    minimum=0.0,
    maximum=10.0,
    unit='s',
)
TENSION_BIAS_STDDEV = NumberParameter(
    'tension_bias_stddev',
    Measuring.tension_bias_stddev,
    '`filtering`: standard deviation of the constant error of each tension, such as the '
    'remaining error after a tare',
    minimum=0.0,
    maximum=1000.0,
    unit='N',
)
MEASURED_BEND_ANGLE_STDDEV = NumberParameter(
    'measured_bend_angle_stddev',
    Measuring.measured_bend_angle_stddev,
    '`filtering` and `tip_force`: standard deviation of the angles on `measured_bend_angle`',
    minimum=1e-6,
    maximum=1.0,
    unit='rad',
)
INPUT_TIMEOUT = NumberParameter(
    'input_timeout',
    Measuring.input_timeout,
    'the input is stale after this time without valid tensions',
    minimum=0.001,
    maximum=3600.0,
    unit='s',
)
MAX_SKEW = NumberParameter(
    'max_skew',
    Measuring.max_skew,
    '`wrench_pair`, and `joint_state` with one cable per message: largest difference of the '
    'times of the two cables in a pair',
    minimum=0.0,
    maximum=10.0,
    unit='s',
)
MAX_CLOCK_OFFSET = NumberParameter(
    'max_clock_offset',
    Measuring.max_clock_offset,
    'stamps that differ more than this from the clock of the node cause a warning',
    minimum=0.001,
    maximum=1e9,
    unit='s',
)
LOAD_TIMEOUT = NumberParameter(
    'load_timeout',
    Measuring.load_timeout,
    "the load is not assured after this time without gravity's direction from its sensor, or "
    'without a tip force',
    minimum=0.001,
    maximum=3600.0,
    unit='s',
)
TIP_FORCE_LEVEL = NumberParameter(
    'tip_force_level',
    Measuring.tip_force_level,
    'rate, or more, at which the intervals of `~/tip_force` contain the true force',
    minimum=0.5,
    maximum=0.9999,
)
TARE = (
    NumberParameter(
        'tare_time',
        Measuring.tare_time,
        '`~/tare` averages the readings of this time',
        minimum=0.1,
        maximum=60.0,
        unit='s',
    ),
    NumberParameter(
        'tare_limit',
        Measuring.tare_limit,
        '`~/tare` refuses where a cable reads more, since it may be taut',
        minimum=0.0,
        maximum=1e6,
        unit='N',
    ),
)
"""Of ``~/tare``"""
PLAUSIBILITY = (
    NumberParameter(
        'max_tension_rate',
        _BELIEVED.max_rate,
        'no tension changes faster: one that does is dropped as too fast; 0: not checked',
        minimum=0.0,
        maximum=1e9,
        unit='N/s',
    ),
    NumberParameter(
        'saturation_count',
        _BELIEVED.saturation_count,
        'a cell counts as saturated from so many readings in a row at its largest or smallest '
        'so far; 0: not checked',
        minimum=0,
        maximum=1_000_000,
    ),
    NumberParameter(
        'frozen_count',
        _BELIEVED.frozen_count,
        'a cell counts as frozen from so many readings in a row that are the same to the last '
        'digit; 0: not checked',
        minimum=0,
        maximum=1_000_000,
    ),
)
"""What is believed of load cells"""
GRAVITY_DIRECTION = VectorParameter(
    'gravity_direction',
    Measuring.gravity_direction,
    'direction of gravity in the joint frame, of any length: for `fixed`, and until the first '
    'message of a sensor',
)
IMU_MOUNTING = VectorParameter(
    'imu_mounting',
    Measuring.imu_mounting,
    '`imu`: roll, pitch and yaw of the IMU in the joint frame, as in URDF',
    unit='rad',
)
TIP_DIRECTION = VectorParameter(
    'tip_direction',
    Measuring.tip_direction,
    'unit vector in the plane of bending, in the joint frame, along which `tip_force` looks '
    'for a force',
)
GRAVITY_SOURCE = ChoiceParameter(
    'gravity_source',
    GRAVITY_SOURCES[0],
    'where gravity points: `fixed`: `gravity_direction`; `imu`: `sensor_msgs/Imu` on `imu`; '
    '`pose`: `geometry_msgs/PoseStamped` on `base_pose`',
    choices=GRAVITY_SOURCES,
)
TIP_WRENCH = SwitchParameter(
    'tip_wrench',
    False,
    'whether the force on the tip is read from `tip_wrench`; otherwise there is none',
)
TIP_FORCE = SwitchParameter(
    'tip_force',
    False,
    'whether there are `~/tip_force`, `~/tip_wrench` and `~/solve_tip_force`: what else '
    'pushes at the tip; the angle is that on `measured_bend_angle`, if there is one',
)
MARKERS = SwitchParameter('markers', False, 'whether there is `~/markers`, for RViz')
EXECUTOR = ChoiceParameter(
    'executor',
    EXECUTORS[0],
    "`single`: rclpy's default executor; `events`: its experimental EventsExecutor, which "
    'takes less CPU time and does not count lost messages',
    choices=EXECUTORS,
)
SERVICE_DEPTH = NumberParameter(
    'service_depth',
    1000,
    'requests that may wait at each of its own services while it is busy; more are lost',
    minimum=1,
    maximum=100_000,
    is_fixed=True,
)
AUTOSTART = SwitchParameter('autostart', True, 'whether the node configures and activates itself')
