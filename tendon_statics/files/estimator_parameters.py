"""The estimator's parameters: one table, from which all that is said and done of them comes.

The node declares, reads and checks them by it, the files of a unit are checked by it, the node's
reference shows it, and what is not in it is named as unknown.
"""

from __future__ import annotations

import math

from ..estimation.methods import METHODS
from ..estimation.settings import Settings
from ..physics.design import DesignParameter, JointDesign, design_fields
from ..tensions.watch import Plausibility
from .cable_parameters import (
    BIASES,
    CABLE_NAMES,
    GAINS,
    MAX_TENSIONS,
    SLACK_THRESHOLDS,
    TENSION_SOURCE,
    WRENCH_COMPONENT,
)
from .parameter_kinds import (
    ChoiceParameter,
    ListParameter,
    NumberParameter,
    Parameter,
    SwitchParameter,
    TextParameter,
    VectorParameter,
)

ESTIMATIONS = tuple(METHODS)
GRAVITY_SOURCES = ('fixed', 'imu', 'pose')
EXECUTORS = ('single', 'events')

DESIGN = 'design.'
"""What the names of the design's parameters begin with"""

_BELIEVED = Plausibility()

NUMBERS = (
    NumberParameter(
        'tension_stddev',
        Settings.tension_stddev,
        'standard deviation of each measured tension, the two independent',
        minimum=0.0,
        maximum=1000.0,
        unit='N',
    ),
    NumberParameter(
        'confidence',
        Settings.confidence,
        'probability with which `bend_angle_low` and `bend_angle_high` in `~/estimate` enclose '
        'the angle',
        minimum=0.01,
        maximum=0.999,
    ),
    NumberParameter(
        'filter_lag',
        Settings.filter_lag,
        '`filtering`: time after which what was found is not taken back any more',
        minimum=0.0,
        maximum=10.0,
        unit='s',
    ),
    NumberParameter(
        'tension_bias_stddev',
        Settings.tension_bias_stddev,
        '`filtering`: standard deviation of the constant error of each tension, such as what a '
        'tare leaves over',
        minimum=0.0,
        maximum=1000.0,
        unit='N',
    ),
    NumberParameter(
        'measured_bend_angle_stddev',
        Settings.measured_bend_angle_stddev,
        '`filtering` and `tip_force`: standard deviation of what comes on `measured_bend_angle`',
        minimum=1e-6,
        maximum=1.0,
        unit='rad',
    ),
    NumberParameter(
        'initial_bend_angle',
        Settings.initial_bend_angle,
        'where a unit that is remembered is at the start and after `~/reset`, within its stops',
        minimum=-0.5 * math.pi,
        maximum=0.5 * math.pi,
        unit='rad',
    ),
    NumberParameter(
        'input_timeout',
        Settings.input_timeout,
        'without valid tensions for so long the input is stale',
        minimum=0.001,
        maximum=3600.0,
        unit='s',
    ),
    NumberParameter(
        'max_skew',
        Settings.max_skew,
        '`wrench_pair`, and `joint_state` with one cable a message: most that the times of the '
        'two cables may differ in a pair',
        minimum=0.0,
        maximum=10.0,
        unit='s',
    ),
    NumberParameter(
        'max_clock_offset',
        Settings.max_clock_offset,
        'stamps that differ more from the clock of the node are a warning',
        minimum=0.001,
        maximum=1e9,
        unit='s',
    ),
    *GAINS,
    *BIASES,
    *MAX_TENSIONS,
    *SLACK_THRESHOLDS,
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
        'readings in a row at the largest or smallest so far, from which on a cell counts as '
        'saturated; 0: not checked',
        minimum=0,
        maximum=1_000_000,
    ),
    NumberParameter(
        'frozen_count',
        _BELIEVED.frozen_count,
        'readings in a row that are the same to the last digit, from which on a cell counts as '
        'frozen; 0: not checked',
        minimum=0,
        maximum=1_000_000,
    ),
    NumberParameter(
        'load_timeout',
        Settings.load_timeout,
        "without gravity's direction from its sensor, or a tip force, for so long the load is not "
        'assured',
        minimum=0.001,
        maximum=3600.0,
        unit='s',
    ),
    NumberParameter(
        'tip_distance',
        Settings.tip_distance,
        "distance along the unit's axis at which the force of `tip_wrench` acts, and that which "
        '`tip_force` looks for',
        minimum=-10.0,
        maximum=10.0,
        unit='m',
    ),
    NumberParameter(
        'tip_force_level',
        Settings.tip_force_level,
        'rate at which the intervals of `~/tip_force` hold the true force, or more',
        minimum=0.5,
        maximum=0.9999,
    ),
    NumberParameter(
        'tare_time',
        Settings.tare_time,
        '`~/tare` averages over the readings of so long',
        minimum=0.1,
        maximum=60.0,
        unit='s',
    ),
    NumberParameter(
        'tare_limit',
        Settings.tare_limit,
        '`~/tare` refuses where a cable reads more, since it may be taut',
        minimum=0.0,
        maximum=1e6,
        unit='N',
    ),
)
"""Those that are numbers and may change while the node runs, beside the design's"""

