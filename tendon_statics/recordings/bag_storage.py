"""The files of a ROS 2 bag, MCAP or SQLite, down to whatever of a damaged one can be read."""

from __future__ import annotations

import sqlite3
from collections import defaultdict
from collections.abc import Collection, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

from .errors import RecordingError
from .libraries import needed
from .progress import Progress, unseen

PURPOSE = 'ROS bags'

ZSTD_MAGIC = b'\x28\xb5\x2f\xfd'
"""What a message begins with that was compressed by itself; CDR never does"""


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
        _read_file(path, topics, messages, progress)
        return messages
    files = sorted([*path.glob('*.mcap'), *path.glob('*.db3')])
    if not files:
        raise RecordingError(
            'it is a folder without .mcap or .db3 files, so no bag; '
            'files ending in .zstd are to be unpacked first, zstd -d'
        )
    for file in files:
        try:
            _read_file(file, topics, messages, progress)
        except RecordingError as error:
            if len(files) == 1:
                raise
            messages.damage.append(f'{file.name}: {error}')
    return messages


def _read_file(
    path: Path, topics: Collection[str], messages: Messages, progress: Progress
) -> None:
    types = _Types()
    is_mcap = path.suffix == '.mcap'
    records = (_mcap_records if is_mcap else _sqlite_records)(path, messages)
    unreadable: dict[str, int] = defaultdict(int)
    for topic, kind, definition, log_time, data in progress(records, 'reading'):
        if topic not in topics:
            continue
        try:
            messages.messages[topic].append((log_time, types.decode(kind, definition, data)))
        except Exception:
            # A damaged message fails in as many ways as there are types.
            unreadable[topic] += 1
    for topic, count in unreadable.items():
        messages.damage.append(f'{count} messages on {topic} cannot be decoded')


class _Types:
    """Decodes messages by the definitions of ROS 2 Jazzy, or those that the bag holds."""

    def __init__(self) -> None:
        self._typesys, self._zstandard = needed('rosbags.typesys', 'zstandard', purpose=PURPOSE)
        self._store = self._typesys.get_typestore(self._typesys.Stores.ROS2_JAZZY)

    def decode(self, kind: str, definition: str, data: bytes) -> Any:
        if data[: len(ZSTD_MAGIC)] == ZSTD_MAGIC:
            data = self._zstandard.decompress(data)
        if kind not in self._store.fielddefs:
            self._store.register(self._typesys.get_types_from_msg(definition, kind))
        return self._store.deserialize_cdr(data, kind)


_Record = tuple[str, str, str, int, bytes]
"""Topic, type, its definition, time of recording in ns, content"""


def _mcap_records(path: Path, messages: Messages) -> Iterator[_Record]:
    """Read an MCAP file from front to back, without the index that a truncated one lacks.

    A chunk that is damaged is passed over.
    """
    stream_reader, record = needed('mcap.stream_reader', 'mcap.records', purpose=PURPOSE)
    schemas: dict[int, Any] = {}
    channels: dict[int, Any] = {}

    def read(entry: Any) -> Iterator[_Record]:
        if isinstance(entry, record.Schema):
            schemas[entry.id] = entry
        elif isinstance(entry, record.Channel):
            channels[entry.id] = entry
            messages.types[entry.topic] = schemas[entry.schema_id].name
        elif isinstance(entry, record.Message):
            channel = channels[entry.channel_id]
            schema = schemas[channel.schema_id]
            definition = schema.data.decode(errors='replace')
            yield channel.topic, schema.name, definition, entry.log_time, entry.data

    with path.open('rb') as file:
        if not file.read(8) == b'\x89MCAP0\r\n':
            raise RecordingError('it is not an MCAP file')
        file.seek(0)
        # Whatever the content is, the library is not to ask for more memory than the file has.
        limit = path.stat().st_size
        entries = stream_reader.StreamReader(
            file, emit_chunks=True, record_size_limit=limit
        ).records
        while True:
            start = file.tell()
            try:
                entry = next(entries)
            except StopIteration:
                return
            except Exception:
                # The library raises what its unpacking happens to: it ends within a record.
                messages.damage.append(f'it is truncated or damaged from byte {start} on')
                return
            try:
                parts = [entry]
                if isinstance(entry, record.Chunk):
                    parts = stream_reader.breakup_chunk(entry, validate_crc=True)
                for part in parts:
                    yield from read(part)
            except Exception as error:
                reason = ' '.join(str(error).split()) or type(error).__name__
                messages.damage.append(f'a part at byte {start} cannot be read ({reason})')


def _sqlite_records(path: Path, messages: Messages) -> Iterator[_Record]:
    """Read an SQLite file row by row, up to where it is damaged."""
    # Read-only, without looking for a journal.
    uri = f'{path.absolute().as_uri()}?mode=ro&immutable=1'
    path.open('rb').close()  # for the system's own reason, if it cannot be
    database = sqlite3.connect(uri, uri=True)
    with closing(database):
        try:
            # So that a file that is shorter than its header says is read all the same.
            database.execute('PRAGMA writable_schema = ON')
            names = {
                key: (name, kind)
                for key, name, kind in database.execute('SELECT id, name, type FROM topics')
            }
            tables = {name for (name,) in database.execute('SELECT name FROM sqlite_master')}
            definitions: dict[str, str] = {}
            if 'message_definitions' in tables:
                definitions |= database.execute(
                    'SELECT topic_type, encoded_message_definition FROM message_definitions'
                )
            rows = database.execute('SELECT topic_id, timestamp, data FROM messages')
        except sqlite3.Error as error:
            raise RecordingError(f'it cannot be read as a bag: {error}') from None
        messages.types.update(names.values())
        try:
            for key, log_time, data in rows:
                topic, kind = names[key]
                yield topic, kind, definitions.get(kind, ''), log_time, data
        except (sqlite3.Error, KeyError) as error:
            messages.damage.append(f'it is truncated or damaged ({error})')
