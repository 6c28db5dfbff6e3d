"""As much of `rosbag2_py` of ROS 2 Jazzy as is used, over the pure library.

The real one is in apt alone. What this shows is that its interface, as documented, gives what the
pure libraries give; the messages are decoded by ROS's own serialization, which is the real one.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from mcap.reader import make_reader


class StorageOptions(NamedTuple):
    """What is to be opened."""

    uri: str
    storage_id: str


class ConverterOptions(NamedTuple):
    """In which serialization."""

    input_serialization_format: str
    output_serialization_format: str


class TopicMetadata(NamedTuple):
    """A topic of a bag."""

    name: str
    type: str
    type_description_hash: str = ''


class SequentialReader:
    """Reads a bag from its beginning to its end; takes no file that is not sound."""

    hashes: dict[str, str] = {}  # noqa: RUF012
    """Type → hash that bags are to have of it"""

    def open(self, storage: StorageOptions, _converter: ConverterOptions) -> None:
        """Open a file."""
        if storage.storage_id != 'mcap':
            raise RuntimeError(f'No storage could be initialized for {storage.storage_id}')
        try:
            with Path(storage.uri).open('rb') as file:
                reader = make_reader(file, validate_crcs=True)
                summary = reader.get_summary()
                self._messages = list(reader.iter_messages())
        except Exception as error:
            raise RuntimeError(f'No storage could be initialized:\n{error}') from None
        self._topics = {
            channel.topic: summary.schemas[channel.schema_id].name
            for channel in summary.channels.values()
        }
        self._next = 0

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """All topics, with or without messages."""
        return [
            TopicMetadata(name, kind, self.hashes.get(kind, ''))
            for name, kind in self._topics.items()
        ]

    def has_next(self) -> bool:
        """Whether there are more messages."""
        return self._next < len(self._messages)

    def read_next(self) -> tuple[str, bytes, int]:
        """Topic, content and time of recording of the next message."""
        _, channel, message = self._messages[self._next]
        self._next += 1
        return channel.topic, message.data, message.log_time
