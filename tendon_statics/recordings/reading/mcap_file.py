"""Messages in MCAP files, down to whatever of a damaged one can be read."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Generator, Iterable, Iterator
from io import BytesIO
from pathlib import Path
from typing import IO, Any

from ..errors import RecordingError
from ..libraries import needed
from .bag_record import PURPOSE, UNKNOWN_TYPE, Record, type_name
from .compression import decompressed_beginning

MAGIC = b'\x89MCAP0\r\n'
"""What a file begins and ends with"""

RECORD = struct.Struct('<BQ')
"""Kind of a record, never 0, and length of what follows"""

CHUNK = struct.Struct('<QQQII')
"""What a chunk begins with; the last is the length of the name of its compression"""

LENGTH = struct.Struct('<Q')

LONGEST_NAME = 16
"""Bytes of the name of a compression"""

OF_CHUNK, LAST_KIND = 0x06, 0x0F
"""Kinds of records"""

FOOTER = struct.Struct('<BQQQI')
"""Kind and length of the last record, where the summary and its offsets begin, CRC of it all"""

CRC_SIZE = 4


def mcap_records(path: Path, types: dict[str, str], damage: list[str]) -> Iterator[Record]:
    """Read the messages of an MCAP file.

    The summary at its end says what topics there are and where the chunks of messages lie, so
    that a damaged place costs no more than its chunk. A file without a summary, as a truncated
    one, is read from front to back, as far as its records tell where the next begins. Of a chunk
    that was cut the beginning counts, also where a disk that lost power left zeros for the rest.

    Parameters
    ----------
    types : dict
        Gets every topic of the bag, with its type.
    damage : list
        Gets what cannot be read.

    Raises
    ------
    RecordingError
        If it is no MCAP file.
    """
    with path.open('rb') as file:
        yield from _McapFile(file, types, damage).records()


class _McapFile:
    """An open file, and what has been learned of it so far."""

    def __init__(self, file: IO[bytes], types: dict[str, str], damage: list[str]) -> None:
        self._library, self._kinds = needed('mcap.stream_reader', 'mcap.records', purpose=PURPOSE)
        self._file = file
        # Whatever the content, the library must not ask for more memory than the file is long.
        self._size = os.fstat(file.fileno()).st_size
        self._types = types
        self._damage = damage
        self._schemas: dict[int, Any] = {}
        self._channels: dict[int, Any] = {}
        self._messages = 0
        self._unknown = 0

    def records(self) -> Iterator[Record]:
        """Read the messages; see `mcap_records`."""
        begins = self._file.read(len(MAGIC)) == MAGIC
        summary = self._summary()
        if not begins and not summary:
            raise RecordingError('it is not an MCAP file')
        for entry in summary or ():
            self._define(entry)
        chunks = [entry for entry in summary or () if isinstance(entry, self._kinds.ChunkIndex)]
        for start, entry in self._indexed(chunks) if chunks else self._front_to_back():
            yield from self._messages_in(start, entry)
        if self._unknown:
            self._damage.append(f'{self._unknown} messages are of topics that it does not define')
        if self._damage:
            return
        if summary is None:
            self._damage.append('its end, the summary, is truncated or damaged')
        for entry in summary or ():
            if isinstance(entry, self._kinds.Statistics) and entry.message_count > self._messages:
                missing = entry.message_count - self._messages
                self._damage.append(f'{missing} messages are missing that its summary counts')

    def _summary(self) -> list[Any] | None:
        """Return the records of the summary; None if it cannot be read or believed."""
        end = FOOTER.size + len(MAGIC)
        if self._size < end:
            return None
        self._file.seek(-end, os.SEEK_END)
        *_, start, _, crc = FOOTER.unpack(self._file.read(FOOTER.size))
        if start == 0:
            start = self._size - end  # There is none but the footer.
        if not 0 < start <= self._size - end:
            return None
        self._file.seek(start)
        content = self._file.read()
        if crc and zlib.crc32(content[: -len(MAGIC) - CRC_SIZE]) != crc:
            return None
        try:
            return list(self._reader(BytesIO(content)))
        except Exception:
            # The library raises what its unpacking happens to.
            return None

    def _reader(self, stream: IO[bytes]) -> Iterator[Any]:
        """Read the records from where a stream is."""
        records: Iterator[Any] = self._library.StreamReader(
            stream, skip_magic=True, emit_chunks=True, record_size_limit=self._size
        ).records
        return records

    def _indexed(self, chunks: Iterable[Any]) -> Iterator[tuple[int, Any]]:
        """Give each chunk that the summary lists, and where it is."""
        for index in chunks:
            start = index.chunk_start_offset
            try:
                self._file.seek(start)
                content = BytesIO(self._file.read(index.chunk_length))
                chunk = next(self._reader(content))
                if not isinstance(chunk, self._kinds.Chunk):
                    raise TypeError('no chunk')
            except Exception as error:
                self._passed_over(start, error)
                continue
            yield start, chunk

    def _front_to_back(self) -> Iterator[tuple[int, Any]]:
        """Give each record outside the summary, and where it is, up to the first broken one."""
        broken = yield from self._whole_records(self._file, len(MAGIC), self._size)
        if broken is None:
            return
        chunk = self._cut_chunk(broken)
        if chunk is None:
            self._damage.append(f'it is truncated or damaged from byte {broken} on')
        else:
            yield broken, chunk

    def _whole_records(
        self, stream: IO[bytes], start: int, end: int
    ) -> Generator[tuple[int, Any], None, int | None]:
        """Give the records of a stream, and where they begin; return where the first broken is.

        Zeros that follow a record which ends in zeros may have begun within it, so it is broken.
        """
        stream.seek(start)
        entries = self._reader(stream)
        while start < end:
            try:
                stream.seek(start)
                kind, length = RECORD.unpack(stream.read(RECORD.size))
                after = start + RECORD.size + length
                if kind == 0 or after > end:
                    return start
                if kind > LAST_KIND:  # of a later version, or somebody's own
                    start = after
                    continue
                stream.seek(after - 1)
                ending = stream.read(2)
                if not any(ending) and (len(ending) > 1 or kind == OF_CHUNK):
                    return start
                stream.seek(start)
                entry = next(entries)
            except Exception:
                return start
            if isinstance(entry, self._kinds.DataEnd):
                return None
            yield start, entry
            start = after
        return start if stream is self._file else None

    def _cut_chunk(self, start: int) -> Any | None:
        """Return what there is of a chunk that was cut, without its compression."""
        try:
            self._file.seek(start)
            kind, length = RECORD.unpack(self._file.read(RECORD.size))
            begin, last, size, _, named = CHUNK.unpack(self._file.read(CHUNK.size))
            name = self._file.read(min(named, LONGEST_NAME)).decode()
            LENGTH.unpack(self._file.read(LENGTH.size))
        except (struct.error, ValueError):
            return None
        if kind != OF_CHUNK:
            return None
        data = self._file.read(min(length, self._size)).rstrip(b'\0')
        return self._kinds.Chunk(
            compression='',
            data=decompressed_beginning(data, name),
            message_start_time=begin,
            message_end_time=last,
            uncompressed_crc=0,
            uncompressed_size=size,
        )

    def _messages_in(self, start: int, entry: Any) -> Iterator[Record]:
        parts: Iterable[Any] = [entry]
        if isinstance(entry, self._kinds.Chunk):
            try:
                parts = self._parts(start, entry)
            except Exception as error:
                self._passed_over(start, error)
                return
        for part in parts:
            self._define(part)
            if not isinstance(part, self._kinds.Message):
                continue
            self._messages += 1
            channel = self._channels.get(part.channel_id)
            if channel is None:
                self._unknown += 1
                continue
            schema = self._schemas.get(channel.schema_id)
            kind = type_name(schema.name) if schema else UNKNOWN_TYPE
            definition = schema.data.decode(errors='replace') if schema else ''
            yield Record(
                *(channel.topic, kind, definition, part.log_time, part.data),
                channel.message_encoding,
                channel.metadata.get('topic_type_hash', ''),
            )

    def _parts(self, start: int, chunk: Any) -> Iterable[Any]:
        """Give the records of a chunk; of one without a sum to check, up to the first broken."""
        if chunk.uncompressed_crc:
            parts: list[Any] = self._library.breakup_chunk(chunk, validate_crc=True)
            return parts
        data = decompressed_beginning(chunk.data, chunk.compression)
        records = self._whole_records(BytesIO(data), 0, len(data))
        parts = []
        while True:
            try:
                parts.append(next(records)[1])
            except StopIteration as end:
                if end.value is not None or len(data) < chunk.uncompressed_size:
                    there = sum(isinstance(part, self._kinds.Message) for part in parts)
                    self._damage.append(
                        f'a part at byte {start} is cut short or damaged: the first {there} '
                        'messages of it can be read'
                    )
                return parts

    def _define(self, entry: Any) -> None:
        """Take what a record says of topics, unless that is known: the summary comes first."""
        if isinstance(entry, self._kinds.Schema):
            self._schemas.setdefault(entry.id, entry)
        elif isinstance(entry, self._kinds.Channel):
            self._channels.setdefault(entry.id, entry)
            schema = self._schemas.get(entry.schema_id)
            kind = type_name(schema.name) if schema else UNKNOWN_TYPE
            self._types.setdefault(entry.topic, kind)

    def _passed_over(self, start: int, error: Exception) -> None:
        reason = str(error) or type(error).__name__
        self._damage.append(f'a part at byte {start} cannot be read ({reason})')
