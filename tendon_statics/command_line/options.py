"""Options that several verbs share, and the error for asking too much of them."""

from __future__ import annotations

import argparse
import json
import math

from ..files.design_file import default_design_path, load_design
from ..physics import JointDesign


class UsageError(Exception):
    """The command line asks for what cannot be; the text is for the user."""


def add_design_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--design FILE``."""
    parser.add_argument(
        '--design',
        metavar='FILE',
        help='joint design, a ROS parameter file; default: the preliminary design',
    )


def design_from(options: argparse.Namespace) -> JointDesign:
    """Return the design that ``--design`` names, or the installed default."""
    return load_design(options.design or default_design_path())


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


def add_tension_stddev_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--tension-stddev N``."""
    parser.add_argument(
        '--tension-stddev',
        type=_deviation,
        default=0.01,
        metavar='N',
        help='standard deviation of each tension in N; default: %(default)s',
    )


def _deviation(text: str) -> float:
    """Return a standard deviation, of which there is none that is not finite and above 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is a finite number above 0')
    return value


def add_format_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--format text|json``."""
    parser.add_argument(
        '--format', choices=('text', 'json'), default='text', help='default: %(default)s'
    )


def print_json(content: object) -> None:
    """Print something as JSON; what is not determined is null, never NaN."""
    print(json.dumps(content, indent=2, allow_nan=False))
