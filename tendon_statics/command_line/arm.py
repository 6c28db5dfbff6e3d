"""``tendon-statics arm``: units in series; one module for each of its verbs."""

from __future__ import annotations

import argparse
from importlib import import_module

ARM_VERBS = {
    'track': 'follow the arm, with memory, through a recording, and print every sample',
    'replay': 'the same, with a summary: what each joint did, and how far off measured angles are',
    'report': 'a recorded session of the arm as one HTML file',
    'margins': 'how near every joint is to slipping, under one set of tensions',
    'order': 'the order in which the joints slip while the tensions change',
    'invert': 'the tensions that bring one joint to its limit first',
    'tip-force': 'the forces at the tip with which friction can hold all joints where they are',
    'plot': 'a figure of the arm going through a recording',
}
"""Verb → what it does; the module ``arm_...`` has the rest"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    verbs = parser.add_subparsers(dest='arm_verb', metavar='VERB', required=True)
    for name, description in ARM_VERBS.items():
        subparser = verbs.add_parser(name, help=description, description=description)
        module = import_module(f'{__package__}.arm_{name.replace("-", "_")}')
        module.add_arguments(subparser)
        subparser.set_defaults(run_arm=module.run)


def run(options: argparse.Namespace) -> int:
    """Run the verb of the arm."""
    code: int | None = options.run_arm(options)
    return code or 0
