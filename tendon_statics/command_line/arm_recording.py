"""What the verbs that follow an arm through a recording have in common."""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..estimation.arm_settings import ArmSettings
from ..files.arm_file import load_arm, load_arm_uncertainties
from ..files.arm_parameters import (
    ARM_ESTIMATIONS,
    ARM_PARAMETERS,
    ARM_TENSION_SOURCES,
    cable_table,
)
from ..files.arm_settings import arm_settings_from, check_cables, joint_names
from ..files.known_parameters import check_parameters_of_ros
from ..files.parameter_file import node_parameters, read_parameters
from ..files.parameter_form import ParameterFileError
from ..files.parameter_kinds import SettingError, in_their_types
from ..physics import ArmError, Load
from ..physics.deviations import TENSION_STDDEV
from ..physics.load import push_along
from ..recordings.arm_recording import ArmRecording
from ..recordings.hints import arm_hints
from ..recordings.reading.arm_bag import DEFAULT_MEASURED
from ..recordings.reading.load import ENDINGS, load_arm_recording
from ..recordings.reading.topics import DEFAULT_TENSIONS, BagTopics
from ..recordings.reading.units import of_arm as quantities_of
from ..recordings.replay.arm_estimates import replay_arm
from ..recordings.replay.arm_result import ArmReplay
from ..recordings.replay.arm_tip_forces import arm_tip_forces
from ..recordings.replay.tip_forces import TipForces
from ..recordings.scaling import of_arm
from .arm_options import add_arm_options, bend_angles_from, load_from
from .options import UsageError, add_bend_angle_stddev_option, add_tension_stddev_option
from .progress import with_progress
from .recording_bag_options import DEFAULTS, TIP_WRENCH, add_common_bag_options, names_of
from .recording_options import (
    add_table_options,
    table_from,
)
from .tip_force_options import add_direction_option, add_level_option

OF_ARM = (
    'on the end of the last unit, fixed in the frame of the base: X towards cables s, Z along the '
    'first unit at zero bend'
)
"""Where a force at the tip is looked for"""

ARM_NODE = '/arm_estimator'


class FollowedArm(NamedTuple):
    """An arm that was followed through a recording."""

    settings: ArmSettings
    replay: ArmReplay
    tips: TipForces | None = None
    """What pushes at the tip, if it was asked for"""

    @property
    def hints(self) -> list[str]:
        """What looks wrong with the recording."""
        return arm_hints(self.replay.recording, self.settings)


def add_arm_tip_force_options(parser: argparse.ArgumentParser) -> None:
    """Add along which line a force at the tip is looked for, if it is, and how sure all is."""
    group = add_direction_option(parser, OF_ARM, required=False)
    add_level_option(group)
    add_bend_angle_stddev_option(group, file='parameter file')


def add_arm_recording_options(parser: argparse.ArgumentParser) -> None:
    """Add the arm, its recording, how that is read, and how the arm is followed through it."""
    add_arm_options(parser)
    parser.add_argument(
        'data',
        type=Path,
        metavar='DATA',
        help=f'recording, ending in {", ".join(ENDINGS)}, or the folder of a bag: the tensions at '
        "the base, by the cables' names",
    )
    parser.add_argument(
        '--parameters',
        metavar='FILE',
        help='ROS parameter file of arm_estimator: gains and biases of the load cells, what is '
        'believed of them, where the joints begin; its arm_file is not looked at',
    )
    parser.add_argument(
        '--node',
        metavar='NAME',
        default=ARM_NODE,
        help='the estimator whose parameters are taken from that file; default: %(default)s',
    )
    parser.add_argument(
        '--estimation',
        choices=ARM_ESTIMATIONS,
        help='how the arm is followed; default: that of the parameter file, or '
        f'{ARM_ESTIMATIONS[0]}',
    )
    add_tension_stddev_option(parser, default=None)
    _add_bag_options(parser)
    add_table_options(parser, 'l_tip=Fz1,bend_angle_1=Enc1', 'tension=mN,bend_angle=deg')


def _add_bag_options(parser: argparse.ArgumentParser) -> None:
    """Add what says where in a bag the numbers are."""
    bag = parser.add_argument_group('of a bag')
    bag.add_argument(
        '--tensions-topic',
        metavar='TOPIC',
        help='JointState or DynamicJointState with the cables by name, an array in the order of '
        f"the arm's file, or ArmEstimate; default: {DEFAULT_TENSIONS}",
    )
    bag.add_argument(
        '--tension-source',
        choices=ARM_TENSION_SOURCES,
        help='type of the tensions, as the parameter of arm_estimator; default: that of the '
        'parameter file, or whichever there is',
    )
    bag.add_argument(
        '--measured-topic',
        metavar='TOPIC',
        help='measured angles by the names of the joints: JointState or DynamicJointState; '
        f'default: {DEFAULT_MEASURED}, if it is there',
    )
    bag.add_argument(
        '--joint-names',
        type=names_of,
        metavar='NAME,...',
        help='of all joints, from the base on; default: those of the parameter file, or '
        'arm_joint_1 and so on',
    )
    add_common_bag_options(bag, 'parameter file')


