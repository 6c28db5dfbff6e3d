"""``tendon-statics arm margins``: how near every joint is to slipping."""

from __future__ import annotations

import argparse
import math

from ..physics import arm_margins
from .arm_options import add_arm_options, add_tensions_option, arm_from, tensions_from
from .options import add_format_option, print_json
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    add_tensions_option(parser, '--tensions', 'the tensions at the base')
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the margins."""
    arm, angles, load = arm_from(options)
    margins = arm_margins(arm, angles, tensions_from(options.tensions), load)
    if options.format == 'json':
        print_json({'slip_margins': margins})
        return
    rows = [
        [
            str(number),
            f'{math.degrees(angle):.3f}',
            f'{margin:+.4f}',
            _meaning(margin, angle, stop),
        ]
        for number, (angle, margin, stop) in enumerate(
            zip(angles, margins, arm.stops, strict=True), start=1
        )
    ]
    print(markdown_table(('joint:', 'bend angle [deg]:', 'slip margin:', 'is'), rows))


def _meaning(margin: float, angle: float, stop: float) -> str:
    if abs(margin) <= 1.0:
        return 'held'
    if angle == math.copysign(stop, margin):
        return 'pressed on its stop'
    return f'slips to {"s" if margin > 0.0 else "l"}'
