"""What speaks to a program: sends tensions, takes its answers and checks them."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from ros_programs import Program, wait_for
from std_msgs.msg import Float64, Float64MultiArray
from tendon_statics_interfaces.msg import Estimate

from .pairs import noisy_pairs


class Answer(NamedTuple):
    """What a program answers each message with."""

    topic: str
    """In its private namespace"""
    message_type: type
    number: Callable[[Any], float]
    """Returns what of it is checked"""

    node: str = 'estimator'
    """That publishes it"""


ANSWERS = (
    Answer('bend_angle', Float64, lambda message: message.data),
    Answer('joint_pressure', Float64, lambda message: message.data),
)
"""What is listened to as a rule"""

ESTIMATE = Answer('estimate', Estimate, lambda message: message.bend_angle)

LOAD = 4000
"""Messages at every rate that is tried: several times what the queue of a program holds"""

HALVINGS = 5
TRIALS = 2
"""At a rate, until one loses nothing: what else the machine does may disturb one"""

KEPT = 0.9
"""Part of a rate that the caller has to hold itself"""

QUIET = 0.3
"""s without an answer after which none is expected any more of messages that came too fast"""

PATIENCE = 2.0
"""The same of messages that did not: one that waits so long is lost"""

TOLERANCE = 1e-9
"""Relative, of answers"""


class Callee(NamedTuple):
    """A program that answers tensions."""

    name: str
    """Its namespace"""
    command: Sequence[str | Path]
    answer: Callable[[float, float], tuple[float, float]]
    """What it should say of T_l and T_s in N: bend angle in rad, pressure in Pa; NaN: whatever"""
    estimates: bool = False
    """Whether its estimates are listened to as well"""

    @property
    def answers(self) -> tuple[Answer, ...]:
        """What is listened to."""
        return (*ANSWERS, ESTIMATE) if self.estimates else ANSWERS

    def expected(self, tension_l: float, tension_s: float) -> tuple[float, ...]:
        """Return what each of the answers should say."""
        angle, pressure = self.answer(tension_l, tension_s)
        return (angle, pressure, angle) if self.estimates else (angle, pressure)

    def talk(self) -> Talk:
        """Return what is sent, and what should come of it."""
        pairs = noisy_pairs(LOAD).tolist()
        messages = [Float64MultiArray(data=pair) for pair in pairs]
        return Talk(self.answers, messages, np.array([self.expected(*pair) for pair in pairs]))


class Talk(NamedTuple):
    """What is sent to programs, and what should come of it."""

    answers: Sequence[Answer]
    messages: Sequence[Any]
    """`LOAD` of one type, on ``tensions``"""
    expected: np.ndarray
    """What each answer to each message should say; NaN: whatever"""


@dataclass(frozen=True)
class Stream:
    """What became of messages that were sent at an even rate."""

    lost: int
    """Answers that did not come"""
    whole: bool
    """Whether all came, and none too many, so that the times mean something"""
    there_and_back: float
    """Median time in s from a message to the last of its answers"""
    cpu: float
    """CPU time in s of the program for a message"""


class Trial(NamedTuple):
    """What became of `LOAD` messages, sent as fast as was asked for or possible."""

    rate: float
    """At which they were sent, in Hz"""
    lost: bool


class HighestRate(NamedTuple):
    """The highest rate at which a program loses nothing."""

    rate: float
    """Hz"""
    is_of_caller: bool
    """Whether the caller can send no faster, so that the program may bear more"""


class Caller(Node):
    """Sends tensions to programs that have a namespace of their own, and takes their answers.

    Mostly it is one; several are there for the time that they take together.
    """

    def __init__(
        self, name: str, talk: Talk, programs: Sequence[Program], context: Context
    ) -> None:
        super().__init__(
            *('caller',),
            namespace=name,
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.name = name
        self._programs = programs
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self)
        self._came: list[list[tuple[float, float]]] = [[] for _ in talk.answers]  # time, answer
        self._tensions = self.create_publisher(
            type(talk.messages[0]),
            'tensions',
            QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT),
        )
        for answer, came in zip(talk.answers, self._came, strict=True):
            self.create_subscription(
                answer.message_type,
                f'{answer.node}/{answer.topic}',
                lambda message, came=came, number=answer.number: came.append(
                    (time.perf_counter(), number(message))
                ),
                2 * LOAD,
            )
        self._messages, self._expected = talk.messages, talk.expected

    def connect(self) -> None:
        """Wait until messages pass both ways, which is known of one end only."""
        wait_for(f'{self.name} to be found', self._is_found)
        for _ in range(100):
            self._tensions.publish(self._messages[0])
            self._spin_until(time.perf_counter() + 0.1)
            if all(self._came):
                break
        else:
            raise RuntimeError(f'{self.name} does not answer: {self._output()}')

    def _is_found(self) -> bool:
        self._spin_until(time.perf_counter() + 0.05)
        return self._tensions.get_subscription_count() >= len(self._programs) and all(
            subscription.get_publisher_count() > 0 for subscription in self.subscriptions
        )

    def _spin_until(self, due: float) -> None:
        while (left := due - time.perf_counter()) > 0.0:
            self._executor.spin_once(timeout_sec=left)

    def stream(self, rate: float, count: int) -> Stream:
        """Send so many messages at an even rate, taking the answers in between.

        Raises
        ------
        RuntimeError
            If the program has ended, or an answer is wrong.
        """
        for came in self._came:
            came.clear()
        cpu = self._cpu_time()
        sent = []
        begin = time.perf_counter()
        for index in range(count):
            self._spin_until(begin + index / rate)
            sent.append(time.perf_counter())
            self._tensions.publish(self._messages[index])
        self._take_what_comes(count)
        self._check_that_it_lives()
        cpu = self._cpu_time() - cpu
        lost = sum(max(count - len(came), 0) for came in self._came)
        whole = all(len(came) == count for came in self._came)
        # Where one is lost or late, it is not known which.
        back = self._times_back(sent) if whole else [math.nan]
        return Stream(lost, whole, float(np.median(back)), cpu / count)

    def _take_what_comes(self, count: int) -> None:
        """Take answers until all or none comes any more."""
        came, heard = 0, time.perf_counter()
        while came < count * len(self._came) and time.perf_counter() < heard + PATIENCE:
            self._executor.spin_once(timeout_sec=PATIENCE)
            before, came = came, sum(map(len, self._came))
            if came > before:
                heard = time.perf_counter()

    def _times_back(self, sent: list[float]) -> np.ndarray:
        """Return the time from each message to the last of its answers, which are checked."""
        came = np.array(self._came)  # topic, message, time and answer
        expected = self._expected[: len(sent)].T
        known = np.isfinite(expected)
        if not np.allclose(came[:, :, 1][known], expected[known], rtol=TOLERANCE, atol=0.0):
            raise RuntimeError(f'{self.name} answers {came[:, 0, 1]}, expected {expected[:, 0]}')
        return came[:, :, 0].max(axis=0) - sent

    def _check_that_it_lives(self) -> None:
        for program in self._programs:
            code = program.process.poll()
            if code is not None:
                raise RuntimeError(f'{self.name} has ended with {code}: {program.output()}')

    def _cpu_time(self) -> float:
        return sum(program.cpu_time() for program in self._programs)

    def _output(self) -> str:
        return ''.join(program.output() for program in self._programs)

    def highest_rate(self, guess: float) -> HighestRate:
        """Find the highest rate at which the program loses nothing; begin at a guess in Hz."""
        low, high = 0.5 * guess, 4.0 * guess
        lowest = low
        while not (trial := self._bear(high)).lost:
            if trial.rate < KEPT * high:
                return HighestRate(trial.rate, is_of_caller=True)
            low, high = high, 2.0 * high
        high = min(high, trial.rate)
        for _ in range(HALVINGS):
            rate = math.sqrt(low * high)
            if self._bear(rate).lost:
                high = rate
            else:
                low = rate
        if low == lowest and self._bear(low).lost:
            raise RuntimeError(f'{self.name} loses messages even at {low:.0f} Hz')
        return HighestRate(low, is_of_caller=False)

    def _bear(self, rate: float) -> Trial:
        """Return the first trial at a rate that loses nothing, or the last."""
        for _ in range(TRIALS):
            trial = self._try(rate)
            if not trial.lost:
                break
        return trial

    def _try(self, rate: float) -> Trial:
        """Send `LOAD` messages at a rate, then take the answers, which wait in the middleware."""
        expected = LOAD * len(self._came)
        self._take_answers(expected + 1)  # Whatever came late of those before.
        begin = time.perf_counter()
        for index, message in enumerate(self._messages):
            while (left := begin + index / rate - time.perf_counter()) > 0.0:
                time.sleep(left)
            self._tensions.publish(message)
        took = time.perf_counter() - begin
        lost = self._take_answers(expected) < expected
        self._check_that_it_lives()
        return Trial(LOAD / took, lost)

    def _take_answers(self, most: int) -> int:
        """Take answers past the executor until so many or none comes any more; return how many."""
        came, heard = 0, time.perf_counter()
        while came < most and time.perf_counter() < heard + QUIET:
            before = came
            for subscription in self.subscriptions:
                with subscription.handle:
                    while subscription.handle.take_message(subscription.msg_type, False):
                        came += 1
            if came > before:
                heard = time.perf_counter()
            time.sleep(0.01)
        return came

    def end(self) -> str:
        """End the programs and return what they have written."""
        for program in self._programs:
            program.end()
        return self._output()


@contextmanager
def called(callee: Callee) -> Iterator[Caller]:
    """Run a program and connect a caller with it."""
    with calling(callee.name, [callee.command], callee.talk()) as caller:
        yield caller


@contextmanager
def calling(name: str, commands: Sequence[Sequence[str | Path]], talk: Talk) -> Iterator[Caller]:
    """Run programs in a namespace and connect a caller with them."""
    context = Context()
    context.init()
    with ExitStack() as stack:
        programs = [
            stack.enter_context(
                Program.running_command([*command, '--ros-args', '-r', f'__ns:=/{name}'])
            )
            for command in commands
        ]
        caller = Caller(name, talk, programs, context)
        caller.connect()
        try:
            yield caller
        finally:
            caller.destroy_node()
            context.try_shutdown()
