"""What the workers of this machine do at first."""

from __future__ import annotations

import signal
from contextlib import suppress


def dask_setup(_worker: object) -> None:
    """Leave Ctrl-C, which a terminal sends to all, to the program that they work for."""
    with suppress(ValueError):  # Only the main thread may.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
