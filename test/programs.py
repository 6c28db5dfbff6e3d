"""Running the installed ``tendon-statics``."""

from __future__ import annotations

import subprocess

from ament_index_python.packages import get_package_prefix

PROGRAM = [f'{get_package_prefix("tendon_statics")}/lib/tendon_statics/tendon-statics']


def run(*arguments: object) -> subprocess.CompletedProcess:
    """Run it to its end."""
    command = [*PROGRAM, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def assert_refused(done: subprocess.CompletedProcess, named: str) -> None:
    """Assert an error in one line, and nothing else."""
    assert done.returncode == 2, done.stdout
    assert done.stdout == ''
    assert done.stderr.startswith('tendon-statics: ')
    assert done.stderr.count('\n') == 1, done.stderr
    assert named in done.stderr
