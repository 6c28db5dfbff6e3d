"""A progress bar on long work, on a terminal only."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib.util import find_spec

DELAY = 1.0
"""s before the bar appears"""


def with_progress(items: Iterable[int]) -> Iterable[int]:
    """Pass items on and show on stderr how far they are; without tqdm just pass them on."""
    if not sys.stderr.isatty() or find_spec('tqdm') is None:
        return items
    from tqdm import tqdm

    bar: Iterable[int] = tqdm(items, delay=DELAY, leave=False, unit='chunk')
    return bar
