"""The files of a ROS 2 bag, MCAP or SQLite, down to whatever of a damaged one can be read."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection
from pathlib import Path
from typing import Any

from ..errors import RecordingError
from ..libraries import needed
from ..progress import Progress, unseen
from .bag_record import PURPOSE, Record
from .mcap_file import mcap_records
from .sqlite_file import sqlite_records

ZSTD_MAGIC = b'\x28\xb5\x2f\xfd'
"""What a message begins with that was compressed by itself; CDR never does"""

END_OF_TIME = 2**62
"""ns, in the year 2116; differences of times before it fit into 64 bits"""


class Messages:
    """The messages of some topics of a bag."""

    def __init__(self) -> None:
        self.types: dict[str, str] = {}
        """Every topic of the bag → its type"""
        self.messages: dict[str, list[tuple[int, Any]]] = defaultdict(list)
        """Topic → time of recording in ns, and message"""
        self.damage: list[str] = []


def read_messages(path: Path, topics: Collection[str], progress: Progress = unseen) -> Messages:
    """Read the messages of some topics from a bag's file or folder.

    Raises
    ------
    RecordingError
        If nothing of it can be read.
    """
    messages = Messages()
    if not path.is_dir():
        messages.damage += _read_file(path, topics, messages, progress)
        return messages
    files = sorted([*path.glob('*.mcap'), *path.glob('*.db3')])
    if not files:
        raise RecordingError(
            'it is a folder without .mcap or .db3 files, so no bag; '
            'files ending in .zstd are to be unpacked first, zstd -d'
        )
    for file in files:
        try:
            damage = _read_file(file, topics, messages, progress)
        except (RecordingError, OSError) as error:
            if len(files) == 1:
                raise
            damage = [str(error)]
        messages.damage += [f'{file.name}: {place}' for place in damage]
    return messages


def _read_file(
    path: Path, topics: Collection[str], messages: Messages, progress: Progress
) -> list[str]:
    """Add the messages of a file to those there are; return what of it cannot be read."""
    types = _Types()
    read = mcap_records if path.suffix == '.mcap' else sqlite_records
    damage: list[str] = []
    unreadable: dict[str, int] = defaultdict(int)
    for record in progress(read(path, messages.types, damage), 'reading'):
        if record.topic not in topics:
            continue
        try:
            timed = (_time(record), types.decode(record))
        except Exception:
            # A damaged message fails in as many ways as there are types.
            unreadable[record.topic] += 1
        else:
            messages.messages[record.topic].append(timed)
    damage += [
        f'{count} messages on {topic} cannot be read' for topic, count in unreadable.items()
    ]
    return damage


def _time(record: Record) -> int:
    if isinstance(record.log_time, int) and 0 <= record.log_time < END_OF_TIME:
        return record.log_time
    raise ValueError('no time')


class _Types:
    """Decodes messages by the definitions of ROS 2 Jazzy, or those that the bag holds."""

    def __init__(self) -> None:
        self._typesys, self._zstandard = needed('rosbags.typesys', 'zstandard', purpose=PURPOSE)
        self._store = self._typesys.get_typestore(self._typesys.Stores.ROS2_JAZZY)

    def decode(self, record: Record) -> Any:
        data, kind = record.data, record.kind
        if data[: len(ZSTD_MAGIC)] == ZSTD_MAGIC:
            data = self._zstandard.decompress(data)
        if kind not in self._store.fielddefs:
            self._store.register(self._typesys.get_types_from_msg(record.definition, kind))
        return self._store.deserialize_cdr(data, kind)
