"""The estimator with stop watches on its parts, as a process.

It is called as the estimator is, and on ending writes ``Took: `` and CPU times in s as JSON.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.publisher import Publisher
from stop_watches import StopWatches

from tendon_statics.estimation.unit_estimator import UnitEstimator
from tendon_statics.node import program
from tendon_statics.node.estimator import Estimator
from tendon_statics.node.inputs.sources import ArraySource
from tendon_statics.node.outputs.publishers import Outputs


def main() -> int:
    """Run the estimator, then say what took how long."""
    watches = StopWatches('wait and dispatch')
    for owner, name, part in (
        (SingleThreadedExecutor, '_take_subscription', 'decode'),
        (ArraySource, '_take', 'decode'),
        (Estimator, '_on_reading', 'check and count'),
        (UnitEstimator, '_followed', 'solve'),
        (Outputs, 'publish', 'build'),
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
