"""What a report was made from and how, so that it can be made again."""

from __future__ import annotations

import argparse
import hashlib
from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta, timezone
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ..recordings.reading.bag_folder import files_of_bag
from ..recordings.session import Session
from .tables import Facts

INTERNAL = ('command', 'run', 'verb', 'run_arm', 'arm_verb', 'version')
"""Attributes of the options that nobody has typed by themselves"""

CHUNK = 2**20
"""Bytes read at a time"""

EPOCH = datetime(1970, 1, 1, tzinfo=timezone.utc)


def origin_facts(
    options: argparse.Namespace, recording: Session, designs: Sequence[Path]
) -> Facts:
    """Return command, version, date of the recording, checksums and all options.

    Parameters
    ----------
    designs : sequence of Path
        Files that say what was recorded.
    """
    return [
        ('command', options.command),
        ('version', f'tendon_statics {version("tendon_statics")}'),
        ('recorded', recorded_on(recording)),
        *((f'SHA-256 of {file.name}', sha256(file)) for file in files_of(Path(options.data))),
        *((f'SHA-256 of {design.name}', sha256(design)) for design in designs),
        ('options', ', '.join(f'{name} = {_shown(value)}' for name, value in _chosen(options))),
        ('random numbers', 'none are drawn, so there is no seed'),
    ]


def recorded_on(recording: Session) -> str:
    """Return when the first sample was, in UTC; or that the recording does not tell."""
    if not recording.time_origin or recording.time is None or not len(recording):
        return 'not known: the recording has no date'
    # Whole microseconds: a float holds no time since 1970 to the last digit.
    first = recording.time_origin // 1000 + round(1e6 * float(recording.time[0]))
    return f'{EPOCH + timedelta(microseconds=first):%Y-%m-%d %H:%M:%S} UTC'


def files_of(path: Path) -> list[Path]:
    """Return the files of a recording: itself and what is read with it, or all of its folder."""
    if path.is_dir():
        return sorted(part for part in path.rglob('*') if part.is_file())
    return files_of_bag(path)


def sha256(path: Path) -> str:
    """Return the checksum of a file, as `sha256sum` prints it."""
    digest = hashlib.sha256()
    with path.open('rb') as file:
        while chunk := file.read(CHUNK):
            digest.update(chunk)
    return digest.hexdigest()


def _chosen(options: argparse.Namespace) -> Iterator[tuple[str, Any]]:
    """Every option, also those that were left at their default."""
    return ((name, value) for name, value in sorted(vars(options).items()) if name not in INTERNAL)


def _shown(value: Any) -> str:
    return 'not given' if value is None or value == '' else str(value)
