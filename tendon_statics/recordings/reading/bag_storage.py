"""The messages of a bag, down to whatever of a damaged one can be read."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import RecordingError
from ..libraries import needed
from ..progress import Progress, unseen
from .bag_folder import BAG_ENDINGS, METADATA, BagFolder, bag_folder
from .bag_record import CDR, PURPOSE, ROS1, Record, check_cdr
from .compression import decompressed, decompressed_message
from .mcap_file import mcap_records
from .ros1_file import ros1_records
from .rosbag2_file import RosDecoder, is_there, rosbag2_records
from .sqlite_file import sqlite_records
from .topics import full_name

END_OF_TIME = 2**62
"""ns, in the year 2116; differences of times before it fit into 64 bits"""

Reader = Callable[[Path, dict[str, str], list[str]], Iterator[Record]]
_READERS: dict[str, Reader] = dict(
    zip(BAG_ENDINGS, (mcap_records, sqlite_records, ros1_records), strict=True)
)


class Message(NamedTuple):
    """A message of a bag."""

    order: int
    """Its place among those that were read"""
    log_time: int
    """When it was recorded, in ns"""
    kind: str
    content: Any
    digest: int
    """Of the content as it was recorded"""

    @property
    def stamp(self) -> int:
        """When it was measured, by its header, in ns; 0 if that does not say."""
        header = getattr(self.content, 'header', None)
        return 0 if header is None else header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


class Messages:
    """The messages of some topics of a bag; every name of a topic begins with a slash."""

    def __init__(self) -> None:
        self.types: dict[str, str] = {}
        """Every topic of the bag → its type, of several that which it came with first"""
        self.messages: dict[str, list[Message]] = defaultdict(list)
        """In the order of the bag"""
        self.damage: list[str] = []
        self.notes: list[str] = []
        """What else the user should know of it"""


def read_messages(path: Path, topics: Collection[str], progress: Progress = unseen) -> Messages:
    """Read the messages of some topics from a bag's file or folder.

    Raises
    ------
    RecordingError
        If nothing of it can be read.
    """
    messages = Messages()
    folder = bag_folder(path) if path.is_dir() else BagFolder([path])
    reading = _Reading(topics, messages, progress)
    for file in folder.files:
        try:
            damage = reading.read(file)
        except (RecordingError, OSError) as error:
            if len(folder.files) == 1:
                raise
            damage = [str(error)]
        prefix = f'{file.name}: ' if path.is_dir() else ''
        messages.damage += [f'{prefix}{place}' for place in damage]
    messages.damage += [*folder.damage, *_missing(folder.counts, reading.counts)]
    messages.notes += folder.notes
    return messages


def without_copies(bag: Messages, topic: str, messages: Sequence[Message]) -> list[Message]:
    """Leave out what was recorded more than once: the same content at the same stamp, or time.

    Without stamps that may be by chance, unless it is so of all of them.
    """
    seen: set[tuple[int, int]] = set()
    kept: list[Message] = []
    stamped = False
    for message in messages:
        key = (message.stamp or message.log_time, message.digest)
        if key not in seen:
            kept.append(message)
        seen.add(key)
        stamped = stamped or message.stamp != 0
    copies = len(messages) - len(kept)
    if not copies or not (stamped or copies >= len(kept)):
        return list(messages)
    bag.notes.append(
        f'{topic} was recorded more than once: {copies} copies of messages are left out'
    )
    return kept


def _missing(expected: dict[str, int], counts: Counter[str]) -> Iterator[str]:
    """Compare the number of messages in the manifest with those that were found."""
    for topic, count in expected.items():
        there = counts[topic] if topic else sum(counts.values())
        if there != count:
            on = f' on {topic}' if topic else ''
            yield f'{METADATA} counts {count} messages{on}, and {there} can be read'


class _Reading:
    """Adds the messages of one file after the other to those there are."""

    def __init__(self, topics: Collection[str], messages: Messages, progress: Progress) -> None:
        self._topics = topics
        self._messages = messages
        self._progress = progress
        self._order = 0
        self.counts: Counter[str] = Counter()
        """Topic as the bag writes it → messages"""

    def read(self, path: Path) -> list[str]:
        """Read a file; return what of it cannot be read."""
        damage: list[str] = []
        with decompressed(path, damage) as file:
            unreadable = self._read_bare(file, damage)
        damage += [
            f'{count} messages on {topic} cannot be read' for topic, count in unreadable.items()
        ]
        return damage

    def _read_bare(self, path: Path, damage: list[str]) -> Counter[str]:
        decoder = _Decoder()
        types: dict[str, str] = {}
        unreadable: Counter[str] = Counter()
        read = _READERS.get(path.suffix, sqlite_records)
        if read is mcap_records and is_there():
            read = rosbag2_records
        records = read(path, types, damage)
        for record in self._progress(records, 'reading'):
            self.counts[record.topic] += 1
            topic = full_name(record.topic)
            if topic not in self._topics:
                continue
            try:
                log_time, data = _time(record), decompressed_message(record.data)
                content = decoder.decode(record, data)
                digest = hash(bytes(data))
            except RecordingError:
                raise
            except Exception:
                # A damaged message fails in as many ways as there are types.
                unreadable[topic] += 1
                continue
            message = Message(self._order, log_time, record.kind, content, digest)
            self._order += 1
            self._messages.messages[topic].append(message)
        for name, kind in types.items():
            self._messages.types.setdefault(full_name(name), kind)
        return unreadable


def _time(record: Record) -> int:
    if isinstance(record.log_time, int) and 0 <= record.log_time < END_OF_TIME:
        return record.log_time
    raise ValueError('no time')


class _Decoder:
    """Decodes messages: with ROS's own types where `rosbag2_py` is, or with the pure library."""

    def __init__(self) -> None:
        self._ros = RosDecoder() if is_there() else None
        self._pure: _PureDecoder | None = None

    def decode(self, record: Record, data: Any) -> Any:
        if record.encoding == CDR:
            check_cdr(record.kind, data)
        if self._ros is not None and record.encoding == CDR:
            with suppress(LookupError):  # of a type that is not installed so
                return self._ros.decode(record, data)
        self._pure = self._pure or _PureDecoder()
        return self._pure.decode(record, data)


