"""One line of the table that the bench prints."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A ratio and what it is to reach; None for one that is only to be known."""

    work: str
    against: str
    ratio: float
    target: str | None = None
    reached: bool | None = None


def at_least(work: str, against: str, ratio: float, target: float) -> Row:
    """Return a row whose ratio, times faster, is to be large."""
    return Row(work, against, ratio, f'≥ {target:g} times faster', ratio >= target)


def at_most(work: str, against: str, ratio: float, target: float) -> Row:
    """Return a row whose ratio, times as much, is to be small."""
    return Row(work, against, ratio, f'≤ {target:g} times', ratio <= target)
