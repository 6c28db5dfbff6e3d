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
        self.create_timer(0.5, self._step)

    def _step(self):
        if not self._client.wait_for_service(timeout_sec=PATIENCE):
            print('no estimator is running')
            return
        request = SolveInverse.Request(bend_angle=self._angle, total_tension=TOTAL_TENSION)
        try:
            answer = self._client.call(request, timeout_sec=PATIENCE)
        except TimeoutError:
            print(f'no answer within {PATIENCE:g} s')
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
    node = Controller()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
