"""The folder of a bag: which files belong to it, by its ``metadata.yaml``."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Collection, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from ...files.yaml_file import YamlFileError, read_yaml
from ..errors import RecordingError
from .compression import ENDINGS as COMPRESSIONS

METADATA = 'metadata.yaml'
STORAGES = ('.mcap', '.db3')
BAG_ENDINGS = (*STORAGES, '.bag')
"""Of a bag that is one file; the last is of ROS 1"""

WAL = '-wal'
"""Ending of the log in which SQLite keeps what has not yet come to the file itself"""

JOURNAL = '-journal'
"""Ending of the file in which SQLite keeps what a change that is not finished has overwritten"""


@dataclasses.dataclass
class BagFolder:
    """What belongs to a bag."""

    files: list[Path]
    """In the order of recording"""
    counts: dict[str, int] = dataclasses.field(default_factory=dict)
    """Topic → messages, as the manifest says; empty if it does not"""
    notes: list[str] = dataclasses.field(default_factory=list)
    damage: list[str] = dataclasses.field(default_factory=list)


def is_bag_file(path: Path) -> bool:
    """Whether a file is one of a bag by its ending, compressed or not."""
    return _without_compression(path).suffix in BAG_ENDINGS


def is_bag_folder(folder: Path, names: Collection[str]) -> bool:
    """Whether a folder with files of these names is one bag, and not some that lie together.

    That is what its manifest says; without one it is a bag if all that are bags by their ending
    are called after it and numbered, as a recorder that was killed leaves them.
    """
    files = [name for name in names if is_bag_file(Path(name))]
    if METADATA in names:
        return bool(files) or _is_manifest(folder / METADATA)
    numbered = re.compile(rf'{re.escape(folder.name)}_\d+\.[\w.]+')
    return bool(files) and all(map(numbered.fullmatch, files))


def files_of_bag(path: Path) -> list[Path]:
    """All files that may tell what is in a bag: of its folder, or one and what is read with it."""
    if not path.is_dir():
        return [path, *_journals(path)]
    return [
        file
        for file in sorted(path.iterdir())
        if file.is_file() and (is_bag_file(file) or file.name == METADATA or _is_journal(file))
    ]


def _journals(path: Path) -> list[Path]:
    """What a killed recorder leaves beside a ``.db3``."""
    beside = (path.with_name(f'{path.name}{ending}') for ending in (JOURNAL, WAL))
    return [file for file in beside if _is_journal(file) and file.is_file()]


def _is_journal(path: Path) -> bool:
    return path.name.endswith((f'.db3{JOURNAL}', f'.db3{WAL}'))


def _is_manifest(path: Path) -> bool:
    try:
        _information(read_yaml(path))
    except (YamlFileError, KeyError, TypeError):
        return False
    return True


def bag_folder(folder: Path) -> BagFolder:
    """Find the files of a bag: those of its manifest, or all if there is none.

    Raises
    ------
    RecordingError
        If there are none.
    """
    named = sorted((path for path in folder.iterdir() if is_bag_file(path)), key=_natural)
    there = [path for path in named if path.is_file()]
    manifest = folder / METADATA
    bag = BagFolder(there)
    if manifest.is_file():
        bag = _by_manifest(folder, manifest, there)
    else:
        if len(there) > 1:
            bag.notes.append(f'there is no {METADATA}: its files are taken by the numbers in them')
        bag.damage += [f'{path.name} is a link to nothing' for path in named if _is_broken(path)]
    if not bag.files and there:
        raise RecordingError(
            f'{bag.damage[0]}, and so is all else that it lists; to read one of '
            f'{", ".join(path.name for path in there)} all the same, name the file itself'
        )
    if not bag.files:
        why = f'; {bag.damage[0]}' if bag.damage else ''
        raise RecordingError(
            f'it is a folder without {" or ".join(STORAGES)} files, so no bag; compressed ones '
            f'end in {", ".join(COMPRESSIONS)} after that{why}'
        )
    return bag


def _is_broken(path: Path) -> bool:
    return path.is_symlink() and not path.exists()


def _by_manifest(folder: Path, manifest: Path, there: list[Path]) -> BagFolder:
    try:
        content = _information(read_yaml(manifest))
        names = [str(name) for name in content['relative_file_paths']]
        counts = _counts(content)
    except (YamlFileError, KeyError, TypeError, AttributeError) as error:
        why = str(error) if isinstance(error, YamlFileError) else 'it is not that of a bag'
        text = f'{METADATA}: {why}; the files are taken by the numbers in them'
        return BagFolder(there, damage=[text])
    if not names:  # as left by a recorder that was killed
        text = f'{METADATA} lists no files; they are taken by the numbers in them'
        return BagFolder(there, damage=[text])
    bag = BagFolder([], counts)
    for name in names:
        found = _found(folder, name)
        if found is None:
            bag.damage.append(f'{PurePosixPath(name).name} is missing, which {METADATA} lists')
        else:
            bag.files.append(found)
    strangers = [path.name for path in there if path not in bag.files]
    if strangers:
        bag.notes.append(f'left out, as {METADATA} does not list it: {", ".join(strangers)}')
    return bag


def _information(content: Any) -> Mapping[str, Any]:
    information: Mapping[str, Any] = content['rosbag2_bagfile_information']
    return information


def _counts(content: Mapping[str, Any]) -> dict[str, int]:
    """Messages by topic; the key '' stands for all where no topic is counted."""
    topics = {
        str(entry['topic_metadata']['name']): int(entry['message_count'])
        for entry in content.get('topics_with_message_count') or ()
    }
    if topics:
        return topics
    total = int(content.get('message_count') or 0)
    return {'': total} if total else {}


def _found(folder: Path, name: str) -> Path | None:
    """Return a file of the folder that the manifest lists, packed or unpacked since.

    Early versions wrote the folder's own name before that of the file. A file elsewhere is not
    part of the bag.
    """
    listed = folder / PurePosixPath(name).name
    bare = _without_compression(listed)
    for candidate in (listed, bare, *(Path(f'{bare}{ending}') for ending in COMPRESSIONS)):
        if candidate.is_file():
            return candidate
    return None


def _without_compression(path: Path) -> Path:
    return path.with_suffix('') if path.suffix in COMPRESSIONS else path


def _natural(path: Path) -> list[tuple[int, str]]:
    """Key by which ``run_2`` comes before ``run_10``."""
    parts = re.split(r'(\d+)', path.name)
    return [(int(part), '') if part.isdigit() else (-1, part) for part in parts]
