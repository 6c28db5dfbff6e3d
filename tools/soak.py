"""Stream faulty tensions at the estimator for minutes, and balance the books.

A stand-in driver and the estimator run as processes of their own, on this machine only. What the
driver says it sent, what the estimator says came of it and what arrived on its topics must agree;
memory is measured on the way. The exit code is 1 if the books do not balance or memory grows.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.context import Context
from rclpy.node import Node
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from std_msgs.msg import Float64, String
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.command_line.tables import markdown_table

OUTPUTS = {'regime': String, 'bend_angle': Float64, 'estimate': Estimate}
"""Topics that are counted → type"""

RATE = 500.0
"""Hz"""

MOST_GROWTH = 5.0
"""MB"""

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

DROPS = {
    'not finite': ('nan_burst',),
    'implausible': ('implausible',),
    'wrong length and unpaired': ('wrong_length',),
    'out of order and repeated stamp': ('out_of_order', 'repeated_stamp'),
}
"""Reasons of the estimator → faults of the driver"""


class Observer(Node):
    """Counts what the estimator publishes and keeps what it says of itself."""

    def __init__(self, context: Context) -> None:
        super().__init__('observer', context=context)
        self.came: Counter[str] = Counter()
        self.counts: dict[str, int] = {}
        self._is_quiet = False
        for name, kind in OUTPUTS.items():
            self.create_subscription(
                kind,
                f'estimator/{name}',
                lambda message, name=name: self._count(name, message),
                5000,
            )
        self.create_subscription(DiagnosticArray, '/diagnostics', self._keep, 100)

    def _count(self, name: str, message: String | Float64 | Estimate) -> None:
        self.came[name] += 1
        if name == 'regime':
            self.came[f'regime {message.data}'] += 1

    def _keep(self, message: DiagnosticArray) -> None:
        values = {item.key: item.value for item in message.status[0].values}
        counted = {key: int(value) for key, value in values.items() if value.isdigit()}
        for reasons in DROPS:
            keys = [f'dropped: {reason}' for reason in reasons.split(' and ')]
            counted[f'dropped: {reasons}'] = sum(int(values[key]) for key in keys)
        key = 'messages received'
        self._is_quiet = counted[key] == self.counts.get(key)
        self.counts = counted

    def is_quiet(self) -> bool:
        """Whether nothing came between the last two reports."""
        return self._is_quiet


def main() -> int:
    """Run the soak; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=float, default=5.0, help='default: %(default)s')
    minutes = parser.parse_args().minutes
    if not 0.05 <= minutes <= 10_000.0:
        parser.error('--minutes takes 0.05 to 10000')
    with own_domain(), spinning(Observer) as observer, tempfile.TemporaryDirectory() as folder:
        return soak(observer, Path(folder), minutes)


def soak(observer: Observer, folder: Path, minutes: float) -> int:
    """Stream for so many minutes and print what came of it."""
    recording = folder / 'recording.csv'
    recording.write_text('tension_l,tension_s\n' + ''.join(rows()), encoding='utf-8')
    # Every message is to count, also on a busy machine.
    overrides = [
        '/tensions.subscription.reliability:=reliable',
        *(f'/estimator/{name}.publisher.depth:=5000' for name in OUTPUTS),
    ]
    quality = [part for rule in overrides for part in ('-p', f'qos_overrides.{rule}')]
    kind = ('-p', 'tension_source:=joint_state')
    with Program.running('estimator', '--ros-args', *kind, *quality) as estimator:
        with driver(recording, count=0, rate=100.0):
            wait_for('the estimator', lambda: observer.came['estimate'] > 0)
            wait_for('its reports', lambda: observer.counts)
        wait_for('the last of them', observer.is_quiet)
        before, came = dict(observer.counts), observer.came.copy()
        memory = [estimator.memory()]
        count = round(minutes * 60.0 * RATE)
        with driver(recording, count=count, rate=RATE, **FAULTS) as made:
            deadline = time.monotonic() + 120.0 * minutes + 60.0
            while 'Sent: ' not in made.output():
                if time.monotonic() > deadline or estimator.process.poll() is not None:
                    raise TimeoutError(f'the stream did not come to its end: {estimator.output()}')
                memory.append(estimator.memory())
                time.sleep(1.0)
            sent = made.sent()
            memory.append(estimator.memory())
            # Until then the driver must be there, since what is on the way ends with it.
            wait_for('all that is out', observer.is_quiet)
        code = estimator.end()
    grown = Counter({key: value - before.get(key, 0) for key, value in observer.counts.items()})
    return report(sent, grown, observer.came - came, memory, code)


def report(
    sent: dict[str, int],
    grown: Counter[str],
    came: Counter[str],
    memory: list[float],
    code: int,
) -> int:
    """Print the books; return 1 if they do not balance."""
    good = sent['good'] + sent['slack']
    # Of cable l the name is missing too, so that its message waits for a partner in vain.
    wrong = grown['dropped: wrong length']
    invalid = sent['nan_burst'] + sent['implausible'] + wrong
    lines = [
        ('messages in', sent['messages'], grown['messages received']),
        ('pairs solved', good, grown['pairs solved']),
        *(
            (f'dropped: {reasons}', sum(sent[fault] for fault in faults), grown[key])
            for reasons, faults in DROPS.items()
            for key in (f'dropped: {reasons}',)
        ),
        ('messages lost on the way', 0, grown['messages lost on the way']),
        ('~/estimate out', good, came['estimate']),
        ('~/regime out, invalid', invalid, came['regime invalid']),
        (
            '~/regime out, of results',
            good,
            came['regime'] - came['regime invalid'] - came['regime stale'],
        ),
        ('exit code', 0, code),
    ]
    shown = [
        (what, str(expected), str(found), '' if expected == found else 'differs')
        for what, expected, found in lines
    ]
    print(markdown_table(('', 'sent or expected:', 'estimator:', ''), shown))
    print(
        f'\n~/bend_angle out: {came["bend_angle"]}; stale: {came["regime stale"]} times; '
        f'skipped by the driver, that was too slow: {sent["skipped"]}'
    )
    print(
        f'memory (RSS): {memory[0]:.1f} MB at the start, {memory[-1]:.1f} MB at the end, '
        f'{max(memory):.1f} MB at most; allowed are {MOST_GROWTH:.0f} MB more than at the start'
    )
    balanced = all(expected == found for _, expected, found in lines)
    return 0 if balanced and max(memory) <= memory[0] + MOST_GROWTH else 1


def rows() -> Iterator[str]:
    """Tensions of every regime but slack, which the driver makes."""
    for index in range(400):
        yield f'1.0,{1.2 + 0.003 * index:.4f}\n'


@contextmanager
def driver(recording: Path, **parameters: float) -> Iterator[Program]:
    """Run a stand-in driver, which begins when it is heard."""
    values = {
        'file': str(recording),
        'tension_source': 'joint_state',
        'awaited_subscribers': 1,
        **parameters,
    }
    arguments = [part for name, value in values.items() for part in ('-p', f'{name}:={value}')]
    with Program.running('pulley_driver', '--ros-args', *arguments) as program:
        yield program


if __name__ == '__main__':
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit('soak interrupted')
    except (TimeoutError, AssertionError) as error:
        sys.exit(f'soak failed: {error}')
