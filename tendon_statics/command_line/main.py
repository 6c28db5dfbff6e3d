"""The program ``tendon-statics``: finds the verb and runs it."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import signal
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from importlib import import_module
from typing import Any, NoReturn

from ..physics.errors import TendonStaticsError
from .options import UsageError

VERBS = {
    'solve': 'bend angle and joint pressure of one pair of cable tensions',
    'admissible': 'the bend angles at which friction can hold the unit',
    'calibrate': 'fit a design to a recorded session, with the uncertainty of every value',
    'replay': 'every sample of a recorded session through the model',
    'archive': 'every recording below some folders through the model, into one data set',
    'report': 'a recorded session and its calibration as one HTML file',
    'tare': 'the biases of load cells from a recording of slack cables',
    'sweep': 'a map of the answers over both cable tensions, as a file',
    'track': 'a replay with memory, as a table of where the unit is at each sample',
    'tip-force': 'the forces at the tip that explain tensions and angle, as far as friction lets '
    'one know',
    'invert': 'the tensions at which the unit is about to slip at a bend angle',
    'paper': "the paper's published case: bisection, errata, identified values, signs, other laws",
    'design': 'check a design file and show what is in it',
    'arm': 'units in series: where an arm is, and which of its joints slip',
    'plot': 'figures: Eq. (4), the unit, its hysteresis, maps, recordings, calibrations',
}
"""Verb → what it does; the module of the same name, with _ for -, has the rest."""


class _Help(argparse.HelpFormatter):
    """Help that shows a vector by its parts, ``X Z``, also where it is taken with a Y of 0."""

    def _format_args(self, action: argparse.Action, default_metavar: str) -> str:
        if action.nargs == '+' and isinstance(action.metavar, tuple):
            return ' '.join(action.metavar)
        return super()._format_args(action, default_metavar)


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line, and which takes -1e-3 for a number."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **{'formatter_class': _Help, **more})
        # Python before 3.14 knows -0.001 only, and takes -1e-3 for an option.
        self._negative_number_matcher = re.compile(
            r'-(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$', re.IGNORECASE
        )

    def error(self, message: str) -> NoReturn:
        raise UsageError(f'{message} (see {self.prog} --help)')


class _Version(argparse.Action):
    """Looks the version up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        from importlib.metadata import version

        print(f'tendon-statics {version("tendon_statics")}')
        parser.exit()


def with_word_first(arguments: Sequence[str], words: Iterable[str]) -> list[str]:
    """Put the first of some words, verbs or figures, before the options that precede it.

    So options count in any place. Values of those that every verb has may be called as a word.
    """
    for place, argument in enumerate(arguments):
        is_value = place > 0 and arguments[place - 1] in ('--design', '--node')
        if argument in words and not is_value:
            return [argument, *arguments[:place], *arguments[place + 1 :]]
    return list(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run ``tendon-statics``; return the exit code.

    It is 0; 1 if a recording could not be read as a whole, with what was missing on stderr; 2 with
    one line on stderr; or 128 more than the number of the signal that interrupted it.
    """
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    parser = _Parser(
        prog='tendon-statics',
        description='Statics of a tendon-driven ball-joint unit, from its cable tensions.',
    )
    parser.add_argument('--version', action=_Version, nargs=0, help='print the version and exit')
    verbs = parser.add_subparsers(dest='verb', metavar='VERB', required=True)
    # Whatever else is given, and missing.
    arguments = ['--version'] if '--version' in arguments else with_word_first(arguments, VERBS)
    for verb, description in VERBS.items():
        subparser = verbs.add_parser(verb, help=description, description=description)
        if verb in arguments[:1]:  # A verb that is not asked for is not loaded.
            module = import_module(f'{__package__}.{verb.replace("-", "_")}')
            module.add_arguments(subparser)
            subparser.set_defaults(run=module.run)
            if verb in ('plot', 'arm'):
                words = module.FIGURES if verb == 'plot' else module.ARM_VERBS
                arguments[1:] = with_word_first(arguments[1:], words)
    with suppress(ValueError):  # Only the main thread may.
        # So that a half-written file is removed.
        signal.signal(signal.SIGTERM, _interrupt)
    try:
        chosen = parser.parse_args(arguments)
        chosen.command = shlex.join(['tendon-statics', *arguments])
        code: int | None = chosen.run(chosen)
        sys.stdout.flush()
    except BrokenPipeError:
        # Whoever reads the output has stopped, as `head` does; that is not an error.
        _drop_output()
        return 0
    except KeyboardInterrupt as interruption:
        return 128 + (interruption.args or (signal.SIGINT,))[0]
    except (TendonStaticsError, OSError) as error:
        print(f'tendon-statics: {error}', file=sys.stderr)
        if isinstance(error, OSError):
            _drop_output()
        return 2
    return code or 0


def _interrupt(number: int, _frame: object) -> NoReturn:
    raise KeyboardInterrupt(number)


def _drop_output() -> None:
    """Keep Python from trying once more, at its end, to write what could not be written."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


if __name__ == '__main__':
    sys.exit(main())
