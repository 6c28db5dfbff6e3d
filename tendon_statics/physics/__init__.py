"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from typing import TYPE_CHECKING, Any

from .admissible import admissible_angles, slip_margin
from .contact import CONTACT_LAWS
from .design import (
    DesignChoice,
    DesignParameter,
    JointDesign,
    design_fields,
    design_parameters,
)
from .errors import (
    BendAngleError,
    CalibrationError,
    DesignError,
    LoadError,
    TensionError,
    UnreachableError,
)
from .forces import ContactCoefficients, ContactForces, ForceRemainder, contact_coefficients
from .gradients import TensionGradient
from .inverse import tensions_for
from .load import UPRIGHT, Load
from .solver import residual, solve
from .state import Equilibrium, Regime
from .tensions import Tensions
from .tracker import StickSlipTracker

if TYPE_CHECKING:
    from .batch import EquilibriumBatch, solve_batch
    from .calibration import calibrate
    from .calibration_result import Calibration
    from .filter import FilterState, StickSlipFilter

__all__ = [
    'CONTACT_LAWS',
    'UPRIGHT',
    'BendAngleError',
    'Calibration',
    'CalibrationError',
    'ContactCoefficients',
    'ContactForces',
    'DesignChoice',
    'DesignError',
    'DesignParameter',
    'Equilibrium',
    'EquilibriumBatch',
    'FilterState',
    'ForceRemainder',
    'JointDesign',
    'Load',
    'LoadError',
    'Regime',
    'StickSlipFilter',
    'StickSlipTracker',
    'TensionError',
    'TensionGradient',
    'Tensions',
    'UnreachableError',
    'admissible_angles',
    'calibrate',
    'contact_coefficients',
    'design_fields',
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
    if name in ('FilterState', 'StickSlipFilter'):
        from . import filter

        return getattr(filter, name)
    if name == 'calibrate':
        from .calibration import calibrate

        return calibrate
    if name == 'Calibration':
        from .calibration_result import Calibration
    from .filter import FilterState, StickSlipFilter

        return Calibration
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
