"""The estimator of one unit, with each kind of messages of tensions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from rclpy.parameter import Parameter
from ros_programs import Program
from std_msgs.msg import Float64, String
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.files.cable_parameters import TENSION_SOURCES
from tendon_statics.tensions.reason import Reason

from .subject import Line, Setting, Subject

FAULTS = {
    'noise_stddev': 0.002,
    'dropout_probability': 0.01,
    'nan_burst_probability': 0.0005,
    'nan_burst_length': 50,
    'out_of_order_probability': 0.01,
    'repeated_stamp_probability': 0.01,
    'wrong_length_probability': 0.01,
    'slack_probability': 0.0002,
    'slack_length': 200,
    'implausible_probability': 0.001,
}

TOPICS = {
    'array': ('tensions',),
    'joint_state': ('tensions',),
    'wrench_pair': ('tension_l', 'tension_s'),
}

SETTINGS: tuple[tuple[Setting, bool], ...] = (
    (('tension_stddev', Parameter.Type.DOUBLE, 0.01), True),
    (('design.mass', Parameter.Type.DOUBLE, -1.0), False),
    (('design.contact_start_angle', Parameter.Type.DOUBLE, 1.6), True),  # waits
    (('design.gravity', Parameter.Type.INTEGER, -5), False),
    (('design.contact_start_angle', Parameter.Type.DOUBLE, 1.0471975511965976), True),
)

OF_CONTENT = tuple(reason for reason in Reason if reason.is_of_content)

DROPS = {
    'not finite': ('nan_burst',),
    'implausible': ('implausible',),
    'wrong length and unpaired': ('wrong_length',),
    'out of order and repeated stamp': ('out_of_order', 'repeated_stamp'),
}
"""Reasons of the estimator → faults of the driver"""


def units(folder: Path) -> list[Subject]:
    """Return one subject for each kind of messages; their recording is put in a folder."""
    recording = folder / 'recording.csv'
    recording.write_text('tension_l,tension_s\n' + ''.join(_rows()), encoding='utf-8')
    return [_unit(kind, recording) for kind in TENSION_SOURCES]


def _unit(kind: str, recording: Path) -> Subject:
    @contextmanager
    def drive(count: int, rate: float, *, with_faults: bool) -> Iterator[Program]:
        values = {
            'file': str(recording),
            'tension_source': kind,
            'awaited_subscribers': 1,
            'count': count,
            'rate': rate,
            **(_faults_of(kind) if with_faults else {}),
        }
        arguments = [part for name, value in values.items() for part in ('-p', f'{name}:={value}')]
        with Program.running('pulley_driver', '--ros-args', *arguments) as program:
            yield program

    def books(sent: Mapping[str, int], grown: Counter[str], came: Counter[str]) -> list[Line]:
        good = sent['good'] + sent['slack']
        # Of cable l the name is missing too, so that its message waits for a partner in vain.
        wrong = grown['dropped: wrong length']
        # Of load cells both messages of a pair are late.
        each = {'out of order and repeated stamp': len(TOPICS[kind])}
        invalid = sent['nan_burst'] + sent['implausible'] + wrong
        return [
            ('messages in', sent['messages'], grown['messages received']),
            ('pairs solved', good, grown['pairs solved']),
            *(
                (
                    f'dropped: {reasons}',
                    each.get(reasons, 1) * sum(sent[fault] for fault in faults),
                    sum(grown[f'dropped: {reason}'] for reason in reasons.split(' and ')),
                )
                for reasons, faults in DROPS.items()
            ),
            ('~/estimate out', good, came['estimate']),
            ('~/regime out, invalid', invalid, came['regime invalid']),
            (
                '~/regime out, of results',
                good,
                came['regime'] - came['regime invalid'] - came['regime stale'],
            ),
        ]

    counted = ('pairs solved', *(f'dropped: {reason.value}' for reason in OF_CONTENT))
    return Subject(
        title=f'estimator, tension_source: {kind}',
        program='estimator',
        # A pair has one stamp. What has lost its partner must find no other, though a driver that
        # catches up sends the next reading within microseconds.
        arguments=(f'tension_source:={kind}', 'max_skew:=0.0'),
        topics=TOPICS[kind],
        outputs={'regime': String, 'bend_angle': Float64, 'estimate': Estimate},
        estimates='estimate',
        regimes='regime',
        regime=lambda message: message.data,
        rate=500.0,
        drive=drive,
        settings=SETTINGS,
        books=books,
        # A pair of load cells is two messages, and counts once where it is solved or invalid.
        messages_for_one=dict.fromkeys(counted, len(TOPICS[kind])),
    )


def _faults_of(kind: str) -> dict[str, float]:
    """Return the faults of a kind of messages; an array has no stamp that could be wrong."""
    stamps = ('out_of_order_probability', 'repeated_stamp_probability')
    return {name: of for name, of in FAULTS.items() if kind != 'array' or name not in stamps}


def _rows() -> Iterator[str]:
    """Tensions of every regime but slack, which the driver makes."""
    for index in range(400):
        yield f'1.0,{1.2 + 0.003 * index:.4f}\n'
