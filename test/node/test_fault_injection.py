"""Faults of a rig, made on purpose over real ROS processes: what comes out, and what is kept."""

import itertools
import signal
from contextlib import contextmanager

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from forked_programs import ForkedProgram
from listener import Listener, reliable_input
from rclpy.context import Context
from ros_programs import EXECUTOR, Program, spinning, wait_for

from tendon_statics import Regime

ROWS = [(1.0, 2.6 + 0.001 * index) for index in range(300)]
"""All driven to the stop, so that something comes on every topic."""

KINDS = ('array', 'joint_state', 'wrench_pair')
OUTPUTS = ('regime', 'estimate', 'bend_angle')
STAMP_FAULTS = ('out_of_order_probability:=0.02', 'repeated_stamp_probability:=0.02')
FAULTS = (
    *('dropout_probability:=0.05', 'nan_burst_probability:=0.005', 'nan_burst_length:=8'),
    *('wrong_length_probability:=0.03', 'slack_probability:=0.005', 'slack_length:=10'),
    *('implausible_probability:=0.02', 'seed:=7'),
)


class Observer(Listener):
    """Leaves the tensions to drivers, and runs the estimator as installed: its memory counts."""

    PROGRAM = Program

    def __init__(self, context: Context) -> None:
        super().__init__(context, None)


@pytest.fixture
def observer():
    with spinning(Observer) as node:
        yield node


@pytest.fixture
def recording(tmp_path):
    path = tmp_path / 'recording.csv'
    lines = [f'{tension_l!r},{tension_s!r}' for tension_l, tension_s in ROWS]
    path.write_text('\n'.join(['tension_l,tension_s', *lines]))
    return path


def driver(recording, *parameters: str, kind: str = 'array'):
    """A stand-in driver as a process, which begins when it is heard."""
    values = (f'file:={recording}', f'tension_source:={kind}', 'awaited_subscribers:=1')
    arguments = [part for value in (*values, *parameters) for part in ('-p', value)]
    return ForkedProgram.running('pulley_driver', '--ros-args', *arguments)


@contextmanager
def estimator_of(observer, recording, *more: str, kind: str = 'array', reliable=True):
    """An estimator that is known to hear a driver and to be heard on all topics."""
    # A pair has one stamp; a driver that catches up sends the next reading within microseconds.
    values = [f'tension_source:={kind}', 'max_skew:=0.0', *more]
    # Room for a listener that is slow on a busy machine.
    values += [f'qos_overrides./estimator/{topic}.publisher.depth:=5000' for topic in OUTPUTS]
    arguments = [part for value in values for part in ('-p', value)]
    if reliable:  # so that every message counts
        arguments += reliable_input(kind)
    with observer.estimator(*arguments) as program:
        with driver(recording, 'rate:=200.0', kind=kind):
            wait_for('the estimator to be heard', observer.hears_all)
        wait_for_quiet(observer)
        observer.forget()
        yield program


def wait_for_quiet(observer) -> dict[str, int]:
    """Wait until nothing more comes, neither to the estimator nor of it; return what it counts.

    That is so when two reports in a row count the same, and nothing came between them: of what
    waits, the observer takes one message of each topic in turn.
    """
    before: tuple = ()

    def is_quiet() -> bool:
        nonlocal before
        earlier, before = before, (counts(observer.report()), observer.count_kept())
        return before == earlier

    wait_for('all that is on the way', is_quiet)
    return before[0]


def counts(status: DiagnosticStatus) -> dict[str, int]:
    """What a report counts."""
    return {
        item.key: int(item.value)
        for item in status.values
        if item.value.isdigit() and not item.key.startswith('publishers')
    }


def all_taken(observer, made, before: dict[str, int]) -> dict[str, int]:
    """What the estimator counts when it has taken all that a driver says that it sent.

    Until then the driver must be there, since what is on the way ends with it.
    """
    sent = made.sent()['messages']
    key = 'messages received'
    wait_for('every message', lambda: counts(observer.report())[key] - before[key] == sent)
    return wait_for_quiet(observer)


