"""What is shown of a message ``Estimate``, in words and in drawings alike."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from ..estimation.regimes import REGIME_COLOURS
from ..physics import Load, LoadError, Regime
from .history import Sample

COVERAGE = 2.0
"""Standard deviations on either side, where an estimate has no interval of its own"""

OLD = 2.0
"""Seconds after which an estimate counts as one that was"""

GREY = '#777777'
"""Of what has no regime, and of what was"""


def is_present(said: str, age: float) -> bool:
    """Whether an estimate is of now, and not the last that was known.

    Parameters
    ----------
    said
        ``invalid`` or ``stale``, if the estimator said so after it.
    age
        Seconds since it came.
    """
    return not said and age <= OLD


def colour_of(estimate: Any, *, present: bool) -> str:
    """Return the colour that stands for an estimate, that of its regime while it is of now."""
    regime = regime_of(estimate)
    return REGIME_COLOURS[regime] if regime and present else GREY


def sample_of(estimate: Any) -> Sample:
    """Return what is drawn of an estimate; angles in degrees."""
    low, high = map(math.degrees, angle_interval(estimate) or (math.nan, math.nan))
    ends = [math.degrees(end) for end in estimate.admissible_angles]
    spread = COVERAGE * estimate.pressure_stddev
    return Sample(
        angle=math.degrees(estimate.bend_angle),
        angle_low=low,
        angle_high=high,
        admissible=list(pairs_of(ends)),
        pressure=estimate.pressure,
        pressure_low=estimate.pressure - spread,
        pressure_high=estimate.pressure + spread,
        slip_margin=estimate.slip_margin,
        tension_l=estimate.tension_l,
        tension_s=estimate.tension_s,
    )


def pairs_of(ends: Sequence[float]) -> Iterator[tuple[float, float]]:
    """Return the intervals of a list of ends; one that is left over is none."""
    return zip(ends[::2], ends[1::2], strict=False)


def angle_interval(estimate: Any) -> tuple[float, float] | None:
    """Return the ends in rad of where the angle is, within a half turn; None if it is not known.

    That is the interval that the estimator gives, else `COVERAGE` standard deviations. Without an
    angle there is none: an interval is about the angle that is told.
    """
    angle, spread = estimate.bend_angle, COVERAGE * estimate.bend_angle_stddev
    low, high = estimate.bend_angle_low, estimate.bend_angle_high
    if math.isnan(low):
        low, high = angle - spread, angle + spread
    if not all(map(math.isfinite, (angle, low, high))):
        return None
    return max(low, -math.pi), min(high, math.pi)


def load_of(estimate: Any) -> Load | None:
    """Return the load that an estimate was worked out with, None if it tells none."""
    direction = (
        estimate.gravity_direction_x,
        estimate.gravity_direction_y,
        estimate.gravity_direction_z,
    )
    tip_force = (estimate.tip_force_x, estimate.tip_force_z)
    try:
        return Load(direction, tip_force, estimate.tip_distance)
    except LoadError:
        return None


def regime_of(estimate: Any) -> Regime | None:
    """Return the regime of an estimate, None if it is of a kind that is not known here."""
    try:
        return Regime(estimate.regime)
    except ValueError:
        return None


def regime_probabilities(estimate: Any) -> dict[Regime, float] | None:
    """Return the probability of each regime, None where the estimator says none."""
    found = {regime: getattr(estimate, f'probability_{regime.value}') for regime in Regime}
    return None if any(map(math.isnan, found.values())) else found
