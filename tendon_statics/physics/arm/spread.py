"""How sure the bend angles of an arm are, from the noise of the tensions that brought it there.

To first order, with tensions whose errors are independent, of one deviation σ, and of all samples.
A joint that rests at its limit, f(θ, T) = 0, follows the tensions of the sample that brought it
there, and the joints that did not move, which follow samples before. So with the covariance C of
these in units of σ²,

    θ_at = −J⁻¹ (F T + J_rest θ_rest),   J = ∂f/∂θ_at,   F = ∂f/∂T.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from .excess import Excess
from .flow import Settled

Floats = NDArray[np.float64]

BARELY = 1e-3
"""Share of K below its limit at which a joint that has slipped counts as at it: what moved on
after it took so little off, that its place is that at the limit, to first order"""


def spread_after(excess: Excess, settled: Settled, before: Floats) -> Floats:
    """Return the covariance of all bend angles, over the variance of a tension, in rad²/N².

    NaN where it is not known: of a joint that came to rest while others moved on, and took it
    from its limit by more than `BARELY`, and of those that depend on it.

    Parameters
    ----------
    before : array
        The covariance before the arm slipped.
    """
    look, stops = settled.look, excess.arm.stops
    count = len(stops)
    at_limit = settled.at_limit | _barely_below(settled, stops)
    after: Floats = before.copy()
    for joint in settled.moved:
        at_stop = abs(look.angles[joint]) == stops[joint]
        after[joint, :] = after[:, joint] = 0.0 if at_stop else math.nan
        after[joint, joint] = 0.0 if at_stop else math.nan
    at = list(at_limit)
    if not at:
        return after
    rest = [joint for joint in range(count) if joint not in at]
    by_all = excess.jacobian(look, at_limit)
    by_tension = excess.by_base_tensions(at_limit, look)
    try:
        inverse = -np.linalg.inv(by_all[:, at])
    except np.linalg.LinAlgError:
        inverse = np.full((len(at), len(at)), math.nan)
    of_tension = inverse @ by_tension
    found = of_tension @ of_tension.T
    if rest:
        of_rest = inverse @ by_all[:, rest]
        across = of_rest @ after[rest][:, rest]
        found = found + across @ of_rest.T
        after[np.array(at)[:, None], rest] = across
        after[np.array(rest)[:, None], at] = across.T
    after[np.array(at)[:, None], at] = found
    return after


def _barely_below(settled: Settled, stops: tuple[float, ...]) -> dict[int, float]:
    """Return the joints that others took from their limit, but hardly → the side of it."""
    look, found = settled.look, {}
    for joint in settled.moved - settled.at_limit.keys():
        side, excess, capacity = look.drive(joint)
        if abs(look.angles[joint]) < stops[joint] and excess >= -BARELY * capacity:
            found[joint] = side
    return found
