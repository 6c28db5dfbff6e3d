"""Asking an estimator for the design of its unit."""

from __future__ import annotations

import math
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

from ..files.estimator_parameters import DESIGN
from ..physics import DesignError, JointDesign, design_fields

PERIOD = 3.0
"""Seconds between two questions, since a design may be changed at any time"""

NAMES = [field.name for field in design_fields()]


class DesignQuestion:
    """Asks for an estimator's design again and again; reads it, and changes nothing."""

    def __init__(self, node: Node, estimator: str) -> None:
        self.design: JointDesign | None = None
        """The newest answer; None before the first, and where there is none"""
        self._node = node
        self._client = node.create_client(GetParameters, f'{estimator}/get_parameters')
        self._next = -math.inf
        self._asked: Any = None

    def ask_when_due(self, now: float) -> None:
        """Take the answer that came, and ask once more if it is time; `now` is in s."""
        if self._asked is not None and self._asked.done():
            self._take(self._asked)
            self._asked = None
        if now >= self._next and self._client.service_is_ready():
            self._next = now + PERIOD
            self._forget()
            names = [DESIGN + name for name in NAMES]
            self._asked = self._client.call_async(GetParameters.Request(names=names))

    def close(self) -> None:
        """Ask no more."""
        self._forget()
        self._node.destroy_client(self._client)

    def _forget(self) -> None:
        if self._asked is not None:  # of an estimator that has ended meanwhile
            self._client.remove_pending_request(self._asked)
            self._asked = None

    def _take(self, asked: Any) -> None:
        values = map(parameter_value_to_python, asked.result().values)
        given = {
            name: value for name, value in zip(NAMES, values, strict=False) if value is not None
        }
        try:
            self.design = JointDesign.from_mapping(given)
        except DesignError:  # as of an estimator that is not configured yet
            self.design = None
