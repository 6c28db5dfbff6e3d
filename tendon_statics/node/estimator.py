"""The node ``estimator``: bend angle and joint pressure for every pair of tensions."""

from __future__ import annotations

import copy
import functools
import json
import math
import time
from collections.abc import Callable
from typing import Any

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import KeyValue
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType, JumpThreshold
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import QoSCompatibility, QoSProfile, ReliabilityPolicy, qos_check_compatible
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription
from rclpy.time import Time as ClockTime
from rclpy.topic_endpoint_info import TopicEndpointInfo
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ..files.number_parameter import SettingError
from ..physics import (
    BendAngleError,
    Equilibrium,
    StickSlipTracker,
    TensionError,
    solve,
)
from ..tensions.cable_scale import scaled, worse
from ..tensions.reason import Reason
from . import messages
from .health import Health, Level
from .lost_messages import LostMessages
from .outputs import INVALID, STALE, Outputs
from .program import StartError
from .settings import Settings, declare_settings, read_settings
from .tension_source import (
    ArraySource,
    JointStateSource,
    Reading,
    TensionSource,
    WrenchPairSource,
)
from .unknown_parameters import warn_of_unknown_parameters
from .waiting_messages import waiting_messages
from .wiring import declare_wiring

WARNING_PERIOD = 5.0
"""Least time in s between two warnings that messages cause."""

DIAGNOSTICS_PERIOD = 1.0
"""s"""

LONGEST_SLEEP = 0.25
"""s between two looks at what is due, unless something is before"""

SHORTEST_SLEEP = 1000
"""ns; no timer is then a little early"""

INPUT_DEPTH = 1000
"""Messages kept while the node is busy, so that a burst or a stall loses none."""

MOST_AT_ONCE = 100
"""Messages taken in a row before services and timers have their turn"""

UNCONFIGURED, INACTIVE, ACTIVE, FINALIZED = 'unconfigured', 'inactive', 'active', 'finalized'
"""States of a managed node"""


