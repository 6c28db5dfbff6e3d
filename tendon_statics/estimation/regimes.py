"""Words for what has no regime, and the colour of each regime in RViz and figures alike."""

from __future__ import annotations

from ..physics.regime import Regime

INVALID = 'invalid'
"""Said of what holds no pair of tensions that the model takes"""

STALE = 'stale'
"""Said once when no more valid tensions come"""

# Okabe and Ito's palette, told apart with any colour vision and in grey print.
REGIME_COLOURS = {
    Regime.HELD: '#56B4E9',
    Regime.EQUILIBRIUM: '#D55E00',
    Regime.SLIPPING: '#009E73',
    Regime.DRIVEN_TO_STOP: '#E69F00',
    Regime.SLACK: '#999999',
}


def red_green_blue(colour: str) -> tuple[float, float, float]:
    """Return a colour such as ``#56B4E9`` as shares of red, green and blue from 0 to 1."""
    red, green, blue = (int(colour[place : place + 2], 16) / 255.0 for place in (1, 3, 5))
    return red, green, blue
