"""An estimator that follows a unit through the recorded session, and a live page of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from ros_domain import own_domain
from ros_programs import Program, wait_for

from tendon_statics.files.installed_files import installed_config

SESSION_RATE = 10.0
"""Rows per second at which the session is lively and still to be followed"""


class LiveRig(NamedTuple):
    """What runs."""

    estimator: Program
    view: Program
    url: str
    """Where the page is"""


@contextmanager
def live_rig(
    *, port: int = 0, rate: float = SESSION_RATE, estimation: str = 'filtering'
) -> Iterator[LiveRig]:
    """Play the recorded session over and over, on this machine only; it ends with the block.

    Parameters
    ----------
    port : int
        Of the page; 0 for any that is free.
    rate : float
        Rows per second.
    estimation : str
        The estimator's parameter.

    Raises
    ------
    RuntimeError
        If the page cannot be served.
    """
    session, design = (
        str(installed_config(name))
        for name in ('recorded_session.mcap', 'preliminary_design.yaml')
    )
    follow = ('--params-file', design, '-p', f'estimation:={estimation}')
    play = ('-p', f'file:={session}', '-p', f'rate:={rate}')
    with (
        own_domain(),
        Program.running('estimator', '--ros-args', *follow) as estimator,
        Program.running('pulley_driver', '--ros-args', *play),
        Program.running('view', '--ros-args', '-p', f'port:={port}') as view,
    ):
        wait_for('the page', lambda: 'Ready: ' in view.output() or view.process.poll() is not None)
        _, ready, rest = view.output().partition('Ready: ')
        if not ready:
            raise RuntimeError(view.output().strip())
        yield LiveRig(estimator, view, rest.split()[0])
