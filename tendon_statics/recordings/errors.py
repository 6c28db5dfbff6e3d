"""What can be wrong with a recording."""

from __future__ import annotations


class RecordingError(ValueError):
    """A file that holds no recording, or not the one asked for."""
