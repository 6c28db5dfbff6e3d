"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions.

All public names are here; each is loaded when it is first asked for, and with it what it needs:
the standard library alone for the physics of one pair, NumPy for many, SciPy for calibrations.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .design_file import default_design_path as default_design_path
    from .design_file import load_design as load_design
    from .design_file import save_design as save_design
    from .physics import (
        UPRIGHT as UPRIGHT,
    )
    from .physics import (
        BendAngleError as BendAngleError,
    )
    from .physics import (
        Calibration as Calibration,
    )
    from .physics import (
        CalibrationError as CalibrationError,
    )
    from .physics import (
        ContactForces as ContactForces,
    )
    from .physics import (
        DesignError as DesignError,
    )
    from .physics import (
        Equilibrium as Equilibrium,
    )
    from .physics import (
        EquilibriumBatch as EquilibriumBatch,
    )
    from .physics import (
        ForceRemainder as ForceRemainder,
    )
    from .physics import (
        JointDesign as JointDesign,
    )
    from .physics import (
        Load as Load,
    )
    from .physics import (
        LoadError as LoadError,
    )
    from .physics import (
        Regime as Regime,
    )
    from .physics import (
        StickSlipTracker as StickSlipTracker,
    )
    from .physics import (
        TensionError as TensionError,
    )
    from .physics import (
        TensionGradient as TensionGradient,
    )
    from .physics import (
        Tensions as Tensions,
    )
    from .physics import (
        UnreachableError as UnreachableError,
    )
    from .physics import (
        admissible_angles as admissible_angles,
    )
    from .physics import (
        calibrate as calibrate,
    )
    from .physics import (
        design_fields as design_fields,
    )
    from .physics import (
        design_parameters as design_parameters,
    )
    from .physics import (
        residual as residual,
    )
    from .physics import (
        slip_margin as slip_margin,
    )
    from .physics import (
        solve as solve,
    )
    from .physics import (
        solve_batch as solve_batch,
    )
    from .physics import (
        tensions_for as tensions_for,
    )
    from .recordings.errors import RecordingError as RecordingError
    from .recordings.load import load_recording as load_recording
    from .recordings.motion import mark_motion as mark_motion
    from .recordings.recording import Recording as Recording

_PLACES = {
    '.design_file': ('default_design_path', 'load_design', 'save_design'),
    '.physics': (
        *('UPRIGHT', 'BendAngleError', 'Calibration', 'CalibrationError', 'ContactForces'),
        *('DesignError', 'Equilibrium', 'EquilibriumBatch', 'ForceRemainder', 'JointDesign'),
        *('Load', 'LoadError', 'Regime', 'StickSlipTracker', 'TensionError', 'TensionGradient'),
        *('Tensions', 'UnreachableError', 'admissible_angles', 'calibrate', 'design_fields'),
        *('design_parameters', 'residual', 'slip_margin', 'solve', 'solve_batch', 'tensions_for'),
    ),
    '.recordings.errors': ('RecordingError',),
    '.recordings.load': ('load_recording',),
    '.recordings.motion': ('mark_motion',),
    '.recordings.recording': ('Recording',),
}
"""Module → the public names that it has"""

_MODULES = {name: module for module, names in _PLACES.items() for name in names}

__all__ = [*sorted(_MODULES)]


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    value = getattr(import_module(_MODULES[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
