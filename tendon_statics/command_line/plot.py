"""``tendon-statics plot``: figures, as SVG, PNG or PDF."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from ..physics import paper, residual, solve
from .figures import BLUE, FORMATS, VERMILION, figure
from .options import add_design_option, design_from

POINTS = 301


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    figures = parser.add_subparsers(dest='figure', metavar='FIGURE', required=True)
    description = "Eq. (4) over the bend angle (the paper's Fig. 2)"
    residual_parser = figures.add_parser('residual', help=description, description=description)
    for name, tension in (('l', paper.TENSION_L), ('s', paper.TENSION_S)):
        residual_parser.add_argument(
            f'--tension-{name}',
            type=float,
            default=tension,
            metavar='N',
            help=f'tension of cable {name} in N; default: %(default)s',
        )
    add_design_option(residual_parser)
    residual_parser.add_argument(
        '--output', type=Path, required=True, metavar='FILE', help=f'ending: {", ".join(FORMATS)}'
    )


def run(options: argparse.Namespace) -> None:
    """Draw and write the figure."""
    design = design_from(options)
    equilibrium = solve(design, options.tension_l, options.tension_s)
    weak, strong = sorted((equilibrium.tension_l, equilibrium.tension_s))
    stop = design.max_bend_angle
    angles = [stop * index / (POINTS - 1) for index in range(POINTS)]
    values = [residual(design, weak, strong, angle) / design.contact_area for angle in angles]
    with figure(options.output) as axes:
        axes.axhline(0.0, color='black', linewidth=0.8)
        axes.plot([math.degrees(angle) for angle in angles], values, color=BLUE)
        if equilibrium.iterations and equilibrium.bend_angle is not None:
            angle = abs(equilibrium.bend_angle)
            axes.plot([math.degrees(angle)], [0.0], 'o', color=VERMILION)
            axes.annotate(
                f'θ = {math.degrees(angle):.2f}°, p = {equilibrium.pressure:.1f} Pa',
                (math.degrees(angle), 0.0),
                xytext=(-8, 10),
                textcoords='offset points',
                horizontalalignment='right',
            )
        axes.set_xlim(0.0, math.degrees(stop))
        axes.set_xlabel('bend angle θ towards the stronger cable [°]')
        axes.set_ylabel('Eq. (4), left − right-hand side [Pa]')
        axes.set_title(
            f'{equilibrium.regime} at T_l = {equilibrium.tension_l:g} N, '
            f'T_s = {equilibrium.tension_s:g} N',
            fontsize=10,
        )
