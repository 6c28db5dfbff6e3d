"""``tendon-statics solve``: one pair of cable tensions."""

from __future__ import annotations

import argparse
import math

from ..physics import DesignUncertainty, Equilibrium, Regime, solve
from .load_text import DEFAULT_LAW, load_dict, setting_facts
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    add_tension_options,
    add_tension_stddev_option,
    load_from,
    print_json,
    unit_from,
)
from .tables import fact_lines

MEANING = {
    Regime.EQUILIBRIUM: 'on the verge of slipping at this angle',
    Regime.HELD: 'friction holds from 0 to the stop; tensions alone do not determine the angle',
    Regime.DRIVEN_TO_STOP: 'friction holds nowhere from 0 to the stop, to which the unit slides',
    Regime.SLACK: 'a cable carries no tension, which is outside the model',
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_tension_options(parser)
    add_load_options(parser)
    add_design_option(parser)
    add_format_option(parser)
    add_tension_stddev_option(parser)


def run(options: argparse.Namespace) -> None:
    """Solve and print."""
    unit = unit_from(options)
    design, load = unit.design, load_from(options, unit)
    equilibrium = solve(design, options.tension_l, options.tension_s, load)
    if options.format == 'json':
        print_json(
            {
                'contact_law': design.contact_law,
                'load': load_dict(load),
                **equilibrium.as_dict(),
                'bend_angle_derivatives': equilibrium.bend_angle_derivatives,
                'pressure_derivatives': equilibrium.pressure_derivatives,
            }
        )
    else:
        print('\n'.join(_text(equilibrium, options.tension_stddev, unit.uncertainty)))


def _text(
    equilibrium: Equilibrium, tension_stddev: float, uncertainty: DesignUncertainty | None
) -> list[str]:
    lines = [f'regime        {equilibrium.regime}: {MEANING[equilibrium.regime]}']
    if settings := setting_facts(equilibrium.design, equilibrium.load):
        lines.append(fact_lines(settings))
    if equilibrium.bend_angle is None or equilibrium.pressure is None:
        return lines
    lines += [
        f'bend angle    {math.degrees(equilibrium.bend_angle):.4f} deg '
        f'({equilibrium.bend_angle:.10f} rad), towards cable '
        f'{"l" if equilibrium.bend_angle < 0 else "s"}',
        f'pressure      {equilibrium.pressure:.4f} Pa '
        f'(contact force {equilibrium.normal_force:.6f} N)',
    ]
    if equilibrium.regime is Regime.EQUILIBRIUM:
        lines.append(
            f'roots         {equilibrium.root_count}, '
            + (
                'this one stable'
                if equilibrium.stable
                else 'this one unstable: pushed past it, the unit slides on to the stop'
            )
        )
    angle_stddev = equilibrium.bend_angle_stddev(tension_stddev, uncertainty)
    pressure_stddev = equilibrium.pressure_stddev(tension_stddev, uncertainty)
    if angle_stddev is not None and pressure_stddev is not None:
        lines.append(
            f'deviation     {math.degrees(angle_stddev):.2f} deg and {pressure_stddev:.2f} Pa '
            f'at {tension_stddev:g} N of noise on each tension'
            + ('' if uncertainty is None else " and the design's tolerance")
        )
    gradient, pressure_gradient = equilibrium.bend_angle_gradient, equilibrium.pressure_gradient
    if gradient and pressure_gradient:
        lines += [
            f'sensitivity   by tension_l {math.degrees(gradient.tension_l):+.1f} deg/N, '
            f'{pressure_gradient.tension_l:+.1f} Pa/N',
            f'              by tension_s {math.degrees(gradient.tension_s):+.1f} deg/N, '
            f'{pressure_gradient.tension_s:+.1f} Pa/N',
        ]
    derivatives, of_pressure = (
        equilibrium.bend_angle_derivatives,
        equilibrium.pressure_derivatives,
    )
    if derivatives and of_pressure:
        lines.append(
            f'              by base tilt {derivatives["base_tilt"]:+.2f} deg/deg, '
            f'{round(math.radians(of_pressure["base_tilt"]), 1) + 0.0:+.1f} Pa/deg'
        )
    if equilibrium.force_remainder:
        x, z = (round(part, 3) + 0.0 for part in equilibrium.force_remainder)
        lines.append(f'remainder     {x:+.3f} N in X, {z:+.3f} N in Z of the two force equations')
        if equilibrium.design.contact_law == DEFAULT_LAW:
            lines.append(
                "              (the paper's law only has their squares add up; others meet both)"
            )
    if not equilibrium.branch_consistent:
        lines.append(
            'warning       the force equations ask for another contact force than the one taken'
        )
    return lines
