"""What a page shows of a unit."""

from __future__ import annotations

from collections.abc import Sequence

from bokeh.models import LayoutDOM

from ..physics import JointDesign
from .estimate_values import is_present, regime_probabilities
from .map_figure import MapFigure
from .panels import LastMinute
from .probability_figure import ProbabilityFigure
from .time_figures import TimeFigures
from .unit_figure import UnitFigure
from .unit_sample import UNIT_NAMES
from .watch import Watch
from .words import state_words


class UnitPanels:
    """The unit, the map of regimes, the last minute and the probabilities."""

    def __init__(self) -> None:
        self._minute = LastMinute('history', UNIT_NAMES)
        self._unit = UnitFigure()
        self._map = MapFigure(self._minute.source)
        self._times = TimeFigures(self._minute.source)
        self._probabilities = ProbabilityFigure()
        self._design: JointDesign | None = None
        self.move_on = self._times.move_on

    @property
    def roots(self) -> Sequence[LayoutDOM]:
        """All figures."""
        times = (self._times.angle, self._times.pressure, self._times.margin)
        return (self._unit.root, self._map.root, self._probabilities.root, *times)

    def draw(self, watch: Watch, age: float) -> None:
        """Draw what is new; `age` is that of the newest estimate in s."""
        self._minute.draw(watch)
        estimate, design = watch.estimate, watch.design
        if estimate is None:
            return
        if design != self._design:
            self._design = design
            self._unit.clear()
            if design is not None:
                self._unit.draw_design(design)
                self._times.draw_design(design)
        if design is not None:
            self._unit.draw(design, estimate, present=is_present(watch.said, age))
        self._map.draw(design, estimate)
        self._probabilities.draw(regime_probabilities(estimate))

    def say(self, watch: Watch, age: float) -> str:
        """Return what to say in words of the newest estimate."""
        is_drawn = watch.design is not None
        return state_words(watch.estimate, watch.said, age, is_drawn=is_drawn)

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""
        self._minute.clear()
        self._design = None
        self._unit.clear()
        self._map.clear()
        self._probabilities.draw(None)
