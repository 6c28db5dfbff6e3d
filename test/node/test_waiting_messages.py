"""`waiting_messages`: what waits is taken in order, with its number, and not too much at once."""

import pytest
from rclpy.context import Context
from rclpy.node import Node
from ros_programs import wait_for
from std_msgs.msg import Float64

from tendon_statics.node.inputs.waiting_messages import waiting_messages


@pytest.fixture
def node():
    """A node that nothing spins."""
    context = Context()
    context.init()
    node = Node('sleeper', context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def test_what_waits_is_taken_in_order(node):
    subscription = node.create_subscription(Float64, 'numbers', lambda _message: None, 10)
    publisher = node.create_publisher(Float64, 'numbers', 10)
    wait_for('the subscription', lambda: publisher.get_subscription_count() > 0)
    taken = []

    def has_come(count):
        at_once = list(waiting_messages(subscription, 2))
        assert len(at_once) <= 2
        taken.extend(at_once)
        return len(taken) >= count

    assert not list(waiting_messages(subscription, 2))
    for number in range(5):
        publisher.publish(Float64(data=float(number)))
    wait_for('five messages', lambda: has_come(5))
    assert [message.data for message, _ in taken] == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert [info['publication_sequence_number'] for _, info in taken] == [1, 2, 3, 4, 5]
