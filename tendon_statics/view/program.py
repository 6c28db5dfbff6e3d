"""The program ``view``; it imports nothing of ROS at first, as the estimator's."""

from __future__ import annotations

from collections.abc import Sequence

from ..node.program import run


def view(arguments: Sequence[str] | None = None) -> int:
    """Run the live page; the entry point of ``ros2 run tendon_statics view``."""
    return run('view', f'{__package__}.view', 'View', arguments)
