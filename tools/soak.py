"""Stream faulty tensions at the estimator for minutes, and balance the books.

A stand-in driver and the estimator run as processes of their own, on this machine only, with each
kind of messages of tensions in turn. What the driver says it sent, what the estimator says came of
it and what arrived on its topics must agree, though parameters are set all the time; then drivers
are killed, and every message has to be accounted for. Memory is measured on the way. The exit code
is 1 if the books do not balance or memory grows.
"""

from __future__ import annotations

import argparse
import itertools
import signal
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.srv import SetParameters
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for
from std_msgs.msg import Float64, String
from tendon_statics_interfaces.msg import Estimate

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.files.cable_parameters import TENSION_SOURCES
from tendon_statics.tensions.reason import Reason

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

TOPICS = {
    'array': ('tensions',),
    'joint_state': ('tensions',),
    'wrench_pair': ('tension_l', 'tension_s'),
}

SETTINGS: tuple[tuple[tuple[tuple[str, Parameter.Type, float], ...], bool], ...] = (
    ((('tension_stddev', Parameter.Type.DOUBLE, 0.01),), True),
    ((('design.mass', Parameter.Type.DOUBLE, -1.0),), False),
    ((('design.contact_start_angle', Parameter.Type.DOUBLE, 1.6),), True),  # waits
    ((('design.gravity', Parameter.Type.INTEGER, -5),), False),
    ((('design.contact_start_angle', Parameter.Type.DOUBLE, 1.0471975511965976),), True),
)
"""What is set all the time, and whether it is to be taken"""

OF_CONTENT = tuple(reason for reason in Reason if reason.is_of_content)

REASONS = tuple(f'dropped: {reason.value}' for reason in Reason)

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
        self.settings: Counter[str] = Counter()
        """How parameters were set: as expected, or otherwise"""
        self.set_parameters_client = self.create_client(SetParameters, 'estimator/set_parameters')
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

    def grown_since(self, before: dict[str, int]) -> Counter[str]:
        """Return by how much the estimator's counts have grown."""
        return Counter({key: value - before.get(key, 0) for key, value in self.counts.items()})

    def is_quiet(self) -> bool:
        """Whether nothing came between the last two reports."""
        return self._is_quiet


