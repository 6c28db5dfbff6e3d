"""A message as it stands in the file of a bag, whatever the format."""

from __future__ import annotations

from typing import Any, NamedTuple

PURPOSE = 'ROS bags'

UNKNOWN_TYPE = 'message of unknown type'

CDR, ROS1 = 'cdr', 'ros1'


TEXT = 'std_msgs/msg/String'

BIG_ENDIAN, LITTLE_ENDIAN = b'\x00\x00', b'\x00\x01'
"""What a message in CDR begins with, as ROS writes it"""

CDR_HEADER = 4
"""Bytes before the first field"""


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
    type_hash: str = ''
    """Of the fields of its type, as ROS 2 makes it; empty if the bag has none"""


def check_cdr(kind: str, data: bytes) -> None:
    """Check what decoding does not see: whether a message can have been written at all.

    Raises
    ------
    ValueError
        If it has no header of CDR, holds nothing but zeros, or is a text that is cut.
    """
    start = data[: len(BIG_ENDIAN)]
    if len(data) < CDR_HEADER or start not in (BIG_ENDIAN, LITTLE_ENDIAN):
        raise ValueError('it has no header of CDR')
    if not any(data):
        raise ValueError('it holds nothing but zeros')
    if kind == TEXT:
        length, text = data[CDR_HEADER : 2 * CDR_HEADER], data[2 * CDR_HEADER :]
        if len(text) < int.from_bytes(length, 'little' if start == LITTLE_ENDIAN else 'big'):
            raise ValueError('its text is cut')
