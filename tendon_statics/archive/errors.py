"""What can go wrong with an archive as a whole."""

from __future__ import annotations

from ..physics.errors import TendonStaticsError


class ArchiveError(TendonStaticsError):
    """What keeps an archive from being written at all; what is done is kept."""
