"""Messages in the bags of ROS 1."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import RecordingError, one_line
from ..libraries import needed
from .bag_record import PURPOSE, ROS1, Record


def ros1_records(path: Path, types: dict[str, str], damage: list[str]) -> Iterator[Record]:
    """Read the messages of a ROS 1 bag, up to where it is damaged.

    Parameters
    ----------
    types : dict
        Gets every topic of the bag, with its type.
    damage : list
        Gets what cannot be read.

    Raises
    ------
    RecordingError
        If its index cannot be read, as after a recorder was killed.
    """
    (rosbag1,) = needed('rosbags.rosbag1', purpose=PURPOSE)
    path.open('rb').close()  # for the system's own reason, if it cannot be
    reader = rosbag1.Reader(path)
    try:
        reader.open()
    except Exception as error:
        # Damage makes the library raise what its unpacking happens to.
        raise RecordingError(
            f'it cannot be read as a bag of ROS 1: {one_line(error)}; `rosbag reindex` may mend '
            'what a recorder has not finished'
        ) from None
    try:
        for connection in reader.connections:
            types.setdefault(connection.topic, connection.msgtype)
        messages = reader.messages()
        while True:
            try:
                connection, log_time, data = next(messages)
            except StopIteration:
                return
            except Exception as error:
                damage.append(f'it is truncated or damaged ({one_line(error)})')
                return
            definition = connection.msgdef  # in rosbags before 0.11 a text
            yield Record(
                *(connection.topic, connection.msgtype, getattr(definition, 'data', definition)),
                *(log_time, data, ROS1),
            )
    finally:
        reader.close()
