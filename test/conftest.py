"""Keeps every test on this machine and in a ROS domain of its own worker."""

import gc
import os
import signal
from dataclasses import asdict

import pytest
import thoroughness  # noqa: F401  which chooses hypothesis's profile

# All cores are taken by workers and programs; threads beyond that wait for one another, at full
# load, in every decomposition of a small matrix.
os.environ.setdefault('OMP_NUM_THREADS', '1')

# In the background a shell has a program ignore Ctrl-C, and with it those that this one starts.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Without it `Float64(data=3)` is silently taken.
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'


LISTENERS = {'listener', 'running', 'filtering'}
"""Fixtures that listen to an estimator"""

OVER_ROS = {'Program', 'ForkedProgram', 'Listener', 'ArmClient', 'spinning'}
"""What a module of tests of the node imports, of these"""


def pytest_xdist_auto_num_workers(config):
    """Two workers a core, since tests of the node mostly wait for one another's processes.

    Without these one, as each takes some seconds to load what it tests; and one in CI, where
    nobody waits and other work may be on the same cores.

    More than 16 gain little, and each has processes and a ROS domain of its own.
    """
    a_core = 1 if config.option.markexpr == 'not node' or os.environ.get('CI') else 2
    return min(a_core * len(os.sched_getaffinity(0)), 16)


def pytest_collection_modifyitems(items):
    """Mark the tests of the node: those that run a program, or listen to one; and a browser's."""
    for item in items:
        uses_ros = not OVER_ROS.isdisjoint(vars(item.module))
        if uses_ros or not LISTENERS.isdisjoint(item.fixturenames):
            item.add_marker(pytest.mark.node)
        if 'browser' in item.fixturenames:
            item.add_marker(pytest.mark.browser)


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Leave what is loaded by then alone: looking for garbage in it takes long and finds none.

    In what the tests make, too, it is looked for less often than in a program that goes on.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.collect()
        gc.freeze()
        gc.set_threshold(50_000, 20, 100)
        gc.enable()


@pytest.fixture(scope='session', autouse=True)
def ros_domain():
    """Take a ROS domain that nobody else on this machine has, and hold it to the end.

    Each worker of a run has one.
    """
    from ros_domain import own_domain

    with own_domain() as domain:
        yield domain


@pytest.fixture(scope='module')
def browser():
    """A real one without a window; a test is left out where there is none, but in CI."""
    from browser import BrowserMissingError, chromium

    try:
        with chromium() as browser:
            yield browser
    except BrowserMissingError as error:
        if os.environ.get('CI'):
            raise
        pytest.skip(str(error))


@pytest.fixture
def listener():
    """A node that keeps what the estimator publishes."""
    from listener import Listener
    from ros_programs import spinning

    with spinning(Listener) as node:
        yield node


@pytest.fixture(scope='module')
def shared_listener():
    """A listener and, in a domain that is theirs, an estimator with its defaults."""
    from listener import Listener
    from own_estimator import own_estimator

    with own_estimator(Listener) as listener:
        yield listener


@pytest.fixture
def running(shared_listener):
    """A listener whose estimator runs already; what a test sets is set back."""
    from designs import PRELIMINARY
    from ros_programs import wait_for

    yield shared_listener
    design = {f'design__{name}': value for name, value in asdict(PRELIMINARY).items()}
    result = shared_listener.set_estimator_parameters(**design, tension_stddev=0.01)
    assert result.successful, result.reason
    wait_for('the rest of the answers', shared_listener.has_all)
    shared_listener.forget()
