"""How probable each regime is, for estimators that say it."""

from __future__ import annotations

from collections.abc import Mapping

from bokeh.models import ColumnDataSource, Range1d
from bokeh.plotting import figure

from ..estimation.regimes import REGIME_COLOURS
from ..physics import Regime
from .words import REGIMES


class ProbabilityFigure:
    """One bar a regime, from 0 to 1."""

    def __init__(self) -> None:
        names = [REGIMES[regime][0] for regime in reversed(Regime)]
        self.root = figure(
            name='probabilities',
            x_range=Range1d(0.0, 1.0),
            y_range=names,
            x_axis_label='probability',
            height=150,
            sizing_mode='stretch_width',
            toolbar_location=None,
            tools='',
            visible=False,
        )
        self._bars = ColumnDataSource({'name': [], 'probability': [], 'colour': []}, name='bars')
        self.root.hbar(
            y='name', right='probability', height=0.7, color='colour', source=self._bars
        )

    def draw(self, probabilities: Mapping[Regime, float] | None) -> None:
        """Draw the probability of each regime; nothing at all where none are said."""
        if bool(probabilities) != self.root.visible:
            self.root.visible = bool(probabilities)
        if not probabilities:
            return
        data = {
            'name': [REGIMES[regime][0] for regime in Regime],
            'probability': [round(probabilities[regime], 3) for regime in Regime],
            'colour': [REGIME_COLOURS[regime] for regime in Regime],
        }
        if data != self._bars.data:
            self._bars.data = data
