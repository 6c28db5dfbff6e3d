"""All parameters of an estimator's node: how they are declared, read, and checked."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any, Generic, TypeVar

from rclpy.node import Node
from rclpy.parameter import Parameter as ROSParameter

from ...estimation.measuring import Measuring
from ...files.parameter_kinds import Parameter
from .declaration import converted, declare_all, read_all

S = TypeVar('S', bound=Measuring)


@dataclasses.dataclass(frozen=True)
class NodeTable(Generic[S]):
    """The parameters of a node, and what is made of their values.

    Attributes
    ----------
    fixed, changeable : tuple of Parameter
        How the node is connected, and what may change while it runs.
    check : callable
        Raises a `SettingError` if a value, of those that are given by name, is not allowed.
    settings : callable
        Makes settings of the values by name; raises a `SettingError` if the whole is not valid.
    whole : tuple of str
        What the names of those begin with that are set all or none.
    whole_is : str
        What those are, for people.
    """

    fixed: tuple[Parameter, ...]
    changeable: tuple[Parameter, ...]
    check: Callable[[Mapping[str, Any]], None]
    settings: Callable[[Mapping[str, Any]], S]
    whole: tuple[str, ...] = ()
    whole_is: str = ''

    def declare_changeable(self, node: Node) -> None:
        """Declare what may change; values that are not allowed are kept, for `read` to refuse."""
        declare_all(node, self.changeable)

    def read(self, node: Node, changes: Iterable[Any] = ()) -> S:
        """Return what the parameters of a node are set to, with these ROS parameters changed.

        Raises
        ------
        SettingError
            If the whole is not valid.
        """
        values = read_all(node, self.changeable, changes)
        return self.settings({**values, 'estimation': node.get_parameter('estimation').value})

    def in_its_type(self, given: ROSParameter) -> ROSParameter:
        """Return what is set in the type that the node keeps, if it can be meant as such."""
        parameter = self._by_name.get(given.name)
        return given if parameter is None else converted(parameter, given)

    @cached_property
    def _by_name(self) -> dict[str, Parameter]:
        return {parameter.name: parameter for parameter in (*self.changeable, *self.fixed)}