@pytest.mark.parametrize('kind', KINDS)
def test_of_all_faults_at_once_each_is_counted_and_nothing_good_is_lost(kind, observer, recording):
    faults = FAULTS if kind == 'array' else FAULTS + STAMP_FAULTS
    with estimator_of(observer, recording, kind=kind) as program:
        before, memory = wait_for_quiet(observer), program.memory()
        with driver(recording, 'rate:=250.0', 'count:=1000', *faults, kind=kind) as made:
            wait_for('the last message', lambda: 'Sent: ' in made.output())
            sent = made.sent()
            after = all_taken(observer, made, before)
        grown = {key: after[key] - before[key] for key in after}
        assert grown['messages received'] == sent['messages']
        good = sent['good'] + sent['slack']
        assert sent['good'] > 600
        assert min(sent[key] for key in ('slack', 'nan_burst', 'wrong_length', 'implausible')) > 5

        assert grown['pairs solved'] == good
        assert grown.get('messages lost on the way', 0) == 0  # EventsExecutor counts none.
        assert grown['dropped: not finite'] == sent['nan_burst']
        assert grown['dropped: implausible'] == sent['implausible']
        halves = 1 if kind == 'wrench_pair' else 0
        wrong = grown['dropped: wrong length'] + grown['dropped: unpaired']
        # One half may have waited since the first driver ended between the two of a pair.
        assert wrong - sent['wrong_length'] in ((0, 1) if kind == 'wrench_pair' else (0,))
        if kind != 'array':
            each = 1 + halves
            # A repeated stamp is an earlier one if a message of NaN came in between.
            late = grown['dropped: out of order'] + grown['dropped: repeated stamp']
            assert late == each * (sent['out_of_order'] + sent['repeated_stamp'])
            assert min(sent['out_of_order'], sent['repeated_stamp']) > 5

        wait_for('every estimate', lambda: len(observer.estimates) == good)
        taken = [(e.tension_l, e.tension_s) for e in observer.estimates if e.regime != 'slack']
        assert set(taken) <= set(ROWS)
        # In the order in which they were sent, round and round.
        places = [ROWS.index(pair) for pair in taken]
        rounds = sum(later < earlier for earlier, later in itertools.pairwise(places))
        assert rounds <= 1000 // len(ROWS)
        invalid = sent['nan_burst'] + sent['implausible'] + grown['dropped: wrong length']
        wait_for('every regime', lambda: len(observer.regimes) == good + invalid)
        assert observer.regimes.count('invalid') == invalid
        wait_for('every angle', lambda: len(observer.bend_angles) == sent['good'])
        assert program.memory() < memory + 4.0


def test_a_driver_that_is_killed_is_missed_and_taken_again(observer, recording):
    kind = 'joint_state'
    # With more time than a busy machine makes a driver pause.
    with estimator_of(observer, recording, 'input_timeout:=3.0', kind=kind):
        wait_for('the first driver to be missed', lambda: observer.stale_regimes)
        observer.stale_regimes.clear()
        for number in (1, 2):
            observer.forget()
            with driver(recording, 'rate:=200.0', kind=kind) as program:
                wait_for('estimates', lambda: len(observer.estimates) > 50)
                since = len(observer.diagnostics)
                program.end(signal.SIGKILL)
            observer.wait_for_status(DiagnosticStatus.STALE, 'no valid tensions', since=since)
            wait_for('that it is said', lambda n=number: len(observer.stale_regimes) == n)
            known = len(observer.regimes)
            wait_for_quiet(observer)
            assert len(observer.stale_regimes) == number
            assert len(observer.regimes) == len(observer.estimates) == known
            assert set(observer.regimes) == {Regime.DRIVEN_TO_STOP.value}


