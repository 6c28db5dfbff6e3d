"""As much of `rosbag2_py` of ROS 2 Jazzy as is used, over the pure library.

The real one is in apt alone. What stands here is after its sources, version 0.26: the bindings
(`_reader.cpp`, `_storage.cpp`), `sequential_reader.cpp` and `mcap_storage.cpp`. The messages are
decoded by ROS's own serialization, which is the real one.
"""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Any, NamedTuple

from mcap.reader import NonSeekingReader, make_reader
from mcap.records import Chunk, Message
from mcap.stream_reader import StreamReader, breakup_chunk


class StorageOptions(NamedTuple):
    """What is to be opened."""

    uri: str
    storage_id: str = ''


class ConverterOptions(NamedTuple):
    """In which serialization."""

    input_serialization_format: str = ''
    output_serialization_format: str = ''


class ReadOrderSortBy(enum.Enum):
    """By what messages are sorted."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


class ReadOrder(NamedTuple):
    """In which order messages come."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


class TopicMetadata(NamedTuple):
    """A topic of a bag."""

    id: int
    name: str
    type: str
    serialization_format: str
    type_description_hash: str


class MessageDefinition(NamedTuple):
    """What a bag says of the fields of a type."""

    topic_type: str
    encoding: str
    encoded_message_definition: str
    type_hash: str = ''


class BagMetadata(NamedTuple):
    """What the summary of a bag says."""

    message_count: int


class SequentialReader:
    """Reads a bag from its beginning to its end."""

    def open(self, storage: StorageOptions, converter: ConverterOptions) -> None:
        """Open a file."""
        assert converter == ('', '')  # Then messages come as they were recorded.
        if storage.storage_id != 'mcap':
            raise RuntimeError('No storage could be initialized from the inputs.')
        try:
            with Path(storage.uri).open('rb') as file:
                self._summary = make_reader(file).get_summary()
        except Exception:
            raise RuntimeError('No storage could be initialized from the inputs.') from None
        if self._summary is None:  # It would scan the file.
            with Path(storage.uri).open('rb') as file:
                self._summary = NonSeekingReader(file).get_summary()
        if self._summary.statistics is None:
            raise RuntimeError('bad optional access')
        for channel in self._summary.channels.values():
            if channel.schema_id not in self._summary.schemas:
                raise RuntimeError(f'Could not find schema for topic {channel.topic}')
        if len({of.message_encoding for of in self._summary.channels.values()}) > 1:
            raise RuntimeError(
                'Topics with different rmw serialization format have been found. '
                'All topics must have the same serialization format.'
            )
        self._uri = storage.uri
        self.set_read_order(ReadOrder())

    def set_read_order(self, order: ReadOrder) -> bool:
        """Choose the order; that by time finds no message without an index."""
        assert not order.reverse
        by_time = order.sort_by is ReadOrderSortBy.ReceivedTimestamp
        if by_time and not any(of.message_index_length for of in self._summary.chunk_indexes):
            return False
        self._messages = list(self._in_file())
        if by_time:
            self._messages.sort(key=lambda of: of.log_time)
        self._next = 0
        return True

    def _in_file(self) -> Any:
        """Give messages as they stand; what cannot be read is passed over, but for a log."""
        with Path(self._uri).open('rb') as file:
            for record in StreamReader(file, emit_chunks=True).records:
                try:
                    parts = breakup_chunk(record, True) if isinstance(record, Chunk) else [record]
                except Exception:
                    continue
                yield from (of for of in parts if isinstance(of, Message))

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """All topics, with or without messages."""
        return [
            TopicMetadata(
                channel.id,
                channel.topic,
                self._summary.schemas[channel.schema_id].name,
                channel.message_encoding,
                channel.metadata.get('topic_type_hash', ''),
            )
            for channel in self._summary.channels.values()
        ]

    def get_all_message_definitions(self) -> list[MessageDefinition]:
        """Definitions of all types."""
        return [
            MessageDefinition(of.name, of.encoding, of.data.decode())
            for of in self._summary.schemas.values()
        ]

    def get_metadata(self) -> BagMetadata:
        """What the summary says."""
        return BagMetadata(self._summary.statistics.message_count)

    def has_next(self) -> bool:
        """Whether there are more messages."""
        return self._next < len(self._messages)

    def read_next(self) -> tuple[str, bytes, int]:
        """Topic, content and time of recording of the next message."""
        message = self._messages[self._next]
        self._next += 1
        return (
            self._summary.channels[message.channel_id].topic,
            bytes(message.data),
            message.log_time,
        )
