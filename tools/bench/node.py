"""The estimator node beside a bare relay: there and back, CPU per message, highest rate.

Estimators and relay are processes of their own that are there all the time; one caller speaks to
them in turn. It listens to bend angle and joint pressure, and nobody to anything else.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from ament_index_python.packages import get_package_prefix
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from ros_domain import own_domain
from ros_programs import Program, wait_for
from std_msgs.msg import Float64, Float64MultiArray

from tendon_statics.physics import paper

from .rows import Row, at_most

ANSWERS = ('bend_angle', 'joint_pressure')
"""Topics that are listened to"""

RATE = 500.0
"""Hz"""

STARTS = 6
"""Of every program, since one process is not as fast as the next"""

STREAMS = 25
"""To every process, of `COUNT` messages each: short, so that all get the same of the machine"""

COUNT = 100
WARM_UP = 200
"""Messages before the first stream"""

NOISE = 0.002
"""Standard deviation in N of the tensions around the published ones"""

SEARCHES = 3
"""Of the highest rate of a program"""

LOAD = 4000
"""Messages at every rate that is tried: several times what the queue of a program holds"""

HALVINGS = 6
QUIET = 0.3
"""s without an answer after which none is expected any more of messages that came too fast"""

PATIENCE = 2.0
"""The same of messages that did not: one that waits so long is lost"""

KEPT = 1.1
"""Times as long as it should that sending may take"""

SHARED = 3000
"""Messages of which the shares are measured"""

RELAY = (sys.executable, Path(__file__).with_name('relay.py'), '--ros-args')
ESTIMATOR = (
    Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics', 'estimator'),
    '--ros-args',
)
TIMED = (sys.executable, Path(__file__).with_name('timed_estimator.py'), '--ros-args')
PROGRAMS = (
    ('relay', *RELAY),
    ('single', *ESTIMATOR),
    ('events', *ESTIMATOR, '-p', 'executor:=events'),
)
"""Namespace and command"""


def rows() -> list[Row]:
    """Measure."""
    relay, single, events = _streams()
    relay_rates, single_rates = _highest_rates(1.0 / median(stream.cpu for stream in relay))
    rate = median(single_rates) / median(relay_rates)
    work, against = 'estimator node, 500 Hz', 'bare rclpy relay'
    whole, whole_with_events = (
        rounds_without_loss(single, relay),
        rounds_without_loss(events, relay),
    )
    there_and_back = median_ratio(whole, 'there_and_back')
    lost = sum(stream.lost for stream in single)
    return [
        Row(
            f'{work}, there and back (p50); {said_of_losses(single, relay, whole)}',
            against,
            there_and_back,
            '≤ 1.15 times, 0 lost',
            there_and_back <= 1.15 and lost == 0,
        ),
        at_most(f'{work}, CPU per message', against, median_ratio(whole, 'cpu'), 1.25),
        at_most(
            f'{work}, CPU per message, `executor:=events`; '
            f'{said_of_losses(events, relay, whole_with_events)}',
            f'{against}, default executor',
            median_ratio(whole_with_events, 'cpu'),
            0.8,
        ),
        Row(
            'estimator node, highest rate with nothing lost',
            against,
            rate,
            '≥ 0.85 times',
            rate >= 0.85,
        ),
    ]


def _streams() -> list[list[Stream]]:
    """Return the streams to each program."""
    streams: list[list[Stream]] = [[] for _ in PROGRAMS]
    for _ in range(STARTS):
        with _callers() as callers:
            for caller in callers:
                caller.stream(RATE, WARM_UP)
            new = in_turn([lambda c=caller: c.stream(RATE, COUNT) for caller in callers], STREAMS)
        for known, of_program in zip(streams, new, strict=True):
            known += of_program
    return streams


def _highest_rates(guess: float) -> list[list[float]]:
    """Return the highest rates of the relay and of the estimator."""
    with _callers() as callers:
        return in_turn(
            [lambda c=caller: highest_rate(c, guess) for caller in callers[:2]], SEARCHES
        )


@contextmanager
def _callers() -> Iterator[list[Caller]]:
    """Run all programs, with a caller each."""
    with own_domain(), ExitStack() as stack:
        yield [stack.enter_context(called(*program)) for program in PROGRAMS]


def shares() -> dict[str, float]:
    """Measure what part of the estimator's CPU time goes where, in order of the work."""
    with own_domain(), called('timed', *TIMED) as caller:
        caller.stream(RATE, SHARED)
        output = caller.end()
    (line,) = [line for line in output.splitlines() if line.startswith('Took: ')]
    took: dict[str, float] = json.loads(line.removeprefix('Took: '))
    return {part: seconds / sum(took.values()) for part, seconds in took.items()}


Rounds = Sequence[tuple['Stream', 'Stream']]
"""Our stream and that of the relay, round by round"""


def rounds_without_loss(ours: Sequence[Stream], theirs: Sequence[Stream]) -> Rounds:
    """Return the rounds in which every message was answered by both."""
    rounds = [pair for pair in zip(ours, theirs, strict=True) if pair[0].lost == pair[1].lost == 0]
    if not rounds:
        raise RuntimeError('answers were lost in every round: the machine is too busy')
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


def in_turn(works: Sequence[Callable[[], object]], rounds: int) -> list[list]:
    """Do the works in turn, round by round; return what each returned."""
    done = [[work() for work in works] for _ in range(rounds)]
    return [list(of_work) for of_work in zip(*done, strict=True)]


