"""`LoneThreadExecutor`: entities are gathered once for a callback; other threads wake it."""

import threading

import pytest
from rclpy.context import Context
from rclpy.node import Node

from tendon_statics.node.lone_thread_executor import LoneThreadExecutor

CALLBACKS = 20

LONG_ENOUGH = 30.0
"""s, for an executor that should have been woken at once"""


class CountingExecutor(LoneThreadExecutor):
    """Counts how often all that there is to wait for is gathered."""

    gathered = 0

    def get_nodes(self):
        self.gathered += 1
        return super().get_nodes()


@pytest.fixture
def executor():
    context = Context()
    context.init()
    executor = CountingExecutor(context=context)
    yield executor
    executor.shutdown()
    context.try_shutdown()


@pytest.fixture
def node(executor):
    node = Node('lone', context=executor.context)
    executor.add_node(node)
    yield node
    node.destroy_node()


def test_entities_are_gathered_once_for_a_callback(executor, node):
    calls = []
    node.create_timer(0.005, lambda: calls.append(executor.gathered))
    while len(calls) < CALLBACKS:
        executor.spin_once()
    assert calls[-1] - calls[0] == CALLBACKS - 1


def test_what_a_callback_asks_for_is_done_though_it_wakes_nobody(executor, node):
    done = []

    def call_once():
        timer.cancel()
        executor.create_task(done.append, 'task')
        node.create_timer(0.001, lambda: done.append('timer'))

    timer = node.create_timer(0.001, call_once)
    for _ in range(CALLBACKS):
        executor.spin_once(timeout_sec=LONG_ENOUGH)
        if {'task', 'timer'} <= set(done):
            return
    pytest.fail(f'only {done} was done')


def test_another_thread_wakes_it(executor):
    done = []
    executor.spin_once(timeout_sec=0.0)
    other = threading.Thread(target=lambda: executor.create_task(done.append, 'task'))
    other.start()
    executor.spin_once(timeout_sec=LONG_ENOUGH)
    other.join()
    assert done == ['task']
