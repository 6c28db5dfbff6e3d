"""Keeps every test on this machine and in a ROS domain of its own worker."""

import os

import pytest
import thoroughness  # noqa: F401  which chooses hypothesis's profile

# Without it `Float64(data=3)` is silently taken.
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'


def pytest_xdist_auto_num_workers():
    """Two workers a core, since tests of the node mostly wait for one another's processes."""
    return 2 * len(os.sched_getaffinity(0))


def pytest_collection_modifyitems(items):
    """Mark the tests of the node: those that run a program, or listen to one."""
    for item in items:
        if 'Program' in vars(item.module) or 'listener' in item.fixturenames:
            item.add_marker(pytest.mark.node)


@pytest.fixture(scope='session', autouse=True)
def ros_domain():
    """Take a ROS domain that nobody else on this machine has, and hold it to the end.

    Each worker of a run has one.
    """
    from ros_domain import own_domain

    with own_domain() as domain:
        yield domain


@pytest.fixture
def listener():
    """A node that keeps what the estimator publishes."""
    from ros_programs import Listener, spinning

    with spinning(Listener) as node:
        yield node