class _PureDecoder:
    """Decodes messages by the definitions of ROS 2 Jazzy, or those that the bag holds."""

    def __init__(self) -> None:
        self._typesys = _typesys()
        self._own: dict[bool, Any] = {}
        """Whether it is ROS 1 → the types of this bag"""

    def decode(self, record: Record, data: Any) -> Any:
        store = self._store(record)
        if record.encoding not in (ROS1, CDR):
            raise ValueError(f'encoded as {record.encoding}')
        if record.encoding == ROS1:
            return store.deserialize_ros1(data, record.kind)
        return store.deserialize_cdr(data, record.kind)

    def _store(self, record: Record) -> Any:
        """Return types among which that of a record is."""
        is_ros1 = record.encoding == ROS1
        if not is_ros1 and record.kind in (shared := _types_of_ros2()).fielddefs:
            return shared
        if is_ros1 not in self._own:
            stores = self._typesys.Stores
            kind = stores.EMPTY if is_ros1 else stores.ROS2_JAZZY
            self._own[is_ros1] = self._typesys.get_typestore(kind)
        store = self._own[is_ros1]
        if record.kind not in store.fielddefs:
            types = self._types(record)
            store.register({n: fields for n, fields in types.items() if n not in store.fielddefs})
        return store

    def _types(self, record: Record) -> Any:
        try:
            return self._typesys.get_types_from_msg(record.definition, record.kind)
        except self._typesys.TypesysError:
            return self._typesys.get_types_from_idl(record.definition)


def _typesys() -> Any:
    (typesys,) = needed('rosbags.typesys', purpose=PURPOSE)
    return typesys


@cache
def _types_of_ros2() -> Any:
    """Return the types of ROS 2 Jazzy: for all bags, since each is compiled when it is used."""
    typesys = _typesys()
    return typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
