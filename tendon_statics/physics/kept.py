"""A property that is worked out once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

Value = TypeVar('Value')


class kept(Generic[Value]):  # noqa: N801 - it is used as `property` is
    """`functools.cached_property` without the lock that it takes before Python 3.12.

    The lock would take 3 % of ``solve(...).as_dict()``.
    """

    def __init__(self, function: Callable[[Any], Value]) -> None:
        self._function = function
        self.__doc__ = function.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: Any, owner: type | None = None) -> Value:
        value = instance.__dict__[self._name] = self._function(instance)
        return value
