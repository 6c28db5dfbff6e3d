"""The estimator with stop watches on its parts, as a process.

It is called as the estimator is, and on ending writes ``Took: `` and CPU times in s as JSON.
"""

from __future__ import annotations

import json
import sys
import time
from collections import Counter
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.publisher import Publisher

from tendon_statics.node import estimator, outputs, program


class StopWatches:
    """CPU time of the present thread, given to the innermost part that is at work."""

    def __init__(self) -> None:
        self.start()

    def start(self) -> None:
        """Begin anew, with what belongs to no part."""
        self.took: Counter[str] = Counter()
        self._at_work = ['wait and dispatch']
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

        setattr(owner, name, timed)


def main() -> int:
    """Run the estimator, then say what took how long."""
    watches = StopWatches()
    for owner, name, part in (
        (SingleThreadedExecutor, '_take_subscription', 'decode'),
        (estimator.ArraySource, '_take', 'decode'),
        (estimator.Estimator, '_on_reading', 'check and count'),
        (estimator.Estimator, '_result', 'solve'),
        (outputs.Outputs, 'publish', 'build'),
        (Publisher, 'publish', 'publish'),
    ):
        watches.put_on(owner, name, part)
    spin = program._spin

    def timed_spin(node: Any) -> None:
        watches.start()
        others = time.process_time() - time.thread_time()
        try:
            spin(node)
        finally:
            watches.turn_to('')
            others = time.process_time() - time.thread_time() - others
            took = {**watches.took, 'threads of the middleware': others}
            print('Took:', json.dumps(took), flush=True)

    program._spin = timed_spin
    return program.estimator()


if __name__ == '__main__':
    sys.exit(main())
