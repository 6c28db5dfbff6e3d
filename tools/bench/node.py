"""The estimator node beside a bare relay: there and back, CPU per message, highest rate.

Estimators and relays are processes of their own that are there at the same time; one caller
speaks to them in turn. It listens to bend angle and joint pressure, of one estimator and one relay
also to the estimate, and nobody to anything else.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from statistics import median

from ament_index_python.packages import get_package_prefix
from ros_domain import own_domain

from tendon_statics import default_design_path, load_design, solve
from tendon_statics.physics import paper

from .caller import Callee, Caller, HighestRate, Stream, called
from .rows import Row, at_most

RATE = 500.0
"""Hz"""

STARTS = 4
"""Of every program, since one process is not as fast as the next"""

STREAMS = 12
"""To every process, of `COUNT` messages each: short, so that all get the same of the machine"""

COUNT = 100

LONG_STREAMS, LONG_COUNT = 7, 500
"""The same for what has a memory of the last tenths of a second"""

WARM_UP = 200
"""Messages before the first stream"""

SEARCHES = 3
"""Of the highest rate of a program"""

SHARED = 3000
"""Messages of which the shares are measured"""


DESIGN = load_design(default_design_path())


def _answer(tension_l: float, tension_s: float) -> tuple[float, float]:
    """Return what the estimator should say."""
    equilibrium = solve(DESIGN, tension_l, tension_s)
    return equilibrium.bend_angle, equilibrium.pressure


ESTIMATOR = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics', 'estimator')
RELAY = (sys.executable, Path(__file__).with_name('relay.py'))


def _answer_of_relay(_tension_l: float, _tension_s: float) -> tuple[float, float]:
    return paper.BEND_ANGLE, paper.PRESSURE


CALLEES = (
    Callee('relay', RELAY, _answer_of_relay),
    Callee('single', (ESTIMATOR,), _answer),
    Callee('events', (ESTIMATOR, '--ros-args', '-p', 'executor:=events'), _answer),
    Callee('relay_of_estimates', (*RELAY, '--estimate'), _answer_of_relay, estimates=True),
    Callee('estimates', (ESTIMATOR,), _answer, estimates=True),
)
FILTERED = (
    CALLEES[0],
    Callee(
        'filtering',
        (ESTIMATOR, '--ros-args', '-p', 'estimation:=filtering'),
        # What it says hangs on when messages come; the tests hold it against the filter.
        lambda _l, _s: (math.nan, math.nan),
    ),
)
TIMED = Callee('timed', (sys.executable, Path(__file__).with_name('timed_estimator.py')), _answer)


def rows() -> list[Row]:
    """Measure."""
    relay, single, events, relay_of_estimates, estimates = _streams()
    relay_rates, single_rates = _highest_rates(1.0 / median(stream.cpu for stream in relay))
    rate = _median_rate(single_rates) / _median_rate(relay_rates)
    work, against = 'estimator node, 500 Hz', 'bare rclpy relay'
    rounds, rounds_with_events = whole_rounds(single, relay), whole_rounds(events, relay)
    there_and_back = median_ratio(rounds, 'there_and_back')
    lost = sum(stream.lost for stream in single)
    return [
        Row(
            f'{work}, there and back (p50); {said_of_losses(single, relay, rounds)}',
            against,
            there_and_back,
            '≤ 1.15 times, 0 lost',
            there_and_back <= 1.15 and lost == 0,
        ),
        at_most(f'{work}, CPU per message', against, median_ratio(rounds, 'cpu'), 1.25),
        at_most(
            f'{work}, CPU per message, `executor:=events`; '
            f'{said_of_losses(events, relay, rounds_with_events)}',
            f'{against}, default executor',
            median_ratio(rounds_with_events, 'cpu'),
            0.8,
        ),
        Row(
            'estimator node, highest rate with nothing lost'
            + said_of_caller(single_rates + relay_rates),
            against,
            rate,
            '≥ 0.85 times',
            rate >= 0.85,
        ),
        *_rows_of_estimates(estimates, relay_of_estimates),
        _row_of_filtering(),
    ]


def _rows_of_estimates(ours: Sequence[Stream], theirs: Sequence[Stream]) -> list[Row]:
    """Return the rows of an estimator whose estimates are listened to."""
    rounds = whole_rounds(ours, theirs)
    work = 'estimator node, 500 Hz, `~/estimate` subscribed'
    against = 'bare rclpy relay that publishes the same message'
    return [
        at_most(
            f'{work}, there and back (p50); {said_of_losses(ours, theirs, rounds)}',
            against,
            median_ratio(rounds, 'there_and_back'),
            1.15,
        ),
        at_most(f'{work}, CPU per message', against, median_ratio(rounds, 'cpu'), 1.3),
    ]


def _row_of_filtering() -> Row:
    """Return the row of an estimator that filters, in streams that are longer than its lag."""
    relay, ours = _streams(FILTERED, starts=1, streams=LONG_STREAMS, count=LONG_COUNT)
    rounds = whole_rounds(ours, relay)
    ratio, lost = median_ratio(rounds, 'cpu'), sum(stream.lost for stream in ours)
    return Row(
        'estimator node, 500 Hz, `estimation:=filtering`, CPU per message; '
        + said_of_losses(ours, relay, rounds),
        'bare rclpy relay',
        ratio,
        '≤ 2.5 times, 0 lost',
        ratio <= 2.5 and lost == 0,
    )


def _streams(
    callees: Sequence[Callee] = CALLEES,
    starts: int = STARTS,
    streams: int = STREAMS,
    count: int = COUNT,
) -> list[list[Stream]]:
    """Return the streams to each program."""
    of_each: list[list[Stream]] = [[] for _ in callees]
    for _ in range(starts):
        with _callers(callees) as callers:
            for caller in callers:
                caller.stream(RATE, WARM_UP)
            new = in_turn([lambda c=caller: c.stream(RATE, count) for caller in callers], streams)
        for known, of_program in zip(of_each, new, strict=True):
            known += of_program
    return of_each


def _highest_rates(guess: float) -> list[list[HighestRate]]:
    """Return the highest rates of the relay and of the estimator."""
    with _callers() as callers:
        return in_turn(
            [lambda c=caller: c.highest_rate(guess) for caller in callers[:2]], SEARCHES
        )


@contextmanager
def _callers(callees: Sequence[Callee] = CALLEES) -> Iterator[list[Caller]]:
    """Run all programs, with a caller each."""
    with own_domain(), ExitStack() as stack:
        yield [stack.enter_context(called(callee)) for callee in callees]


def shares() -> dict[str, float]:
    """Measure what part of the estimator's CPU time goes where, in order of the work."""
    with own_domain(), called(TIMED) as caller:
        lost = caller.stream(RATE, SHARED).lost
        output = caller.end()
    if lost:
        raise RuntimeError(f'{lost} answers of {2 * SHARED} were lost: the machine is too busy')
    (line,) = [line for line in output.splitlines() if line.startswith('Took: ')]
    took: dict[str, float] = json.loads(line.removeprefix('Took: '))
    return {part: seconds / sum(took.values()) for part, seconds in took.items()}


