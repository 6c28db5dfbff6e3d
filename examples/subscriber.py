"""Listen to an estimator: what it says of the unit, and how far to trust it.

Beside a running estimator (``estimator``, or ``ros2 run tendon_statics estimator``):

    python examples/subscriber.py
"""

from contextlib import suppress
from math import degrees, isnan

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from tendon_statics_interfaces.msg import Estimate

PATIENCE = 2.0  # s without an estimate, after which it says so


class Subscriber(Node):
    """Prints each change of regime, with the angle where there is one."""

    def __init__(self):
        super().__init__('subscriber')
        self._regime = ''
        # All that belongs to one pair of tensions is in one message.
        self.create_subscription(Estimate, 'estimator/estimate', self._on_estimate, 10)
        self._silence = self.create_timer(PATIENCE, self._on_silence)

    def _on_estimate(self, estimate):
        self._silence.reset()
        if estimate.regime == self._regime:
            return
        self._regime = estimate.regime
        if isnan(estimate.bend_angle):  # friction holds, or a cable is slack: nobody knows it
            print(f'{estimate.regime}: the tensions do not tell the angle')
            return
        trusted = estimate.angle_assured and estimate.load_assured and estimate.branch_consistent
        print(
            f'{estimate.regime}: {degrees(estimate.bend_angle):.2f}° '
            f'± {degrees(estimate.bend_angle_stddev):.2f}°, {estimate.pressure:.1f} Pa'
            + ('' if trusted else ', not to be trusted')
        )

    def _on_silence(self):
        self._silence.cancel()  # said once; the next estimate starts it again
        self._regime = ''
        print(f'no estimate for {PATIENCE:g} s: is an estimator running, and do tensions come?')


def main():
    """Run until Ctrl-C."""
    rclpy.init()
    # At Ctrl-C rclpy shuts down by itself.
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Subscriber())


if __name__ == '__main__':
    main()
