"""A message as it stands in the file of a bag, whatever the format."""

from __future__ import annotations

from typing import Any, NamedTuple

PURPOSE = 'ROS bags'

UNKNOWN_TYPE = 'message of unknown type'

CDR, ROS1 = 'cdr', 'ros1'


def type_name(name: str) -> str:
    """Return a type's name as ROS 2 writes it: ROS 1 leaves out what kind of interface it is."""
    package, _, last = name.partition('/')
    return f'{package}/msg/{last}' if last and '/' not in last else name


class Record(NamedTuple):
    """A message before it is decoded; of a damaged file the fields may hold anything."""

    topic: str
    kind: str
    definition: str
    """What the bag says of the fields of that type; empty if nothing"""
    log_time: Any
    """When it was recorded, in ns"""
    data: Any
    """Its content"""
    encoding: str = CDR
    """Of its content: `CDR` or `ROS1`"""
