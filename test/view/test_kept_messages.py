"""What was said before a page was opened, and still holds."""

import itertools

import pytest
from list_entities import alone
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from ros_programs import wait_for
from std_msgs.msg import String

from tendon_statics.view import newest_messages
from tendon_statics.view.newest_messages import KeptMessages

KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FORGOTTEN = QoSProfile(depth=1)


@pytest.fixture
def node():
    with alone(lambda: Node('looker')) as node:
        yield node


@pytest.fixture
def kept(node):
    kept = KeptMessages(node, String, 'regime')
    yield kept
    kept.close()


def wait_to_hear(kept, text):
    heard = []

    def has_come():
        heard.extend(message.data for message in kept.take())
        return text in heard

    wait_for(text, has_come)


def test_what_was_said_before_is_heard(node):
    node.create_publisher(String, 'regime', KEPT).publish(String(data='stale'))
    kept = KeptMessages(node, String, 'regime')
    wait_to_hear(kept, 'stale')
    assert kept.take() == []
    kept.close()


def test_what_a_publisher_says_that_comes_later_is_heard(node, kept):
    assert kept.take() == []
    node.create_publisher(String, 'regime', KEPT).publish(String(data='held'))
    wait_to_hear(kept, 'held')


def test_who_keeps_nothing_is_heard_too(node, kept, monkeypatch):
    monkeypatch.setattr(newest_messages, 'LOOK_PERIOD', 0.0)
    publisher = node.create_publisher(String, 'regime', KEPT)
    publisher.publish(String(data='held'))
    wait_to_hear(kept, 'held')
    node.destroy_publisher(publisher)
    publisher, numbers = node.create_publisher(String, 'regime', FORGOTTEN), itertools.count()

    def is_heard():
        publisher.publish(String(data=f'said {next(numbers)}'))
        return bool(kept.take())

    wait_for('what is not kept', is_heard)


@pytest.mark.parametrize(
    'reliability', [ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT]
)
def test_what_is_said_once_is_asked_for_as_reliably_as_it_is_given(node, monkeypatch, reliability):
    monkeypatch.setattr(newest_messages, 'LOOK_PERIOD', 0.0)
    node.create_publisher(String, 'regime', QoSProfile(depth=1, reliability=reliability))
    kept = KeptMessages(node, String, 'regime')

    def asked():
        kept.take()
        (found,) = node.get_subscriptions_info_by_topic('regime')
        return found.qos_profile.reliability

    wait_for('the subscription that fits', lambda: asked() is reliability)
    kept.close()
