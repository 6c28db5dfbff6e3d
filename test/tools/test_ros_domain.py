"""`own_domain`: nobody else has it, and it is left when it is given back."""

import os

from rclpy.node import Node
from ros_domain import free_domain, in_domain, is_silent, own_domain
from ros_programs import spinning, wait_for


def test_a_domain_within_another_leaves_that_as_it_was(ros_domain):
    assert os.environ['ROS_DOMAIN_ID'] == str(ros_domain)
    with own_domain() as other:
        assert other != ros_domain
        assert os.environ['ROS_DOMAIN_ID'] == str(other)
    assert os.environ['ROS_DOMAIN_ID'] == str(ros_domain)


def test_a_domain_in_which_somebody_is_who_took_none_is_not_silent():
    with free_domain() as domain, in_domain(domain):
        assert is_silent(domain)
        with spinning(lambda context: Node('stranger', context=context)):
            assert not is_silent(domain)
        wait_for('it to be left', lambda: is_silent(domain))
