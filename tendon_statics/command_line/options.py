"""Options that several verbs share, and the error for those that cannot be met."""

from __future__ import annotations

import argparse
import json
import math
import sys
from pathlib import Path

from ..files.design_file import default_design_path
from ..files.unit_file import Unit, load_unit
from ..physics import UPRIGHT, JointDesign, Load, TendonStaticsError
from ..physics.deviations import BEND_ANGLE_STDDEV, TENSION_STDDEV


class UsageError(TendonStaticsError):
    """The command line asks for something impossible; the text is for the user."""


def add_design_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--design FILE`` and ``--node NAME``."""
    parser.add_argument(
        '--design',
        metavar='FILE',
        help='joint design, a ROS parameter file; default: the preliminary design',
    )
    parser.add_argument(
        '--node',
        metavar='NAME',
        default='',
        help='the estimator whose parameters are taken from that file, say /left/estimator; '
        'default: the only one that it names, or any',
    )


def unit_from(options: argparse.Namespace) -> Unit:
    """Return the unit that ``--design`` names, or one of the installed default design."""
    return load_unit(*design_file_and_node(options))


def design_file_and_node(options: argparse.Namespace) -> tuple[Path, str]:
    """Return the design file, and the full name of the estimator in it, empty if not said."""
    return design_path(options), _full_name(options.node)


def design_path(options: argparse.Namespace) -> Path:
    """Return the design file that ``--design`` names, or the installed default."""
    return Path(options.design or default_design_path())


def design_name(options: argparse.Namespace) -> str:
    """Return what the design is called in texts."""
    return Path(options.design).name if options.design else 'the preliminary design'


def design_and_load(options: argparse.Namespace) -> tuple[JointDesign, Load]:
    """Return that design, and what acts on the unit beside its cables."""
    unit = unit_from(options)
    return unit.design, load_from(options, unit)


def _full_name(node: str) -> str:
    return node if not node or node.startswith('/') else f'/{node}'


def add_tension_options(
    parser: argparse.ArgumentParser, defaults: tuple[float, float] | None = None
) -> None:
    """Add ``--tension-l N`` and ``--tension-s N``, required unless there are defaults."""
    for name, default in zip(('l', 's'), defaults or (None, None), strict=True):
        parser.add_argument(
            f'--tension-{name}',
            type=float,
            default=default,
            required=default is None,
            metavar='N',
            help=f'tension of cable {name} in N'
            + ('' if default is None else '; default: %(default)s'),
        )


def add_tension_stddev_option(
    parser: argparse.ArgumentParser, default: float | None = TENSION_STDDEV
) -> None:
    """Add ``--tension-stddev N``; without a default it is that of the design file."""
    of_file = '' if default is not None else 'that of the design file, or '
    parser.add_argument(
        '--tension-stddev',
        type=deviation,
        default=default,
        metavar='N',
        help=f'standard deviation of each tension in N; default: {of_file}{TENSION_STDDEV}',
    )


def tension_stddev_of(options: argparse.Namespace, unit: Unit) -> float | None:
    """Return the option, or what the design file says, in N; None where neither does."""
    if options.tension_stddev is not None:
        return float(options.tension_stddev)
    stddev = unit.get('tension_stddev')
    return float(stddev) if stddev else None


def tension_stddev_from(options: argparse.Namespace, unit: Unit) -> float:
    """Return the same, or the default where there is none."""
    return tension_stddev_of(options, unit) or TENSION_STDDEV


def add_bend_angle_stddev_option(
    parser: argparse._ActionsContainer,
    default: float | None = None,
    file: str = 'design file',
) -> None:
    """Add ``--bend-angle-stddev-deg DEG``; without a default that is what a file says."""
    standard = f'{math.degrees(BEND_ANGLE_STDDEV):g}'
    of_file = f'measured_bend_angle_stddev of the {file}, or {standard}'
    parser.add_argument(
        '--bend-angle-stddev-deg',
        type=_deviation_or_0,
        default=default,
        metavar='DEG',
        help='standard deviation of a measured angle in degrees; default: '
        f'{of_file if default is None else f"{default:g}"}',
    )


def bend_angle_stddev_from(options: argparse.Namespace, unit: Unit) -> float:
    """Return the option, if there is one, or what the design file says, or the default, in rad."""
    degrees = getattr(options, 'bend_angle_stddev_deg', None)
    return unit.settings.measured_bend_angle_stddev if degrees is None else math.radians(degrees)


def add_load_options(parser: argparse.ArgumentParser) -> None:
    """Add what acts on the unit beside its cables: tilt or gravity, and a force at the tip."""
    group = parser.add_argument_group(
        'load',
        'beside the cables, in the joint frame; default: gravity_direction of the design file, or '
        'upright, and nothing at the tip',
    )
    add_tilt_options(group)
    group.add_argument(
        '--tip-force',
        type=finite,
        nargs=2,
        metavar=('X', 'Z'),
        help='force on the unit in N, fixed in the joint frame',
    )
    group.add_argument(
        '--tip-distance',
        type=finite,
        metavar='M',
        help="where it acts along the unit's axis, in m from the centre of the ball; default: "
        'tip_distance of the design file',
    )


def add_tilt_options(group: argparse._ActionsContainer) -> None:
    """Add ``--base-tilt-deg DEG`` and ``--gravity-direction X Y Z``, of which one is given."""
    direction = group.add_mutually_exclusive_group()
    direction.add_argument(
        '--base-tilt-deg',
        type=finite,
        metavar='DEG',
        help='tilt of the base in the plane of bending in degrees, positive towards cable s',
    )
    direction.add_argument(
        '--gravity-direction',
        type=finite,
        nargs=3,
        metavar=('X', 'Y', 'Z'),
        help='or the direction of gravity, of any length: X towards cable s, Z along the unit at '
        'zero bend; what Y has is carried by the guides and left out',
    )


def load_from(options: argparse.Namespace, unit: Unit) -> Load:
    """Return the load that the options name, or the design file for what they leave open.

    Raises
    ------
    UsageError
        If a tip distance is given without a force, or it is not said where the force acts.
    LoadError
        If the direction of gravity is of length zero, or a number too large.
    """
    force, distance = options.tip_force, options.tip_distance
    if force is None and distance is not None:
        raise UsageError('--tip-distance is given without --tip-force, whose place it is')
    if distance is None:
        distance = unit.get('tip_distance')
    if force is not None and distance is None:
        raise UsageError(
            "--tip-force is given, but not where along the unit's axis it acts: say "
            '--tip-distance, in m, or tip_distance in the design file'
        )
    tip = ((0.0, 0.0), 0.0) if force is None else (tuple(force), float(distance or 0.0))
    if options.base_tilt_deg is not None:
        return Load.tilted(math.radians(options.base_tilt_deg), *tip)
    direction = options.gravity_direction or unit.get('gravity_direction')
    return Load(tuple(direction or UPRIGHT.gravity_direction), *tip)


def finite(text: str) -> float:
    """Return a finite number that was typed."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is a finite number')
    return value


def deviation(text: str) -> float:
    """Return a standard deviation that was typed, which has to be finite and above 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is a finite number above 0')
    return value


def _deviation_or_0(text: str) -> float:
    value = finite(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is 0 or more')
    return value


def add_format_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--format text|json``."""
    parser.add_argument(
        '--format', choices=('text', 'json'), default='text', help='default: %(default)s'
    )


def say_written(path: Path, options: argparse.Namespace) -> None:
    """Say that a file was written; where JSON is printed, beside it."""
    is_json = getattr(options, 'format', 'text') == 'json'
    print(f'wrote {path}', file=sys.stderr if is_json else sys.stdout)


def print_json(content: object) -> None:
    """Print something as JSON; what is not determined is null, never NaN."""
    print(json.dumps(content, indent=2, allow_nan=False))
