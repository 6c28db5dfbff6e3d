"""Makes the tests' brute force and sessions known to the tools that measure against them."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

TESTS = Path(__file__).resolve().parents[1] / 'test'
sys.path.insert(0, str(TESTS / 'support'))


def run_all(work: Callable[[Any], Any], jobs: Sequence[Any], workers: int) -> Iterable[Any]:
    """Return what a function makes of each job, in their order, from several processes."""
    if workers == 1:
        yield from map(work, jobs)
        return
    with ProcessPoolExecutor(workers) as pool:
        yield from pool.map(work, jobs, chunksize=4)