def followed_arm(options: argparse.Namespace, most_tips: int | None = None) -> FollowedArm:
    """Read arm, parameters and recording as the options say, and follow the one through it.

    Parameters
    ----------
    most_tips : int, optional
        Samples that are asked what pushes at the tip, if that is looked for; by default all.
    """
    settings, given = _settings_from(options)
    recording = _recording_from(options, settings, given)
    estimation = options.estimation or given.get('estimation') or ARM_ESTIMATIONS[0]
    if estimation == 'filtering' and not (options.tension_stddev or 'tension_stddev' in given):
        raise UsageError(
            'estimation is filtering, which needs the noise of the load cells: give '
            '--tension-stddev, in N, or tension_stddev in the parameter file'
        )
    asked = _asked_of_tip(options, settings)
    load = _load_from(options, settings, recording)
    replayed = replay_arm(settings, recording, estimation, load=load, progress=with_progress)
    if asked is None:
        return FollowedArm(settings, replayed)
    tips = arm_tip_forces(
        *(asked, recording, estimation), load=load, most=most_tips, progress=with_progress
    )
    return FollowedArm(asked, replayed, tips)


def _asked_of_tip(options: argparse.Namespace, settings: ArmSettings) -> ArmSettings | None:
    """Return settings with what is asked of a force at the tip; None if nothing is.

    Raises
    ------
    LoadError
        If the direction is none; before the arm is followed, which may take long.
    """
    if getattr(options, 'direction', None) is None:
        return None
    x, z, _, _ = push_along(options.direction, settings.arm.units[-1].length)
    changed = {'tip_direction': (x, 0.0, z), 'tip_force_level': options.level}
    if options.bend_angle_stddev_deg is not None:
        changed['measured_bend_angle_stddev'] = math.radians(options.bend_angle_stddev_deg)
    return dataclasses.replace(settings, **changed)


def _settings_from(options: argparse.Namespace) -> tuple[ArmSettings, Mapping[str, Any]]:
    """Return what the arm's estimator computes with, and the parameters of the file."""
    arm = load_arm(options.arm)
    given: Mapping[str, Any] = {}
    path = options.parameters
    try:
        if path is not None:
            node = options.node if options.node.startswith('/') else f'/{options.node}'
            table = (*ARM_PARAMETERS, *cable_table(arm.cable_names))
            given = in_their_types(table, node_parameters(read_parameters(Path(path)), node))
            check_parameters_of_ros(given)
            check_cables(arm, given)
        named = options.joint_names or given.get('joint_names') or ()
        names = joint_names(arm, named, given.get('arm_name') or 'arm')
        uncertainties = load_arm_uncertainties(options.arm)
        settings = arm_settings_from(arm, given, names, uncertainties)
    except (ParameterFileError, SettingError) as error:
        raise ArmError(f'{path}: {error}') from None
    stddev = options.tension_stddev or (
        settings.tension_stddev if 'tension_stddev' in given else TENSION_STDDEV
    )
    changed: dict[str, Any] = {'tension_stddev': stddev}
    if start := bend_angles_from(options):
        changed['initial_bend_angles'] = tuple(start)
    return dataclasses.replace(settings, **changed), given


def _recording_from(
    options: argparse.Namespace, settings: ArmSettings, given: Mapping[str, Any]
) -> ArmRecording:
    table = table_from(options, quantities_of(settings.arm))
    skew = options.max_skew
    tip = TIP_WRENCH if given.get('tip_wrench') is True else None
    topics = BagTopics(
        tensions=(options.tensions_topic,) if options.tensions_topic else None,
        tension_source=options.tension_source or given.get('tension_source'),
        cable_names=settings.arm.cable_names,
        arm_joints=settings.joint_names,
        interface=options.interface,
        bend_angle=options.measured_topic,
        base=options.base_topic,
        gravity_source=given.get('gravity_source') or DEFAULTS.gravity_source,
        imu_mounting=settings.imu_mounting,
        tip_wrench=options.tip_wrench_topic or tip,
        max_skew=DEFAULTS.max_skew if skew is None else skew,
        tension_skew=settings.max_skew if skew is None else skew,
        clock=options.clock,
    )
    found = load_arm_recording(options.data, settings.arm, topics, table, progress=with_progress)
    return of_arm(found, settings, given)


def _load_from(
    options: argparse.Namespace, settings: ArmSettings, recording: ArmRecording
) -> Load:
    """Return what acts beside the cables as far as it was not recorded."""
    said = {
        'the tilt of the base': ('base_tilt', ('base_tilt_deg', 'gravity_direction')),
        'the force at the tip': ('tip_force_x', ('tip_force',)),
    }
    for what, (quantity, names) in said.items():
        _refuse_both(recording, what, quantity, [n for n in names if getattr(options, n)])
    return load_from(options, settings.gravity_direction)


def _refuse_both(recording: ArmRecording, what: str, quantity: str, given: Sequence[str]) -> None:
    if getattr(recording, quantity) is not None and given:
        raise UsageError(
            f'{recording.name} has {what} in it; --{given[0].replace("_", "-")} is for recordings '
            'that do not'
        )
