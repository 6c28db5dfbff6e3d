"""An estimator that follows a unit, or an arm, through a session, and a live page of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from ros_domain import own_domain
from ros_programs import Program, wait_for

from tendon_statics.files.installed_files import installed_config

SESSION_RATE, ARM_RATE = 10.0, 5.0
"""Rows per second at which a session is lively and still to be followed: of a unit, of an arm"""


class LiveRig(NamedTuple):
    """What runs."""

    estimator: Program
    view: Program
    url: str
    """Where the page is"""


@contextmanager
def live_rig(
    *,
    port: int = 0,
    rate: float | None = None,
    estimation: str = 'filtering',
    is_arm: bool = False,
) -> Iterator[LiveRig]:
    """Play a session over and over, on this machine only; it ends with the block.

    Parameters
    ----------
    port : int
        Of the page; 0 for any that is free.
    rate : float
        Rows per second; None: `SESSION_RATE` or `ARM_RATE`.
    estimation : str
        The estimator's parameter.
    is_arm : bool
        The example of an arm and its drive cycle, in place of a unit and the recorded session.

    Raises
    ------
    RuntimeError
        If the page cannot be served.
    """
    if is_arm:
        name, session = 'arm_estimator', _installed('arm_tensions.csv')
        design = ('-p', f'arm_file:={_installed("arm.yaml")}')
    else:
        name, session = 'estimator', _installed('recorded_session.mcap')
        design = ('--params-file', _installed('preliminary_design.yaml'))
    follow = (*design, '-p', f'estimation:={estimation}')
    rate = rate or (ARM_RATE if is_arm else SESSION_RATE)
    play = (*design, '-p', f'file:={session}', '-p', f'rate:={rate}')
    with (
        own_domain(),
        Program.running(name, '--ros-args', *follow) as estimator,
        Program.running('pulley_driver', '--ros-args', *play),
        Program.running('view', '--ros-args', '-p', f'port:={port}') as view,
    ):
        wait_for('the page', lambda: 'Ready: ' in view.output() or view.process.poll() is not None)
        _, ready, rest = view.output().partition('Ready: ')
        if not ready:
            raise RuntimeError(view.output().strip())
        yield LiveRig(estimator, view, rest.split()[0])


def _installed(name: str) -> str:
    return str(installed_config(name))
