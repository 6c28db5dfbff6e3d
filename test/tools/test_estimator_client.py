"""What tests and tools speak to the estimator with loses nothing once it is connected."""

from rclpy.qos import QoSProfile
from ros_programs import wait_for
from tendon_statics_interfaces.msg import Estimate


def test_once_connected_all_hear_the_first_estimate(listener):
    """Though this side finds the estimator before that has found all of this side."""
    heard = [[] for _ in range(200)]
    for one in heard:
        listener.create_subscription(
            Estimate, 'estimator/estimate', one.append, QoSProfile(depth=10)
        )
    with listener.estimator('-p', 'input_timeout:=60.0'):
        listener.answer(1.0, 3.0)
        wait_for('the estimate everywhere', lambda: all(heard))
        assert {len(one) for one in heard} == {1}
