"""`own_domain`: nobody else has it, and it is left when it is given back."""

import os

from ros_domain import own_domain


def test_a_domain_within_another_leaves_that_as_it_was(ros_domain):
    assert os.environ['ROS_DOMAIN_ID'] == str(ros_domain)
    with own_domain() as other:
        assert other != ros_domain
        assert os.environ['ROS_DOMAIN_ID'] == str(other)
    assert os.environ['ROS_DOMAIN_ID'] == str(ros_domain)
