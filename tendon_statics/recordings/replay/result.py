"""What a replay says of a recording."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...physics import Load, Regime
from ..reading.units import OF_UNIT
from ..recording import Recording
from ..session import OF_LOAD, Floats

VALID = 'valid'


class Replay(NamedTuple):
    """What the model says of each sample; arrays of shape ``(n,)``, NaN where not determined."""

    recording: Recording
    load: Load
    """What acts beside the cables, as far as it was not recorded"""
    estimation: str
    regime: NDArray[np.str_]
    bend_angle: Floats
    """rad"""
    bend_angle_stddev: Floats
    pressure: Floats
    """Pa"""
    pressure_stddev: Floats
    slip_margin: Floats
    angle_assured: NDArray[np.bool_]
    """False where there is no angle, and after what cannot vouch for a unit that is remembered,
    such as a slack cable, until a stop"""
    validity: NDArray[np.str_]
    """``valid``, or why a sample is not, in the node's words (`Reason`)"""
    confidence: float
    """Probability with which an interval holds the angle"""
    measured_stddev: float
    """Standard deviation of a measured angle in rad, as the settings have it"""
    interval: tuple[Floats, Floats] | None = None
    """Ends in rad of the interval that holds the angle; None unless filtered"""
    regime_probabilities: Mapping[Regime, Floats] | None = None
    """Probability of each regime, likewise"""
    noise_risks: int = 0
    """Samples at which noise alone could have slipped a tracked unit (`Remark.NOISE`)"""

    @property
    def error(self) -> Floats | None:
        """Estimated less measured angle in rad, where both are there and the angle is assured."""
        if self.recording.bend_angle is None:
            return None
        error: Floats = np.where(
            self.angle_assured, self.bend_angle - self.recording.bend_angle, math.nan
        )
        return error

    def columns(self) -> dict[str, Floats | NDArray[np.str_] | NDArray[np.bool_]]:
        """Table with the recorded columns and the estimated ones, by name; SI units."""
        recorded = self.recording
        columns = {
            name: values
            for name, values in (
                ('time', recorded.time),
                ('tension_l', recorded.tension_l),
                ('tension_s', recorded.tension_s),
                *zip(OF_UNIT.readings, recorded.readings or (None, None), strict=True),
                ('bend_angle', recorded.bend_angle),
                ('pressure', recorded.pressure),
                *((name, getattr(recorded, name)) for name in OF_LOAD),
                ('state', None if recorded.state is None else np.array(recorded.state)),
            )
            if values is not None
        }
        columns |= {
            'regime': self.regime,
            'estimated_bend_angle': self.bend_angle,
            'estimated_bend_angle_stddev': self.bend_angle_stddev,
        }
        if self.interval is not None:
            low, high = self.interval
            columns |= {'estimated_bend_angle_low': low, 'estimated_bend_angle_high': high}
        for regime, shares in (self.regime_probabilities or {}).items():
            columns[f'probability_{regime.value}'] = shares
        return columns | {
            'estimated_pressure': self.pressure,
            'estimated_pressure_stddev': self.pressure_stddev,
            'slip_margin': self.slip_margin,
            'angle_assured': self.angle_assured,
            'validity': self.validity,
        }
