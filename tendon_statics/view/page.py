"""One page in a browser: what it shows, of which estimator, and whether it is paused."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bokeh.document import Document
from bokeh.events import ConnectionLost, DocumentReady
from bokeh.models import CustomJS, Div, Select, Toggle

from ..estimation.regimes import REGIME_COLOURS
from .arm_panels import ArmPanels
from .arm_time_figures import TIP_COLOURS
from .estimators_in_sight import Sighting, estimators_in_sight
from .kinds import ARM, UNIT
from .map_figure import NOT_SEATED, ON_MAP
from .over_time import local_clock
from .panels import Panels
from .ros_job import ros_job
from .unit_panels import UnitPanels
from .watch import Watch, Watches
from .words import REGIMES, STYLE, diagnostics_words, nobody, waiting

TEMPLATE = Path(__file__).with_name('page.html')

WORDS_PERIOD = 0.2
"""Seconds between two readings in words; quicker ones cannot be read"""

SHOW_KIND = "document.body.classList.toggle('arm', choice.tags.includes('arm'))"
"""What the browser does when an estimator of another kind is chosen; see page.html"""

SIGHT_PERIOD = 1.0
"""Seconds between two looks for estimators"""


class Page:
    """One page of one browser.

    Parameters
    ----------
    node : View
        The node, for what is in sight.
    rate : float
        Drawings per second, at the most.
    first : str
        Full name of the estimator that it begins with; empty for the first in sight.
    """

    def __init__(
        self, document: Document, node: Any, watches: Watches, rate: float, first: str
    ) -> None:
        self._session = document.session_context
        self._node = node
        self._watches = watches
        self._chosen = first
        self._sightings: Sequence[Sighting] = ()
        self._watch: Watch | None = None
        self._words_due = self._sight_due = 0.0

        self._panels: dict[str, Panels] = {UNIT.name: UnitPanels(), ARM.name: ArmPanels()}
        style = {'sizing_mode': 'stretch_width', 'stylesheets': [STYLE]}
        self._state = Div(name='state', **style)
        self._diagnostics = Div(name='diagnostics', **style)
        self._choice = Select(name='estimator', options=[], width=260)
        self._choice.on_change('value', self._on_choice)
        self._pause = Toggle(name='pause', label='Pause', width=110)
        self._pause.on_change('active', self._on_pause)

        # What the page shows hangs on the kind of estimator, which it may have from the start.
        show_kind = CustomJS(args={'choice': self._choice}, code=SHOW_KIND)
        self._choice.js_on_change('tags', show_kind)
        document.js_on_event(DocumentReady, show_kind)

        for root in (self._choice, self._pause, self._state, self._diagnostics):
            document.add_root(root)
        for panels in self._panels.values():
            for root in panels.roots:
                document.add_root(root)
        document.title = 'tendon_statics'
        document.template = TEMPLATE.read_text(encoding='utf-8')
        document.template_variables['regimes'] = [
            *((REGIMES[regime][0], REGIME_COLOURS[regime]) for regime in ON_MAP),
            ('not on its seat', NOT_SEATED),
        ]
        document.template_variables['tip_colours'] = TIP_COLOURS
        document.js_on_event(ConnectionLost, CustomJS(code="document.body.classList.add('lost')"))
        document.add_periodic_callback(ros_job(node.context, self.update), round(1e3 / rate))
        document.on_session_destroyed(lambda _context: self._leave())

    # What the person at the page does

    def _on_choice(self, _name: str, _old: str, new: str) -> None:
        if self._watch is None or new != self._watch.sighting.name:
            self._chosen = new
            self._leave()
            self._sight_due = 0.0

    def _on_pause(self, _name: str, _old: bool, new: bool) -> None:
        self._pause.label = 'Resume' if new else 'Pause'
        self._pause.button_type = 'warning' if new else 'default'

    # Drawing

    def update(self) -> None:
        """Draw what is new. Without a browser, hear nothing: it is closed, or still loading."""
        if self._session is None or self._session.session.connection_count == 0:
            self._leave()
            return
        now = time.monotonic()
        if now >= self._sight_due:
            self._sight_due = now + SIGHT_PERIOD
            self._look_around()
        if self._pause.active:
            return
        self._draw(now)

    def _look_around(self) -> None:
        self._sightings = estimators_in_sight(self._node)
        names = [sighting.name for sighting in self._sightings]
        if self._chosen and self._chosen not in names:
            names.append(self._chosen)  # It may have ended, and may come back.
        if names != self._choice.options:
            self._choice.options = names
        if self._watch is None and self._sightings:
            wanted = self._chosen or self._sightings[0].name
            for sighting in self._sightings:
                if sighting.name == wanted:
                    self._chosen = wanted
                    self._watch = self._watches.look(sighting)
                    self._choice.value = wanted
                    self._choice.tags = [sighting.kind.name]

    def _draw(self, now: float) -> None:
        watch = self._watch
        are_words_due = now >= self._words_due
        if are_words_due:
            self._words_due = now + WORDS_PERIOD
        if watch is None:
            if are_words_due:
                self._say(nobody(self._node.domain, self._chosen), '')
            return
        panels, age = self._panels[watch.sighting.kind.name], now - watch.estimated_at
        panels.draw(watch, age)
        panels.move_on(local_clock(1e3 * time.time()))
        if are_words_due:
            if watch.estimate is None:
                state = waiting(watch.sighting.name, watch.said)
            else:
                state = panels.say(watch, age)
            self._say(state, diagnostics_words(watch.diagnostics, now - watch.diagnosed_at))

    def _say(self, state: str, diagnostics: str) -> None:
        for place, text in ((self._state, state), (self._diagnostics, diagnostics)):
            if place.text != text:
                place.text = text

    def _leave(self) -> None:
        """Look no more, and draw nothing of what was seen."""
        if self._watch is None:
            return
        self._watches.leave(self._watch)
        self._panels[self._watch.sighting.kind.name].clear()
        self._watch = None
