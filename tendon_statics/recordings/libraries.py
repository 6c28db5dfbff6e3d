"""Libraries that only some formats need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .errors import RecordingError, one_line


def needed(*modules: str, purpose: str) -> tuple[Any, ...]:
    """Import modules.

    Raises
    ------
    RecordingError
        If one is not installed, or does not fit the rest; the text says what to install.
    """
    try:
        return tuple(import_module(module) for module in modules)
    except ImportError as error:
        if not isinstance(error, ModuleNotFoundError):
            raise RecordingError(
                f'{purpose} need {modules[0]}, which cannot be loaded: {one_line(error)}'
            ) from None
        library = (error.name or modules[0]).split('.')[0]
        raise RecordingError(
            f'{purpose} need {library}: pip install {library}, or all of them in the folder of '
            "tendon_statics: pip install '.[archive,recordings,matlab]'"
        ) from None
