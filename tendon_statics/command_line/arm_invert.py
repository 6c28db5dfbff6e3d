"""``tendon-statics arm invert``: the tensions that bring one joint to its limit first."""

from __future__ import annotations

import argparse

from ..physics import arm_margins, arm_tensions_for
from .arm_options import add_arm_options, arm_from
from .options import add_format_option, print_json
from .tables import fact_lines, markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    parser.add_argument(
        '--joint', type=int, required=True, metavar='N', help='counted from 1 at the base'
    )
    parser.add_argument('--side', choices=('l', 's'), required=True, help='where it is to slip to')
    parser.add_argument(
        '--tension-range',
        type=float,
        nargs=2,
        required=True,
        metavar=('LEAST', 'GREATEST'),
        help='what each cable may carry, in N',
    )
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the tensions, and the margins under them."""
    arm, angles, load = arm_from(options)
    tensions = arm_tensions_for(
        *(arm, options.joint, options.side),
        tension_range=tuple(options.tension_range),
        bend_angles=angles,
        load=load,
    )
    margins = arm_margins(arm, angles, tensions, load)
    if options.format == 'json':
        print_json({'tensions': tensions, 'slip_margins': margins})
        return
    print(fact_lines([(name, f'{tension:.6f} N') for name, tension in tensions.items()]))
    rows = [[str(number), f'{margin:+.4f}'] for number, margin in enumerate(margins, start=1)]
    print('\n' + markdown_table(('joint:', 'slip margin:'), rows))
