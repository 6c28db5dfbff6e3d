"""What is shown of a message ``ArmEstimate``, joint by joint, in words and in drawings alike."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from ..physics import Arm, Regime
from .estimate_values import interval_about, interval_told, regime_named

OF_A_JOINT = ('angle', 'angle_low', 'angle_high', 'pressure', 'slip_margin')
"""What is drawn over time of each joint: angles in degrees, the pressure in Pa"""

OF_THE_TIP = tuple(f'tip_{axis}{end}' for axis in 'xz' for end in ('', '_low', '_high'))
"""What is drawn over time of the tip, in mm"""


class JointSaid(NamedTuple):
    """What an estimate says of one joint; NaN and None where it is not determined."""

    name: str
    regime: str
    probability: float
    """Of the regime"""
    angle: float
    """In rad"""
    interval: tuple[float, float] | None
    """In rad"""
    is_assured: bool
    slip_margin: float
    pressure: float
    """In Pa"""
    bands: tuple[tuple[float, float], ...] | None
    """In rad, where friction can hold it; None where that is not said"""


class TipSaid(NamedTuple):
    """What an estimate says of one coordinate of the tip, in m or rad."""

    value: float
    interval: tuple[float, float] | None


def joints_said(estimate: Any, admissible: Any = None) -> list[JointSaid]:
    """Return what is said of each joint, from the base on.

    Whoever publishes the message: what it leaves out is not determined.

    Parameters
    ----------
    admissible
        The message ``AdmissibleAngles`` that goes with the estimate, None if there is none.
    """
    found = []
    for place, name in enumerate(estimate.joint_names):

        def of(values: Sequence[float], place: int = place) -> float:
            return values[place] if place < len(values) else math.nan

        regime = estimate.regimes[place] if place < len(estimate.regimes) else ''
        probabilities = getattr(estimate, f'probabilities_{regime}') if is_of_arms(regime) else ()
        angle = of(estimate.bend_angles)
        ends = of(estimate.bend_angle_lows), of(estimate.bend_angle_highs)
        found.append(
            JointSaid(
                name,
                regime,
                of(probabilities),
                angle,
                interval_about(angle, of(estimate.bend_angle_stddevs), ends),
                of(estimate.angles_assured) == 1.0,
                of(estimate.slip_margins),
                of(estimate.pressures),
                None if regime == Regime.SLACK.value else _bands(admissible, name),
            )
        )
    return found


def _bands(admissible: Any, name: str) -> tuple[tuple[float, float], ...] | None:
    names = [] if admissible is None else list(admissible.joint_names)
    if name not in names:
        return None
    number = 1 + names.index(name)
    found = zip(admissible.joints, admissible.lows, admissible.highs, strict=False)
    return tuple(
        (low, high)
        for joint, low, high in found
        if joint == number and math.isfinite(low) and math.isfinite(high)
    )


def is_of_arms(regime: str) -> bool:
    """Whether it is a regime that a joint of an arm can have."""
    return regime_named(regime) not in (None, Regime.EQUILIBRIUM)


def tip_said(estimate: Any) -> dict[str, TipSaid]:
    """Return ``x``, ``z`` and ``tilt`` of the tip, in m and rad."""
    found = {}
    for axis in ('x', 'z', 'tilt'):
        value = getattr(estimate, f'tip_{axis}')
        stddev = getattr(estimate, f'tip_{axis}_stddev')
        ends = getattr(estimate, f'tip_{axis}_low'), getattr(estimate, f'tip_{axis}_high')
        found[axis] = TipSaid(value, interval_told(value, stddev, ends))
    return found


def arm_names(estimate: Any) -> tuple[str, ...]:
    """Names of the columns of an arm's history, those of joints with the joint's number from 0."""
    count = len(estimate.joint_names)
    return (*(f'{name}_{place}' for place in range(count) for name in OF_A_JOINT), *OF_THE_TIP)


def arm_sample(estimate: Any) -> dict[str, float]:
    """Return what is drawn of an estimate, by the names of `arm_names`."""
    sample = {}
    for place, joint in enumerate(joints_said(estimate)):
        ends = joint.interval or (math.nan, math.nan)
        angles = (math.degrees(angle) for angle in (joint.angle, *ends))
        values = (*angles, joint.pressure, joint.slip_margin)
        for name, value in zip(OF_A_JOINT, values, strict=True):
            sample[f'{name}_{place}'] = value
    for axis, tip in tip_said(estimate).items():
        if axis != 'tilt':
            values = (tip.value, *(tip.interval or (math.nan, math.nan)))
            for end, value in zip(('', '_low', '_high'), values, strict=True):
                sample[f'tip_{axis}{end}'] = 1e3 * value
    return sample


def is_of(estimate: Any, arm: Arm) -> bool:
    """Whether an estimate may be of an arm, by its joints and cables."""
    return len(estimate.joint_names) == len(arm.units) and arm.cable_names == tuple(
        estimate.cable_names
    )
