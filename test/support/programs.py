"""Running ``tendon-statics``: as installed, or without its slow start."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from ament_index_python.packages import get_package_prefix
from forks import FORKS, become

from tendon_statics.command_line.main import main

PROGRAM = [f'{get_package_prefix("tendon_statics")}/lib/tendon_statics/tendon-statics']

TIME_LIMIT = 120.0
"""Seconds; ten times what any verb needs"""


def run_installed(*arguments: object) -> subprocess.CompletedProcess:
    """Run the installed program to its end."""
    command = [*PROGRAM, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=TIME_LIMIT, check=False)


def run(*arguments: object) -> subprocess.CompletedProcess:
    """Run its `main` to the end in a process of its own, forked where all is imported already."""
    given = list(map(str, arguments))
    with tempfile.TemporaryDirectory() as folder:
        streams = [Path(folder, name) for name in ('stdout', 'stderr')]
        place = (Path.cwd(), dict(os.environ))
        process = FORKS.Process(target=_run_main, args=(given, streams, *place))
        process.start()
        process.join(TIME_LIMIT)
        if process.exitcode is None:
            process.kill()
            raise TimeoutError(f'{given} took longer than {TIME_LIMIT:.0f} s')
        output, errors = (stream.read_text(encoding='utf-8') for stream in streams)
        return subprocess.CompletedProcess(given, process.exitcode, output, errors)


def _run_main(
    arguments: list[str], streams: list[Path], folder: Path, environment: dict[str, str]
) -> None:
    become(streams, folder, environment)
    gc.disable()  # It ends before there is garbage that counts.
    sys.exit(main(arguments))


def assert_refused(done: subprocess.CompletedProcess, named: str) -> None:
    """Assert an error in one line, and nothing else."""
    assert done.returncode == 2, done.stdout
    assert done.stdout == ''
    assert done.stderr.startswith('tendon-statics: ')
    assert done.stderr.count('\n') == 1, done.stderr
    assert named in done.stderr
