"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .admissible import admissible_angles, slip_margin
from .contact import CONTACT_LAWS as CONTACT_LAWS
from .design import JointDesign, design_fields, design_parameters
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
from .forces import ContactForces, ForceRemainder
from .forces import contact_coefficients as contact_coefficients
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
        ArmFilter,
        ArmFilterState,
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
        arm_tip_force_of_state,
    )
    from .batch import EquilibriumBatch, solve_batch
    from .calibration import Calibration, LawComparison, calibrate, compare_laws
    from .filter import FilterState, StickSlipFilter

__all__ = [
    'UPRIGHT',
    'Arm',
    'ArmError',
    'ArmFilter',
    'ArmFilterState',
    'ArmState',
    'ArmTipForce',
    'ArmTracker',
    'ArmUnit',
    'BendAngleError',
    'Cable',
    'Calibration',
    'CalibrationError',
    'ContactForces',
    'DesignError',
    'DesignMisfitError',
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
    'arm_tip_force_of_state',
    'calibrate',
    'compare_laws',
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

_NEEDING_NUMPY = ('.arm', '.batch', '.filter', '.calibration')
"""Modules that are loaded for who asks for a name of theirs, one after the other"""


def __getattr__(name: str) -> Any:
    if name in __all__:
        for place in _NEEDING_NUMPY:
            module = import_module(place, __name__)
            if name in module.__all__:
                globals()[name] = getattr(module, name)
                return globals()[name]
    raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
