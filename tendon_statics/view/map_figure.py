"""The map of regimes over both tensions, with the present pair and where it came from."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource, LinearColorMapper, Range1d
from bokeh.plotting import figure

from ..estimation.regimes import REGIME_COLOURS
from ..physics import JointDesign, Load, Regime
from ..physics.tensions import MAX_TENSION
from .estimate_values import load_of
from .regime_map import CODES, gives_same_map, map_end, regimes_over_tensions

NOT_SEATED = '#4d4d4d'
"""Colour of pairs that do not press the unit on its seat"""

ON_MAP = (Regime.HELD, Regime.EQUILIBRIUM, Regime.DRIVEN_TO_STOP)
"""What an area of the map may be; whether a unit slips is a matter of where it was"""

EDGE = 0.03
"""How far the map reaches below 0, as a share of the rest, for a mark on its edge"""

SHORTEST_PERIOD = 2.0
"""Seconds between two maps, at the least; one takes up to 0.05 s"""


class MapFigure:
    """Draws the map of one unit.

    Parameters
    ----------
    history : ColumnDataSource
        The last minute, with the columns ``tension_l`` and ``tension_s``.
    """

    def __init__(self, history: ColumnDataSource) -> None:
        self.root = figure(
            name='map',
            x_range=Range1d(0.0, 1.0),
            y_range=Range1d(0.0, 1.0),
            x_axis_label='tension of cable l, T_l [N]',
            y_axis_label='tension of cable s, T_s [N]',
            aspect_ratio=1.15,
            sizing_mode='stretch_width',
            toolbar_location=None,
            tools='',
        )
        self.root.grid.visible = False
        self._image = ColumnDataSource({'codes': [], 'end': []}, name='regimes')
        self._present = ColumnDataSource({'tension_l': [], 'tension_s': []}, name='present')
        colours = [NOT_SEATED, *(REGIME_COLOURS[regime] for regime in Regime)]
        self.root.image(
            image='codes',
            x=0.0,
            y=0.0,
            dw='end',
            dh='end',
            alpha=0.4,
            color_mapper=LinearColorMapper(
                palette=colours, low=min(CODES) - 0.5, high=max(CODES) + 0.5
            ),
            source=self._image,
        )
        self.root.line(
            x='tension_l',
            y='tension_s',
            color='black',
            line_alpha=0.45,
            line_width=1.5,
            source=history,
        )
        self.root.scatter(
            x='tension_l',
            y='tension_s',
            size=13,
            fill_color='white',
            line_color='black',
            line_width=3,
            source=self._present,
        )
        self._largest = 0.0
        self._made: tuple[JointDesign, Load, float] | None = None
        self._made_at = -math.inf

    def draw(self, design: JointDesign | None, estimate: Any) -> None:
        """Draw an estimate's pair, and the map anew if what it depends on has changed."""
        pair = {'tension_l': [estimate.tension_l], 'tension_s': [estimate.tension_s]}
        if pair != self._present.data:
            self._present.data = pair
        shown = (t for t in (estimate.tension_l, estimate.tension_s) if 0.0 <= t <= MAX_TENSION)
        self._largest = max(self._largest, *shown, 0.0)
        load = load_of(estimate)
        if design is None or load is None:
            return
        end = map_end(self._largest)
        if self._made:
            made_design, made_load, made_end = self._made
            if (
                (made_design, made_end) == (design, end)
                and gives_same_map(design, made_load, load)
            ) or time.monotonic() < self._made_at + SHORTEST_PERIOD:
                return
        self._made, self._made_at = (design, load, end), time.monotonic()
        codes = regimes_over_tensions(design, load, end).astype(np.float32)
        self._image.data = {'codes': [codes], 'end': [end]}
        for axis in (self.root.x_range, self.root.y_range):
            axis.update(start=-EDGE * end, end=end)

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._image.data = {'codes': [], 'end': []}
        self._present.data = {'tension_l': [], 'tension_s': []}
        self._largest, self._made = 0.0, None
