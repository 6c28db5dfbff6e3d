"""Where the files that are installed beside the package are."""

from __future__ import annotations

from pathlib import Path


def installed_config(name: str) -> Path:
    """The installed copy of a file of ``config/``.

    It is looked for upwards from this module: in the install prefix's ``share/``, or in the
    source tree if the package runs from there.

    Raises
    ------
    FileNotFoundError
        If the package was copied without its data files.
    """
    for folder in Path(__file__).resolve().parents:
        candidates = [folder / 'share' / 'tendon_statics' / 'config' / name]
        if (folder / 'package.xml').is_file():
            candidates.append(folder / 'config' / name)
        for candidate in candidates:
            if candidate.is_file():
                return candidate
    raise FileNotFoundError(
        f'{name} is not installed beside the package: install it with colcon or pip, '
        'or name a file'
    )
