"""``tendon-statics design``: check the file of a unit and show what is in it."""

from __future__ import annotations

import argparse
import sys

from ..files.estimator_parameters import DESIGN, ESTIMATIONS
from ..physics import design_fields
from .options import add_design_option, unit_from
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_design_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print every parameter of the design with its value, unit and range; and what else is set."""
    unit = unit_from(options)
    design = unit.design
    for warning in filter(None, (*unit.unknown, unit.addressed)):
        print(f'tendon-statics: {warning}', file=sys.stderr)
    print(
        markdown_table(
            ('parameter', 'symbol', 'value:', 'unit', 'allowed', 'meaning'),
            [
                (
                    f'`design.{field.name}`',
                    field.symbol,
                    value if isinstance(value, str) else f'{value:.7g}',
                    field.unit or '1',
                    field.allowed.removesuffix(f' {field.unit}'),
                    field.description,
                )
                for field in design_fields()
                for value in (getattr(design, field.name),)
            ],
        )
    )
    others = {
        name: value for name, value in unit.parameters.items() if not name.startswith(DESIGN)
    }
    if others:
        print('\nbeside the design: ' + ', '.join(f'{name} {others[name]}' for name in others))
    if options.design:
        estimation = unit.get('estimation') or ESTIMATIONS[0]
        unsaid = estimation == 'filtering' and 'tension_stddev' not in unit.parameters
        print(
            f'\nThe file is sound: estimation {estimation}, '
            f'noise of {unit.settings.tension_stddev:g} N on each tension'
            + (', which nobody gave: set tension_stddev to that of the load cells' * unsaid)
        )
