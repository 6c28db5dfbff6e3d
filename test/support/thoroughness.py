"""How much is tried: all of it in CI, a part of it at the desk, where one waits.

The profiles are hypothesis's own; the functions below scale with the one that is loaded.
"""

from __future__ import annotations

import os
from collections.abc import Callable

from hypothesis import HealthCheck, settings

WHOLE = 100
"""Examples of a property that asks for no other number, in CI"""

# No test is timed, and none fails because chance has filtered out many of its first examples.
# In CI the same examples come each time, at the desk always new ones.
_STEADY = settings(
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
settings.register_profile('quick', _STEADY, max_examples=WHOLE // 4)
settings.register_profile('thorough', _STEADY, max_examples=WHOLE, derandomize=True)
settings.load_profile('thorough' if os.environ.get('CI') else 'quick')


def some_of(count: int) -> int:
    """Return how many of `count` are tried: all in CI."""
    return count * settings().max_examples // WHOLE


def few_of(count: int) -> int:
    """Return how many of `count` simulations, which take long, are run: all in CI, or a tenth."""
    return count if settings().max_examples >= WHOLE else max(1, count // 10)


def examples(count: int, how_many: Callable[[int], int] = some_of) -> settings:
    """Try so many examples of a property, in CI, and a part of them elsewhere."""
    return settings(max_examples=how_many(count))