def main() -> int:
    """Run the soak; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=float, default=5.0, help='default: %(default)s')
    parser.add_argument(
        '--kind', choices=TENSION_SOURCES, help='default: all, one after the other'
    )
    options = parser.parse_args()
    if not 0.05 <= options.minutes <= 10_000.0:
        parser.error('--minutes takes 0.05 to 10000')
    kinds = (options.kind,) if options.kind else TENSION_SOURCES
    code = 0
    with tempfile.TemporaryDirectory() as folder:
        recording = Path(folder, 'recording.csv')
        recording.write_text('tension_l,tension_s\n' + ''.join(rows()), encoding='utf-8')
        for kind in kinds:
            print(f'\n== tension_source: {kind}\n', flush=True)
            with own_domain(), spinning(Observer) as observer:
                code |= soak(observer, recording, kind, options.minutes / len(kinds))
    return code


def soak(observer: Observer, recording: Path, kind: str, minutes: float) -> int:
    """Stream for so many minutes, a fifth of it with drivers that die, and print what came of it.

    All the time parameters are set: some that are valid, some that are not, and some that only fit
    together with others. None of them changes what is sound.
    """
    # Every message is to count, also on a busy machine.
    overrides = [
        *(f'/{topic}.subscription.reliability:=reliable' for topic in TOPICS[kind]),
        *(f'/estimator/{name}.publisher.depth:=5000' for name in OUTPUTS),
    ]
    quality = [part for rule in overrides for part in ('-p', f'qos_overrides.{rule}')]
    # Closer than two readings, so that what has lost its partner finds no other.
    source = ('-p', f'tension_source:={kind}', '-p', 'max_skew:=0.0005')
    with Program.running('estimator', '--ros-args', *source, *quality) as estimator:
        # To its end, so that no half of a pair is left.
        with driver(recording, kind, count=300, rate=100.0) as made:
            wait_for('the estimator', lambda: observer.came['estimate'] > 0)
            wait_for('the end of it', lambda: 'Sent: ' in made.output())
            wait_for('its reports', lambda: observer.counts)
        wait_for('the last of them', observer.is_quiet)
        before, came = dict(observer.counts), observer.came.copy()
        memory = [estimator.memory()]
        count = round(0.8 * minutes * 60.0 * RATE)
        faults = faults_of(kind)
        with meddling(observer), driver(recording, kind, count=count, rate=RATE, **faults) as made:
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
        grown = observer.grown_since(before)
        came = observer.came - came
        settings = Counter(observer.settings)
        killed = kill_drivers(observer, recording, kind, 0.2 * minutes * 60.0)
        memory.append(estimator.memory())
        books = observer.grown_since(before)
        code = estimator.end()
    return report(kind, sent, grown, came, memory, code, settings) | report_killed(
        kind, killed, books
    )


def kill_drivers(observer: Observer, recording: Path, kind: str, seconds: float) -> int:
    """Let drivers begin and kill them in the midst of it, for so long; return how many."""
    deadline = time.monotonic() + seconds
    killed = 0
    while time.monotonic() < deadline or killed == 0:
        known = observer.came['estimate']
        with driver(recording, kind, count=0, rate=RATE, **faults_of(kind)) as made:
            wait_for('estimates', lambda n=known: observer.came['estimate'] > n + 100)
            made.end(signal.SIGKILL)
        killed += 1
        wait_for('all that is out', observer.is_quiet)
    return killed


@contextmanager
def meddling(observer: Observer) -> Iterator[None]:
    """Set parameters all the time, as clients do that know no better."""
    ended = threading.Event()

    def meddle() -> None:
        for values, is_taken in itertools.cycle(SETTINGS):
            if ended.wait(0.2):
                return
            parameters = [Parameter(*pair).to_parameter_msg() for pair in values]
            asked = observer.set_parameters_client.call_async(
                SetParameters.Request(parameters=parameters)
            )
            wait_for('an answer', asked.done)
            results = asked.result().results
            as_expected = all(result.successful == is_taken for result in results)
            observer.settings['as expected' if as_expected else 'otherwise'] += 1

    thread = threading.Thread(target=meddle)
    wait_for('the service', observer.set_parameters_client.service_is_ready)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def report(
    kind: str,
    sent: dict[str, int],
    grown: Counter[str],
    came: Counter[str],
    memory: list[float],
    code: int,
    settings: Counter[str],
) -> int:
    """Print the books; return 1 if they do not balance."""
    good = sent['good'] + sent['slack']
    # Of cable l the name is missing too, so that its message waits for a partner in vain.
    wrong = grown['dropped: wrong length']
    # Of load cells both messages of a pair are late.
    each = {'out of order and repeated stamp': len(TOPICS[kind])}
    invalid = sent['nan_burst'] + sent['implausible'] + wrong
    lines = [
        ('messages in', sent['messages'], grown['messages received']),
        ('pairs solved', good, grown['pairs solved']),
        *(
            (
                f'dropped: {reasons}',
                each.get(reasons, 1) * sum(sent[fault] for fault in faults),
                grown[key],
            )
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
        ('parameters set otherwise than expected', 0, settings['otherwise']),
        ('exit code', 0, code),
    ]
    shown = [
        (what, str(expected), str(found), '' if expected == found else 'differs')
        for what, expected, found in lines
    ]
    print(markdown_table(('', 'sent or expected:', 'estimator:', ''), shown))
    print(
        f'\n~/bend_angle out: {came["bend_angle"]}; stale: {came["regime stale"]} times; '
        f'skipped by the driver, that was too slow: {sent["skipped"]}; parameters were set '
        f'{settings.total()} times'
    )
    print(
        f'memory (RSS): {memory[0]:.1f} MB at the start, {memory[len(memory) // 2]:.1f} MB '
        f'halfway, {memory[-1]:.1f} MB at the end, {max(memory):.1f} MB at most; allowed are '
        f'{MOST_GROWTH:.0f} MB more than at the start'
    )
    balanced = all(expected == found for _, expected, found in lines)
    return 0 if balanced and max(memory) <= memory[0] + MOST_GROWTH else 1


def report_killed(kind: str, killed: int, books: Counter[str]) -> int:
    """Print what is left of drivers that were killed; return 1 if the estimator lost count."""
    dropped = sum(count for key, count in books.items() if key in REASONS)
    # A pair of load cells is two messages, and counts once where it is solved or invalid.
    of_pairs = books['pairs solved'] + sum(books[f'dropped: {of.value}'] for of in OF_CONTENT)
    accounted = books['pairs solved'] + dropped + (of_pairs if kind == 'wrench_pair' else 0)
    # One message of a cable may wait for its partner; joint states of one cable wait likewise.
    waiting = books['messages received'] - accounted
    print(
        f'{killed} drivers were killed; of {books["messages received"]} messages in all '
        f'{accounted} are accounted for, and {waiting} wait for a partner'
    )
    return 0 if 0 <= waiting <= 2 else 1


def faults_of(kind: str) -> dict[str, float]:
    """Return the faults of a kind of messages; an array has no stamp that could be wrong."""
    stamps = ('out_of_order_probability', 'repeated_stamp_probability')
    return {name: of for name, of in FAULTS.items() if kind != 'array' or name not in stamps}


def rows() -> Iterator[str]:
    """Tensions of every regime but slack, which the driver makes."""
    for index in range(400):
        yield f'1.0,{1.2 + 0.003 * index:.4f}\n'


@contextmanager
def driver(recording: Path, kind: str, **parameters: float) -> Iterator[Program]:
    """Run a stand-in driver, which begins when it is heard."""
    values = {
        'file': str(recording),
        'tension_source': kind,
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
