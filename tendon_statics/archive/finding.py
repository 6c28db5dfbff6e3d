"""Every recording below some folders, once."""

from __future__ import annotations

import os
import stat
from collections.abc import Collection, Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from ..recordings.errors import RecordingError
from ..recordings.reading.bag_folder import is_bag_file, is_bag_folder
from ..recordings.reading.load import ENDINGS, is_recording_file
from .dataset import is_dataset, short_enough


class Found(NamedTuple):
    """A recording that is there to be read."""

    name: str
    """Its path from the folder that was named on, that folder included, with slashes"""
    path: Path
    """Absolute"""


def find_recordings(folders: Sequence[Path], exclude: Collection[str] = ()) -> list[Found]:
    """Find all recordings below folders, in the order of their names.

    A bag's folder is one recording, and so is each file that lies elsewhere. What is hidden and
    what lies in a data set of an archive is passed over. A folder that cannot be entered, and a
    link to nothing that may have led to recordings, are given as if they were recordings, so that
    they are named with all that cannot be read.

    Parameters
    ----------
    folders : sequence of Path
        Folders, or recordings themselves.
    exclude : collection of str
        Patterns as of a shell, of names, or of paths below a folder.

    Raises
    ------
    RecordingError
        If there is no such folder, or no recording in any of them.
    """
    roots = []
    for folder in folders:
        root = Path(os.path.abspath(folder))  # noqa: PTH100  resolve() would follow links
        if not root.exists():
            raise RecordingError(f'{folder}: there is no such folder')
        roots.append(root)
    walks = {root: [*_walk(root, set())] for root in roots}
    # A recording that was named itself is called after the folder that it lies in.
    bases = {root: root.parent if walk == [root] else root for root, walk in walks.items()}
    labels = _labels([*dict.fromkeys(bases.values())])
    found: dict[str, Found] = {}
    for root, walk in walks.items():
        base = bases[root]
        for path in walk:
            below = path.relative_to(base).as_posix()
            if not any(fnmatch(below, one) or fnmatch(path.name, one) for one in exclude):
                name = f'{labels[base]}/{below}'.rstrip('/.')
                found.setdefault(os.path.realpath(path), Found(short_enough(name), path))
    if not found:
        named = ', '.join(map(str, folders))
        raise RecordingError(f'there is no recording below {named}; they end in {_endings()}')
    return sorted(found.values())


def _walk(path: Path, entered: set[Path]) -> Iterator[Path]:
    """Give the paths of recordings at and below a path; links are followed, not in a circle."""
    try:
        mode = path.stat().st_mode
    except OSError:
        if is_recording_file(path) or _may_be_folder(path):
            yield path
        return
    if not stat.S_ISDIR(mode):
        if stat.S_ISREG(mode) and is_recording_file(path):  # and no pipe, which never ends
            yield path
        return
    real = path.resolve()
    if real in entered:
        return
    entered.add(real)
    try:
        if is_dataset(path):
            return
        # Links last: what is there itself is called by its own path.
        there = sorted(
            (entry for entry in path.iterdir() if not entry.name.startswith('.')),
            key=lambda entry: (entry.is_symlink(), entry.name),
        )
    except OSError:
        yield path
        return
    of_bag = is_bag_folder(path, [entry.name for entry in there])
    if of_bag:
        yield path
    for entry in there:
        if not (of_bag and is_bag_file(entry)):
            yield from _walk(entry, entered)


def _may_be_folder(path: Path) -> bool:
    """Whether what cannot be looked at may be a folder: it does not end as other files do."""
    return not path.suffix[1:2].isalpha()


def _labels(bases: Sequence[Path]) -> dict[Path, str]:
    """Return the name of each folder, with as many of those around it as tell them apart."""
    length = 1
    while True:
        labels = ['/'.join(base.parts[-length:]) for base in bases]
        if len(set(labels)) == len(labels):
            return dict(zip(bases, labels, strict=True))
        length += 1


def _endings() -> str:
    return f'{", ".join(ENDINGS)}, or are folders of bags'
