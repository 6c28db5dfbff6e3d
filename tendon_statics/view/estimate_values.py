"""What is shown of messages ``Estimate`` and ``ArmEstimate``, in words and in drawings alike."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from ..estimation.regimes import REGIME_COLOURS
from ..physics import Load, LoadError, Regime

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
    """Return the colour that stands for a unit, that of its regime while it is of now."""
    return colour_of_regime(regime_named(estimate.regime), present=present)


def colour_of_regime(regime: Regime | None, *, present: bool) -> str:
    """Return the colour that stands for a regime, grey if it is not of now, or is none."""
    return REGIME_COLOURS[regime] if regime and present else GREY


def pairs_of(ends: Sequence[float]) -> Iterator[tuple[float, float]]:
    """Return the intervals of a list of ends; one that is left over is none."""
    return zip(ends[::2], ends[1::2], strict=False)


def angle_interval(estimate: Any) -> tuple[float, float] | None:
    """Return the ends in rad of where a unit's angle is, as `interval_about` has them."""
    return interval_about(
        estimate.bend_angle,
        estimate.bend_angle_stddev,
        (estimate.bend_angle_low, estimate.bend_angle_high),
    )


def interval_about(
    angle: float, stddev: float, ends: tuple[float, float]
) -> tuple[float, float] | None:
    """Return the ends in rad of where an angle is, within a half turn; None if it is not known.

    That is the interval that the estimator gives, else `COVERAGE` standard deviations. Without an
    angle there is none: an interval is about the angle that is told.
    """
    interval = interval_told(angle, stddev, ends)
    return (max(interval[0], -math.pi), min(interval[1], math.pi)) if interval else None


def interval_told(
    value: float, stddev: float, ends: tuple[float, float]
) -> tuple[float, float] | None:
    """Return where a value is; the rest is as of `interval_about`, but for the half turn."""
    low, high = ends
    if math.isnan(low):
        low, high = value - COVERAGE * stddev, value + COVERAGE * stddev
    return (low, high) if all(map(math.isfinite, (value, low, high))) else None


def load_of(estimate: Any) -> Load | None:
    """Return the load that an estimate was worked out with, None if it tells none."""
    direction = (
        estimate.gravity_direction_x,
        estimate.gravity_direction_y,
        estimate.gravity_direction_z,
    )
    tip_force = (estimate.tip_force_x, estimate.tip_force_z)
    try:
        # The force on an arm acts at its end, and its message names no distance.
        return Load(direction, tip_force, getattr(estimate, 'tip_distance', 0.0))
    except LoadError:
        return None


def regime_named(name: str) -> Regime | None:
    """Return the regime of a name, None if it is of a kind that is not known here."""
    try:
        return Regime(name)
    except ValueError:
        return None


def regime_probabilities(estimate: Any) -> dict[Regime, float] | None:
    """Return the probability of each regime, None where the estimator says none."""
    found = {regime: getattr(estimate, f'probability_{regime.value}') for regime in Regime}
    return None if any(map(math.isnan, found.values())) else found