Rounds = Sequence[tuple[Stream, Stream]]
"""Our stream and that of the relay, round by round"""


def whole_rounds(ours: Sequence[Stream], theirs: Sequence[Stream]) -> Rounds:
    """Return the rounds in which every message was answered by both."""
    rounds = [pair for pair in zip(ours, theirs, strict=True) if pair[0].whole and pair[1].whole]
    if len(rounds) < len(ours) / 2:
        raise RuntimeError(
            f'answers were lost in {len(ours) - len(rounds)} of {len(ours)} rounds: '
            'the machine is too busy'
        )
    return rounds


def median_ratio(rounds: Rounds, name: str) -> float:
    """Return the median over rounds of what was measured, over the same of the relay."""
    return median(getattr(our, name) / getattr(their, name) for our, their in rounds)


def said_of_losses(ours: Sequence[Stream], theirs: Sequence[Stream], rounds: Rounds) -> str:
    """Say how many answers were lost, and which rounds count if not all do."""
    lost, of_relay = (sum(stream.lost for stream in streams) for streams in (ours, theirs))
    said = f'{lost} answers lost'
    if len(rounds) < len(ours):
        said += f', {of_relay} by the relay; {len(rounds)} of {len(ours)} rounds, without any'
    return said


def said_of_caller(rates: Sequence[HighestRate]) -> str:
    """Say in how many searches the caller could send no faster, if there are any."""
    count = sum(rate.is_of_caller for rate in rates)
    return f'; in {count} of {len(rates)} searches as fast as the caller can' if count else ''


def _median_rate(rates: Sequence[HighestRate]) -> float:
    return median(rate.rate for rate in rates)


def in_turn(works: Sequence[Callable[[], object]], rounds: int) -> list[list]:
    """Do the works in turn, round by round; return what each returned."""
    done = [[work() for work in works] for _ in range(rounds)]
    return [list(of_work) for of_work in zip(*done, strict=True)]
