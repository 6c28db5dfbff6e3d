"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from importlib import import_module
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
from .design_uncertainty import DesignUncertainty
from .errors import (
    ArmError,
    BendAngleError,
    CalibrationError,
    DesignError,
    DesignMisfitError,
    LoadError,
    TendonStaticsError,
    TensionError,
    UnreachableError,
)
from .forces import ContactCoefficients, ContactForces, ForceRemainder, contact_coefficients
from .gradients import TensionGradient
from .inverse import tensions_for
from .load import UPRIGHT, Load
from .regime import Regime
from .solver import residual, solve
from .state import Equilibrium
from .tensions import Tensions
from .tip_force import TipForce, tip_force, tip_force_intervals
from .tip_force_state import tip_force_of_state
from .tracker import StickSlipTracker
from .uncertainty import SlipAngleDistribution, slip_angle_distribution

if TYPE_CHECKING:
    from .arm import (
        Arm,
        ArmState,
        ArmTipForce,
        ArmTracker,
        ArmUnit,
        Cable,
        JointSlip,
        TipPose,
        arm_margins,
        arm_slip_order,
        arm_tensions_for,
        arm_tip_force,
    )
    from .batch import EquilibriumBatch, solve_batch
    from .calibration import Calibration, LawComparison, calibrate, compare_laws
    from .filter import FilterState, StickSlipFilter

__all__ = [
    'CONTACT_LAWS',
    'UPRIGHT',
    'Arm',
    'ArmError',
    'ArmState',
    'ArmTipForce',
    'ArmTracker',
    'ArmUnit',
    'BendAngleError',
    'Cable',
    'Calibration',
    'CalibrationError',
    'ContactCoefficients',
    'ContactForces',
    'DesignChoice',
    'DesignError',
    'DesignMisfitError',
    'DesignParameter',
    'DesignUncertainty',
    'Equilibrium',
    'EquilibriumBatch',
    'FilterState',
    'ForceRemainder',
    'JointDesign',
    'JointSlip',
    'LawComparison',
    'Load',
    'LoadError',
    'Regime',
    'SlipAngleDistribution',
    'StickSlipFilter',
    'StickSlipTracker',
    'TendonStaticsError',
    'TensionError',
    'TensionGradient',
    'Tensions',
    'TipForce',
    'TipPose',
    'UnreachableError',
    'admissible_angles',
    'arm_margins',
    'arm_slip_order',
    'arm_tensions_for',
    'arm_tip_force',
    'calibrate',
    'compare_laws',
    'contact_coefficients',
    'design_fields',
    'design_parameters',
    'residual',
    'slip_angle_distribution',
    'slip_margin',
    'solve',
    'solve_batch',
    'tensions_for',
    'tip_force',
    'tip_force_intervals',
    'tip_force_of_state',
]


_NEEDING_NUMPY = {
    'Arm': '.arm',
    'ArmState': '.arm',
    'ArmTipForce': '.arm',
    'ArmTracker': '.arm',
    'ArmUnit': '.arm',
    'Cable': '.arm',
    'Calibration': '.calibration',
    'EquilibriumBatch': '.batch',
    'FilterState': '.filter',
    'JointSlip': '.arm',
    'LawComparison': '.calibration',
    'StickSlipFilter': '.filter',
    'TipPose': '.arm',
    'arm_margins': '.arm',
    'arm_slip_order': '.arm',
    'arm_tensions_for': '.arm',
    'arm_tip_force': '.arm',
    'calibrate': '.calibration',
    'compare_laws': '.calibration',
    'solve_batch': '.batch',
}
"""Public name → the module that has it, loaded only by who asks for it"""


def __getattr__(name: str) -> Any:
    if name not in _NEEDING_NUMPY:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    return getattr(import_module(_NEEDING_NUMPY[name], __name__), name)
