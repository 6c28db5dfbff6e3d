"""Times that a busy machine does not distort."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence


def best_times(works: Sequence[Callable[[], object]], rounds: int) -> list[float]:
    """Do the works in turn, round by round; return the shortest time of each in s.

    What else the machine does can only make a work slower, so that the shortest is the truest,
    and taking turns lets all of them have the quiet moments.
    """
    best = [float('inf')] * len(works)
    for _ in range(rounds):
        for index, work in enumerate(works):
            start = time.perf_counter()
            work()
            best[index] = min(best[index], time.perf_counter() - start)
    return best
