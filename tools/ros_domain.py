"""Keeps what talks over ROS on this machine, and apart from all others that do."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from random import randint
from unittest.mock import patch

from domain_coordinator import domain_id

MOST = 100
"""Domains up to which the ports of ROS are not those that others get"""


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
    coordinator = domain_id(lambda: randint(1, MOST))
    domain = coordinator.__enter__()
    try:
        yield domain
    finally:
        coordinator.__exit__(None, None, None)


@contextmanager
def in_domain(domain: int) -> Iterator[None]:
    """Start what is started in a ROS domain, on this machine only."""
    here = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_DOMAIN_ID': str(domain)}
    with patch.dict(os.environ, here):
        yield
