"""``tendon-statics plot``: figures, as SVG, PNG or PDF; one module for each."""

from __future__ import annotations

import argparse
from importlib import import_module
from pathlib import Path

from .figures import FORMATS, SIZE, write_figure
from .options import say_written

FIGURES = {
    'residual': "Eq. (4) over the bend angle (the paper's Fig. 2)",
    'unit': "the unit at its bend angle, with what acts on it (the paper's Fig. 1)",
    'hysteresis': 'the path of a unit whose cables trade tension, and the angles that friction '
    'can hold',
    'map': 'bend angle, pressure or sensitivity over both cable tensions',
    'recording': 'a recorded session and what the model says of it, over time',
    'tip-force': 'what a recorded session tells of a force at the tip, over time',
    'calibration': 'how well a fitted design meets a recorded session',
}
"""Figure → what it shows; the module ``figure_...``, with _ for -, has the rest"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    figures = parser.add_subparsers(dest='figure', metavar='FIGURE', required=True)
    for name, description in FIGURES.items():
        figure_parser = figures.add_parser(name, help=description, description=description)
        module = import_module(f'{__package__}.figure_{name.replace("-", "_")}')
        module.add_arguments(figure_parser)
        figure_parser.set_defaults(module=module)
        figure_parser.add_argument(
            '--output',
            type=Path,
            required=True,
            metavar='FILE',
            help=f'ending: {", ".join(FORMATS)}',
        )


def run(options: argparse.Namespace) -> int:
    """Draw and write the figure."""
    module = options.module
    size = getattr(module, 'SIZE', SIZE)
    code = write_figure(options.output, lambda drawing: module.draw(drawing, options), size)
    say_written(options.output, options)
    return code or 0
