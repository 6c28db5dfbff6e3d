"""Angle, pressure and slip margin of a unit over the last minute."""

from __future__ import annotations

import math

from bokeh.models import ColumnDataSource, DataRange1d, Range1d, Span

from ..physics import JointDesign
from .over_time import OverTime
from .unit_sample import BANDS

ADMISSIBLE = '#56B4E9'


class TimeFigures:
    """Three figures over one time.

    Parameters
    ----------
    history : ColumnDataSource
        The last minute, with the columns of `UNIT_NAMES`.
    """

    def __init__(self, history: ColumnDataSource) -> None:
        time = OverTime(history)
        self.move_on = time.move_on
        self._angles = Range1d(-1.0, 1.0)
        self.angle = time.empty('angle', 'bend angle [°]', self._angles)
        pressures = DataRange1d(start=0.0, only_visible=True)
        self.pressure = time.empty('pressure', 'pressure [Pa]', pressures)
        self.margin = time.margins('margin')
        for band in range(BANDS):
            names = (f'admissible_low_{band}', f'admissible_high_{band}')
            time.band(self.angle, *names, colour=ADMISSIBLE, alpha=0.25)
        for plot, name in ((self.angle, 'angle'), (self.pressure, 'pressure')):
            time.band(plot, f'{name}_low', f'{name}_high')
            time.line(plot, name)
        time.line(self.margin, 'slip_margin')
        self._stops = [
            Span(location=0.0, dimension='width', line_dash='dotted', visible=False)
            for _ in range(2)
        ]
        for stop in self._stops:
            self.angle.add_layout(stop)

    def draw_design(self, design: JointDesign) -> None:
        """Draw the stops, and show what lies between them."""
        stop = math.degrees(design.max_bend_angle)
        self._angles.update(start=-1.15 * stop, end=1.15 * stop)
        for line, place in zip(self._stops, (-stop, stop), strict=True):
            line.update(location=place, visible=True)
