"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions.

All public names are here; each is loaded when it is first asked for, and with it what it needs:
the standard library alone for the physics of one pair, NumPy for many, SciPy for calibrations.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import physics

if TYPE_CHECKING:
    from .files.arm_file import load_arm
    from .files.design_file import (
        default_design_path,
        load_design,
        load_design_uncertainty,
        save_design,
    )
    from .physics import *  # noqa: F403
    from .recordings.arm_recording import ArmRecording
    from .recordings.errors import RecordingError
    from .recordings.motion import mark_motion
    from .recordings.reading.load import load_arm_recording, load_recording
    from .recordings.reading.table_options import TableOptions
    from .recordings.reading.topics import BagTopics
    from .recordings.recording import Recording

__all__ = [
    'ArmRecording',
    'BagTopics',
    'Recording',
    'RecordingError',
    'TableOptions',
    'default_design_path',
    'load_arm',
    'load_arm_recording',
    'load_design',
    'load_design_uncertainty',
    'load_recording',
    'mark_motion',
    'save_design',
]
__all__ += physics.__all__

_NOT_OF_PHYSICS = {
    'ArmRecording': '.recordings.arm_recording',
    'BagTopics': '.recordings.reading.topics',
    'TableOptions': '.recordings.reading.table_options',
    'Recording': '.recordings.recording',
    'RecordingError': '.recordings.errors',
    'default_design_path': '.files.design_file',
    'load_arm': '.files.arm_file',
    'load_arm_recording': '.recordings.reading.load',
    'load_design': '.files.design_file',
    'load_design_uncertainty': '.files.design_file',
    'load_recording': '.recordings.reading.load',
    'mark_motion': '.recordings.motion',
    'save_design': '.files.design_file',
}
"""Public name → the module that has it; all others are of physics"""


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    value = getattr(import_module(_NOT_OF_PHYSICS.get(name, '.physics'), __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
