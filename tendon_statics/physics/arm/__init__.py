"""Units in series: an arm, where its joints are and which of them slip."""

from .arm import Arm, ArmUnit, Cable
from .joints import arm_margins
from .shape import TipPose
from .state import ArmState
from .tracker import ArmTracker

__all__ = ['Arm', 'ArmState', 'ArmTracker', 'ArmUnit', 'Cable', 'TipPose', 'arm_margins']
