"""Places of an SQLite file that hold zeros in place of what was written.

A disk that loses power may leave a file at its full length with zeros where the last data should
be. SQLite has no checksums and takes them for content: of a message that was half written the
rest comes out as zeros, and these as tensions.
"""

from __future__ import annotations

import mmap
import shutil
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path

PAGE_OF_ROWS = 0x0D
"""First byte of a page that holds rows of a table"""

PAGE_HEADER = 8
"""Bytes before the list of places at which the rows of such a page begin"""

OTHERWISE = b'\x01'
"""What zeros could have been as well: it makes neither a page nor the length of a row"""

Places = Sequence[tuple[int, int]]
"""Begin and end of each, in bytes"""


def unwritten_places(path: Path, page_size: int, pages: int) -> list[tuple[int, int]]:
    """Find the zeros of a file that cannot have been written by SQLite.

    These are pages of nothing but zeros, and zeros at which a row begins, since no row has a
    length of 0; with all zeros around them. Where zeros begin and end within one row, which may be
    its content as well, they are none.
    """
    places: set[tuple[int, int]] = set()
    blank = bytes(page_size)
    with path.open('rb') as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        before = b''
        for start in range(0, min(len(content), pages * page_size), page_size):
            page = content[start : start + page_size]
            if page == blank:
                places.add((start - len(before) + len(before.rstrip(b'\0')), start + page_size))
            elif page[0] == PAGE_OF_ROWS:
                places.update((start + begin, start + end) for begin, end in _within(page))
            before = page
    return sorted(places)


def _within(page: bytes) -> Iterator[tuple[int, int]]:
    """Give the zeros in a page of rows that stand where rows begin."""
    count = min(int.from_bytes(page[3:5], 'big'), (len(page) - PAGE_HEADER) // 2)
    listed = PAGE_HEADER + 2 * count
    for place in struct.unpack_from(f'>{count}H', page, PAGE_HEADER):
        if listed <= place < len(page) and not page[place]:
            begin = max(listed, len(page[:place].rstrip(b'\0')))
            yield begin, len(page) - len(page[place:].lstrip(b'\0'))


def copy_with_others(path: Path, copy: Path, places: Places) -> None:
    """Copy a file, with something else in place of its zeros at some places."""
    shutil.copyfile(path, copy)
    with copy.open('r+b') as file:
        for begin, end in places:
            file.seek(begin)
            file.write(OTHERWISE * (end - begin))
