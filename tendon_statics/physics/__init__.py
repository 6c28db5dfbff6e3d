"""The quasi-static model of a tendon-driven ball-joint unit: no ROS, no files, no printing."""

from .design import DesignParameter, JointDesign, design_parameters
from .equations import ContactCoefficients, contact_coefficients, residual
from .equilibrium import ContactForces, Equilibrium, ForceRemainder, Regime, TensionGradient
from .errors import DesignError, TensionError
from .solver import solve

__all__ = [
    'ContactCoefficients',
    'ContactForces',
    'DesignError',
    'DesignParameter',
    'Equilibrium',
    'ForceRemainder',
    'JointDesign',
    'Regime',
    'TensionError',
    'TensionGradient',
    'contact_coefficients',
    'design_parameters',
    'residual',
    'solve',
]
