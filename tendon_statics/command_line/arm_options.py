"""Options that the verbs of an arm share."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from ..files.arm_file import load_arm
from ..physics import UPRIGHT, Arm, Load
from ..recordings.reading.arm_table import ArmTable, load_arm_table
from .options import UsageError, add_tilt_options


def add_arm_options(parser: argparse.ArgumentParser) -> None:
    """Add the arm's file, where its joints are, and what acts on it beside its cables."""
    parser.add_argument('arm', metavar='ARM_FILE', help='an arm in YAML, as config/arm.yaml is')
    parser.add_argument(
        '--bend-angles-deg',
        type=float,
        nargs='+',
        metavar='DEG',
        help='where the joints are at first in degrees, from the base on; default: straight',
    )
    group = parser.add_argument_group(
        'load', "beside the cables, in the base's frame; default: upright, nothing at the tip"
    )
    add_tilt_options(group)
    group.add_argument(
        '--tip-force',
        type=float,
        nargs=2,
        default=(0.0, 0.0),
        metavar=('X', 'Z'),
        help='force in N at the end of the last unit',
    )


def add_tensions_option(parser: argparse.ArgumentParser, option: str, description: str) -> None:
    """Add an option that takes a tension for each cable."""
    parser.add_argument(
        option,
        type=_named_tension,
        nargs='+',
        required=True,
        metavar='CABLE=N',
        help=f'{description}, in N for each cable by its name',
    )


def add_table_option(parser: argparse.ArgumentParser) -> None:
    """Add the table of tensions."""
    parser.add_argument(
        'data',
        metavar='CSV',
        help='tensions in N at the base, one column a cable, titled with its name, one row a '
        'sample; a column time in s is taken along; - is standard input',
    )


def arm_from(options: argparse.Namespace) -> tuple[Arm, list[float], Load]:
    """Return the arm, where its joints are in rad, and the load."""
    arm = load_arm(options.arm)
    degrees = options.bend_angles_deg
    angles = [0.0] * len(arm.units) if degrees is None else [math.radians(d) for d in degrees]
    if options.base_tilt_deg is not None:
        return arm, angles, Load.tilted(math.radians(options.base_tilt_deg), options.tip_force)
    direction = options.gravity_direction or UPRIGHT.gravity_direction
    return arm, angles, Load(tuple(direction), tuple(options.tip_force))


def tensions_from(named: Sequence[tuple[str, float]]) -> dict[str, float]:
    """Return tensions by cable.

    Raises
    ------
    UsageError
        If a cable is given twice.
    """
    names = [name for name, _ in named]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f'the tension of cable {name} is given twice')
    return dict(named)


def table_from(options: argparse.Namespace, arm: Arm) -> ArmTable:
    """Return the table of tensions."""
    return load_arm_table(options.data, arm.cable_names)


def _named_tension(text: str) -> tuple[str, float]:
    name, equals, value = text.rpartition('=')
    try:
        tension = float(value)
    except ValueError:
        tension = math.nan
    if not (equals and name and math.isfinite(tension)):
        raise argparse.ArgumentTypeError(f'it is {text!r}, needed is CABLE=N, say s_tip=1.5')
    return name, tension