VECTORS = (
    VectorParameter(
        'gravity_direction',
        Settings.gravity_direction,
        'direction of gravity in the joint frame, of any length: of `fixed`, and until a sensor '
        'has said the first',
    ),
    VectorParameter(
        'imu_mounting',
        Settings.imu_mounting,
        '`imu`: roll, pitch and yaw of the IMU in the joint frame, as in URDF',
        unit='rad',
    ),
    VectorParameter(
        'tip_direction',
        Settings.tip_direction,
        'unit vector in the plane of bending, in the joint frame, along which `tip_force` looks '
        'for a force',
    ),
)

LISTS = (
    ListParameter(
        'design_uncertainty.parameters',
        (),
        "names of the design's numbers that are not exact, as `calibrate` writes them",
    ),
    ListParameter(
        'design_uncertainty.covariance',
        (),
        'their covariance in SI units, row by row; deviations and probabilities then cover the '
        'design too',
        of_numbers=True,
    ),
)

CHANGEABLE = (*NUMBERS, *VECTORS, *LISTS)
"""All that may change while the node runs, beside the design's"""

WIRING = (
    TENSION_SOURCE,
    CABLE_NAMES,
    WRENCH_COMPONENT,
    ChoiceParameter(
        'estimation',
        ESTIMATIONS[0],
        "`equilibrium`: each pair of tensions by itself, the paper's model; `tracking`: the node "
        'remembers where the unit was, and publishes the angle for every valid message but those '
        'of slack cables; `filtering`: so it does, and takes each tension for a noisy reading, '
        'with intervals and probabilities',
        choices=ESTIMATIONS,
    ),
    ChoiceParameter(
        'gravity_source',
        GRAVITY_SOURCES[0],
        'where gravity points: `fixed`: `gravity_direction`; `imu`: `sensor_msgs/Imu` on `imu`; '
        '`pose`: `geometry_msgs/PoseStamped` on `base_pose`',
        choices=GRAVITY_SOURCES,
    ),
    SwitchParameter(
        'tip_wrench',
        False,
        'whether the force on the tip comes on `tip_wrench`; else there is none',
    ),
    SwitchParameter(
        'tip_force',
        False,
        'whether there are `~/tip_force`, `~/tip_wrench` and `~/solve_tip_force`: what else '
        'pushes at the tip; the angle is taken from `measured_bend_angle` where it comes',
    ),
    TextParameter(
        'frame_id',
        'joint',
        'frame of the joint, in every stamped message: origin in the centre of the ball, Z along '
        'the unit at zero bend, X towards cable s',
    ),
    TextParameter(
        'joint_name',
        'bend',
        'name of the joint in `~/joint_state`, and hardware id in `/diagnostics`',
    ),
    SwitchParameter('markers', False, 'whether there is `~/markers`, for RViz'),
    ChoiceParameter(
        'executor',
        EXECUTORS[0],
        "`single`: rclpy's default executor; `events`: its experimental EventsExecutor, which "
        'takes less of the processor and does not count lost messages',
        choices=EXECUTORS,
    ),
    NumberParameter(
        'service_depth',
        1000,
        'requests that wait at each of its own services while it is busy; more are lost',
        minimum=1,
        maximum=100_000,
        is_fixed=True,
    ),
    SwitchParameter('autostart', True, 'whether the node configures and activates itself'),
)
"""How the estimator is connected, which is fixed at the start"""

ESTIMATOR_PARAMETERS: tuple[Parameter, ...] = (*WIRING, *CHANGEABLE)
"""All but the design's, see `design_table`"""


def design_table(default: JointDesign) -> tuple[Parameter, ...]:
    """Return the design's parameters, with the values of a design for what is not given."""
    return tuple(
        NumberParameter(
            DESIGN + field.name,
            getattr(default, field.name),
            f'{field.description} ({field.symbol})',
            minimum=field.minimum,
            maximum=field.maximum,
            unit=field.unit,
        )
        if isinstance(field, DesignParameter)
        else ChoiceParameter(
            DESIGN + field.name,
            getattr(default, field.name),
            field.description,
            choices=field.choices,
            is_fixed=False,
        )
        for field in design_fields()
    )


def known_names() -> set[str]:
    """Return the names of all parameters."""
    return {parameter.name for parameter in ESTIMATOR_PARAMETERS} | {
        DESIGN + field.name for field in design_fields()
    }
