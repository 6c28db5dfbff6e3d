"""The programs of this package that are nodes: start, run until a signal, end.

It imports nothing of ROS at first, so that a signal is heard while that, the slow part, loads.
"""

from __future__ import annotations

import os
import re
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from types import FrameType
from typing import Any

from ..physics.errors import TendonStaticsError
from .program_help import node_help


class StartError(TendonStaticsError):
    """A node cannot start; the text is for the user."""


def estimator(arguments: Sequence[str] | None = None) -> int:
    """Run the estimator; the entry point of ``ros2 run tendon_statics estimator``."""
    return run('estimator', f'{__package__}.estimator', 'Estimator', arguments)


def arm_estimator(arguments: Sequence[str] | None = None) -> int:
    """Run the estimator of an arm; ``ros2 run tendon_statics arm_estimator``."""
    return run('arm_estimator', f'{__package__}.arm_estimator', 'ArmEstimator', arguments)


def run(name: str, module: str, node_class: str, arguments: Sequence[str] | None) -> int:
    """Run a node until SIGINT, SIGTERM or shutdown of the context; return the exit code.

    Its module is imported here, for that is slow. A node that cannot start, say for a bad
    parameter, is one line on stderr and exit code 1.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _exit_at_once)
    arguments = sys.argv if arguments is None else arguments
    asked = node_help(name, arguments[1:])
    if asked:
        with suppress(BrokenPipeError):  # Whoever reads it may stop, as `head` does.
            print(asked, flush=True)
        return 0
    try:
        import rclpy
        from rclpy.exceptions import ParameterException
        from rclpy.executors import ExternalShutdownException
        from rclpy.utilities import remove_ros_args

        from ..files.parameter_file import ESTIMATORS, check_parameter_files

        make_node = getattr(import_module(module), node_class)
    except ImportError as error:
        return _say(name, f'it needs ROS 2, and {error}')
    try:
        check_parameter_files(arguments)  # before ROS, which says it worse
        foreign = remove_ros_args(arguments)
    except (RuntimeError, TendonStaticsError) as error:  # RCLError is a RuntimeError
        return _say(name, error)
    if len(foreign) > 1:
        return _say(
            name,
            f'{foreign[1]} is not known here: it takes ROS arguments only, and they follow '
            f'--ros-args, say {name} --ros-args --params-file unit.yaml (see {name} --help)',
        )

    # rclpy shuts its context down on both signals. A KeyboardInterrupt on top of that would come
    # at any later moment, also in the midst of tidying up.
    interrupted: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, _frame: interrupted.append(received))
    try:
        rclpy.init(args=arguments)
    except RuntimeError as error:
        return _say(name, error)
    node = None
    try:
        if interrupted:
            return 0
        try:
            if '--params-file' in arguments:  # before the node is ready, and says so
                full_name = _full_name(name)
                namespace = full_name.rpartition('/')[0]
                beside = [f'{namespace}/{of}' for of in ESTIMATORS if name not in ESTIMATORS]
                check_parameter_files(arguments, full_name, beside)
            node = make_node()
        except (StartError, ParameterException, RuntimeError, ValueError) as error:
            # RuntimeError and ValueError are rclpy's own, of bad overrides and names.
            return _say(name, error) if rclpy.ok() else 0
        _spin(node)
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
        # A second signal, as launch sends one after Ctrl-C, must not kill Python while it ends.
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)
    return 0


def _full_name(name: str) -> str:
    """Return what a node would be called; rclpy knows of names that are remapped by nodes only."""
    from rclpy.node import Node
    from rclpy.parameter import Parameter

    node = Node(
        name,
        start_parameter_services=False,
        enable_rosout=False,
        parameter_overrides=[Parameter('use_sim_time', value=False)],  # or it listens to /clock
    )
    try:
        return node.get_fully_qualified_name()
    finally:
        node.destroy_node()


def _spin(node: Any) -> None:
    """Spin a node in the executor that it asks for, until the context ends.

    rclpy wakes the executor on a signal and shuts the context down beside that. An executor that
    looks at the context in between waits again; so the node has to have a timer that never stops.
    """
    kind = getattr(node, 'executor_kind', 'single')
    if kind == 'own':  # It has a loop of its own, which ends with the context.
        node.spin()
        return
    if kind == 'single':
        from .lone_thread_executor import LoneThreadExecutor

        executor = LoneThreadExecutor()
        executor.add_node(node)
        executor.spin()
        return
    from rclpy.experimental import EventsExecutor

    executor = EventsExecutor()
    executor.add_node(node)
    # In PyPI's wheels its endless spin() hangs; in turns of a second it works everywhere.
    while node.context.ok():
        executor.spin_once(timeout_sec=1.0)


def _exit_at_once(_number: int, _frame: FrameType | None) -> None:
    """End while there is nothing yet to tidy up, and imports are not to be interrupted."""
    os._exit(0)


def _say(name: str, error: object) -> int:
    text = _IN_SOURCE.sub('', ' '.join(str(error).split()))
    print(f'{name} cannot start: {text}', file=sys.stderr)
    return 1


_IN_SOURCE = re.compile(r', at \S+\.(?:c|cpp|h|hpp):\d+')
"""Where in ROS's own sources an error arose, which is nothing for the user"""
