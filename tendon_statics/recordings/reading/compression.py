"""Compressed files and messages of bags: zstd and lz4, as rosbag2 writes them."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path
from typing import IO, Any

from ..errors import one_line
from ..libraries import needed
from .bag_record import PURPOSE

ENDINGS = {'.zstd': 'zstd', '.zst': 'zstd', '.lz4': 'lz4'}
"""Ending of a file → how it is compressed"""

ZSTD_MAGIC = b'\x28\xb5\x2f\xfd'
LZ4_MAGIC = b'\x04\x22\x4d\x18'
"""How a message that was compressed on its own begins; CDR never begins so"""

BLOCK = 1 << 16
"""Bytes that are decompressed at once"""

HEADER = 18
"""Bytes of a zstd frame's header at most"""


@contextmanager
def decompressed(path: Path, damage: list[str]) -> Iterator[Path]:
    """Give the path of a file without its compression: its own, or of a temporary copy.

    Of a damaged one the copy holds what came before the damage, which is added to `damage`.
    """
    if path.suffix not in ENDINGS:
        yield path
        return
    with tempfile.TemporaryDirectory(prefix='tendon-statics-') as folder:
        copy = Path(folder, path.stem)
        with path.open('rb') as file, copy.open('wb') as target:
            blocks, size = _content(file, ENDINGS[path.suffix])
            try:
                for block in blocks:
                    target.write(block)
            except Exception as error:  # each library has its own
                if isinstance(error, OSError) and error.errno is not None:
                    raise  # a full disk, say
                damage.append(f'its compression is truncated or damaged ({one_line(error)})')
            else:
                if target.tell() < size:
                    damage.append(f'its compression is truncated: {target.tell()} of {size} bytes')
        yield copy


def decompressed_message(data: Any) -> Any:
    """Return a message's content, decompressed if it was compressed by itself."""
    if not isinstance(data, bytes):
        return data
    if data.startswith(ZSTD_MAGIC):
        (zstandard,) = needed('zstandard', purpose=PURPOSE)
        return zstandard.ZstdDecompressor().decompressobj().decompress(data)
    if data.startswith(LZ4_MAGIC):
        (frame,) = needed('lz4.frame', purpose=PURPOSE)
        return frame.decompress(data)
    return data


def decompressed_beginning(data: bytes, kind: str) -> bytes:
    """Return what is in data that were cut, as far as they go; ``''`` is no compression."""
    if not kind:
        return data
    blocks: list[bytes] = []
    with suppress(Exception):  # each library has its own
        blocks.extend(_content(BytesIO(data), kind)[0])
    return b''.join(blocks)


def _content(file: IO[bytes], kind: str) -> tuple[Iterator[bytes], int]:
    """Return a file's content in blocks, and its size in bytes if that is told, else 0."""
    if kind == 'zstd':
        (zstandard,) = needed('zstandard', purpose=PURPOSE)
        try:
            size = zstandard.frame_content_size(file.read(HEADER))
        except zstandard.ZstdError:
            size = 0
        file.seek(0)
        reader = zstandard.ZstdDecompressor().stream_reader(file, read_across_frames=True)
        return iter(lambda: reader.read(BLOCK), b''), size
    (frame,) = needed('lz4.frame', purpose=PURPOSE)
    return _lz4_blocks(file, frame.LZ4FrameDecompressor), 0


def _lz4_blocks(file: IO[bytes], new_decompressor: Callable[[], Any]) -> Iterator[bytes]:
    """Decompress frame after frame, down to the last block of one that was cut."""
    decompressor = None
    while data := file.read(BLOCK):
        while data:
            decompressor = decompressor or new_decompressor()
            yield decompressor.decompress(data)
            data = b''
            if decompressor.eof:
                data, decompressor = decompressor.unused_data or b'', None
    if decompressor is not None:
        raise EOFError('it ends within a frame')
