"""What a page has for one kind of estimator."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from bokeh.models import ColumnDataSource, LayoutDOM

from .history import TIMES
from .over_time import local_clock
from .watch import Watch


class Panels(Protocol):
    """The figures of a page, and its words, for a unit or for an arm."""

    @property
    def roots(self) -> Sequence[LayoutDOM]:
        """All that the page has to embed, by their names."""

    def draw(self, watch: Watch, age: float) -> None:
        """Draw what is new; `age` is that of the newest estimate in s."""

    def move_on(self, now: float) -> None:
        """Have the last minute end at a time in ms."""

    def say(self, watch: Watch, age: float) -> str:
        """Return what to say in words of the newest estimate."""

    def clear(self) -> None:
        """Draw nothing any more, as of an estimator that is left."""


class LastMinute:
    """The history of a watch in the browser, sent on as it grows."""

    def __init__(self, name: str, columns: Sequence[str] = ()) -> None:
        self.source = ColumnDataSource({column: [] for column in (*TIMES, *columns)}, name=name)
        self._drawn: tuple[Any, int] = (None, 0)

    def draw(self, watch: Watch) -> None:
        """Send what is new, or all of a history that is another than before."""
        history = watch.history
        if history.count == 0:
            return  # It does not have its columns yet.
        drawn, count = self._drawn
        if drawn is not history:
            count = 0
            self.source.data = {column: [] for column in history.columns}
        if history.count > count:
            new = history.since(count)
            for name in TIMES:
                new[name] = local_clock(new[name])
            # Lists, since each array of its own would be two messages more.
            lists = {name: column.tolist() for name, column in new.items()}
            self.source.stream(lists, rollover=history.length)
        self._drawn = history, history.count

    def clear(self) -> None:
        """Forget it."""
        self._drawn = None, 0
        self.source.data = {column: [] for column in self.source.data}
