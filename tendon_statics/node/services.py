"""The services that every estimator has: what each answers."""

from __future__ import annotations

import functools
import json
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_srvs.srv import Trigger

from ..physics import ArmError, TensionError
from ..tensions.tare import TareError, tare
from .outputs import messages

if TYPE_CHECKING:
    from .managed_estimator import ManagedEstimator

MOST_VALUES = 2_000_000
"""Of which ``~/tare`` averages at most, of all cables together"""


class Services:
    """Answers what an estimator is asked, and refuses with the reason unless it is active."""

    def __init__(self, node: ManagedEstimator[Any, Any]) -> None:
        self._node = node
        self._recent: deque[tuple[float, Sequence[float]]] = deque(
            maxlen=MOST_VALUES // len(node.bias_parameters)
        )
        offer(node, Trigger, 'solve_latest', self._solve_latest, messages.refuse)
        offer(node, Trigger, 'reset', self._reset, messages.refuse)
        offer(node, Trigger, 'tare', self._tare, messages.refuse)
        # rclpy raises where a transition does not exist in the present state, through the
        # executor, and that would end the node.
        change = node._service_change_state
        change.callback = functools.partial(self._change_state, change.callback)

    def note_reading(self, values: Sequence[float]) -> None:
        """Remember what load cells say, for ``~/tare``."""
        recent, now = self._recent, time.monotonic()
        recent.append((now, values))
        oldest = now - self._node.core.settings.tare_time
        while recent[0][0] < oldest:
            recent.popleft()

    def forget_readings(self) -> None:
        """Forget what load cells said."""
        self._recent.clear()

    def _solve_latest(
        self, _request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        core, health = self._node.core, self._node.health
        newest = core.newest
        if newest is None:
            reason = f'no valid tensions have come on {self._node.tension_topics} yet'
            if health.last_drop:
                reason += f'; the newest message was invalid: {health.last_drop}'
            return messages.refuse(response, reason)
        try:
            estimate = core.again(newest)
        # Valid for the design and angles of then, not for those of now.
        except (ArmError, TensionError) as error:
            return messages.refuse(response, str(error))
        load = newest.known.load
        response.success = True
        response.message = json.dumps(
            {
                **estimate.as_dict(),
                **self._node.values_of_settings(),
                'gravity_direction': load.gravity_direction,
                'tip_force': load.tip_force,
                'tip_distance': load.tip_distance,
                'load_assured': newest.known.is_assured,
                'age': time.monotonic() - newest.time,
                'invalid_since': core.invalid_since_newest,
                'rejected_corrections': self._node.rejected_corrections,
            },
            allow_nan=False,
        )
        return response

    def _reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        core = self._node.core
        if not core.remembers:
            return messages.refuse(
                response, 'estimation is equilibrium, which remembers nothing to reset'
            )
        response.success = True
        response.message = core.put_back(time.monotonic())
        return response

    def _tare(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Set the biases with which the readings of the last `tare_time` are 0 in the mean."""
        settings, biases = self._node.core.settings, self._node.bias_parameters
        oldest = time.monotonic() - settings.tare_time
        recent = [values for at, values in self._recent if at >= oldest]
        tensions = {
            cable: [scale.gain * reading[place] + scale.bias for reading in recent]
            for place, (cable, scale) in enumerate(zip(biases, settings.scales, strict=True))
        }
        try:
            tares = tare(tensions, [of.bias for of in settings.scales], settings.tension_stddev)
        except TareError as error:
            return messages.refuse(
                response,
                f'{error}, of the last {settings.tare_time:g} s; '
                f'{"both" if len(biases) == 2 else "all"} cables have to hang slack and still',
            )
        for of in tares:
            if not abs(of.mean) <= settings.tare_limit:
                return messages.refuse(
                    response,
                    f'{of.cable} reads {of.mean:.4g} N, more than tare_limit, '
                    f'{settings.tare_limit:g} N: is it taut?',
                )
        result = self._node.changes.set_together(
            Parameter(bias, Parameter.Type.DOUBLE, of.bias)
            for bias, of in zip(biases.values(), tares, strict=True)
        )
        if not result.successful:
            return messages.refuse(response, result.reason)
        response.success = True
        response.message = '; '.join(
            f'{bias} was {of.old_bias:.6g} N and is {of.bias:.6g} N, from {of.readings} '
            f'readings that scatter by {of.scatter:.3g} N'
            + (f' ({doubt})' if (doubt := of.doubt(settings.weight, settings.what)) else '')
            for bias, of in zip(biases.values(), tares, strict=True)
        )
        self._node.get_logger().info(f'Tare: {response.message}')
        return response

    def _change_state(self, change: Callable[[Any, Any], Any], request: Any, response: Any) -> Any:
        try:
            return change(request, response)
        except RuntimeError as error:  # RCLError is one
            self._node.get_logger().error(f'No such transition now: {error}')
            response.success = False
            return response


def say_interfaces_are_missing(
    node: ManagedEstimator[Any, Any], *offered: str, why: str = messages.INTERFACES_MISSING
) -> None:
    """Warn that a node offers less without the package nested in interfaces/."""
    *first, last = offered
    named = f'{", ".join(first)} and {last}' if first else last
    node.get_logger().warning(
        f'No {named}, since tendon_statics_interfaces is not '
        f'there or older than this ({why}). It is in the folder '
        'interfaces/: colcon build --base-paths . interfaces'
    )


def offer(
    node: ManagedEstimator[Any, Any],
    service_type: type,
    name: str,
    answer: Callable[[Any, Any], Any],
    refuse: Callable[[Any, str], Any],
    *,
    in_every_state: bool = False,
) -> None:
    """Create a service that answers while the node is active, or always, and else refuses."""

    def on_request(request: Any, response: Any) -> Any:
        if node.is_active or in_every_state:
            return answer(request, response)
        full_name = node.get_fully_qualified_name()
        return refuse(response, f'{full_name} is {node.state_label}; it answers when it is active')

    depth = QoSProfile(depth=node.wiring.service_depth)
    node.create_service(service_type, f'~/{name}', on_request, qos_profile=depth)
