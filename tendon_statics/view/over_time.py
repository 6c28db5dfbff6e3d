"""Figures over the last minute, on the clock of the machine on which the node runs."""

from __future__ import annotations

import math
import time
from typing import Any

from bokeh.models import (
    BoxAnnotation,
    ColumnDataSource,
    DataRange1d,
    DatetimeTickFormatter,
    GlyphRenderer,
    Range1d,
)
from bokeh.plotting import figure

from .history import SPAN

LINE, BEYOND = '#0072B2', '#D55E00'

STEP = 1.0
"""Seconds by which the window moves on, since each time all of it is drawn anew"""

CLOCK = '%H:%M:%S'
UNITS = ('seconds', 'minsec', 'minutes', 'hourmin')
"""What a tick may be a whole number of; each is shown alike"""

MARGIN = 1.5
"""How much of the slip margin is shown; beyond 1 friction cannot hold, by how much matters less"""


class OverTime:
    """Makes figures over one time.

    Parameters
    ----------
    history : ColumnDataSource
        The last minute, with the columns of a `History`.
    """

    def __init__(self, history: ColumnDataSource) -> None:
        self.window = Range1d(0.0, 1.0)
        self._history = history

    def empty(self, name: str, label: str, y_range: Range1d | DataRange1d) -> figure:
        """Make one without lines."""
        plot = figure(
            name=name,
            x_axis_type='datetime',
            x_range=self.window,
            y_range=y_range,
            y_axis_label=label,
            height=180,
            min_border_left=70,
            sizing_mode='stretch_width',
            toolbar_location=None,
            tools='',
        )
        plot.yaxis.ticker.desired_num_ticks = 4
        plot.xaxis.ticker.desired_num_ticks = 4
        plot.xaxis.formatter = DatetimeTickFormatter(**dict.fromkeys(UNITS, CLOCK))
        return plot

    def margins(self, name: str) -> figure:
        """Make one of slip margins, without lines, that shows where friction cannot hold."""
        plot = self.empty(name, 'slip margin', Range1d(-MARGIN, MARGIN))
        for ends in ({'bottom': 1.0}, {'top': -1.0}):
            plot.add_layout(BoxAnnotation(**ends, fill_color=BEYOND, fill_alpha=0.12))
        return plot

    def line(self, plot: figure, name: str, colour: str = LINE, **look: Any) -> GlyphRenderer[Any]:
        """Draw a column."""
        return plot.line(
            x='time', y=name, color=colour, line_width=2, source=self._history, **look
        )

    def band(
        self, plot: figure, low: str, high: str, *, colour: str = LINE, alpha: float = 0.3
    ) -> GlyphRenderer[Any]:
        """Draw what is between two columns."""
        return plot.quad(
            left='before',
            right='time',
            bottom=low,
            top=high,
            fill_color=colour,
            fill_alpha=alpha,
            line_color=None,
            source=self._history,
        )

    def move_on(self, now: float) -> None:
        """Have the window end at a time in ms, or a little later."""
        end = 1e3 * STEP * math.ceil(1e-3 * now / STEP)
        if end != self.window.end:
            self.window.update(start=end - 1e3 * SPAN, end=end)


def local_clock(milliseconds: Any) -> Any:
    """Return times that the browser shows as the clock of this machine; it knows none but UTC."""
    return milliseconds + 1e3 * time.localtime().tm_gmtoff
