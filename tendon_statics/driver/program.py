"""The program ``pulley_driver``; it imports nothing of ROS at first, as the estimator's."""

from __future__ import annotations

from collections.abc import Sequence

from ..node.program import run


def pulley_driver(arguments: Sequence[str] | None = None) -> int:
    """Run the driver; the entry point of ``ros2 run tendon_statics pulley_driver``."""
    return run('pulley_driver', f'{__package__}.pulley_driver', 'PulleyDriver', arguments)
