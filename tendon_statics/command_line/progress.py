"""A progress bar on long work, on a terminal only."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib.util import find_spec
from typing import TypeVar

DELAY = 1.0
"""s before the bar appears"""

T = TypeVar('T')


def with_progress(items: Iterable[T], doing: str) -> Iterable[T]:
    """Pass items on and show on stderr how far they are; without tqdm just pass them on."""
    if not sys.stderr.isatty() or find_spec('tqdm') is None:
        return items
    from tqdm import tqdm

    bar: Iterable[T] = tqdm(items, desc=doing, delay=DELAY, leave=False, unit='', unit_scale=True)
    return bar
