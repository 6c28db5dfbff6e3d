"""Messages in SQLite files, down to whatever of a damaged one can be read."""

from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from ..errors import RecordingError
from .bag_folder import JOURNAL, WAL
from .bag_record import UNKNOWN_TYPE, Record
from .unwritten import copy_with_others, unwritten_places

JOURNAL_MAGIC = b'\xd9\xd5\x05\xf9\x20\xa1\x63\xd7'
"""What a journal begins with that is still to be undone"""

WAL_HEADER, WAL_PAGE_HEADER = 32, 24
"""Bytes at the beginning of a log, and before each page in it"""

PAGE_SIZE = slice(16, 18)
"""Where a file says how large its pages are; 1 stands for `LARGEST_PAGE`"""

SMALLEST_PAGE, LARGEST_PAGE = 512, 65536
"""Bytes"""

_ROWS = 'SELECT rowid, topic_id, timestamp, data FROM messages'


def sqlite_records(path: Path, types: dict[str, str], damage: list[str]) -> Iterator[Record]:
    """Read the messages of an SQLite file row by row, up to where it is damaged.

    Parameters
    ----------
    types : dict
        Gets every topic of the bag, with its type.
    damage : list
        Gets what cannot be read.

    Raises
    ------
    RecordingError
        If it is no SQLite file, or has no tables of a bag.
    """
    path.open('rb').close()  # for the system's own reason, if it cannot be
    with _opened(path) as (database, file):
        try:
            damage.extend(_unfinished(database, path))
            # So that a file that is shorter than its header says is read all the same.
            database.execute('PRAGMA writable_schema = ON')
            topics = _topics(database)
            rows = database.execute(_ROWS)
        except (sqlite3.Error, MemoryError) as error:
            raise RecordingError(f'it cannot be read as a bag: {error}') from None
        types.update((of.topic, of.kind) for of in topics.values())
        unknown = unwritten = 0
        with _otherwise(database, file) as other:
            try:
                for row in rows:
                    _, key, log_time, data = row
                    blank = topics.get(key)
                    if other is not None and not _is_in(other, row):
                        unwritten += 1
                    elif blank is not None:
                        yield blank._replace(log_time=log_time, data=data)
                    else:
                        unknown += 1
            except (sqlite3.Error, MemoryError) as error:
                damage.append(f'it is truncated or damaged ({error})')
        if unwritten:
            damage.append(
                f'{unwritten} messages are lost where it holds zeros in place of what was recorded'
            )
        if unknown:
            damage.append(f'{unknown} messages are of topics that it does not define')
        if not damage:
            damage.extend(_contradictions(database))


@contextmanager
def _opened(path: Path) -> Iterator[tuple[sqlite3.Connection, Path]]:
    """Open a file, or a copy of it, without changing it or leaving anything beside it."""
    with _readable(path) as file:
        # A copy may be written to, by what is in the journals.
        mode = '?mode=ro&immutable=1' if file is path else ''
        with _connected(f'{file.absolute().as_uri()}{mode}') as database:
            yield database, file


@contextmanager
def _connected(uri: str) -> Iterator[sqlite3.Connection]:
    try:
        database = sqlite3.connect(uri, uri=True)
    except sqlite3.Error as error:
        raise RecordingError(f'it cannot be read as a bag: {error}') from None
    # Damaged text need not be UTF-8, and what should be a blob may have become a text.
    database.text_factory = bytes
    with closing(database):
        yield database


@contextmanager
def _readable(path: Path) -> Iterator[Path]:
    """Give the path of a file, or of a copy that is not as it is.

    Into a copy SQLite may write the journals. And a copy can do without a page at the end that is
    torn: SQLite would read what is missing of it as zeros, which would come out as tensions.
    """
    endings = [ending for ending in (WAL, JOURNAL) if _content(path, ending)]
    torn = _torn_bytes(path)
    if not endings and not torn:
        yield path
        return
    with tempfile.TemporaryDirectory(prefix='tendon-statics-') as folder:
        copy = Path(folder, path.name)
        for ending in ('', *endings):
            shutil.copyfile(f'{path}{ending}', f'{copy}{ending}')
        os.truncate(copy, copy.stat().st_size - torn)
        yield copy


