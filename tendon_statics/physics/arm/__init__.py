"""Units in series: an arm, where its joints are, which of them slip, what pushes."""

from .arm import Arm, ArmUnit, Cable
from .filter import ArmFilter, ArmFilterState
from .inverse import arm_tensions_for
from .joints import arm_margins
from .order import JointSlip, arm_slip_order
from .shape import TipPose
from .state import ArmState
from .tip_force import ArmTipForce, arm_tip_force
from .tip_force_state import arm_tip_force_of_state
from .tracker import ArmTracker

__all__ = [
    'Arm',
    'ArmFilter',
    'ArmFilterState',
    'ArmState',
    'ArmTipForce',
    'ArmTracker',
    'ArmUnit',
    'Cable',
    'JointSlip',
    'TipPose',
    'arm_margins',
    'arm_slip_order',
    'arm_tensions_for',
    'arm_tip_force',
    'arm_tip_force_of_state',
]
