"""What every program of this package that is a node does around its node."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from ..physics.errors import DesignError

WAKE_PERIOD = 0.5
"""Longest time in s that a node goes on after a signal that it slept through."""


class StartError(Exception):
    """A node cannot start; the text is for the user."""


def run_node(make_node: Callable[[], Node], args: Sequence[str] | None = None) -> int:
    """Run a node until SIGINT, SIGTERM or shutdown of the context; return the exit code.

    A node that cannot start, say for a bad parameter, is one line on stderr and exit code 1.
    """
    # rclpy shuts its context down on both signals. A KeyboardInterrupt on top of that would come
    # at any later moment, also in the midst of tidying up.
    interrupted: list[int] = []
    signal.signal(signal.SIGINT, lambda number, _frame: interrupted.append(number))
    try:
        rclpy.init(args=args)
    except RuntimeError as error:  # RCLError is one
        return _say(error)
    node = None
    try:
        executor = SingleThreadedExecutor()
        if not interrupted:
            node = make_node()
            # rclpy wakes the executor on a signal and shuts the context down beside that. An
            # executor that looks at the context in between waits again, and must not for ever.
            node.create_timer(
                WAKE_PERIOD, _do_nothing, clock=Clock(clock_type=ClockType.STEADY_TIME)
            )
            executor.add_node(node)
            executor.spin()
    except (DesignError, ParameterException, StartError) as error:
        return _say(error)
    except ExternalShutdownException:
        pass
    except Exception:
        # The context may end in the midst of a message, and then whatever publishes fails.
        if rclpy.ok():
            raise
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
    return 0


def _do_nothing() -> None:
    pass


def _say(error: Exception) -> int:
    program = Path(sys.argv[0]).name
    print(f'{program} cannot start: {" ".join(str(error).split())}', file=sys.stderr)
    return 1