@dataclass(frozen=True)
class Stream:
    """What became of messages that were sent at an even rate."""

    lost: int
    """Answers that did not come"""
    there_and_back: float
    """Median time in s from a message to the last of its answers"""
    cpu: float
    """CPU time in s of the program for a message"""


class Caller(Node):
    """Sends tensions to one program, which has a namespace of its own, and takes its answers."""

    def __init__(self, name: str, program: Program, context: Context) -> None:
        super().__init__(
            *('caller',),
            namespace=name,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.name = name
        self._program = program
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self)
        self._came: list[list[float]] = [[] for _ in ANSWERS]
        self._tensions = self.create_publisher(
            Float64MultiArray,
            'tensions',
            QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT),
        )
        for topic, times in zip(ANSWERS, self._came, strict=True):
            self.create_subscription(
                Float64,
                f'estimator/{topic}',
                lambda _message, times=times: times.append(time.perf_counter()),
                2 * LOAD,
            )
        draw = np.random.default_rng(1)
        pairs = [paper.TENSION_L, paper.TENSION_S] + NOISE * draw.standard_normal((LOAD, 2))
        # No two alike, as from a sensor.
        self._messages = [Float64MultiArray(data=pair) for pair in pairs.tolist()]

    def connect(self) -> None:
        """Wait until messages pass both ways, which is known of one end only."""
        wait_for(f'{self.name} to be found', self._is_found)
        for _ in range(100):
            self._tensions.publish(self._messages[0])
            self._spin_until(time.perf_counter() + 0.1)
            if all(self._came):
                break
        else:
            raise RuntimeError(f'{self.name} does not answer: {self._program.output()}')

    def _is_found(self) -> bool:
        self._spin_until(time.perf_counter() + 0.05)
        return self._tensions.get_subscription_count() > 0 and all(
            subscription.get_publisher_count() > 0 for subscription in self.subscriptions
        )

    def _spin_until(self, due: float) -> None:
        while (left := due - time.perf_counter()) > 0.0:
            self._executor.spin_once(timeout_sec=left)

    def stream(self, rate: float, count: int) -> Stream:
        """Send so many messages at an even rate, taking the answers in between."""
        for times in self._came:
            times.clear()
        cpu = self._program.cpu_time()
        sent = []
        begin = time.perf_counter()
        for index in range(count):
            self._spin_until(begin + index / rate)
            sent.append(time.perf_counter())
            self._tensions.publish(self._messages[index])
        self._take_what_comes(count)
        cpu = self._program.cpu_time() - cpu
        lost = sum(count - len(times) for times in self._came)
        # Where one is lost, it is not known which.
        back = np.max(self._came, axis=0) - sent if lost == 0 else [np.nan]
        return Stream(lost, float(np.median(back)), cpu / count)

    def _take_what_comes(self, count: int) -> None:
        """Take answers until all or none comes any more."""
        came, heard = 0, time.perf_counter()
        while came < count * len(ANSWERS) and time.perf_counter() < heard + PATIENCE:
            self._executor.spin_once(timeout_sec=PATIENCE)
            before, came = came, sum(map(len, self._came))
            if came > before:
                heard = time.perf_counter()

    def loses_any(self, rate: float) -> bool:
        """Send `LOAD` messages at a rate, then take the answers, which wait in the middleware.

        Raises
        ------
        RuntimeError
            If the caller itself cannot keep to the rate.
        """
        self._take_answers(LOAD * len(ANSWERS) + 1)  # Whatever came late of those before.
        begin = time.perf_counter()
        for index, message in enumerate(self._messages):
            while (left := begin + index / rate - time.perf_counter()) > 0.0:
                time.sleep(left)
            self._tensions.publish(message)
        took = time.perf_counter() - begin
        if took > KEPT * LOAD / rate:
            raise RuntimeError(
                f'{self.name}: the caller sends no more than {LOAD / took:.0f} messages a second'
            )
        return self._take_answers(LOAD * len(ANSWERS)) < LOAD * len(ANSWERS)

    def _take_answers(self, most: int) -> int:
        """Take answers past the executor until so many or none comes any more; return how many."""
        came, heard = 0, time.perf_counter()
        while came < most and time.perf_counter() < heard + QUIET:
            before = came
            for subscription in self.subscriptions:
                with subscription.handle:
                    while subscription.handle.take_message(Float64, False):
                        came += 1
            if came > before:
                heard = time.perf_counter()
            time.sleep(0.01)
        return came

    def end(self) -> str:
        """End the program and return what it has written."""
        self._program.end()
        return self._program.output()


def highest_rate(caller: Caller, guess: float) -> float:
    """Find the highest rate in Hz at which a program loses nothing."""
    low, high = guess / 2.0, guess * 4.0
    while not caller.loses_any(high):
        low, high = high, 2.0 * high
    for _ in range(HALVINGS):
        rate = math.sqrt(low * high)
        if caller.loses_any(rate):
            high = rate
        else:
            low = rate
    if low == guess / 2.0 and caller.loses_any(low):
        raise RuntimeError(f'{caller.name} loses messages even at {low:.0f} Hz')
    return low


@contextmanager
def called(name: str, *command: str | Path) -> Iterator[Caller]:
    """Run a program and connect a caller with it."""
    context = Context()
    context.init()
    with Program.running_command([*command, '-r', f'__ns:=/{name}']) as program:
        caller = Caller(name, program, context)
        caller.connect()
        try:
            yield caller
        finally:
            caller.destroy_node()
            context.try_shutdown()
