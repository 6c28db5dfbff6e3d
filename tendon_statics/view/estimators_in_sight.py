"""Which estimators there are."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.node import Node

from .kinds import KINDS, Kind

UNKNOWN = '_UNKNOWN_'
"""In the name of a node of which only the publisher is known yet"""

OF_TYPE = {f'tendon_statics_interfaces/msg/{kind.estimates.__name__}': kind for kind in KINDS}
"""Type of a topic → the kind of estimator that publishes it"""

NAMED_SO = ('/estimate', '/arm_estimate')
"""What the topics end with that say it at once"""


class Sighting(NamedTuple):
    """An estimator that can be watched."""

    name: str
    """Full name of the node"""
    topic: str
    """That of its estimates"""
    kind: Kind


def estimators_in_sight(node: Node) -> list[Sighting]:
    """Return whatever publishes estimates, by name; each node once."""
    found = {}
    topics = [
        (name, OF_TYPE[of_type])
        for name, types in node.get_topic_names_and_types()
        for of_type in types
        if of_type in OF_TYPE
    ]
    # Of a node with several the one that is named so, and not that which comes late.
    topics.sort(key=lambda topic: topic[0].endswith(NAMED_SO))
    for topic, kind in topics:
        for publisher in node.get_publishers_info_by_topic(topic):
            name = f'{publisher.node_namespace.rstrip("/")}/{publisher.node_name}'
            if UNKNOWN not in name:
                found[name] = Sighting(name, topic, kind)
    return [found[name] for name in sorted(found)]
