"""``tendon-statics arm order``: the order in which the joints slip on a ramp."""

from __future__ import annotations

import argparse
import math

from ..physics import arm_slip_order
from .arm_options import add_arm_options, add_tensions_option, arm_from, tensions_from
from .options import add_format_option, print_json
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    add_tensions_option(parser, '--start', 'the tensions at the start of the ramp')
    add_tensions_option(parser, '--end', 'the tensions at its end')
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the first slip of each joint."""
    arm, angles, load = arm_from(options)
    start, end = tensions_from(options.start), tensions_from(options.end)
    order = arm_slip_order(arm, start, end, load, bend_angles=angles)
    if options.format == 'json':
        print_json([slip.as_dict() for slip in order])
        return
    if not order:
        print('none: friction holds every joint all the way')
        return
    rows = [
        [
            *(str(slip.joint), slip.side, f'{100.0 * slip.share:.3f}'),
            *(f'{tension:.4f}' for tension in slip.tensions.values()),
            f'{math.degrees(slip.bend_angle):.3f}',
        ]
        for slip in order
    ]
    cables = (f'{name} [N]:' for name in arm.cable_names)
    print(markdown_table(('joint:', 'slips to', 'at [%]:', *cables, 'from [deg]:'), rows))
