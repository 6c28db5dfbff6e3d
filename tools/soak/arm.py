"""The estimator of an arm."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from rclpy.parameter import Parameter
from ros_programs import EXECUTOR, Program
from tendon_statics_interfaces.msg import ArmEstimate, JointRegimes

from .subject import Line, Subject

DRIVER = Path(__file__).with_name('arm_driver.py')

DROPS = {
    'not finite': ('nan',),
    'implausible': ('implausible',),
    'wrong length': ('wrong_length',),
    'out of order and repeated stamp': ('out_of_order', 'repeated_stamp'),
}
"""Reasons of the estimator → faults of the driver"""


def arm() -> Subject:
    """Return the installed arm, whose cables' tensions come all in one joint state."""
    return Subject(
        title='arm_estimator, tension_source: joint_state',
        program='arm_estimator',
        arguments=(
            *('tension_source:=joint_state', 'input_timeout:=2.0'),
            f'executor:={EXECUTOR or "single"}',
        ),
        topics=('tensions',),
        outputs={'regimes': JointRegimes, 'arm_estimate': ArmEstimate},
        estimates='arm_estimate',
        regimes='regimes',
        regime=lambda message: message.regimes[0],
        rate=100.0,
        drive=_drive,
        settings=(
            (('tension_stddev', Parameter.Type.DOUBLE, 0.01), True),
            (('cables.s_tip.gain', Parameter.Type.DOUBLE, 0.0), False),
            (('cables.l_mid.max_tension', Parameter.Type.INTEGER, 900), True),
            (('confidence', Parameter.Type.DOUBLE, 2.0), False),
        ),
        books=_books,
        messages_for_one={},
    )


@contextmanager
def _drive(count: int, rate: float, *, with_faults: bool) -> Iterator[Program]:
    given = ('--count', str(count), '--rate', str(rate), *['--with-faults'] * with_faults)
    with Program.running_command((sys.executable, DRIVER, *given)) as program:
        yield program


def _books(sent: Mapping[str, int], grown: Counter[str], came: Counter[str]) -> list[Line]:
    good = sent['good']
    invalid = sent['nan'] + sent['implausible'] + sent['wrong_length']
    results = came['regimes'] - came['regimes invalid'] - came['regimes stale']
    return [
        ('messages in', sent['messages'], grown['messages received']),
        ('readings solved', good, grown['readings solved']),
        *(
            (
                f'dropped: {reasons}',
                sum(sent[fault] for fault in faults),
                sum(grown[f'dropped: {reason}'] for reason in reasons.split(' and ')),
            )
            for reasons, faults in DROPS.items()
        ),
        ('~/arm_estimate out', good, came['arm_estimate']),
        ('~/regimes out, invalid', invalid, came['regimes invalid']),
        ('~/regimes out, of results', good, results),
    ]
