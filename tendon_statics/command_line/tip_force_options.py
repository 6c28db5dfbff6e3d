"""Options that say along which line a force at the tip is looked for, and how sure all is."""

from __future__ import annotations

import argparse
import math
from typing import NamedTuple

from ..files.unit_file import Unit
from .options import UsageError, deviation, finite

BEND_ANGLE_STDDEV_DEG = 0.5
"""As of the verbs that calibrate"""

LEVEL = 0.95


class Line(NamedTuple):
    """A line along which a force may act at the tip."""

    direction: tuple[float, ...]
    distance: float
    """m"""


def add_line_options(parser: argparse.ArgumentParser, *, required: bool) -> None:
    """Add ``--direction``, ``--distance`` and ``--level``."""
    group = parser.add_argument_group(
        'force at the tip', 'that is looked for; it adds to what the load has'
    )
    group.add_argument(
        '--direction',
        type=finite,
        nargs='+',
        required=required,
        metavar=('X', 'Z'),
        help='unit vector along which it acts on the unit, fixed in the joint frame: X towards '
        'cable s, Z along the unit at zero bend',
    )
    group.add_argument(
        '--distance',
        type=finite,
        metavar='M',
        help="where it acts along the unit's axis, in m from the centre of the ball; default: "
        'tip_distance of the design file',
    )
    add_level_option(group)


def add_level_option(group: argparse._ArgumentGroup) -> None:
    """Add ``--level``."""
    group.add_argument(
        '--level',
        type=_level,
        default=LEVEL,
        metavar='SHARE',
        help='rate at which the intervals are to hold the true force, from 0.5 to below 1; '
        'default: %(default)s',
    )


def add_bend_angle_stddev_option(
    parser: argparse.ArgumentParser, default: float = BEND_ANGLE_STDDEV_DEG
) -> None:
    """Add ``--bend-angle-stddev-deg``."""
    parser.add_argument(
        '--bend-angle-stddev-deg',
        type=deviation,
        default=default,
        metavar='DEG',
        help='standard deviation of the measured angle in degrees; default: %(default)s',
    )


def line_from(options: argparse.Namespace, unit: Unit) -> Line:
    """Return the line that the options name, or the design file for what they leave open.

    Raises
    ------
    UsageError
        If it is not said where the force acts.
    """
    distance = options.distance
    distance = unit.get('tip_distance') if distance is None else distance
    if distance is None:
        raise UsageError(
            "it is not said where along the unit's axis the force acts: say --distance, in m, or "
            'tip_distance in the design file'
        )
    return Line(tuple(options.direction), float(distance))


def _level(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.5 <= value < 1.0:
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is 0.5 to below 1')
    return value