def test_a_burst_of_nan_longer_than_the_timeout_is_stale_once(observer, recording):
    # With this seed two bursts, sound readings between them, and 3 s of those to the end.
    count, length, starts = 520, 150, [56, 227]
    faults = ('nan_burst_probability:=0.01', f'nan_burst_length:={length}', 'seed:=118')
    # Half as long as a burst, and longer than a busy machine makes a driver pause.
    with estimator_of(observer, recording, 'input_timeout:=1.5'):
        wait_for('the first driver to be missed', lambda: observer.stale_regimes)
        observer.forget()
        observer.stale_regimes.clear()
        with driver(recording, 'rate:=50.0', f'count:={count}', *faults) as made:
            wait_for('the last message', lambda: 'Sent: ' in made.output())
            sent = made.sent()
            wait_for('every regime', lambda: len(observer.regimes) == count)
        assert sent['nan_burst'] == 2 * length
        # Once in each burst; when the driver has ended it is missed again.
        in_bursts = [after for after in observer.stale_regimes if after < count]
        assert len(in_bursts) == 2
        for start, after in zip(starts, in_bursts, strict=True):
            assert start < after <= start + length
        wait_for('every angle', lambda: len(observer.bend_angles) == sent['good'])
        assert observer.regimes.count('invalid') == sent['nan_burst']


@pytest.mark.skipif(EXECUTOR == 'events', reason='EventsExecutor counts no lost messages')
def test_a_storm_is_weathered(observer, recording):
    """10 kHz for 5 s: what is too much for a process is counted as lost, nothing piles up."""
    with estimator_of(observer, recording, reliable=False) as program:
        # A shorter one first fills all that is to be filled once.
        for count in (10_000, 50_000):
            before, memory = wait_for_quiet(observer), program.memory()
            observer.forget()
            with driver(recording, 'rate:=10000.0', f'count:={count}') as made:
                wait_for('the last message', lambda: 'Sent: ' in made.output())
                sent = made.sent()
                after = wait_for_quiet(observer)
        grown = {key: after[key] - before[key] for key in after}
        # The first few may go before the estimator knows the driver, the last find no room.
        came = grown['messages received'] + grown['messages lost on the way']
        assert 0.9 * sent['messages'] <= came <= sent['messages']
        assert grown['pairs solved'] == grown['messages received'] > 1000
        # The observer is slower than the estimator, whose outputs wait 100 deep.
        assert 1000 < len(observer.regimes) <= grown['pairs solved']
        assert program.memory() < memory + 20.0
        observer.forget()
        with driver(recording, 'rate:=100.0'):
            wait_for('estimates of a quiet driver', lambda: len(observer.estimates) >= 90)
        # Nothing is queued: each reading is answered before the next, and not one behind.
        with spinning(Listener) as slow:
            slow.connect(program)
            for row in ROWS[:50]:
                assert slow.answer(*row) == Regime.DRIVEN_TO_STOP.value
                newest = slow.newest_estimate()
                assert (newest.tension_l, newest.tension_s) == row
        assert 'Traceback' not in program.output()


def test_of_two_drivers_at_once_no_pair_is_mixed_and_both_are_noticed(
    observer, recording, tmp_path
):
    other = tmp_path / 'other.csv'
    other.write_text('tension_l,tension_s\n3.0,1.0\n')
    with estimator_of(observer, recording):
        since = len(observer.diagnostics)
        with driver(recording, 'rate:=100.0'), driver(other, 'rate:=100.0'):
            observer.wait_for_status(
                DiagnosticStatus.WARN, '2 publishers on /tensions', since=since
            )
            wait_for('estimates', lambda: len(observer.estimates) > 200)
            # A loss is counted in the second report after it, while its publisher is there.
            for _ in range(3):
                observer.report()
            if EXECUTOR != 'events':
                assert observer.count('messages lost on the way') == 0
        pairs = {(e.tension_l, e.tension_s) for e in observer.estimates}
        assert (3.0, 1.0) in pairs
        assert pairs <= {*ROWS, (3.0, 1.0)}


