"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from .admissible import admissible_angles, slip_margin
from .contact import ContactCoefficients, ContactForces, ForceRemainder, contact_coefficients
from .design import DesignParameter, JointDesign, design_parameters
from .equations import residual
from .equilibrium import Equilibrium, Regime, TensionGradient
from .errors import BendAngleError, DesignError, TensionError, UnreachableError
from .inverse import Tensions, tensions_for
from .solver import solve
from .tracker import StickSlipTracker, TrackedState

__all__ = [
    'BendAngleError',
    'ContactCoefficients',
    'ContactForces',
    'DesignError',
    'DesignParameter',
    'Equilibrium',
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
    'contact_coefficients',
    'design_parameters',
    'residual',
    'slip_margin',
    'solve',
    'tensions_for',
]
