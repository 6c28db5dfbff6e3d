"""The program ``tendon-statics``: finds the verb and runs it."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from ..physics.errors import DesignError, TensionError
from ..tension_file import TensionFileError
from .options import UsageError

VERBS = {
    'solve': 'bend angle and joint pressure of one pair of cable tensions',
    'paper': "the paper's published case: errata, identified values and sign check, as tables",
    'design': 'check a design file and show what is in it',
    'plot': 'figures: Eq. (4) over the bend angle',
}
"""Verb → what it does; the module of the same name has the rest."""


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f'{message} (see {self.prog} --help)')


def main(arguments: Sequence[str] | None = None) -> int:
    """Run ``tendon-statics``; return the exit code: 0, or 2 with one line on stderr."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    parser = _Parser(
        prog='tendon-statics',
        description='Statics of a tendon-driven ball-joint unit, from its cable tensions.',
    )
    verbs = parser.add_subparsers(dest='verb', metavar='VERB', required=True)
    for verb, description in VERBS.items():
        subparser = verbs.add_parser(verb, help=description, description=description)
        if verb in arguments:  # A verb that is not asked for is not loaded.
            module = import_module(f'{__package__}.{verb}')
            module.add_arguments(subparser)
            subparser.set_defaults(run=module.run)
    try:
        chosen = parser.parse_args(arguments)
        chosen.run(chosen)
    except (UsageError, DesignError, TensionError, TensionFileError, FileNotFoundError) as error:
        print(f'tendon-statics: {error}', file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader of our output has gone, as `head` does; that is no error of ours.
        sys.stderr.close()
        return 0
    return 0


if __name__ == '__main__':
    sys.exit(main())
