"""Running ``tendon-statics``: as installed, or without its slow start."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from typing import IO

from ament_index_python.packages import get_package_prefix

from tendon_statics.command_line.main import main

PROGRAM = [f'{get_package_prefix("tendon_statics")}/lib/tendon_statics/tendon-statics']

TIME_LIMIT = 120.0
"""Seconds; ten times what any verb needs"""


def run_installed(*arguments: object) -> subprocess.CompletedProcess:
    """Run the installed program to its end."""
    command = [*PROGRAM, *map(str, arguments)]
    return _shown(
        subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
    )


def run(*arguments: object) -> subprocess.CompletedProcess:
    """Run its `main` to the end in this process, with all else as a program has it.

    A fork of a process that has everything loaded would cost as much as ten answers.
    """
    given = list(map(str, arguments))
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        with _streams_and_warnings_of_a_program(output, errors):
            code = _exit_code(given)
        texts = (_text_of(file) for file in (output, errors))
        return _shown(subprocess.CompletedProcess(given, code, *texts))


def _shown(done: subprocess.CompletedProcess) -> subprocess.CompletedProcess:
    """Write to stderr what a program did there, which pytest shows where the test then fails."""
    sys.stderr.write(done.stderr)
    return done


@contextmanager
def _streams_and_warnings_of_a_program(output: IO[bytes], errors: IO[bytes]) -> Iterator[None]:
    """Write to files, warnings too, which pytest collects; `main` may put others in their place.

    It may set what ends a program, too, which is set back.
    """
    of_sigterm = signal.getsignal(signal.SIGTERM)
    try:
        with (
            # Other descriptors of the same files, as standard streams are.
            os.fdopen(os.dup(output.fileno()), 'w', encoding='utf-8') as stdout,
            os.fdopen(os.dup(errors.fileno()), 'w', encoding='utf-8', buffering=1) as stderr,
            redirect_stdout(stdout),
            redirect_stderr(stderr),
            warnings.catch_warnings(),
        ):
            warnings.showwarning = _show_warning
            warnings.simplefilter('default')
            for category in _NOT_SHOWN:
                warnings.simplefilter('ignore', category)
            yield
    finally:
        signal.signal(signal.SIGTERM, of_sigterm)


_NOT_SHOWN = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)
"""Warnings that Python shows to nobody unless asked"""


def _show_warning(message, category, filename, lineno, file=None, line=None) -> None:  # noqa: ARG001
    sys.stderr.write(warnings.formatwarning(message, category, filename, lineno, line))


def _exit_code(arguments: list[str]) -> int:
    try:
        return main(arguments)
    except SystemExit as end:  # of argparse, after help
        return end.code or 0


def _text_of(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read().decode('utf-8')


def assert_refused(done: subprocess.CompletedProcess, named: str) -> None:
    """Assert an error in one line, and nothing else."""
    assert done.returncode == 2, done.stdout
    assert done.stdout == ''
    assert done.stderr.startswith('tendon-statics: ')
    assert done.stderr.count('\n') == 1, done.stderr
    assert named in done.stderr
