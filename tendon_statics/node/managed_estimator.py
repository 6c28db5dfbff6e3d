"""What the nodes of a unit and of an arm have in common: lifecycle, readings, what is in doubt."""

from __future__ import annotations

import time

from builtin_interfaces.msg import Time
from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.time import Time as ClockTime

from ..estimation.estimate import KnownLoad
from ..estimation.health import Health
from ..estimation.reading_estimator import ReadingEstimator
from ..estimation.regimes import INVALID
from ..files.measuring_parameters import TENSION_STDDEV
from ..files.parameter_kinds import SettingError
from ..physics import BendAngleError
from ..tensions.reason import ReadingError, Reason
from .diagnostics import Reports
from .inputs.load import LoadInputs
from .inputs.subscriptions import Subscriptions
from .inputs.tension_source import Reading, nanoseconds
from .kind_of_estimator import E, KindOfEstimator, S
from .parameters.changes import Changes
from .parameters.unknown import warn_of_unknown_parameters
from .program import StartError
from .services import Services
from .watchdog import Watchdog, throttled

UNCONFIGURED, INACTIVE, ACTIVE, FINALIZED = 'unconfigured', 'inactive', 'active', 'finalized'
"""States of a managed node"""


class ManagedEstimator(KindOfEstimator[S, E]):
    """Publishes what every set of tensions that arrives says of a unit, or of an arm.

    What it knows of that is in a `ReadingEstimator`, which needs no ROS; here it is connected, and
    has its lifecycle. All topics, services and timers are there from the start, since rclpy
    cannot handle subscriptions that come and go while it spins. What the state of the lifecycle
    changes is whether they do anything.

    Parameters
    ----------
    name : str
        Of the node.
    """

    health: Health

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.core: ReadingEstimator[S, E]  # from configuring on
        self.rejected_corrections = 0
        self.left_out = set()
        self.state_label = UNCONFIGURED
        self._has_run = False

        self._declare()
        self._warn_of_unsaid_noise()
        sees_numbers = self.wiring.executor == 'single'
        self.health = self._new_health(counts_lost=sees_numbers)
        self._outputs = self._new_outputs()
        self._source = self._new_source(lambda: self.core.settings.max_skew)
        self._inputs = Subscriptions(
            self, self._source, self.health, lambda: self.is_active, sees_numbers=sees_numbers
        )
        self._load = LoadInputs(self.wiring, lambda: self.core.settings, self._warn_of_load)
        for topic, of_topic in self._load.inputs.items():
            self._inputs.add(topic, *of_topic)
        self._answers = Services(self)
        self._connect()
        self._reports = Reports(self, self._outputs, self._inputs, self._load)
        self._watchdog = Watchdog(self, self._outputs, self._source, self._reports)
        self._jump_handle = self.get_clock().create_jump_callback(
            JumpThreshold(
                min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
            ),
            post_callback=lambda _jump: self._source.forget(),
        )
        warn_of_unknown_parameters(self)
        # Last, since every declaration would be a change.
        self.changes: Changes[S] = Changes(
            self, self.table, self._take_settings, self._warn_of_misfit
        )
        if self.wiring.autostart:
            self.table.read(self)  # raises with the reason, where a transition could only fail
            for trigger in (self.trigger_configure, self.trigger_activate):
                if trigger() != TransitionCallbackReturn.SUCCESS:
                    raise StartError('a transition of its lifecycle failed')

    @property
    def executor_kind(self) -> str:
        """Which executor is to spin the node: ``single`` or ``events``."""
        return self.wiring.executor

    @property
    def is_active(self) -> bool:
        """Whether it estimates and answers."""
        return self.state_label == ACTIVE

    @property
    def is_configured(self) -> bool:
        """Whether it has settings in force."""
        return self.state_label in (INACTIVE, ACTIVE)

    @property
    def tension_topics(self) -> str:
        """The topics of tensions, as a person reads them."""
        return self._inputs.tension_topics

    def known_load(self) -> KnownLoad:
        """Return what is known of the load now."""
        return self._load.known(time.monotonic())

    # Lifecycle

    def on_configure(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Take the parameters, if they are valid."""
        try:
            settings = self.table.read(self)
        except SettingError as error:
            self.get_logger().error(f'Not configured: {error}')
            return TransitionCallbackReturn.FAILURE
        self.changes.begin_anew()
        self.core = self._new_core(settings)
        for doubt in settings.doubts:
            self.get_logger().warning(doubt)
        for default in settings.defaults:
            self.get_logger().info(default)
        self.state_label = INACTIVE
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Begin to estimate."""
        self._inputs.let_pass_what_waits()
        self._answers.forget_readings()
        if self._tip_forces is not None:
            self._tip_forces.forget()
        if self._has_run:
            self.core.doubt()  # It may have moved while nobody looked.
        self._has_run = True
        self.state_label = ACTIVE
        self._watchdog.begin()
        self.get_logger().info(f'Ready: {self.wiring.estimation} from {self.tension_topics}')
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Do and publish nothing until activated again."""
        self._stop(INACTIVE)
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Forget what was measured; parameters may be set one by one again."""
        self.state_label = UNCONFIGURED
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Do and publish nothing any more."""
        self._stop(FINALIZED)
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured; rclpy keeps to itself what went wrong."""
        self.get_logger().error('A transition failed; the node is unconfigured now')
        self._stop(UNCONFIGURED)
        return TransitionCallbackReturn.SUCCESS

    def _stop(self, state: str) -> None:
        if self.is_active:
            self._source.forget()
            self._watchdog.lose_sight()
            self._reports.report('deactivated')
        self.state_label = state

    def _take_settings(self, settings: S) -> None:
        """Take a whole set of parameters while it is inactive or active."""
        before = self.core.settings
        warning = self.core.change_settings(settings)
        if warning:
            self.get_logger().warning(warning)
        for doubt in settings.doubts:
            if doubt not in before.doubts:
                self.get_logger().warning(doubt)
        if settings.input_timeout != before.input_timeout:
            self._watchdog.begin_again()

    def _warn_of_misfit(self, text: str) -> None:
        self.get_logger().warning(text)
        if self.is_active:
            self._reports.report()

    def note_set(self, names: set[str]) -> None:
        """Note that parameters of these names have been set."""
        self.left_out -= names

    def _warn_of_unsaid_noise(self) -> None:
        """Warn that a filter takes for its noise what nobody said it is."""
        if (
            self.wiring.estimation == 'filtering'
            and 'tension_stddev' not in self._parameter_overrides
        ):
            self.get_logger().warning(
                f'estimation is filtering, and no tension_stddev came: {TENSION_STDDEV.default} N '
                'is taken for the noise of each tension, and intervals are as wide as that says'
            )

    # Topics

    def _on_reading(self, reading: Reading) -> None:
        core, arrival = self.core, self._inputs.arrival
        self._answers.note_reading(reading.values)
        known = self.known_load()
        lag = max(0.0, 1e-9 * (time.time_ns() - arrival))
        # What waited because this node was busy is no gap in what it was sent.
        arrived = time.monotonic() - lag
        if reading.stamp is None:
            measured = 1e-9 * arrival
        else:
            measured = 1e-9 * nanoseconds(reading.stamp)
            offset = measured - 1e-9 * self.get_clock().now().nanoseconds
            self.health.note_offset(offset, core.settings.max_clock_offset)
        was_stale = self.health.stale
        try:
            estimate = core.take_readings(reading.values, known, arrived, measured)
        except ReadingError as error:
            self._say_dropped(error.reason, str(error))
            return

        def stamp() -> Time:
            return reading.stamp or self._time_of(arrival)

        self._outputs.publish(estimate, stamp)
        if self._committed is not None:
            self._committed.publish(core, measured, stamp)
        if self._tip_forces is not None:
            self._tip_forces.publish(estimate, stamp)
        self.health.note_lag(lag, core.settings.input_timeout)
        self._source.tighten()
        self._watchdog.note_valid(was_stale=was_stale)
        self._reports.report_change(recovered=was_stale)

    def _time_of(self, arrival: int) -> Time:
        clock = self.get_clock()
        if clock.ros_time_is_active:  # A simulated clock does not know how long it waited.
            return clock.now().to_msg()
        return ClockTime(nanoseconds=arrival).to_msg()

    def _on_drop(self, reason: Reason, text: str) -> None:
        """Take that a message gives no tensions."""
        self.core.drop(reason, text)
        self._say_dropped(reason, text)

    def _say_dropped(self, reason: Reason, text: str) -> None:
        if reason.is_of_content:
            self._outputs.say_regime(INVALID)
        self.get_logger().warning(
            f'{"Invalid" if reason.is_of_content else "Dropped"} message on '
            f'{self.tension_topics} ({self.health.dropped.total()} so far): {text}',
            **throttled(),
        )
        self._reports.report_change()

    def _reject_correction(self, error: BendAngleError | str) -> None:
        """Say that a measured angle is of no use."""
        self.rejected_corrections += 1
        self.get_logger().warning(
            f'Rejected a measured bend angle ({self.rejected_corrections} so far): {error}',
            **throttled(),
        )

    def _warn_of_load(self, text: str) -> None:
        self.get_logger().warning(text, **throttled())  # A throttle is of the line of code.
