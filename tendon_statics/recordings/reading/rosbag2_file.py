"""Messages in MCAP files through rosbag2_py, which a rig's ROS has without any pip."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import RecordingError, one_line
from ..libraries import needed
from .bag_record import PURPOSE, UNKNOWN_TYPE, Record, type_name
from .mcap_file import MAGIC, mcap_records

ROSBAG2 = 'rosbag2_py'


def is_there() -> bool:
    """Whether ROS's own library for bags can be used; one made for another Python cannot."""
    try:
        import_module(ROSBAG2)
        import_module('rclpy.serialization')
    except ImportError:
        return False
    return True


def rosbag2_records(path: Path, types: dict[str, str], damage: list[str]) -> Iterator[Record]:
    """Read the messages of an MCAP file, as `mcap_records` does.

    rosbag2 says of a file that was cut nothing, or refuses it. Such a file is read by the pure
    libraries, down to whatever can be read of it, if they are installed.

    Raises
    ------
    RecordingError
        If it is no MCAP file.
    """
    try:
        bag = _opened(path)
    except RecordingError as error:
        yield from _by_pure_libraries(path, types, damage, str(error))
        return
    types.update((name, record.kind) for name, record in bag.blanks.items())
    missing = bag.messages
    while True:
        try:
            if not bag.reader.has_next():
                break
            topic, data, log_time, *_ = bag.reader.read_next()
        except Exception as error:
            damage.append(f'it is truncated or damaged ({one_line(error)})')
            return
        missing -= 1
        blank = bag.blanks.get(topic) or Record(topic, UNKNOWN_TYPE, '', 0, b'')
        yield blank._replace(log_time=log_time, data=data)
    if missing > 0:
        # rosbag2 goes on after a part that it cannot read, and says so on stderr alone.
        damage.append(f'{missing} messages are missing that its summary counts')


class _Opened(NamedTuple):
    reader: Any
    messages: int
    """As many as its summary says"""
    blanks: dict[str, Record]
    """Topic → a record of it without time and content"""


def _opened(path: Path) -> _Opened:
    """Open a file.

    Raises
    ------
    RecordingError
        If rosbag2 would not read all of it.
    """
    if not _has_end(path):
        raise RecordingError('its end is missing')
    library = import_module(ROSBAG2)
    reader = library.SequentialReader()
    try:
        reader.open(
            library.StorageOptions(uri=str(path), storage_id='mcap'),
            library.ConverterOptions('', ''),
        )
        # By time, which is the default, it finds only what the file has an index of.
        reader.set_read_order(library.ReadOrder(library.ReadOrderSortBy.File, False))
        topics = reader.get_all_topics_and_types()
        count = reader.get_metadata().message_count
    except Exception as error:  # whatever its plugins raise
        raise RecordingError(f'rosbag2 refuses it: {one_line(error)}') from error
    if count and not topics:
        raise RecordingError('its summary has no topics')
    definitions = _definitions(reader)
    blanks: dict[str, Record] = {}
    for of in topics:
        kind = type_name(of.type) or UNKNOWN_TYPE
        blank = Record(of.name, kind, definitions.get(of.type, ''), 0, b'')
        blank = blank._replace(
            encoding=of.serialization_format, type_hash=of.type_description_hash
        )
        if blanks.setdefault(of.name, blank) != blank:
            raise RecordingError(f'{of.name} has several types')
    return _Opened(reader, count, blanks)


def _definitions(reader: Any) -> dict[str, str]:
    """Return the definitions of types, which only those need that are not installed."""
    try:
        return {
            of.topic_type: of.encoded_message_definition
            for of in reader.get_all_message_definitions()
        }
    except UnicodeDecodeError:  # of a comment in one of them
        return {}


def _has_end(path: Path) -> bool:
    with path.open('rb') as file:
        file.seek(-min(len(MAGIC), path.stat().st_size), os.SEEK_END)
        return file.read() == MAGIC


def _by_pure_libraries(
    path: Path, types: dict[str, str], damage: list[str], why: str
) -> Iterator[Record]:
    try:
        import_module('mcap')
    except ImportError:
        text = f'{why}; what of it can be read, is with `pip install mcap rosbags`'
        raise RecordingError(text) from None
    yield from mcap_records(path, types, damage)


class RosDecoder:
    """Decodes messages by the types that are installed, with ROS's own serialization."""

    def __init__(self) -> None:
        self._serialization: Any = import_module('rclpy.serialization')
        self._types: dict[tuple[str, str], Any] = {}

    def decode(self, record: Record, data: Any) -> Any:
        """Decode a message.

        Raises
        ------
        LookupError
            If its type is not installed, or had other fields when it was recorded.
        """
        key = record.kind, record.type_hash
        if key not in self._types:
            self._types[key] = _message_type(*key)
        if self._types[key] is None:
            raise LookupError(f'{record.kind} is not installed as it was recorded')
        return self._serialization.deserialize_message(bytes(data), self._types[key])


def _message_type(kind: str, recorded: str) -> Any:
    """Return the class of a type; None if it is not there, or has another hash."""
    package, _, name = kind.partition('/msg/')
    try:
        found = getattr(import_module(f'{package}.msg'), name)
    except (ImportError, AttributeError, ValueError):
        return None
    return found if recorded in ('', _installed_hash(package, name) or recorded) else None


def _installed_hash(package: str, name: str) -> str:
    """Return the hash of the fields of a type, from the file beside it; empty if unknown."""
    try:
        (packages,) = needed('ament_index_python.packages', purpose=PURPOSE)
        share = Path(packages.get_package_share_directory(package))
        entries = json.loads((share / 'msg' / f'{name}.json').read_text(encoding='utf-8'))
        hashes = {of['type_name']: of['hash_string'] for of in entries['type_hashes']}
    except (LookupError, OSError, ValueError, TypeError, RecordingError):
        return ''
    return str(hashes.get(f'{package}/msg/{name}', ''))
