"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from typing import TYPE_CHECKING, Any

from .admissible import admissible_angles, slip_margin
from .contact import ContactCoefficients, ContactForces, ForceRemainder, contact_coefficients
from .design import DesignParameter, JointDesign, design_parameters
from .equations import residual
from .equilibrium import Equilibrium, Regime
from .errors import (
    BendAngleError,
    CalibrationError,
    DesignError,
    TensionError,
    UnreachableError,
)
from .inverse import Tensions, tensions_for
from .sensitivity import TensionGradient
from .solver import solve
from .tracker import StickSlipTracker, TrackedState

if TYPE_CHECKING:
    from .batch import EquilibriumBatch, solve_batch
    from .calibration import calibrate
    from .calibration_result import Calibration

__all__ = [
    'BendAngleError',
    'Calibration',
    'CalibrationError',
    'ContactCoefficients',
    'ContactForces',
    'DesignError',
    'DesignParameter',
    'Equilibrium',
    'EquilibriumBatch',
    'ForceRemainder',
    'JointDesign',
    'Regime',
    'StickSlipTracker',
    'TensionError',
    'TensionGradient',
    'Tensions',
    'TrackedState',
    'UnreachableError',
    'admissible_angles',
    'calibrate',
    'contact_coefficients',
    'design_parameters',
    'residual',
    'slip_margin',
    'solve',
    'solve_batch',
    'tensions_for',
]


def __getattr__(name: str) -> Any:
    # NumPy is loaded only by who asks for what needs it.
    if name in ('EquilibriumBatch', 'solve_batch'):
        from . import batch

        return getattr(batch, name)
    if name == 'calibrate':
        from .calibration import calibrate

        return calibrate
    if name == 'Calibration':
        from .calibration_result import Calibration

        return Calibration
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
