"""Stream faulty tensions at the estimators for minutes, and balance the books.

A driver and an estimator run as processes of their own, on this machine only: that of a unit with
each kind of messages of tensions in turn, then that of an arm. What the driver says it sent, what
the estimator says came of it and what arrived on its topics must agree, though parameters are set
all the time; then drivers are killed, and every message has to be accounted for. Memory is
measured on the way. The exit code is 1 if the books do not balance or memory grows.
"""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from ros_domain import own_domain
from ros_programs import Program, spinning, wait_for

from tendon_statics.command_line.tables import markdown_table
from tendon_statics.tensions.reason import Reason

from .arm import arm
from .observer import Observer
from .subject import Subject
from .units import units

MOST_GROWTH = 5.0
"""MB, once all that is filled once is filled"""

WARM_UP = 0.1
"""Share of the stream in which that happens"""

LATE = 600.0
"""Seconds to wait for what waits in queues, where others have the processor"""

ACCOUNTED = ('pairs solved', 'readings solved', *(f'dropped: {reason.value}' for reason in Reason))


def main() -> int:
    """Run the soak; return the exit code."""
    parser = argparse.ArgumentParser(prog='soak', description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=float, default=5.0, help='default: %(default)s')
    parser.add_argument('--only', default='', metavar='TEXT', help='what has this in its title')
    options = parser.parse_args()
    if not 0.05 <= options.minutes <= 10_000.0:
        parser.error('--minutes takes 0.05 to 10000')
    with tempfile.TemporaryDirectory() as folder:
        known = [*units(Path(folder)), arm()]
        subjects = [subject for subject in known if options.only in subject.title]
        if not subjects:
            titles = '; '.join(subject.title for subject in known)
            parser.error(f'--only takes a part of one of these: {titles}')
        code = 0
        for subject in subjects:
            print(f'\n== {subject.title}\n', flush=True)
            with (
                own_domain(),
                spinning(lambda context, of=subject: Observer(context, of)) as observer,
            ):
                code |= soak(observer, subject, 60.0 * options.minutes / len(subjects))
    return code


def soak(observer: Observer, subject: Subject, seconds: float) -> int:
    """Stream for so long, a fifth of it with drivers that die, and print what came of it.

    All the time parameters are set: some that are valid, some that are not, and some that only fit
    together with others. None of them changes what is sound.
    """
    name = subject.program
    # Every message is to count, also where others take the processor for seconds.
    overrides = [
        *(f'/{topic}.subscription.reliability:=reliable' for topic in subject.topics),
        *(f'/{topic}.subscription.depth:=20000' for topic in subject.topics),
        *(f'/{name}/{topic}.publisher.depth:=5000' for topic in subject.outputs),
    ]
    values = (*subject.arguments, *(f'qos_overrides.{rule}' for rule in overrides))
    arguments = [part for value in values for part in ('-p', value)]
    with Program.running(name, '--ros-args', *arguments) as estimator:
        # To its end, so that no half of a pair is left.
        with subject.drive(300, 100.0, with_faults=False) as made:
            wait_for('the estimator', lambda: observer.estimates() > 0)
            wait_for('the end of it', lambda: 'Sent: ' in made.output())
            wait_for('its reports', lambda: observer.counts)
        wait_for('the last of them', observer.is_quiet, LATE)
        before, came = dict(observer.counts), observer.came.copy()
        memory = [estimator.memory()]
        count = round(0.8 * seconds * subject.rate)
        with observer.meddling(), subject.drive(count, subject.rate, with_faults=True) as made:
            deadline = time.monotonic() + 2.0 * seconds + 60.0
            while 'Sent: ' not in made.output():
                if time.monotonic() > deadline or estimator.process.poll() is not None:
                    raise TimeoutError(f'the stream did not come to its end: {estimator.output()}')
                memory.append(estimator.memory())
                time.sleep(1.0)
            sent = made.sent()
            memory.append(estimator.memory())
            # Until then the driver must be there, since what is on the way ends with it.
            wait_for(
                'every message', lambda: observer.taken_since(before) >= sent['messages'], LATE
            )
            wait_for('all that is out', observer.is_quiet, LATE)
        grown = observer.grown_since(before)
        came = observer.came - came
        settings = Counter(observer.settings)
        killed = kill_drivers(observer, subject, 0.2 * seconds)
        after = estimator.memory()
        books = observer.grown_since(before)
        code = estimator.end()
    return (
        report_books(subject, sent, grown, came, settings, code)
        | report_memory(memory, after)
        | report_killed(subject, killed, books)
    )


def kill_drivers(observer: Observer, subject: Subject, seconds: float) -> int:
    """Let drivers begin and kill them in the midst of it, for so long; return how many."""
    deadline = time.monotonic() + seconds
    killed = 0
    while time.monotonic() < deadline or killed == 0:
        known = observer.estimates()
        with subject.drive(0, subject.rate, with_faults=True) as made:
            wait_for('estimates', lambda n=known: observer.estimates() > n + 100)
            made.end(signal.SIGKILL)
        killed += 1
        wait_for('all that is out', observer.is_quiet, LATE)
    return killed


def report_books(
    subject: Subject,
    sent: dict[str, int],
    grown: Counter[str],
    came: Counter[str],
    settings: Counter[str],
    code: int,
) -> int:
    """Print the books; return 1 if they do not balance."""
    otherwise = settings.total() - settings['as expected']
    lines = [
        *subject.books(sent, grown, came),
        ('messages lost on the way', 0, grown['messages lost on the way']),
        ('parameters set otherwise than expected', 0, otherwise),
        ('exit code', 0, code),
    ]
    shown = [
        (what, str(expected), str(found), '' if expected == found else 'differs')
        for what, expected, found in lines
    ]
    print(markdown_table(('', 'sent or expected:', 'estimator:', ''), shown))
    print(
        f'\nstale: {came[f"{subject.regimes} stale"]} times; skipped by the driver, that was too '
        f'slow: {sent["skipped"]}; parameters were set {settings.total()} times'
    )
    for what in sorted(settings):
        if what != 'as expected':
            print(f'{what}: {settings[what]} times')
    return 0 if all(expected == found for _, expected, found in lines) else 1


def report_memory(memory: list[float], after: float) -> int:
    """Print what a stream and the killing of drivers cost; return 1 if memory grows."""
    warm = memory[round(WARM_UP * (len(memory) - 1))]
    print(
        f'memory (RSS): {memory[0]:.1f} MB at the start, {warm:.1f} MB after a tenth of the '
        f'stream, {memory[len(memory) // 2]:.1f} MB after half of it, {memory[-1]:.1f} MB at its '
        f'end, {after:.1f} MB after drivers were killed; allowed are {MOST_GROWTH:.0f} MB more '
        'than after a tenth'
    )
    return 0 if max(*memory, after) <= warm + MOST_GROWTH else 1


def report_killed(subject: Subject, killed: int, books: Counter[str]) -> int:
    """Print what is left of drivers that were killed; return 1 if the estimator lost count."""
    accounted = sum(books[key] * subject.messages_for_one.get(key, 1) for key in ACCOUNTED)
    # One message of a cable may wait for its partner; joint states of one cable wait likewise.
    waiting = books['messages received'] - accounted
    print(
        f'{killed} drivers were killed; of {books["messages received"]} messages in all '
        f'{accounted} are accounted for, and {waiting} wait for a partner',
        flush=True,
    )
    return 0 if 0 <= waiting <= 2 else 1


if __name__ == '__main__':
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit('soak interrupted')
    except (TimeoutError, AssertionError) as error:
        sys.exit(f'soak failed: {error}')
