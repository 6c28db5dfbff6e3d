"""``tendon-statics design``: check a design file and show what is in it."""

from __future__ import annotations

import argparse

from ..physics import design_parameters
from .options import add_design_option, design_from
from .tables import markdown_table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_design_option(parser)


def run(options: argparse.Namespace) -> None:
    """Print every parameter with its value, unit and range."""
    design = design_from(options)
    print(
        markdown_table(
            ('parameter', 'symbol', 'value:', 'unit', 'allowed', 'meaning'),
            [
                (
                    f'`design.{parameter.name}`',
                    parameter.symbol,
                    f'{getattr(design, parameter.name):.7g}',
                    parameter.unit or '1',
                    f'{parameter.minimum:.6g} to {parameter.maximum:.6g}',
                    parameter.description,
                )
                for parameter in design_parameters()
            ],
        )
    )
