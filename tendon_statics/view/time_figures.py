"""Angle, pressure and slip margin over the last minute."""

from __future__ import annotations

import math
import time
from typing import Any

from bokeh.models import (
    BoxAnnotation,
    ColumnDataSource,
    DataRange1d,
    DatetimeTickFormatter,
    Range1d,
    Span,
)
from bokeh.plotting import figure

from ..physics import JointDesign
from .history import BANDS, SPAN

LINE, ADMISSIBLE, BEYOND = '#0072B2', '#56B4E9', '#D55E00'

STEP = 1.0
"""Seconds by which the window moves on, since each time all of it is drawn anew"""

CLOCK = '%H:%M:%S'
UNITS = ('seconds', 'minsec', 'minutes', 'hourmin')
"""What a tick may be a whole number of; each is shown alike"""

MARGIN = 1.5
"""How much of the slip margin is shown; beyond 1 friction cannot hold, by how much matters less"""


class TimeFigures:
    """Three figures over one time, the clock of the machine on which the node runs.

    Parameters
    ----------
    history : ColumnDataSource
        The last minute, with the columns of `history.COLUMNS`.
    """

    def __init__(self, history: ColumnDataSource) -> None:
        self._window = Range1d(0.0, 1.0)
        self._history = history
        self._angles = Range1d(-1.0, 1.0)
        self.angle = self._figure('angle', 'bend angle [°]', self._angles)
        pressures = DataRange1d(start=0.0, only_visible=True)
        self.pressure = self._figure('pressure', 'pressure [Pa]', pressures)
        self.margin = self._figure('margin', 'slip margin', Range1d(-MARGIN, MARGIN))
        for band in range(BANDS):
            names = (f'admissible_low_{band}', f'admissible_high_{band}')
            self._band(self.angle, *names, colour=ADMISSIBLE, alpha=0.25)
        for plot, name in ((self.angle, 'angle'), (self.pressure, 'pressure')):
            self._band(plot, f'{name}_low', f'{name}_high', colour=LINE, alpha=0.3)
        for plot, name in (
            (self.angle, 'angle'),
            (self.pressure, 'pressure'),
            (self.margin, 'slip_margin'),
        ):
            plot.line(x='time', y=name, color=LINE, line_width=2, source=history)
        self._stops = [
            Span(location=0.0, dimension='width', line_dash='dotted', visible=False)
            for _ in range(2)
        ]
        for stop in self._stops:
            self.angle.add_layout(stop)
        for ends in ({'bottom': 1.0}, {'top': -1.0}):
            self.margin.add_layout(BoxAnnotation(**ends, fill_color=BEYOND, fill_alpha=0.12))

    def _figure(self, name: str, label: str, y_range: Range1d | DataRange1d) -> figure:
        plot = figure(
            name=name,
            x_axis_type='datetime',
            x_range=self._window,
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

    def _band(self, plot: figure, low: str, high: str, *, colour: str, alpha: float) -> None:
        plot.quad(
            left='before',
            right='time',
            bottom=low,
            top=high,
            fill_color=colour,
            fill_alpha=alpha,
            line_color=None,
            source=self._history,
        )

    def draw_design(self, design: JointDesign) -> None:
        """Draw the stops, and show what lies between them."""
        stop = math.degrees(design.max_bend_angle)
        self._angles.update(start=-1.15 * stop, end=1.15 * stop)
        for line, place in zip(self._stops, (-stop, stop), strict=True):
            line.update(location=place, visible=True)

    def move_on(self, now: float) -> None:
        """Have the window end at a time in ms, or a little later."""
        end = 1e3 * STEP * math.ceil(1e-3 * now / STEP)
        if end != self._window.end:
            self._window.update(start=end - 1e3 * SPAN, end=end)


def local_clock(milliseconds: Any) -> Any:
    """Return times that the browser shows as the clock of this machine; it knows none but UTC."""
    return milliseconds + 1e3 * time.localtime().tm_gmtoff
