"""An estimator that several tests share, apart from what else they start."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import TypeVar

from arm_client import ArmClient
from listener import Listener
from rclpy.context import Context
from ros_domain import free_domain, in_domain
from ros_programs import spinning

Client = TypeVar('Client', Listener, ArmClient)


@contextmanager
def own_estimator(make: Callable[[Context], Client], *arguments: str) -> Iterator[Client]:
    """Run an estimator in a domain of its own; give the client that it is connected with.

    Parameters
    ----------
    make : callable
        Makes the client.
    arguments : str
        Of the estimator.
    """
    with free_domain() as domain, ExitStack() as stack:
        # Only they: what a test starts beside them starts in the domain of the run.
        with in_domain(domain):
            client = stack.enter_context(spinning(make))
            stack.enter_context(client.estimator(*arguments))
        yield client
