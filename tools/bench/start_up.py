"""How long it takes to get going, beside loading NumPy."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading

from .rows import Row, at_most
from .timing import best_times

ROUNDS = 15
LIMIT = 60
"""s that a process may take"""


def rows() -> list[Row]:
    """Measure."""
    program = shutil.which('tendon-statics')
    if program is None:
        raise RuntimeError('there is no program tendon-statics: run `make setup`')
    python = sys.executable
    numpy, physics, solve = best_times(
        [
            lambda: _run(python, '-c', 'import numpy'),
            lambda: _run(python, '-c', 'import tendon_statics.physics'),
            lambda: _run(program, 'solve', '--tension-l', '1', '--tension-s', '2'),
        ],
        ROUNDS,
    )
    against = '`python -c "import numpy"`'
    return [
        at_most('`import tendon_statics.physics`, a process', against, physics / numpy, 1.5),
        at_most('`tendon-statics solve`, a process', against, solve / numpy, 1.5),
    ]


def _run(*command: str) -> None:
    # NumPy was compiled to bytecode when it was installed; the package is on its first run.
    environment = {k: v for k, v in os.environ.items() if k != 'PYTHONDONTWRITEBYTECODE'}
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, env=environment) as process:
        # A limit given to `wait` would have it look for the end at intervals of up to 50 ms.
        watchdog = threading.Timer(LIMIT, process.kill)
        watchdog.start()
        code = process.wait()
        watchdog.cancel()
    if code != 0:
        raise RuntimeError(f'{" ".join(command)} ended with {code}, at the latest after {LIMIT} s')
