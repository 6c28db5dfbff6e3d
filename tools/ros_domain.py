"""Keeps what talks over ROS on this machine, and apart from all others that do."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch

from domain_coordinator import domain_id


@contextmanager
def own_domain() -> Iterator[int]:
    """Take a ROS domain that nobody else on this machine has, and start nothing beyond it."""
    # Entered by hand, since it would hide an exception behind one of its own.
    coordinator = domain_id()
    domain = coordinator.__enter__()
    here = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_DOMAIN_ID': str(domain)}
    try:
        # Whoever has a domain already is back in it afterwards; this one is then free for others.
        with patch.dict(os.environ, here):
            yield domain
    finally:
        coordinator.__exit__(None, None, None)
