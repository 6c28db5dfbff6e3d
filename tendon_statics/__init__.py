"""Bend angle and joint pressure of a tendon-driven unit from its cable tensions.

All public names are here; each is loaded when it is first asked for, and with it what it needs:
the standard library alone for the physics of one pair, NumPy for many, SciPy for calibrations.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .files.arm_file import load_arm
    from .files.design_file import (
        default_design_path,
        load_design,
        load_design_uncertainty,
        save_design,
    )
    from .physics import (
        UPRIGHT,
        Arm,
        ArmError,
        ArmFilter,
        ArmFilterState,
        ArmState,
        ArmTipForce,
        ArmTracker,
        ArmUnit,
        BendAngleError,
        Cable,
        Calibration,
        CalibrationError,
        ContactForces,
        DesignError,
        DesignMisfitError,
        DesignUncertainty,
        Equilibrium,
        EquilibriumBatch,
        FilterState,
        ForceRemainder,
        JointDesign,
        JointSlip,
        LawComparison,
        Load,
        LoadError,
        Regime,
        SlipAngleDistribution,
        StickSlipFilter,
        StickSlipTracker,
        TendonStaticsError,
        TensionError,
        TensionGradient,
        Tensions,
        TipForce,
        TipPose,
        UnreachableError,
        admissible_angles,
        arm_margins,
        arm_slip_order,
        arm_tensions_for,
        arm_tip_force,
        calibrate,
        compare_laws,
        design_fields,
        design_parameters,
        residual,
        slip_angle_distribution,
        slip_margin,
        solve,
        solve_batch,
        tensions_for,
        tip_force,
        tip_force_intervals,
        tip_force_of_state,
    )
    from .recordings.arm_recording import ArmRecording
    from .recordings.errors import RecordingError
    from .recordings.motion import mark_motion
    from .recordings.reading.load import load_arm_recording, load_recording
    from .recordings.reading.table_options import TableOptions
    from .recordings.reading.topics import BagTopics
    from .recordings.recording import Recording

__all__ = [
    'UPRIGHT',
    'Arm',
    'ArmError',
    'ArmFilter',
    'ArmFilterState',
    'ArmRecording',
    'ArmState',
    'ArmTipForce',
    'ArmTracker',
    'ArmUnit',
    'BagTopics',
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
    'Recording',
    'RecordingError',
    'Regime',
    'SlipAngleDistribution',
    'StickSlipFilter',
    'StickSlipTracker',
    'TableOptions',
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
    'default_design_path',
    'design_fields',
    'design_parameters',
    'load_arm',
    'load_arm_recording',
    'load_design',
    'load_design_uncertainty',
    'load_recording',
    'mark_motion',
    'residual',
    'save_design',
    'slip_angle_distribution',
    'slip_margin',
    'solve',
    'solve_batch',
    'tensions_for',
    'tip_force',
    'tip_force_intervals',
    'tip_force_of_state',
]

_NOT_OF_PHYSICS = {
    'ArmRecording': '.recordings.arm_recording',
    'BagTopics': '.recordings.reading.topics',
    'TableOptions': '.recordings.reading.table_options',
    'Recording': '.recordings.recording',
    'RecordingError': '.recordings.errors',
    'default_design_path': '.files.design_file',
    'load_arm': '.files.arm_file',
    'load_arm_recording': '.recordings.reading.load',
    'load_design': '.files.design_file',
    'load_design_uncertainty': '.files.design_file',
    'load_recording': '.recordings.reading.load',
    'mark_motion': '.recordings.motion',
    'save_design': '.files.design_file',
}
"""Public name → the module that has it; all others are of physics"""


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    value = getattr(import_module(_NOT_OF_PHYSICS.get(name, '.physics'), __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
