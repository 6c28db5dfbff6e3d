"""The parameters of the estimator of an arm: one table, as `estimator_parameters` is of a unit's.

How the cables are measured is said cable by cable; their names come from the arm's file.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

from ..estimation.arm_follower import ARM_METHODS
from .cable_parameters import BIASES, GAINS, MAX_TENSIONS, SLACK_THRESHOLDS
from .measuring_parameters import (
    AUTOSTART,
    CONFIDENCE,
    EXECUTOR,
    FILTER_LAG,
    GRAVITY_DIRECTION,
    GRAVITY_SOURCE,
    IMU_MOUNTING,
    INPUT_TIMEOUT,
    LOAD_TIMEOUT,
    MARKERS,
    MAX_CLOCK_OFFSET,
    MAX_SKEW,
    MEASURED_BEND_ANGLE_STDDEV,
    PLAUSIBILITY,
    SERVICE_DEPTH,
    TARE,
    TENSION_BIAS_STDDEV,
    TENSION_STDDEV,
    TIP_DIRECTION,
    TIP_FORCE,
    TIP_FORCE_LEVEL,
    TIP_WRENCH,
)
from .parameter_kinds import (
    ChoiceParameter,
    ListParameter,
    NumberParameter,
    Parameter,
    TextParameter,
)

ARM_ESTIMATIONS = tuple(ARM_METHODS)
ARM_TENSION_SOURCES = ('joint_state', 'array')

CABLES = 'cables.'
"""What the names of the cables' parameters begin with"""


def _said(parameter: Parameter, description: str) -> Parameter:
    """Return a parameter that is the same of an arm but for how it is described."""
    return dataclasses.replace(parameter, description=description)


INITIAL_BEND_ANGLES = ListParameter(
    'initial_bend_angles',
    (),
    'where the joints are at the start and after `~/reset` in rad, from the base on, within '
    'their stops; empty: the arm is straight',
    of_numbers=True,
)

ARM_NUMBERS: tuple[NumberParameter, ...] = (
    dataclasses.replace(
        TENSION_STDDEV, description='standard deviation of each measured tension, all independent'
    ),
    dataclasses.replace(
        MEASURED_BEND_ANGLE_STDDEV,
        description='`filtering` and `tip_force`: standard deviation of the angles on '
        '`measured_joint_states`',
    ),
    dataclasses.replace(
        CONFIDENCE,
        description='`filtering`: probability with which the intervals in `~/arm_estimate` '
        'contain the true values',
    ),
    FILTER_LAG,
    TENSION_BIAS_STDDEV,
    INPUT_TIMEOUT,
    dataclasses.replace(
        MAX_SKEW,
        description='`joint_state` with some of the cables per message: largest difference of '
        'the times of the messages that are put together',
    ),
    MAX_CLOCK_OFFSET,
    *PLAUSIBILITY,
    LOAD_TIMEOUT,
    TIP_FORCE_LEVEL,
    *TARE,
)
"""Those that are numbers and may change while the node runs, beside the cables'"""

ARM_VECTORS = (
    dataclasses.replace(
        GRAVITY_DIRECTION,
        description="direction of gravity in the base's frame, of any length: for `fixed`, and "
        'until the first message of a sensor',
    ),
    dataclasses.replace(
        IMU_MOUNTING,
        description="`imu`: roll, pitch and yaw of the IMU in the base's frame, as in URDF",
    ),
    dataclasses.replace(
        TIP_DIRECTION,
        description="unit vector in the plane of bending, in the base's frame, along which "
        '`tip_force` looks for a force on the end of the last unit',
    ),
)

ARM_CHANGEABLE: tuple[Parameter, ...] = (*ARM_NUMBERS, INITIAL_BEND_ANGLES, *ARM_VECTORS)
"""All that may change while the node runs, beside the cables'"""

ARM_WIRING: tuple[Parameter, ...] = (
    TextParameter(
        'arm_file',
        '',
        "file of the arm: its units and cables; empty: the installed example's",
    ),
    ChoiceParameter(
        'tension_source',
        ARM_TENSION_SOURCES[0],
        '`joint_state`: `JointState` on `tensions`, with all cables or a part of them by name in '
        "`effort`; `array`: `Float64MultiArray` on `tensions`, in the order of the arm's file",
        choices=ARM_TENSION_SOURCES,
    ),
    ChoiceParameter(
        'estimation',
        ARM_ESTIMATIONS[0],
        'the node remembers where the joints were; `tracking`: it takes each tension as it is; '
        '`filtering`: it treats tensions as noisy and says how certain it is, which takes tens of '
        'milliseconds per message',
        choices=ARM_ESTIMATIONS,
    ),
    GRAVITY_SOURCE,
    _said(
        TIP_WRENCH,
        "whether the force on the end of the last unit is read from `tip_wrench`, in the base's "
        'frame; otherwise there is none',
    ),
    _said(
        TIP_FORCE,
        'whether there are `~/tip_force`, `~/tip_wrench` and `~/solve_tip_force`: what else '
        'pushes at the end of the last unit; angles are those on `measured_joint_states`, if '
        'there are any',
    ),
    TextParameter(
        'frame_id',
        'base',
        "frame of the base, in every stamped message: origin in the centre of the first joint's "
        'ball, Z along the straight arm, X towards cables s',
    ),
    TextParameter('arm_name', 'arm', 'hardware id in `/diagnostics`'),
    ListParameter(
        'joint_names',
        (),
        'names of the joints in every message, from the base on; empty: `arm_name` with '
        '`_joint_1`, `_joint_2` and so on',
        is_fixed=True,
    ),
    MARKERS,
    EXECUTOR,
    SERVICE_DEPTH,
    AUTOSTART,
)
"""How the estimator of an arm is connected, which is fixed at the start"""

ARM_PARAMETERS: tuple[Parameter, ...] = (*ARM_WIRING, *ARM_CHANGEABLE)
"""All but the cables', see `cable_table`"""

_OF_A_CABLE = tuple(group[0] for group in (GAINS, BIASES, MAX_TENSIONS, SLACK_THRESHOLDS))


def cable_table(cable_names: Sequence[str]) -> tuple[NumberParameter, ...]:
    """Return the parameters of cables: how the tension of each is measured."""
    return tuple(
        dataclasses.replace(parameter, name=f'{cable_prefix(cable)}{_last(parameter)}')
        for cable in cable_names
        for parameter in _OF_A_CABLE
    )


def cable_prefix(cable: str) -> str:
    """Return what the names of a cable's parameters begin with."""
    return f'{CABLES}{cable}.'


def _last(parameter: Parameter) -> str:
    return parameter.name.rpartition('.')[2]