def _torn_bytes(path: Path) -> int:
    """Bytes of a file after its last whole page."""
    with path.open('rb') as file:
        page_size = int.from_bytes(file.read(PAGE_SIZE.stop)[PAGE_SIZE], 'big')
    if page_size == 1:
        page_size = LARGEST_PAGE
    if page_size & (page_size - 1) or not SMALLEST_PAGE <= page_size <= LARGEST_PAGE:
        return 0  # SQLite will say what it is.
    return path.stat().st_size % page_size


@contextmanager
def _otherwise(database: sqlite3.Connection, file: Path) -> Iterator[sqlite3.Connection | None]:
    """Open the file with something else in place of zeros that nobody has written.

    A message that is another one there was not recorded as it stands. None: there are no such
    zeros.
    """
    (page_size,), (pages,) = (
        database.execute(f'PRAGMA {name}').fetchone() for name in ('page_size', 'page_count')
    )
    places = unwritten_places(file, page_size, pages)
    if not places:
        yield None
        return
    with tempfile.TemporaryDirectory(prefix='tendon-statics-') as folder:
        copy = Path(folder, file.name)
        copy_with_others(file, copy, places)
        with _connected(f'{copy.as_uri()}?mode=ro&immutable=1') as other:
            other.execute('PRAGMA writable_schema = ON')
            yield other


def _is_in(database: sqlite3.Connection, row: tuple[Any, ...]) -> bool:
    """Whether a database holds a message as it is in another."""
    try:
        found = database.execute(f'{_ROWS} WHERE rowid = ?', row[:1]).fetchone()
    except (sqlite3.Error, MemoryError):
        return False
    return bool(found == row)


def _unfinished(database: sqlite3.Connection, path: Path) -> Iterator[str]:
    """Say what of the journals SQLite leaves out: all from the first damaged page of a log on."""
    if _content(path, JOURNAL).startswith(JOURNAL_MAGIC):
        yield f'what was written last is left out: as its {JOURNAL} says, it was not finished'
    log = _content(path, WAL)
    if not log:
        return
    page_size, salt = int.from_bytes(log[8:12], 'big'), log[16:24]
    pages = range(WAL_HEADER, len(log), WAL_PAGE_HEADER + page_size)
    written = sum(log[start + 8 : start + 16] == salt for start in pages)
    _, taken, _ = database.execute('PRAGMA wal_checkpoint').fetchone()
    lost = max(written, 1) - max(taken, 0)
    if lost > 0:
        yield f'{lost} pages of its {WAL} are damaged or were not committed'


def _content(path: Path, ending: str) -> bytes:
    journal = Path(f'{path}{ending}')
    return journal.read_bytes() if journal.is_file() else b''


def _topics(database: sqlite3.Connection) -> dict[Any, Record]:
    """Return the records of each topic, by its key, without time and content."""
    definitions = _definitions(database)
    columns = {name for _, name, *_ in database.execute('PRAGMA table_info(topics)')}
    hash_column = 'type_description_hash' if b'type_description_hash' in columns else "''"
    topics: dict[Any, Record] = {}
    for key, *texts in database.execute(f'SELECT id, name, type, {hash_column} FROM topics'):
        name, kind, type_hash = map(_text, texts)
        if name:
            blank = Record(name, kind or UNKNOWN_TYPE, definitions.get(kind, ''), 0, b'')
            topics[key] = blank._replace(type_hash=type_hash)
    return topics


def _definitions(database: sqlite3.Connection) -> dict[str, str]:
    """Definitions of the message types; bags before ROS 2 Iron hold none."""
    tables = {name for (name,) in database.execute('SELECT name FROM sqlite_master')}
    if b'message_definitions' not in tables:
        return {}
    rows = database.execute(
        'SELECT topic_type, encoded_message_definition FROM message_definitions'
    )
    return {_text(kind): _text(definition) for kind, definition in rows}


def _contradictions(database: sqlite3.Connection) -> Iterator[str]:
    """Say whether the pages of the file contradict each other, so that rows may be missing."""
    try:
        ((found,),) = database.execute('PRAGMA integrity_check(1)').fetchall()
    except (sqlite3.Error, ValueError) as error:
        found = str(error).encode()
    if found != b'ok':
        yield f'it is damaged, messages may be missing ({_text(found)})'


def _text(value: Any) -> str:
    return value.decode(errors='replace') if isinstance(value, bytes) else ''
