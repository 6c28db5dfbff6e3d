"""Changes of an estimator's parameters: each value by itself, and all of them as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Generic

from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter

from ...files.parameter_kinds import MisfitError, SettingError
from .table import NodeTable, S

if TYPE_CHECKING:
    from ..managed_estimator import ManagedEstimator


class Changes(Generic[S]):
    """Takes what is set while the node runs.

    What clients set together is taken or refused as a whole. ROS's other way, one by one, cannot
    be: values that only fit together would be refused where the first of them comes, and the rest
    would make a unit that nobody asked for. So of one request all of the design is taken or none,
    and values that do not fit the others wait: until they do, the last whole set stays in force.

    Parameters
    ----------
    table : NodeTable
        The parameters.
    take : callable
        Takes the settings of a whole set.
    warn : callable
        Takes a text on values that do not fit together.
    """

    def __init__(
        self,
        node: ManagedEstimator[S, Any],
        table: NodeTable[S],
        take: Callable[[S], None],
        warn: Callable[[str], None],
    ) -> None:
        self.misfit = ''
        """Why the parameters, as they are, are not in force; empty if they are"""
        self._node = node
        self._table = table
        self._take = take
        self._warn = warn
        self._is_one_by_one = False
        node.add_pre_set_parameters_callback(lambda given: list(map(table.in_its_type, given)))
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._note)
        # Before the node spins, so that no executor knows them yet.
        for service in node.services:
            if service.srv_type is SetParameters:
                service.callback = self._set_one_by_one
            elif service.srv_type is SetParametersAtomically:
                service.callback = self._set_together

    def set_together(self, parameters: Iterable[Parameter]) -> SetParametersResult:
        """Set all or none, with the reason."""
        given = list(map(self._table.in_its_type, parameters))
        if not given:
            return SetParametersResult(successful=True)
        objection = self._objection(given)
        if objection:
            return SetParametersResult(successful=False, reason=objection)
        return self._node.set_parameters_atomically(given)

    def begin_anew(self) -> None:
        """Take it that what is set now is in force, as with configuring."""
        self.misfit = ''

    def _set_together(
        self,
        request: SetParametersAtomically.Request,
        response: SetParametersAtomically.Response,
    ) -> SetParametersAtomically.Response:
        response.result = self.set_together(map(Parameter.from_parameter_msg, request.parameters))
        self._say_refused([response.result])
        return response

    def _set_one_by_one(
        self, request: SetParameters.Request, response: SetParameters.Response
    ) -> SetParameters.Response:
        given = [Parameter.from_parameter_msg(message) for message in request.parameters]
        whole = [of for of in given if of.name.startswith(self._table.whole)]
        self._is_one_by_one = True
        try:
            of_whole = self.set_together(whole)
            if not of_whole.successful and len(whole) > 1:
                of_whole.reason += f'; none of {self._table.whole_is} is set that came with it'
            results = [
                of_whole if parameter in whole else self._set_one(parameter) for parameter in given
            ]
        finally:
            self._is_one_by_one = False
        self._judge()
        for result in results:
            if result.successful:
                result.reason = self.misfit
        self._say_refused(results)
        response.results = results
        return response

    def _say_refused(self, results: Iterable[SetParametersResult]) -> None:
        """Say it here too, since a client may pass over it, as ``ros2 param load`` does."""
        for reason in dict.fromkeys(of.reason for of in results if not of.successful):
            self._node.get_logger().warning(f'Not set: {reason}', throttle_duration_sec=1.0)

    def _set_one(self, parameter: Parameter) -> SetParametersResult:
        """Set what is not of the design; a value that is fixed may be set to what it is."""
        node, name = self._node, parameter.name
        if (
            node.has_parameter(name)
            and node.describe_parameter(name).read_only
            and self._table.in_its_type(parameter).value == node.get_parameter(name).value
        ):
            return SetParametersResult(successful=True)
        return self.set_together([parameter])

    def _objection(self, parameters: Iterable[Parameter]) -> str:
        """Say what is against values by themselves, better than rclpy does; empty if nothing."""
        for parameter in parameters:
            name = parameter.name
            if not self._node.has_parameter(name):
                return f'{name} is {parameter.value!r}, but there is no such parameter'
            if parameter.type_ == Parameter.Type.NOT_SET:
                return f'{name} cannot be deleted, only set to another value'
            try:
                self._table.check({name: parameter.value})
            except SettingError as error:
                return str(error)
        return ''

    # What rclpy calls, also for what this program itself sets

    def _check(self, parameters: list[Parameter]) -> SetParametersResult:
        objection = self._objection(parameters)
        if not objection and self._node.is_configured:  # before, the whole is on configuring
            try:
                self._table.read(self._node, parameters)
            except MisfitError as error:
                objection = '' if self._is_one_by_one else str(error)
            except SettingError as error:
                objection = str(error)
        return SetParametersResult(successful=not objection, reason=objection)

    def _note(self, parameters: list[Parameter]) -> None:
        changes = ', '.join(f'{parameter.name} = {parameter.value!r}' for parameter in parameters)
        self._node.get_logger().info(f'Changed: {changes}')
        self._node.note_set({parameter.name for parameter in parameters})
        if not self._is_one_by_one:
            self._judge()

    def _judge(self) -> None:
        """Put the parameters in force, if they make a whole."""
        if not self._node.is_configured:
            return
        try:
            settings = self._table.read(self._node)
        except MisfitError as error:
            misfit = f'parameters do not fit together, so that those before stay in force: {error}'
            is_new, self.misfit = misfit != self.misfit, misfit
            if is_new:
                self._warn(misfit)
            return
        self.misfit = ''
        self._take(settings)
