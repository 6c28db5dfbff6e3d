"""``tendon-statics admissible``: where friction can hold the unit."""

from __future__ import annotations

import argparse
import math

from ..physics import admissible_angles
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    add_tension_options,
    design_and_load,
    print_json,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_tension_options(parser)
    add_load_options(parser)
    add_design_option(parser)
    add_format_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print the intervals."""
    design, load = design_and_load(options)
    intervals = admissible_angles(design, options.tension_l, options.tension_s, load)
    if options.format == 'json':
        print_json({'admissible_angles': intervals})
    elif not intervals:
        print('none: friction cannot hold the unit anywhere; it slides to its stop')
    for low, high in intervals if options.format == 'text' else ():
        print(
            f'{math.degrees(low):+.4f} deg to {math.degrees(high):+.4f} deg '
            f'({low:+.10f} to {high:+.10f} rad)'
        )
