"""Keeps every test on this machine and in a ROS domain of its own run."""

import os

import pytest
from hypothesis import settings

# No test is timed. In CI the same examples come each time; elsewhere each run looks for new ones.
settings.register_profile('local', deadline=None)
settings.register_profile('ci', deadline=None, derandomize=True)
settings.load_profile('ci' if os.environ.get('CI') else 'local')

# Without it `Float64(data=3)` is silently taken.
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'


def pytest_collection_modifyitems(items):
    """Mark the tests of the node: those that run a program, or listen to one."""
    for item in items:
        if 'Program' in vars(item.module) or 'listener' in item.fixturenames:
            item.add_marker(pytest.mark.node)


@pytest.fixture(scope='session', autouse=True)
def ros_domain():
    """Take a ROS domain that no other run on this machine has, and hold it to the end."""
    from ros_domain import own_domain

    with own_domain() as domain:
        yield domain


@pytest.fixture
def listener():
    """A node that keeps what the estimator publishes."""
    from ros_programs import Listener, spinning

    with spinning(Listener) as node:
        yield node
