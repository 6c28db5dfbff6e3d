"""The programs over ROS without their slow start, for tests that are about something else."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path

from forks import FORKS, become
from ros_programs import Process, Program

ENTRY_POINTS = {
    'estimator': 'tendon_statics.node.program',
    'arm_estimator': 'tendon_statics.node.program',
    'pulley_driver': 'tendon_statics.driver.program',
    'view': 'tendon_statics.view.program',
}
"""Program → module with its entry point, a function of the same name"""

_SET_PARENT_DEATH_SIGNAL = 1
"""PR_SET_PDEATHSIG of prctl(2)"""


class ForkedProgram(Program):
    """The entry point of a program in a process of its own, forked where all is loaded already.

    That saves half a second of processor time.
    """

    def _start(self, command: Sequence[str | Path]) -> Process:
        return _Forked(command, Path(f'/proc/{os.getpid()}/fd/{self._output.fileno()}'))


class _Forked:
    """What `subprocess.Popen` has, for a process that the server of forks starts and reaps."""

    def __init__(self, command: Sequence[str | Path], output: Path) -> None:
        place = ((output, output), Path.cwd(), dict(os.environ))
        self._process = FORKS.Process(target=_run, args=(list(map(str, command)), *place))
        self._process.start()
        self.pid = self._process.pid

    def poll(self) -> int | None:
        return self._process.exitcode

    def wait(self, timeout: float | None = None) -> int:
        self._process.join(timeout)
        if self._process.exitcode is None:
            raise subprocess.TimeoutExpired(self._process.name, timeout)
        return self._process.exitcode

    def send_signal(self, sig: int, /) -> None:
        if self.poll() is None:
            with suppress(ProcessLookupError):  # It may have ended since.
                os.kill(self.pid, sig)


def _run(
    command: list[str],
    streams: tuple[Path, Path],
    folder: Path,
    environment: dict[str, str],
) -> None:
    become(streams, folder, environment)
    ctypes.CDLL(None).prctl(_SET_PARENT_DEATH_SIGNAL, signal.SIGTERM)
    name = Path(command[0]).name
    sys.exit(getattr(import_module(ENTRY_POINTS[name]), name)(command))
