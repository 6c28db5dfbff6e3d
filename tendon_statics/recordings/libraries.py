"""Libraries that only some formats need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .errors import RecordingError


def needed(*modules: str, purpose: str) -> tuple[Any, ...]:
    """Import modules.

    Raises
    ------
    RecordingError
        If one is not installed, or does not fit what is; the text says what to install.
    """
    try:
        return tuple(import_module(module) for module in modules)
    except ImportError as error:
        if not isinstance(error, ModuleNotFoundError):
            reason = ' '.join(str(error).split())
            raise RecordingError(
                f'{purpose} need {modules[0]}, which cannot be loaded: {reason}'
            ) from None
        library = (error.name or modules[0]).split('.')[0]
        raise RecordingError(
            f'{purpose} need {library}: pip install {library}, '
            "or all of pip install 'tendon_statics[recordings]'"
        ) from None
