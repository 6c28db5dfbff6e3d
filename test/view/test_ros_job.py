"""What is asked of ROS while a signal may end it at any moment."""

import pytest
from rclpy.context import Context
from rclpy.node import Node

from tendon_statics.view.ros_job import ros_job


@pytest.fixture
def context():
    context = Context()
    context.init()
    yield context
    context.try_shutdown()


def test_what_fails_since_ros_has_ended_in_its_midst_is_let_be(context):
    node = Node('looks_around', context=context)

    def look_around():
        context.shutdown()
        node.get_topic_names_and_types()

    ros_job(context, look_around)()
    node.destroy_node()


def test_what_fails_while_ros_runs_is_an_error(context):
    def fail():
        raise RuntimeError('a fault')

    with pytest.raises(RuntimeError, match='a fault'):
        ros_job(context, fail)()


def test_nothing_is_done_once_ros_has_ended(context):
    done = []
    job = ros_job(context, lambda: done.append(True))
    job()
    context.shutdown()
    job()
    assert done == [True]
