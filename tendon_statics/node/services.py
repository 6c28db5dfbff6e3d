"""The services of the estimator: what each answers."""

from __future__ import annotations

import functools
import json
import time
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_srvs.srv import Trigger

from ..files.cable_parameters import BIASES
from ..physics import LoadError, TensionError, solve
from ..tensions.tare import TareError, tare
from .load_design import load_design
from .outputs import messages

if TYPE_CHECKING:
    from .estimator import Estimator

MOST_READINGS = 1_000_000
"""Of which ``~/tare`` averages at most"""


class Services:
    """Answers what the estimator is asked, and refuses with the reason unless it is active."""

    def __init__(self, node: Estimator) -> None:
        self._node = node
        self._recent: deque[tuple[float, float, float]] = deque(maxlen=MOST_READINGS)
        if messages.INTERFACES_MISSING:
            node.get_logger().warning(
                'No ~/solve, ~/solve_inverse, ~/load_design and ~/estimate, since '
                f'tendon_statics_interfaces is not there ({messages.INTERFACES_MISSING}). It is '
                'in the folder interfaces/: colcon build --base-paths . interfaces'
            )
        else:
            offer(node, messages.Solve, 'solve', self._solve, messages.refuse_solve)
            offer(
                node, messages.SolveInverse, 'solve_inverse', self._invert, messages.refuse_inverse
            )
            offer(
                node,
                messages.LoadDesign,
                'load_design',
                functools.partial(load_design, node),
                messages.refuse,
                in_every_state=True,
            )
        offer(node, Trigger, 'solve_latest', self._solve_latest, messages.refuse)
        offer(node, Trigger, 'reset', self._reset, messages.refuse)
        offer(node, Trigger, 'tare', self._tare, messages.refuse)
        # rclpy raises where a transition does not exist in the present state, through the
        # executor, and that would end the node.
        change = node._service_change_state
        change.callback = functools.partial(self._change_state, change.callback)

    def note_reading(self, value_l: float, value_s: float) -> None:
        """Remember what load cells say, for ``~/tare``."""
        recent, now = self._recent, time.monotonic()
        recent.append((now, value_l, value_s))
        oldest = now - self._node.unit.settings.tare_time
        while recent[0][0] < oldest:
            recent.popleft()

    def forget_readings(self) -> None:
        """Forget what load cells said."""
        self._recent.clear()

    def _solve(
        self, request: messages.Solve.Request, response: messages.Solve.Response
    ) -> messages.Solve.Response:
        settings = self._node.unit.settings
        try:
            known = messages.asked_load(request, self._node.known_load())
            result = solve(settings.design, request.tension_l, request.tension_s, known.load)
        except (TensionError, LoadError) as error:
            return messages.refuse_solve(response, str(error))
        return messages.fill_solve_response(
            response, result, settings, load_assured=known.is_assured
        )

    def _invert(
        self, request: messages.SolveInverse.Request, response: messages.SolveInverse.Response
    ) -> messages.SolveInverse.Response:
        return messages.fill_inverse_response(
            response, self._node.unit.settings.design, request, self._node.known_load().load
        )

    def _solve_latest(
        self, _request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        unit, health = self._node.unit, self._node.health
        newest = unit.newest
        if newest is None:
            reason = f'no valid tensions have come on {self._node.tension_topics} yet'
            if health.last_drop:
                reason += f'; the newest message was invalid: {health.last_drop}'
            return messages.refuse(response, reason)
        try:
            estimate = unit.again(newest)
        except TensionError as error:  # valid for the design of then, not for that of now
            return messages.refuse(response, str(error))
        load = newest.known.load
        response.success = True
        response.message = json.dumps(
            {
                **estimate.as_dict(),
                'contact_law': unit.settings.design.contact_law,
                'gravity_direction': load.gravity_direction,
                'tip_force': load.tip_force,
                'tip_distance': load.tip_distance,
                'load_assured': newest.known.is_assured,
                'age': time.monotonic() - newest.time,
                'invalid_since': unit.invalid_since_newest,
                'rejected_corrections': self._node.rejected_corrections,
            },
            allow_nan=False,
        )
        return response

    def _reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        unit = self._node.unit
        if not unit.remembers:
            return messages.refuse(
                response, 'estimation is equilibrium, which remembers nothing to reset'
            )
        unit.put(unit.settings.initial_bend_angle, time.monotonic())
        response.success = True
        response.message = f'the unit is at {unit.settings.initial_bend_angle:.6g} rad'
        return response

    def _tare(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Set the biases with which the readings of the last `tare_time` are 0 in the mean."""
        settings = self._node.unit.settings
        oldest = time.monotonic() - settings.tare_time
        recent = [(value_l, value_s) for at, value_l, value_s in self._recent if at >= oldest]
        tension_l, tension_s = (
            [scale.gain * reading[cable] + scale.bias for reading in recent]
            for cable, scale in enumerate(settings.scales)
        )
        try:
            tares = tare(
                tension_l,
                tension_s,
                (settings.cable_l.bias, settings.cable_s.bias),
                settings.tension_stddev,
            )
        except TareError as error:
            return messages.refuse(
                response,
                f'{error}, of the last {settings.tare_time:g} s; both cables have to hang slack '
                'and still',
            )
        for of in tares:
            if not abs(of.mean) <= settings.tare_limit:
                return messages.refuse(
                    response,
                    f'{of.cable} reads {of.mean:.4g} N, more than tare_limit, '
                    f'{settings.tare_limit:g} N: is it taut?',
                )
        result = self._node.changes.set_together(
            Parameter(bias.name, Parameter.Type.DOUBLE, of.bias)
            for bias, of in zip(BIASES, tares, strict=True)
        )
        if not result.successful:
            return messages.refuse(response, result.reason)
        response.success = True
        response.message = '; '.join(
            f'{bias.name} was {of.old_bias:.6g} N and is {of.bias:.6g} N, from {of.readings} '
            f'readings that scatter by {of.scatter:.3g} N'
            + (f' ({doubt})' if (doubt := of.doubt(settings.design.weight)) else '')
            for bias, of in zip(BIASES, tares, strict=True)
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


def offer(
    node: Estimator,
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
