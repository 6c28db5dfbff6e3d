"""Where the time goes: stop watches on functions."""

from __future__ import annotations

import time
from collections import Counter
from contextlib import ExitStack
from typing import Any
from unittest.mock import patch


class StopWatches(ExitStack):
    """CPU time of the present thread, given to the innermost part that is at work.

    They are taken off at the end of a ``with`` statement.

    Attributes
    ----------
    took : Counter
        Part → time in s, since the last `start`.

    Parameters
    ----------
    rest : str
        What belongs to no part.
    """

    def __init__(self, rest: str) -> None:
        super().__init__()
        self._rest = rest
        self.start()

    def start(self) -> None:
        """Begin anew, with what belongs to no part."""
        self.took: Counter[str] = Counter()
        self._at_work = [self._rest]
        self._since = time.thread_time()

    def turn_to(self, part: str) -> None:
        """Let one more part be at work, or go back from it to the one before, if it is empty."""
        now = time.thread_time()
        self.took[self._at_work[-1]] += now - self._since
        self._since = now
        if part:
            self._at_work.append(part)
        else:
            self._at_work.pop()

    def put_on(self, owner: Any, name: str, part: str) -> None:
        """Count the time in a function as that of a part."""
        function = getattr(owner, name)

        def timed(*given: Any, **named: Any) -> Any:
            self.turn_to(part)
            try:
                return function(*given, **named)
            finally:
                self.turn_to('')

        self.enter_context(patch.object(owner, name, timed))
