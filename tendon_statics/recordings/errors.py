"""What can be wrong with a recording."""

from __future__ import annotations

from ..physics.errors import TendonStaticsError


class RecordingError(TendonStaticsError, ValueError):
    """A file that holds no recording, or not the one asked for."""


def one_line(text: object) -> str:
    """Return a text without line breaks, whatever a file or a library has put into it."""
    return ' '.join(str(text).split())
