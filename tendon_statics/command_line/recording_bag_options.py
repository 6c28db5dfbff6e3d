"""What says where in a bag the numbers are."""

from __future__ import annotations

import argparse

from ..files.cable_parameters import TENSION_SOURCES
from ..files.unit_file import Unit
from ..recordings.reading.clock import CLOCKS
from ..recordings.reading.topics import (
    DEFAULT_PAIR,
    DEFAULT_TENSIONS,
    FORCE_COMPONENTS,
    BagTopics,
)

DEFAULTS = BagTopics()

TIP_WRENCH = '/tip_wrench'
"""Where the estimator listens"""


def add_bag_options(bag: argparse._ArgumentGroup) -> None:
    """Add what says where in a bag the numbers of a unit are."""
    bag.add_argument(
        '--tensions-topic',
        type=names_of,
        metavar='TOPIC[,TOPIC]',
        help='Float64MultiArray, Float32MultiArray, JointState, DynamicJointState or Estimate; or '
        'two of WrenchStamped, Wrench, Float64 or Float32, cable l first; default: '
        f'{DEFAULT_TENSIONS}, or {",".join(DEFAULT_PAIR)} if only these are there',
    )
    bag.add_argument(
        '--tension-source',
        choices=TENSION_SOURCES,
        help="type of the tensions, as the estimator's parameter; default: that of the design "
        'file, or whichever there is',
    )
    bag.add_argument(
        '--cable-names',
        type=names_of,
        metavar='L,S',
        help='names in a JointState; default: those of the design file, or '
        f'{",".join(DEFAULTS.cable_names)}',
    )
    bag.add_argument(
        '--force-component',
        choices=FORCE_COMPONENTS,
        help=f'of a wrench; default: that of the design file, or {DEFAULTS.force_component}',
    )
    bag.add_argument(
        '--bend-angle-topic',
        metavar='TOPIC',
        help='Float64, Float32, JointState or DynamicJointState; default: /measured_bend_angle, '
        'if it is there',
    )
    bag.add_argument(
        '--joint-name', metavar='NAME', help='in a JointState of the angle; default: its only one'
    )
    bag.add_argument(
        '--pressure-topic',
        metavar='TOPIC',
        help='Float64 or Float32; default: /measured_pressure, if it is there',
    )
    bag.add_argument('--state-topic', metavar='TOPIC', help='String: slipping or held')
    add_common_bag_options(bag, 'design file')


def add_common_bag_options(bag: argparse._ArgumentGroup, file: str) -> None:
    """Add what is alike of a unit and of an arm, whose parameters are in a file called so."""
    bag.add_argument(
        '--interface',
        metavar='NAME',
        default=DEFAULTS.interface,
        help='of the cables in a DynamicJointState; default: %(default)s',
    )
    bag.add_argument(
        '--base-topic',
        metavar='TOPIC',
        help='of the base: Imu, PoseStamped or QuaternionStamped; or its tilt in rad, Float64 or '
        f"Float32; default: what the {file}'s gravity_source says, or /measured_base_tilt, if "
        'it is there',
    )
    bag.add_argument(
        '--tip-wrench-topic',
        metavar='TOPIC',
        help='of the force at the tip, in the joint frame: WrenchStamped or Wrench; default: '
        f'/tip_wrench if the {file} says tip_wrench, else none',
    )
    bag.add_argument(
        '--max-skew',
        type=float,
        metavar='S',
        help='by which messages that belong together may be apart; default: '
        f'{DEFAULTS.max_skew}, and of the two tensions of a pair that of the design file, or '
        f'{DEFAULTS.pair_skew}',
    )
    bag.add_argument(
        '--clock',
        choices=CLOCKS,
        default=DEFAULTS.clock,
        help='times of messages: their stamps, those of recording (log), or whichever of these '
        'all of them have; default: %(default)s',
    )


def topics_from(options: argparse.Namespace, unit: Unit) -> BagTopics:
    """Return where in a bag the numbers are, by the options or the unit's file."""
    skew = options.max_skew
    return BagTopics(
        tensions=options.tensions_topic,
        tension_source=options.tension_source or unit.get('tension_source'),
        cable_names=options.cable_names or tuple(unit.get('cable_names') or DEFAULTS.cable_names),
        interface=options.interface,
        force_component=options.force_component
        or unit.get('wrench_component')
        or DEFAULTS.force_component,
        bend_angle=options.bend_angle_topic,
        joint_name=options.joint_name,
        pressure=options.pressure_topic,
        base=options.base_topic,
        gravity_source=unit.get('gravity_source') or DEFAULTS.gravity_source,
        imu_mounting=tuple(unit.get('imu_mounting') or DEFAULTS.imu_mounting),
        tip_wrench=options.tip_wrench_topic
        or (TIP_WRENCH if unit.get('tip_wrench') is True else None),
        state=options.state_topic,
        max_skew=DEFAULTS.max_skew if skew is None else skew,
        tension_skew=unit.get('max_skew') if skew is None else skew,
        clock=options.clock,
    )


def names_of(text: str) -> tuple[str, ...]:
    """Return the names in a list with commas."""
    return tuple(filter(None, (name.strip() for name in text.split(','))))
