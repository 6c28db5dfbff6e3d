"""Which estimators there are."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.node import Node

ESTIMATE = 'tendon_statics_interfaces/msg/Estimate'

UNKNOWN = '_UNKNOWN_'
"""In the name of a node of which only the publisher is known yet"""


class Sighting(NamedTuple):
    """An estimator that can be watched."""

    name: str
    """Full name of the node"""
    topic: str
    """That of its estimates"""


def estimators_in_sight(node: Node) -> list[Sighting]:
    """Return whatever publishes estimates, by name; each node once."""
    found = {}
    topics = [name for name, types in node.get_topic_names_and_types() if ESTIMATE in types]
    # Of a node with several the one that is named so, and not that which comes late.
    for topic in sorted(topics, key=lambda name: name.endswith('/estimate')):
        for publisher in node.get_publishers_info_by_topic(topic):
            name = f'{publisher.node_namespace.rstrip("/")}/{publisher.node_name}'
            if UNKNOWN not in name:
                found[name] = Sighting(name, topic)
    return [found[name] for name in sorted(found)]