def test_a_second_driver_may_come_and_go_and_come_again(observer, recording, tmp_path):
    """While it is there a warning says so; nothing of the first is lost, nor said to be."""
    other = tmp_path / 'other.csv'
    other.write_text('tension_l,tension_s\n3.0,1.0\n')

    def count_of_other() -> int:
        return sum(estimate.tension_l == 3.0 for estimate in observer.estimates)

    with estimator_of(observer, recording), driver(recording, 'rate:=100.0'):
        wait_for('the first alone', lambda: len(observer.estimates) > 50)
        before = observer.count('messages lost on the way') if EXECUTOR != 'events' else 0
        # One that is killed says no goodbye, and is missed only after some 20 s of silence.
        for number in (signal.SIGINT, signal.SIGKILL, signal.SIGTERM):
            since, known = len(observer.diagnostics), count_of_other()
            with driver(other, 'rate:=100.0') as second:
                observer.wait_for_status(
                    DiagnosticStatus.WARN, '2 publishers on /tensions', since=since
                )
                wait_for('what it sends', lambda n=known: count_of_other() > n + 50)
                second.end(number)
            observer.wait_for_status(DiagnosticStatus.OK, Regime.DRIVEN_TO_STOP.value)
        # A loss is said in the second report after it. A slow machine may be behind, without any.
        for _ in range(3):
            assert 'lost' not in observer.report().message
        if EXECUTOR != 'events':
            assert observer.count('messages lost on the way') == before
        taken = [(e.tension_l, e.tension_s) for e in observer.estimates]
        places = [ROWS.index(pair) for pair in taken if pair != (3.0, 1.0)]
        for earlier, later in itertools.pairwise(places):
            assert later == (earlier + 1) % len(ROWS)


def test_a_bad_parameter_in_the_middle_of_a_stream_changes_nothing(observer, recording):
    with (
        estimator_of(observer, recording) as program,
        # No more than a busy machine can take: requests wait for what came before them.
        driver(recording, 'rate:=50.0') as made,
    ):
        for number in range(20):
            count = len(observer.estimates)
            wait_for('the stream', lambda n=count: len(observer.estimates) > n + 4)
            result = observer.set_estimator_parameters(
                design__max_bend_angle=0.1, design__mass=-1.0 - number
            )
            assert not result.successful
            assert 'design.mass' in result.reason
        count = len(observer.estimates)
        wait_for('the stream after it', lambda: len(observer.estimates) > count + 10)
        known = len(observer.estimates)
        made.end()
        sent = made.sent()
        wait_for_quiet(observer)
        assert known <= len(observer.estimates) <= sent['good'] == sent['readings']
        taken = [(e.tension_l, e.tension_s) for e in observer.estimates]
        rows = itertools.islice(itertools.cycle(ROWS), sent['readings'])
        # Each of the rows was answered, in order; of what was on the way when the driver ended
        # some may be missing.
        assert taken[:known] == list(itertools.islice(rows, known))
        assert all(row in rows for row in taken[known:])
        assert len(observer.regimes) == len(observer.bend_angles) == len(observer.estimates)
        assert set(observer.regimes) == {Regime.DRIVEN_TO_STOP.value}
        assert len(set(observer.bend_angles)) == 1
        assert program.process.poll() is None


def test_stamps_that_go_backwards_are_dropped_and_the_good_ones_kept():
    from builtin_interfaces.msg import Time

    with (
        spinning(lambda context: Listener(context, 'joint_state')) as listener,
        listener.estimator('-p', 'input_timeout:=60.0', *reliable_input('joint_state')),
    ):
        base = listener.get_clock().now().nanoseconds // 10**9 + 100
        good = [Time(sec=base + second) for second in range(100)]
        for stamp in good:
            listener.publish(1.0, 3.0, stamp=stamp)
            # Before the first of them in any case; the same stamp again is another fault.
            listener.publish(1.0, 2.9, stamp=Time(sec=base - 1 - stamp.sec % 50))
        wait_for('the good ones', lambda: len(listener.estimates) == 100)
        assert [estimate.header.stamp for estimate in listener.estimates] == good
        assert set(listener.regimes) == {'driven_to_stop'}
        wait_for('the count', lambda: listener.count('dropped: out of order') == 100)
