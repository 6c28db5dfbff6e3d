"""Keeps what talks over ROS on this machine, and apart from all others that do."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from domain_coordinator import domain_id


@contextmanager
def own_domain() -> Iterator[int]:
    """Take a ROS domain that nobody else on this machine has, and start nothing beyond it."""
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    # Entered by hand, since it would hide an exception behind one of its own.
    coordinator = domain_id()
    domain = coordinator.__enter__()
    os.environ['ROS_DOMAIN_ID'] = str(domain)
    try:
        yield domain
    finally:
        coordinator.__exit__(None, None, None)
