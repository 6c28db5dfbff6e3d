"""The figure of docs/filter.md: a session with noise, the truth, the tracker and the filter."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tendon_statics import StickSlipFilter, StickSlipTracker
from tendon_statics.command_line.figures import (
    BLUE,
    GREY,
    HOLDS,
    TENSION_L,
    TENSION_S,
    VERMILION,
    write_figure,
)

from .sessions import session

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SEED, SECONDS, NOISE, RATE = 2, 12.0, 0.02, 500.0

DRAWN = slice(None, None, 5)
"""Samples that are drawn; more are no better to see"""


def draw(drawing: Figure) -> None:
    """Draw the hanging unit through ramps and rests."""
    drawn = session('hanging', 'ramps', NOISE, RATE, SECONDS, np.random.default_rng(SEED))
    found = StickSlipFilter(drawn.design, tension_stddev=NOISE)
    tracker = StickSlipTracker(drawn.design)
    median, low, high, believing = [], [], [], []
    for at, tension_l, tension_s in zip(
        drawn.time.tolist(), drawn.tension_l.tolist(), drawn.tension_s.tolist(), strict=True
    ):
        state = found.update(tension_l, tension_s, at)
        ends = state.interval(0.95)
        median.append(math.degrees(state.bend_angle))
        low.append(math.degrees(ends[0]))
        high.append(math.degrees(ends[1]))
        believing.append(math.degrees(tracker.update(tension_l, tension_s).bend_angle))
    above, below = drawing.subplots(2, sharex=True, height_ratios=(1, 2))
    for tension, colour, name in (
        (drawn.tension_l, TENSION_L, 'T_l'),
        (drawn.tension_s, TENSION_S, 'T_s'),
    ):
        above.plot(drawn.time[DRAWN], tension[DRAWN], color=colour, linewidth=0.6, label=name)
    above.set_ylabel('tension [N]')
    above.legend(loc='upper left', ncols=2, frameon=False)
    time = drawn.time[DRAWN]
    below.fill_between(time, low[DRAWN], high[DRAWN], color=HOLDS, label='filter, 95 % interval')
    below.plot(time, believing[DRAWN], color=GREY, linewidth=1.2, label='tracker')
    below.plot(time, median[DRAWN], color=BLUE, linewidth=1.4, label='filter, median')
    truth = np.degrees(drawn.bend_angle)
    below.plot(time, truth[DRAWN], color=VERMILION, linewidth=1.0, linestyle='--', label='truth')
    below.set_xlabel('time [s]')
    below.set_ylabel('bend angle θ [°]')
    below.legend(loc='best', frameon=False)


def write(path: Path) -> None:
    """Write the figure."""
    write_figure(path, draw, (6.4, 5.0))
