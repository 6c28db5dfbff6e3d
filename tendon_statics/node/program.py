"""What every program of this package that is a node does around its node."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from ..physics.errors import DesignError


class StartError(Exception):
    """A node cannot start; the text is for the user."""


def run_node(make_node: Callable[[], Node], args: Sequence[str] | None = None) -> int:
    """Run a node until SIGINT, SIGTERM or shutdown of the context; return the exit code.

    A node that cannot start, say for a bad parameter, is one line on stderr and exit code 1.
    """
    node = None
    try:
        rclpy.init(args=args)
        try:
            node = make_node()
        except (DesignError, ParameterException, StartError) as error:
            return _say(error)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RuntimeError as error:  # rclpy's own errors; RCLError is one
        # A signal ends the context at any moment, and what then still publishes fails.
        if node is None:
            return _say(error)
        if rclpy.ok():
            raise
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
    return 0


def _say(error: Exception) -> int:
    program = Path(sys.argv[0]).name
    print(f'{program} cannot start: {" ".join(str(error).split())}', file=sys.stderr)
    return 1
