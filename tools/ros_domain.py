"""Keeps what talks over ROS on this machine, and apart from all others that do."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from random import randint
from unittest.mock import patch

from domain_coordinator import domain_id

MOST = 100
"""Domains up to which the ports of ROS are not those that others get"""

PROCESSES = 32
"""Of one domain, of which each has ports of its own"""


@contextmanager
def own_domain() -> Iterator[int]:
    """Take a ROS domain that nobody else on this machine has, and start nothing beyond it."""
    # Whoever has a domain already is back in it afterwards; this one is then free for others.
    with free_domain() as domain, in_domain(domain):
        yield domain


@contextmanager
def free_domain() -> Iterator[int]:
    """Hold a ROS domain that nobody else on this machine has."""
    # At random, since in one that was just given back a node that was killed may still be known.
    # Entered by hand, since it would hide an exception behind one of its own.
    coordinator = domain_id(_silent_domain)
    domain = coordinator.__enter__()
    try:
        yield domain
    finally:
        coordinator.__exit__(None, None, None)


def _silent_domain() -> int:
    """Draw until nobody is in the domain, since a program started by hand takes none in turn."""
    while not is_silent(domain := randint(1, MOST)):
        pass
    return domain


def is_silent(domain: int) -> bool:
    """Whether no process on this machine listens in a ROS domain.

    Each has a UDP port by which the others discover it (RTPS 2.5, 9.6.2.3).
    """
    first = 7400 + 250 * domain + 10
    return all(_is_unbound(first + 2 * number) for number in range(PROCESSES))


def _is_unbound(port: int) -> bool:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(('', port))
        except OSError:
            return False
    return True


@contextmanager
def in_domain(domain: int) -> Iterator[None]:
    """Start what is started in a ROS domain, on this machine only."""
    here = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_DOMAIN_ID': str(domain)}
    with patch.dict(os.environ, here):
        yield