class Estimator(LifecycleNode):
    """Publishes what every pair of tensions that arrives says of the unit.

    With the parameter ``estimation`` at ``equilibrium`` each pair is solved by itself, as in the
    paper; at ``tracking`` a `StickSlipTracker` remembers where the unit was.

    All topics, services and timers are there from the start, since rclpy does not bear that
    subscriptions come and go while it spins. What the state of the lifecycle changes is whether
    they do anything.
    """

    def __init__(self) -> None:
        super().__init__('estimator')
        self._state = UNCONFIGURED
        self._settings: Settings  # from configuring on
        self._tracker: StickSlipTracker | None = None
        self._latest: tuple[float, float, float] | None = None
        self._invalid_since_latest = 0
        self._rejected_corrections = 0
        self._reported_level = Level.OK
        self._lost: dict[str, LostMessages] = {}  # by topic of tensions
        self._arrival = 0  # of the present message, in ns since 1970
        self._has_run = False
        self._has_said_stale = True
        self._watched_since = -math.inf  # steady, in s: activation or change of the timeout
        self._next_report = math.inf  # likewise
        self._corrected = -math.inf  # when a tracked unit was last put somewhere, steady, in s

        self._left_out = declare_settings(self)
        self._wiring = declare_wiring(self)
        # EventsExecutor fails on callbacks that take a message's number.
        self._sees_numbers = self._wiring.executor == 'single'
        self._health = Health(counts_lost=self._sees_numbers)
        self._outputs = Outputs(self, self._wiring)
        self._source = self._make_source()
        self._inputs = {
            topic: self._tension_subscription(topic, *of_topic)
            for topic, of_topic in self._source.inputs.items()
        }
        self._subscriptions_by_topic = dict(self._inputs)
        if self._wiring.estimation == 'tracking':
            topic = 'measured_bend_angle'
            self._subscriptions_by_topic[topic] = self._subscription(
                Float64, topic, self._on_measured_bend_angle
            )
        self._create_services()
        self._create_timers()
        warn_of_unknown_parameters(self)
        # Last, since every declaration fires them too.
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._take_parameters)
        if self._wiring.autostart:
            read_settings(self)  # raises with the reason, where a transition could only fail
            for trigger in (self.trigger_configure, self.trigger_activate):
                if trigger() != TransitionCallbackReturn.SUCCESS:
                    raise StartError('a transition of its lifecycle failed')

    def _make_source(self) -> TensionSource:
        if self._wiring.tension_source == 'joint_state':
            return JointStateSource(self._on_reading, self._on_drop, self._wiring.cable_names)
        if self._wiring.tension_source == 'wrench_pair':
            return WrenchPairSource(
                self._on_reading,
                self._on_drop,
                self._wiring.wrench_component,
                lambda: self._settings.max_skew,
            )
        return ArraySource(self._on_reading, self._on_drop)

    def _tension_subscription(
        self, topic: str, message_type: type, take: Callable[[Any], None]
    ) -> Subscription:
        """Subscribe to a topic of the source; count what comes and what is lost on the way."""
        lost = self._lost[topic] = LostMessages()

        def take_arrived(message: Any, arrival: int | None) -> None:
            if self._state == ACTIVE:
                self._arrival = arrival or time.time_ns()
                self._health.received += 1
                take(message)

        def on_message(message: Any) -> None:
            take_arrived(message, None)

        # A middleware may leave out any part of the info, or say 0.
        def on_numbered_message(message: Any, info: dict[str, int | None]) -> None:
            lost.note(info.get('publication_sequence_number'))
            take_arrived(message, info.get('received_timestamp'))

        def on_numbered_messages(message: Any, info: dict[str, int | None]) -> None:
            on_numbered_message(message, info)
            for waiting in waiting_messages(subscription, MOST_AT_ONCE):
                on_numbered_message(*waiting)

        subscription = self._subscription(
            message_type, topic, on_numbered_messages if self._sees_numbers else on_message
        )
        return subscription

    def _subscription(
        self, message_type: type, topic: str, callback: Callable[..., None]
    ) -> Subscription:
        return self.create_subscription(
            message_type,
            topic,
            callback,
            QoSProfile(depth=INPUT_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
            # As of the outputs; of a publisher that does not fit /diagnostics tells.
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )

    def _create_services(self) -> None:
        if messages.INTERFACES_MISSING:
            self.get_logger().warning(
                'No ~/solve, ~/solve_inverse and ~/estimate, since tendon_statics_interfaces is '
                f'not there ({messages.INTERFACES_MISSING}). It is in the folder interfaces/: '
                'colcon build --base-paths . interfaces'
            )
        else:
            self._service(messages.Solve, '~/solve', self._on_solve, messages.refuse_solve)
            self._service(
                messages.SolveInverse,
                '~/solve_inverse',
                self._on_solve_inverse,
                messages.refuse_inverse,
            )
        self._service(Trigger, '~/solve_latest', self._on_solve_latest, messages.refuse)
        self._service(Trigger, '~/reset', self._on_reset, messages.refuse)
        # rclpy raises where a transition does not exist in the present state, through the
        # executor, and that would end the node.
        change = self._service_change_state
        change.callback = functools.partial(self._on_change_state, change.callback)

    def _service(
        self,
        service_type: type,
        name: str,
        answer: Callable[[Any, Any], Any],
        refuse: Callable[[Any, str], Any],
    ) -> None:
        """Offer a service, which is refused with the reason unless the node is active."""

        def on_request(request: Any, response: Any) -> Any:
            if self._state == ACTIVE:
                return answer(request, response)
            node = self.get_fully_qualified_name()
            return refuse(response, f'{node} is {self._state}; it answers when it is active')

        self.create_service(service_type, name, on_request)

    def _create_timers(self) -> None:
        # Steady, since the node's own clock stands still with use_sim_time and no /clock.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._throttled = {
            'throttle_duration_sec': WARNING_PERIOD,
            'throttle_time_source_type': steady,
        }
        # One for all, since each is waited for with every message; it also wakes the executor.
        self._timer = self.create_timer(LONGEST_SLEEP, self._on_time, clock=steady)
        self._jump_handle = self.get_clock().create_jump_callback(
            JumpThreshold(
                min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
            ),
            post_callback=lambda _jump: self._source.forget(),
        )

    @property
    def executor_kind(self) -> str:
        """Which executor is to spin the node: ``single`` or ``events``."""
        return self._wiring.executor

    # Lifecycle

    def on_configure(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Take the parameters, if they are valid."""
        try:
            self._settings = read_settings(self)
        except SettingError as error:
            self.get_logger().error(f'Not configured: {error}')
            return TransitionCallbackReturn.FAILURE
        if self._wiring.estimation == 'tracking':
            self._tracker = StickSlipTracker(
                self._settings.design, self._settings.initial_bend_angle
            )
        self._state = INACTIVE
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to estimate."""
        self._let_pass_what_waits()
        if self._tracker is not None and self._has_run:
            self._tracker.doubt()  # It may have moved while nobody looked.
        self._has_run = True
        self._health.begin_period()
        self._health.stale = False
        self._watched_since = time.monotonic()
        self._next_report = self._watched_since + DIAGNOSTICS_PERIOD
        self._state = ACTIVE
        self._wake_when_due()
        self.get_logger().info(f'Ready: {self._wiring.estimation} from {self._input_names()}')
        return TransitionCallbackReturn.SUCCESS

    def _let_pass_what_waits(self) -> None:
        """Take the messages that came while inactive, which are not of the present."""
        for lost in self._lost.values():
            lost.forget()
        for subscription in self._subscriptions_by_topic.values():
            for _ in waiting_messages(subscription, INPUT_DEPTH):
                pass

    def on_deactivate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Do and publish nothing until activated again."""
        self._stop()
        self._state = INACTIVE
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Forget what was measured; parameters may be set one by one again."""
        self._latest = None
        self._state = UNCONFIGURED
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Do and publish nothing any more."""
        self._stop()
        self._state = FINALIZED
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured; rclpy keeps to itself what went wrong."""
        self.get_logger().error('A transition failed; the node is unconfigured now')
        self._stop()
        self._state = UNCONFIGURED
        return TransitionCallbackReturn.SUCCESS

    def _stop(self) -> None:
        if self._state == ACTIVE:
            self._source.forget()
            self._lose_sight()
            self._report('deactivated')

    def _on_change_state(
        self, change: Callable[[Any, Any], Any], request: Any, response: Any
    ) -> Any:
        try:
            return change(request, response)
        except RuntimeError as error:  # RCLError is one
            self.get_logger().error(f'No such transition now: {error}')
            response.success = False
            return response

    # Parameters: all of a change is checked before any of it is taken.

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            if parameter.type_ == Parameter.Type.NOT_SET:
                reason = f'{parameter.name} cannot be deleted, only set to another value'
                return SetParametersResult(successful=False, reason=reason)
        if self._state in (INACTIVE, ACTIVE):  # before, on configuring
            try:
                read_settings(self, parameters)
            except SettingError as error:
                return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _take_parameters(self, parameters: list[Parameter]) -> None:
        changes = ', '.join(f'{parameter.name} = {parameter.value!r}' for parameter in parameters)
        self.get_logger().info(f'Changed: {changes}')
        self._left_out -= {parameter.name for parameter in parameters}
        if self._state not in (INACTIVE, ACTIVE):
            return
        before, self._settings = self._settings, read_settings(self)
        if self._settings.input_timeout != before.input_timeout:
            self._watched_since = time.monotonic()
            self._wake_when_due()
        if self._tracker is not None and self._settings.design != before.design:
            angle = self._tracker.bend_angle
            self._tracker.change_design(self._settings.design)
            if self._tracker.bend_angle != angle:
                self.get_logger().warning(
                    f'The unit was at {angle:.6g} rad, beyond the new stop; it is now taken to '
                    f'be at {self._tracker.bend_angle:.6g} rad'
                )

    # Topics

    def _on_reading(self, reading: Reading) -> None:
        settings = self._settings
        tension_l, fault_l = scaled('tension_l', reading.value_l, settings.cable_l)
        tension_s, fault_s = scaled('tension_s', reading.value_s, settings.cable_s)
        fault = worse(fault_l, fault_s)
        if fault:
            self._on_drop(*fault)
            return
        if self._health.stale and not self._is_corrected():
            self._doubt()
        lag = max(0.0, 1e-9 * (time.time_ns() - self._arrival))
        begin = time.monotonic()
        try:
            result = self._result(self._tracker, tension_l, tension_s)
        except TensionError as error:
            self._on_drop(Reason.BELOW_WEIGHT, str(error))
            return
        solved = time.monotonic()
        self._outputs.publish(result, settings, lambda: reading.stamp or self._time_of_arrival())
        was_stale = self._health.stale
        self._health.note_result(result, solved - begin)
        self._health.note_lag(lag, settings.input_timeout)
        self._source.tighten()
        self._latest = (tension_l, tension_s, solved)
        self._invalid_since_latest = 0
        self._has_said_stale = False
        if was_stale:
            self._wake_when_due()
            self.get_logger().info('Valid tensions come again', **self._throttled)
        self._report_change(recovered=was_stale)

    def _time_of_arrival(self) -> Time:
        clock = self.get_clock()
        if clock.ros_time_is_active:  # A simulated clock does not know how long it waited.
            return clock.now().to_msg()
        return ClockTime(nanoseconds=self._arrival).to_msg()

    def _doubt(self) -> None:
        """A tracked unit may have moved unseen; before the first tensions it is where it began."""
        if self._tracker is not None and self._latest is not None:
            self._tracker.doubt()

    def _is_corrected(self) -> bool:
        """Whether a tracked unit was put somewhere so lately that it is there."""
        return time.monotonic() - self._corrected <= self._settings.input_timeout

    def _result(
        self, tracker: StickSlipTracker | None, tension_l: float, tension_s: float
    ) -> Equilibrium:
        if tracker is None:
            return solve(self._settings.design, tension_l, tension_s)
        return tracker.update(tension_l, tension_s)

    def _on_drop(self, reason: Reason, text: str) -> None:
        """Count and report a message that gives no pair of tensions."""
        self._health.note_drop(reason, text)
        if reason.is_of_content:
            self._invalid_since_latest += 1
            self._outputs.say_regime(INVALID)
        self.get_logger().warning(
            f'{"Invalid" if reason.is_of_content else "Dropped"} message on '
            f'{self._input_names()} ({self._health.dropped.total()} so far): {text}',
            **self._throttled,
        )
        self._report_change()

    def _input_names(self) -> str:
        return ' and '.join(subscription.topic_name for subscription in self._inputs.values())

    def _on_measured_bend_angle(self, message: Float64) -> None:
        if self._state != ACTIVE or self._tracker is None:
            return
        try:
            self._tracker.reset(message.data)
            self._corrected = time.monotonic()
        except BendAngleError as error:
            self._rejected_corrections += 1
            self.get_logger().warning(
                f'Rejected a measured bend angle ({self._rejected_corrections} so far): {error}',
                **self._throttled,
            )

    # Health

    def _on_time(self) -> None:
        """Do what is due by now, and wake again when the next is.

        Putting the timer off with every message would wake the executor once more for each. It
        goes on for ever, since EventsExecutor does not bear timers that are cancelled.
        """
        if self._state == ACTIVE:
            now = time.monotonic()
            if now >= self._stale_from():
                self._on_stale_input()
            if now >= self._next_report:
                self._next_report = now + DIAGNOSTICS_PERIOD
                self._on_report_time()
        self._wake_when_due()

    def _stale_from(self) -> float:
        """When the input gets stale, on the steady clock in s, if no more tensions come."""
        if self._health.stale:
            return math.inf
        newest = -math.inf if self._latest is None else self._latest[2]
        return max(newest, self._watched_since) + self._settings.input_timeout

    def _wake_when_due(self) -> None:
        delay = LONGEST_SLEEP
        if self._state == ACTIVE:
            due = min(self._stale_from(), self._next_report)
            delay = min(due - time.monotonic(), LONGEST_SLEEP)
        self._timer.timer_period_ns = max(int(delay * 1e9), 0) + SHORTEST_SLEEP
        self._timer.reset()

    def _on_stale_input(self) -> None:
        """Say once that no more tensions come; what is drawn or remembered is not vouched for."""
        self._lose_sight()
        self._source.loosen()
        self.get_logger().warning(
            f'No valid tensions on {self._input_names()} for {self._settings.input_timeout:g} s',
            **self._throttled,
        )
        self._report()

    def _lose_sight(self) -> None:
        """Take it that the unit may move unseen from now on; say so once."""
        self._health.stale = True
        if not self._has_said_stale:
            self._has_said_stale = True
            self._outputs.say_regime(STALE)
        self._doubt()
        self._outputs.clear_drawing()

    def _on_report_time(self) -> None:
        self._settle_losses()
        self._report()
        self._health.begin_period()
        self._reported_level = self._health.level

    def _report_change(self, *, recovered: bool = False) -> None:
        """Report at once what got worse, or that tensions come again; the rest can wait.

        So a regime that changes with every message does not flood ``/diagnostics``.
        """
        if recovered or self._health.level > self._reported_level:
            self._report()

    def _report(self, note: str = '') -> None:
        self._reported_level = self._health.level
        self._health.counts_lost &= all(lost.are_counted for lost in self._lost.values())
        name = self.get_fully_qualified_name().lstrip('/')
        status = self._health.status(
            f'{name}: estimation',
            self._wiring.joint_name,
            {
                subscription.topic_name: subscription.get_publisher_count()
                for subscription in self._inputs.values()
            },
            self._misfit(),
            note,
        )
        left_out = ', '.join(sorted(self._left_out))
        status.values.append(
            KeyValue(key='design values left at the preliminary design', value=left_out)
        )
        self._outputs.report(status)

    def _settle_losses(self) -> None:
        if not self._health.counts_lost:
            return
        for topic, subscription in self._inputs.items():
            lost = self._lost[topic]
            heard = [
                tuple(info.endpoint_gid)
                for info in self.get_publishers_info_by_topic(topic)
                if not self._misfit_of(info, subscription)
            ]
            if count := lost.settle(heard):
                self._health.note_lost(count)

    def _misfit(self) -> str:
        """Say which publishers are not heard, and why; empty if all are."""
        misfits = [
            f'{subscription.topic_name} is published {misfit}'
            for topic, subscription in self._subscriptions_by_topic.items()
            # Of the topic before it is remapped, which this does itself.
            for info in self.get_publishers_info_by_topic(topic)
            if (misfit := self._misfit_of(info, subscription))
        ]
        return '; '.join(dict.fromkeys(misfits))

    def _misfit_of(self, publisher: TopicEndpointInfo, subscription: Subscription) -> str:
        taken = messages.type_name(subscription.msg_type)
        if publisher.topic_type != taken:
            taker = 'it'
            if subscription in self._inputs.values():
                taker = f'tension_source {self._wiring.tension_source}'
            return f'as {publisher.topic_type}, but {taker} takes {taken}'
        fit, reason = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
        if fit == QoSCompatibility.ERROR:
            return f'with a quality of service that does not fit: {reason.rstrip("; ")}'
        return ''

    # Services

    def _on_solve(
        self, request: messages.Solve.Request, response: messages.Solve.Response
    ) -> messages.Solve.Response:
        try:
            equilibrium = solve(self._settings.design, request.tension_l, request.tension_s)
        except TensionError as error:
            return messages.refuse_solve(response, str(error))
        return messages.fill_solve_response(response, equilibrium, self._settings.tension_stddev)

    def _on_solve_inverse(
        self, request: messages.SolveInverse.Request, response: messages.SolveInverse.Response
    ) -> messages.SolveInverse.Response:
        return messages.fill_inverse_response(response, self._settings.design, request)

    def _on_solve_latest(
        self, _request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        if self._latest is None:
            reason = f'no valid tensions have come on {self._input_names()} yet'
            if self._health.last_drop:
                reason += f'; the newest message was invalid: {self._health.last_drop}'
            return messages.refuse(response, reason)
        tension_l, tension_s, arrival = self._latest
        try:
            # A copy, since asking does not move the unit.
            result = self._result(copy.copy(self._tracker), tension_l, tension_s)
        except TensionError as error:  # valid for the design of then, not for that of now
            return messages.refuse(response, str(error))
        stddev = self._settings.tension_stddev
        response.success = True
        response.message = json.dumps(
            {
                **result.as_dict(),
                'bend_angle_stddev': result.bend_angle_stddev(stddev),
                'pressure_stddev': result.pressure_stddev(stddev),
                'age': time.monotonic() - arrival,
                'invalid_since': self._invalid_since_latest,
                'rejected_corrections': self._rejected_corrections,
            },
            allow_nan=False,
        )
        return response

    def _on_reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        if self._tracker is None:
            return messages.refuse(
                response, 'estimation is equilibrium, which remembers nothing to reset'
            )
        self._tracker.reset(self._settings.initial_bend_angle)
        self._corrected = time.monotonic()
        response.success = True
        response.message = f'the unit is at {self._settings.initial_bend_angle:.6g} rad'
        return response
