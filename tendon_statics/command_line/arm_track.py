"""``tendon-statics arm track``: follow an arm through a table of tensions."""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np

from ..physics import ArmState, ArmTracker, TensionError
from ..recordings.errors import RecordingError
from ..recordings.replay.table_output import write_csv
from .arm_options import add_arm_options, add_table_option, arm_from, table_from
from .options import add_tension_stddev_option

BLANK = (math.nan, math.nan, math.nan)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    add_table_option(parser)
    add_tension_stddev_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print a row for each sample: the tip in m and rad; angle in rad, regime, margin a joint."""
    arm, angles, load = arm_from(options)
    table = table_from(options, arm)
    tracker, states = ArmTracker(arm, angles), []
    for number, tensions in enumerate(table.tensions, start=1):
        try:
            states.append(tracker.update(tensions, load))
        except TensionError as error:
            raise RecordingError(f'{options.data}: row {number}: {error}') from None
    columns: dict[str, list[object]] = {} if table.time is None else {'time': [*table.time]}
    for name in arm.cable_names:
        columns[name] = [state.tensions[name] for state in states]
    tips = [state.tip or BLANK for state in states]
    deviations = [state.tip_stddev(options.tension_stddev) or BLANK for state in states]
    for index, name in enumerate(('tip_x', 'tip_z', 'tip_tilt')):
        columns[name] = [tip[index] for tip in tips]
        columns[f'{name}_stddev'] = [deviation[index] for deviation in deviations]
    for joint in range(len(arm.units)):
        columns |= _joint_columns(joint, states)
    write_csv(sys.stdout, {name: np.array(values) for name, values in columns.items()})


def _joint_columns(joint: int, states: list[ArmState]) -> dict[str, list[object]]:
    answers = [state.joints[joint] for state in states]

    def numbers(values: list[float | None]) -> list[object]:
        return [math.nan if value is None else value for value in values]

    number = joint + 1
    return {
        f'bend_angle_{number}': numbers([answer.bend_angle for answer in answers]),
        f'regime_{number}': [answer.regime.value for answer in answers],
        f'slip_margin_{number}': numbers([answer.slip_margin for answer in answers]),
        f'pressure_{number}': numbers([answer.pressure for answer in answers]),
        f'angle_assured_{number}': [answer.angle_assured for answer in answers],
    }
