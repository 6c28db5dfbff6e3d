"""Angles, slip margins and pressures of an arm's joints, and its tip, over the last minute."""

from __future__ import annotations

from bokeh.core.validation import silence
from bokeh.core.validation.warnings import MISSING_RENDERERS
from bokeh.models import ColumnDataSource, DataRange1d, GlyphRenderer
from bokeh.palettes import viridis
from bokeh.plotting import figure

from .over_time import OverTime

# Until an arm has told how many joints it has, its figures have no lines.
silence(MISSING_RENDERERS)

TIP_COLOURS = {'x': '#0072B2', 'z': '#D55E00'}


def line_colours(count: int) -> list[str]:
    """Return the colours of the joints' lines, dark at the base and bright at the tip."""
    return list(viridis(count + 1)[:count]) if count else []  # the last is too pale for a line


class ArmTimeFigures:
    """Four figures over one time; joints are told apart by their colours.

    Parameters
    ----------
    history : ColumnDataSource
        The last minute, with the columns of `arm_names`.
    """

    def __init__(self, history: ColumnDataSource) -> None:
        self._time = OverTime(history)
        self.move_on = self._time.move_on
        # Wide enough that a still arm's noise does not fill them.
        self.angle = self._time.empty('arm_angle', 'bend angles [°]', _range(10.0))
        pressures = DataRange1d(start=0.0, only_visible=True)
        self.pressure = self._time.empty('arm_pressure', 'pressures [Pa]', pressures)
        self.margin = self._time.margins('arm_margin')
        self.tip = self._time.empty('arm_tip', 'tip [mm]', _range(5.0))
        self._lines: list[tuple[figure, GlyphRenderer]] = []
        self.count = 0
        """Of joints that have lines"""

    def draw_joints(self, count: int) -> None:
        """Have lines for so many joints, and for the tip."""
        if count == self.count:
            return
        self.clear()
        self.count = count
        time = self._time
        for place, colour in enumerate(line_colours(count)):
            ends = f'angle_low_{place}', f'angle_high_{place}'
            self._keep(self.angle, time.band(self.angle, *ends, colour=colour, alpha=0.25))
            for plot, name in (
                (self.angle, 'angle'),
                (self.pressure, 'pressure'),
                (self.margin, 'slip_margin'),
            ):
                self._keep(plot, time.line(plot, f'{name}_{place}', colour))
        for axis, colour in TIP_COLOURS.items():
            name = f'tip_{axis}'
            band = time.band(self.tip, f'{name}_low', f'{name}_high', colour=colour)
            self._keep(self.tip, band)
            self._keep(self.tip, time.line(self.tip, name, colour))

    def clear(self) -> None:
        """Have no lines."""
        for plot, line in self._lines:
            plot.renderers.remove(line)
        self._lines, self.count = [], 0

    def _keep(self, plot: figure, line: GlyphRenderer) -> None:
        self._lines.append((plot, line))


def _range(least: float) -> DataRange1d:
    return DataRange1d(only_visible=True, min_interval=least, range_padding=0.1)
