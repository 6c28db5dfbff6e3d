"""``tendon-statics design``: check a design file and show what is in it."""

from __future__ import annotations

import argparse
import sys

from ..physics import design_fields
from .options import add_design_option, unit_from
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_design_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print every parameter with its value, unit and range."""
    unit = unit_from(options)
    design = unit.design
    for warning in filter(None, (*unit.misspelt, unit.addressed)):
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
