"""What a replay says of a recording of an arm."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...physics import Load, Regime
from ...physics.arm import Arm, TipPose
from ..arm_recording import ArmRecording
from ..session import OF_LOAD, Floats
from .result import Replay


class ArmReplay(NamedTuple):
    """What the model says of each sample; arrays of shape ``(n,)``, NaN where not determined."""

    recording: ArmRecording
    arm: Arm
    load: Load
    """What acts beside the cables, as far as it was not recorded"""
    estimation: str
    joints: tuple[Replay, ...]
    """Each joint from the base on as a unit of its own, under the sums of the tensions that cross
    it, with its measured angle"""
    validity: NDArray[np.str_]
    """``valid``, or why a sample is not, in the node's words (`Reason`)"""
    tip: tuple[Floats, Floats, Floats]
    """x and z in m, tilt in rad, of the end of the last unit in the base's frame"""
    tip_stddev: tuple[Floats, Floats, Floats]
    tip_interval: tuple[tuple[Floats, Floats], ...] | None = None
    """Ends of the intervals that hold x, z and tilt; None unless filtered"""

    def columns(self) -> dict[str, NDArray[Any]]:
        """Table with the recorded columns and the estimated ones, by name; SI units."""
        recorded = self.recording
        columns: dict[str, NDArray[Any]] = {}
        if recorded.time is not None:
            columns['time'] = recorded.time
        columns |= recorded.cable_tensions
        columns |= {f'reading_{name}': of for name, of in (recorded.readings or {}).items()}
        columns |= {f'bend_angle_{joint}': of for joint, of in recorded.bend_angles.items()}
        for name in OF_LOAD:
            values = getattr(recorded, name)
            if values is not None:
                columns[name] = values
        for place, name in enumerate(TipPose._fields):
            columns[f'tip_{name}'] = self.tip[place]
            columns[f'tip_{name}_stddev'] = self.tip_stddev[place]
            if self.tip_interval is not None:
                low, high = self.tip_interval[place]
                columns |= {f'tip_{name}_low': low, f'tip_{name}_high': high}
        for number, joint in enumerate(self.joints, start=1):
            columns |= {f'{name}_{number}': of for name, of in _estimated(joint).items()}
        return columns | {'validity': self.validity}


def _estimated(joint: Replay) -> dict[str, NDArray[Any]]:
    """What there is of each joint, by name; the number of the joint follows it."""
    columns: dict[str, NDArray[Any]] = {
        'regime': joint.regime,
        'estimated_bend_angle': joint.bend_angle,
        'estimated_bend_angle_stddev': joint.bend_angle_stddev,
    }
    if joint.interval is not None:
        low, high = joint.interval
        columns |= {'estimated_bend_angle_low': low, 'estimated_bend_angle_high': high}
    shares: dict[Regime, Floats] = dict(joint.regime_probabilities or {})
    columns |= {f'probability_{regime.value}': of for regime, of in shares.items()}
    return columns | {
        'estimated_pressure': joint.pressure,
        'slip_margin': joint.slip_margin,
        'angle_assured': joint.angle_assured,
    }
