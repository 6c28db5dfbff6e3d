"""Options that the verbs of an arm share."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from ..files.arm_file import load_arm
from ..physics import UPRIGHT, Arm, Load
from .options import UsageError, add_tilt_options, finite


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
        type=finite,
        nargs=2,
        metavar=('X', 'Z'),
        help='force in N at the end of the last unit; default: none',
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


def arm_from(options: argparse.Namespace) -> tuple[Arm, list[float], Load]:
    """Return the arm, where its joints are in rad, and the load."""
    arm = load_arm(options.arm)
    angles = bend_angles_from(options) or [0.0] * len(arm.units)
    return arm, angles, load_from(options)


def bend_angles_from(options: argparse.Namespace) -> list[float]:
    """Return where the joints are at first in rad, from the base on; empty if it is not said."""
    return [math.radians(degrees) for degrees in options.bend_angles_deg or ()]


def load_from(
    options: argparse.Namespace, direction: Sequence[float] = UPRIGHT.gravity_direction
) -> Load:
    """Return what acts beside the cables; `direction` is that of gravity if it is not said."""
    tip = tuple(options.tip_force or (0.0, 0.0))
    if options.base_tilt_deg is not None:
        return Load.tilted(math.radians(options.base_tilt_deg), tip)
    return Load(tuple(options.gravity_direction or direction), tip)


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


def _named_tension(text: str) -> tuple[str, float]:
    name, equals, value = text.rpartition('=')
    try:
        tension = float(value)
    except ValueError:
        tension = math.nan
    if equals and name and math.isfinite(tension):
        return name, tension
    comma = name and ',' in value
    hint = f'decimals take a point: {name}={value.replace(",", ".")}' if comma else 'say s_tip=1.5'
    raise argparse.ArgumentTypeError(f'it is {text!r}, needed is CABLE=N, {hint}')
