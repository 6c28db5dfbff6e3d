"""Ask an estimator from within a callback, and wait there for the answer.

A controller that wants the tensions for an angle asks while its own timer runs. With the default
executor that waits for ever: the answer is a callback too, and has no turn before the timer's
callback ends. So the client has a callback group of its own, and the executor a second thread.

Beside a running estimator:

    python examples/service_client.py
"""

from math import degrees

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from tendon_statics_interfaces.srv import SolveInverse

PERIOD = 0.5  # s between two questions
PATIENCE = 5.0  # s for the service to be there, and for an answer
TOTAL_TENSION = 3.0  # N


class Controller(Node):
    """Asks for the tensions of one angle after the other."""

    def __init__(self):
        super().__init__('controller')
        self._angle = 0.0
        self._client = self.create_client(
            SolveInverse,
            'estimator/solve_inverse',
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        self._waited = 0.0
        self.create_timer(PERIOD, self._step)

    def _step(self):
        if not self._client.service_is_ready():
            self._waited += PERIOD
            if self._waited >= PATIENCE:
                print('no estimator is running: start one first, as examples/README.md says')
                self._waited = 0.0
            return
        request = SolveInverse.Request(bend_angle=self._angle, total_tension=TOTAL_TENSION)
        try:
            answer = self._client.call(request, timeout_sec=PATIENCE)
        except TimeoutError:
            print(f'no answer within {PATIENCE:g} s')
            return
        if answer is None:  # Ctrl-C while it waited
            return
        if answer.success:
            print(
                f'{degrees(self._angle):.0f}°: cable l {answer.tension_l:.3f} N, '
                f'cable s {answer.tension_s:.3f} N'
            )
        else:
            print(f'{degrees(self._angle):.0f}°: {answer.message}')
        self._angle = 0.0 if self._angle > 0.4 else self._angle + 0.1


def main():
    """Run until Ctrl-C."""
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    try:
        executor.add_node(Controller())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # Ctrl-C: rclpy shuts down by itself, and a callback that waits stops waiting
    finally:
        executor.shutdown()


if __name__ == '__main__':
    main()
