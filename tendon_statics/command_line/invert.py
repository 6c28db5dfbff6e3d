"""``tendon-statics invert``: from a bend angle back to tensions."""

from __future__ import annotations

import argparse
import math

from ..physics import tensions_for
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    design_and_load,
    print_json,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    angle = parser.add_mutually_exclusive_group(required=True)
    angle.add_argument('--bend-angle', type=float, metavar='RAD', help='bend angle in rad')
    angle.add_argument('--bend-angle-deg', type=float, metavar='DEG', help='bend angle in degrees')
    target = parser.add_mutually_exclusive_group(required=True)
    target.add_argument('--pressure', type=float, metavar='PA', help='joint pressure in Pa')
    target.add_argument(
        '--total-tension', type=float, metavar='N', help='sum of the two tensions in N'
    )
    add_load_options(parser)
    add_design_option(parser)
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the tensions."""
    angle = options.bend_angle
    if angle is None:
        angle = math.radians(options.bend_angle_deg)
    design, load = design_and_load(options)
    tensions = tensions_for(
        design,
        angle,
        pressure=options.pressure,
        total_tension=options.total_tension,
        load=load,
    )
    if options.format == 'json':
        print_json(tensions._asdict())
    else:
        print(f'tension_l     {tensions.tension_l:.9f} N')
        print(f'tension_s     {tensions.tension_s:.9f} N')
