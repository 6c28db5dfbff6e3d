"""``tendon-statics tip-force``: what pushes at the tip, from tensions and a measured angle."""

from __future__ import annotations

import argparse
import math
from typing import Any

from ..physics import TipForce, tip_force
from .load_text import load_dict, setting_facts
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    add_tension_options,
    add_tension_stddev_option,
    finite,
    load_from,
    print_json,
    tension_stddev_from,
    unit_from,
)
from .tables import fact_lines
from .tip_force_options import add_bend_angle_stddev_option, add_line_options, line_from


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_tension_options(parser)
    parser.add_argument(
        '--bend-angle-deg',
        type=finite,
        required=True,
        metavar='DEG',
        help='measured bend angle in degrees, positive towards cable s',
    )
    parser.add_argument(
        '--slipping',
        choices=('s', 'l'),
        default='',
        help='cable towards which the unit is slipping, so that friction is at its limit; '
        'default: it is at rest',
    )
    parser.add_argument(
        '--at-stop',
        action='store_true',
        help='the unit leans on its stop, which carries what friction does not',
    )
    add_line_options(parser, required=True)
    add_bend_angle_stddev_option(parser)
    add_load_options(parser)
    add_design_option(parser)
    add_format_option(parser)
    add_tension_stddev_option(parser, default=None)


def run(options: argparse.Namespace) -> None:
    """Print the intervals, exact and under noise."""
    unit = unit_from(options)
    load, line = load_from(options, unit), line_from(options, unit)
    stddev = tension_stddev_from(options, unit)

    def ask(**noise: Any) -> TipForce:
        return tip_force(
            unit.design,
            options.tension_l,
            options.tension_s,
            bend_angle=math.radians(options.bend_angle_deg),
            load=load,
            **line._asdict(),
            slipping=options.slipping,
            at_stop=options.at_stop,
            level=options.level,
            **noise,
        )

    exact = ask()
    noisy = ask(
        tension_stddev=stddev,
        bend_angle_stddev=math.radians(options.bend_angle_stddev_deg),
        design_covariance=unit.uncertainty,
    )
    if options.format == 'json':
        print_json(
            {
                'contact_law': unit.design.contact_law,
                'load': load_dict(load),
                'exact_intervals': finite_ends(exact.intervals),
                'intervals': finite_ends(noisy.intervals),
                'level': noisy.level,
                'probability_free': noisy.probability_free,
                'at_limit': noisy.at_limit,
                'force': noisy.force,
                'force_stddev': noisy.force_stddev,
            }
        )
        return
    noise = f'{stddev:g} N on each tension, {options.bend_angle_stddev_deg:g} deg'
    if unit.uncertainty is not None:
        noise += ', and the uncertainty of the design'
    facts = [
        *setting_facts(unit.design, load),
        ('friction', _friction_text(options)),
        ('explained by', intervals_text(exact.intervals)),
        (f'at {100.0 * noisy.level:g} %', f'{intervals_text(noisy.intervals)}, with {noise}'),
        ('free tip', f'{percent(noisy.probability_free)} probable'),
    ]
    if noisy.force is not None and noisy.force_stddev is not None:
        facts.append(('force', f'{noisy.force:+.4f} N, deviation {noisy.force_stddev:.4f} N'))
    print(fact_lines(facts))


NOTHING = 'no force: the model does not explain this state'


def intervals_text(intervals: list[tuple[float, float]], nothing: str = NOTHING) -> str:
    """Say intervals of forces as a person reads them."""
    if not intervals:
        return nothing
    return ' or '.join(_interval_text(low, high) for low, high in intervals)


def _interval_text(low: float, high: float) -> str:
    if math.isinf(low) and math.isinf(high):
        return 'any force'
    if math.isinf(low):
        return f'any force up to {high:+.4f} N'
    if math.isinf(high):
        return f'any force from {low:+.4f} N on'
    return f'{low:+.4f} N' if low == high else f'{low:+.4f} to {high:+.4f} N'


def finite_ends(intervals: list[tuple[float, float]]) -> list[list[float | None]]:
    """Return intervals ready for JSON, with null for an infinite end."""
    return [[end if math.isfinite(end) else None for end in interval] for interval in intervals]


def _friction_text(options: argparse.Namespace) -> str:
    if options.slipping:
        return f'at its limit, against slipping towards cable {options.slipping}'
    if options.at_stop:
        return 'anything up to its limit, beside what the stop carries'
    return 'anything up to its limit'


def percent(probability: float) -> str:
    """Say a probability in percent."""
    return f'{100.0 * probability:.3g} %'
