"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions."""

from typing import TYPE_CHECKING, Any

from . import physics
from .files.design_file import default_design_path, load_design, save_design
from .physics import (
    CalibrationError,
    DesignError,
    Equilibrium,
    JointDesign,
    Regime,
    TensionError,
    solve,
)
from .recordings.errors import RecordingError

if TYPE_CHECKING:
    from .physics import Calibration, EquilibriumBatch, calibrate, solve_batch
    from .recordings.motion import mark_motion
    from .recordings.reading.load import load_recording
    from .recordings.reading.table_options import TableOptions
    from .recordings.reading.topics import BagTopics
    from .recordings.recording import Recording

__all__ = [
    'BagTopics',
    'Calibration',
    'CalibrationError',
    'DesignError',
    'Equilibrium',
    'EquilibriumBatch',
    'JointDesign',
    'Recording',
    'RecordingError',
    'Regime',
    'TableOptions',
    'TensionError',
    'calibrate',
    'default_design_path',
    'load_design',
    'load_recording',
    'mark_motion',
    'save_design',
    'solve',
    'solve_batch',
]


def __getattr__(name: str) -> Any:
    if name in ('Calibration', 'EquilibriumBatch', 'calibrate', 'solve_batch'):
        return getattr(physics, name)
    if name == 'load_recording':
        from .recordings.reading.load import load_recording

        return load_recording
    if name == 'BagTopics':
        from .recordings.reading.topics import BagTopics

        return BagTopics
    if name == 'TableOptions':
        from .recordings.reading.table_options import TableOptions

        return TableOptions
    if name == 'mark_motion':
        from .recordings.motion import mark_motion

        return mark_motion
    if name == 'Recording':
        from .recordings.recording import Recording

        return Recording
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
