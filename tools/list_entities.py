"""Print what the estimator has, for docs/node.md: every topic, service and timer, and how many."""

from __future__ import annotations

import contextlib
import io
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import rclpy
from rclpy.node import Node
from ros_domain import own_domain
from ros_programs import wait_for

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.node.arm_estimator import ArmEstimator
from tendon_statics.node.estimator import Estimator
from tendon_statics.node.watchdog import LONGEST_SLEEP

NodeType = TypeVar('NodeType', bound=Node)


def entities(node: Node) -> dict[str, dict[str, str]]:
    """Return what the graph says of a node: kind → name, with ~ for the node's own → type."""
    asked = {
        'publisher': node.get_publisher_names_and_types_by_node,
        'subscription': node.get_subscriber_names_and_types_by_node,
        'service': node.get_service_names_and_types_by_node,
    }
    made = {
        'publisher': {of.topic_name for of in node.publishers},
        'subscription': {of.topic_name for of in node.subscriptions},
        'service': {of.service_name for of in node.services},
    }

    def in_graph() -> dict[str, dict[str, str]]:
        return {
            kind: {name: ', '.join(types) for name, types in ask(node.get_name(), namespace)}
            for kind, ask in asked.items()
        }

    own, namespace = node.get_fully_qualified_name() + '/', node.get_namespace()
    # The middleware says it of itself in its own time.
    wait_for('the graph', lambda: all(made[kind] <= {*of} for kind, of in in_graph().items()))
    return {
        kind: {name.replace(own, '~/'): types for name, types in of_kind.items()}
        for kind, of_kind in in_graph().items()
    }


def main() -> None:
    """Print the table."""
    with estimator() as node:
        rows = [
            (kind, f'`{name}`', interface.replace('/msg/', '/').replace('/srv/', '/'))
            for kind, of_kind in entities(node).items()
            for name, interface in sorted(of_kind.items())
        ]
        (_,) = node.timers
    rows.append(('timer', 'what is due', f'up to {LONGEST_SLEEP:g} s, steady clock'))
    counts = Counter(kind for kind, _, _ in rows)
    print(markdown_table(('entity', 'name', 'type'), rows))
    numbers = [f'{count} {kind}{"s" if count > 1 else ""}' for kind, count in counts.items()]
    print(f'\nIn all {", ".join(numbers)}.')


@contextmanager
def estimator(*parameters: str) -> Iterator[Estimator]:
    """Make an estimator in this process, alone in a domain of its own, with parameters."""
    arguments = [part for parameter in parameters for part in ('-p', parameter)]
    with alone(Estimator, *arguments) as node:
        yield node


@contextmanager
def arm_estimator(*parameters: str) -> Iterator[ArmEstimator]:
    """Make the estimator of the installed arm in the same way."""
    arguments = [part for parameter in parameters for part in ('-p', parameter)]
    with alone(ArmEstimator, *arguments) as node:
        yield node


@contextmanager
def alone(make_node: Callable[[], NodeType], *ros_arguments: str) -> Iterator[NodeType]:
    """Make a node in this process, alone in a domain of its own."""
    with own_domain() as domain:
        rclpy.init(args=['--ros-args', '--log-level', 'fatal', *ros_arguments], domain_id=domain)
        try:
            with contextlib.redirect_stderr(io.StringIO()):
                node = make_node()
            try:
                yield node
            finally:
                node.destroy_node()
        finally:
            rclpy.shutdown()


def own_parameters(node: Node) -> list[str]:
    """Names of the parameters that not every node has, in the order of their declaration."""
    of_ros = ('use_sim_time', 'start_type_description_service', 'qos_overrides')
    return [name for name in node._parameters if not name.startswith(of_ros)]


if __name__ == '__main__':
    main()
