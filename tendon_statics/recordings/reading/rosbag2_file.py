"""Messages in MCAP files through rosbag2_py, which a rig's ROS has without any pip."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..errors import RecordingError, one_line
from ..libraries import needed
from .bag_record import PURPOSE, UNKNOWN_TYPE, Record
from .mcap_file import MAGIC, mcap_records

ROSBAG2 = 'rosbag2_py'


def is_there() -> bool:
    """Whether ROS's own library for bags is installed."""
    return is_installed(ROSBAG2)


@cache
def is_installed(library: str) -> bool:
    """Whether a library can be found."""
    return find_spec(library) is not None


def rosbag2_records(path: Path, types: dict[str, str], damage: list[str]) -> Iterator[Record]:
    """Read the messages of an MCAP file, as `mcap_records` does.

    rosbag2 says of a file that was cut nothing, or refuses it. Such a file is read by the pure
    libraries, down to whatever can be read of it, if they are installed.

    Raises
    ------
    RecordingError
        If it is no MCAP file.
    """
    if not _has_end(path):
        yield from _by_pure_libraries(path, types, damage, 'its end is missing')
        return
    library = import_module(ROSBAG2)
    reader = library.SequentialReader()
    try:
        reader.open(
            library.StorageOptions(uri=str(path), storage_id='mcap'),
            library.ConverterOptions('', ''),
        )
        topics = reader.get_all_topics_and_types()
    except Exception as error:  # whatever its plugins raise
        yield from _by_pure_libraries(
            path, types, damage, f'rosbag2 refuses it: {one_line(error)}'
        )
        return
    others = [of.type for of in topics if _is_of_another_version(of)]
    if others:
        why = f'it has {", ".join(others)} in another version than is installed'
        yield from _by_pure_libraries(path, types, damage, why)
        return
    known = {of.name: of.type or UNKNOWN_TYPE for of in topics}
    types.update(known)
    while True:
        try:
            if not reader.has_next():
                return
            topic, data, log_time, *_ = reader.read_next()
        except Exception as error:
            damage.append(f'it is truncated or damaged ({one_line(error)})')
            return
        yield Record(topic, known.get(topic, UNKNOWN_TYPE), '', log_time, data)


def _has_end(path: Path) -> bool:
    with path.open('rb') as file:
        file.seek(-min(len(MAGIC), path.stat().st_size), os.SEEK_END)
        return file.read() == MAGIC


def _by_pure_libraries(
    path: Path, types: dict[str, str], damage: list[str], why: str
) -> Iterator[Record]:
    if not is_installed('mcap'):
        raise RecordingError(f'{why}; what of it can be read, is with `pip install mcap rosbags`')
    yield from mcap_records(path, types, damage)


def _is_of_another_version(topic: Any) -> bool:
    """Whether the type of a topic had other fields when it was recorded than where it is read.

    The bag has a hash of them, and so has a file beside each type that is installed.
    """
    recorded = getattr(topic, 'type_description_hash', '')
    package, _, name = topic.type.partition('/msg/')
    try:
        (packages,) = needed('ament_index_python.packages', purpose=PURPOSE)
        share = Path(packages.get_package_share_directory(package))
        entries = json.loads((share / 'msg' / f'{name}.json').read_text(encoding='utf-8'))
        installed = {of['type_name']: of['hash_string'] for of in entries['type_hashes']}
    except (LookupError, OSError, ValueError, TypeError, RecordingError):
        return False  # Not installed; then the pure libraries decode it.
    return bool(recorded) and installed.get(topic.type, recorded) != recorded


class RosDecoder:
    """Decodes messages by the types that are installed, with ROS's own serialization."""

    def __init__(self) -> None:
        self._serialization: Any = import_module('rclpy.serialization')
        self._types: dict[str, Any] = {}

    def decode(self, kind: str, data: Any) -> Any:
        """Decode a message.

        Raises
        ------
        LookupError
            If its type is not installed.
        """
        if kind not in self._types:
            self._types[kind] = _message_type(kind)
        return self._serialization.deserialize_message(bytes(data), self._types[kind])


def _message_type(kind: str) -> Any:
    package, _, name = kind.partition('/msg/')
    try:
        return getattr(import_module(f'{package}.msg'), name)
    except (ImportError, AttributeError, ValueError) as error:
        raise LookupError(f'{kind} is not installed') from error
