"""Asking an estimator what it is of: the design of its unit, or its arm."""

from __future__ import annotations

import math
from typing import Any

from rcl_interfaces.srv import GetParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

from .kinds import Kind

PERIOD = 3.0
"""Seconds between two questions, since a design may be changed at any time"""

PATIENCE = 30.0
"""Seconds after which an answer is no longer waited for; a busy estimator is slow to answer"""


class DesignQuestion:
    """Asks for an estimator's design again and again; reads it, and changes nothing."""

    def __init__(self, node: Node, estimator: str, kind: Kind) -> None:
        self.design: Any = None
        """The newest answer, a `JointDesign` or an `Arm`; None before the first, and where there
        is none"""
        self._node = node
        self._kind = kind
        self._client = node.create_client(GetParameters, f'{estimator}/get_parameters')
        self._asked_at = -math.inf
        self._asked: Any = None

    def ask_when_due(self, now: float) -> None:
        """Take the answer that came, and ask once more if it is time; `now` is in s."""
        if self._asked is not None and self._asked.done():
            self._take(self._asked)
            self._asked = None
        if not self._client.service_is_ready():
            self._forget()
        elif now >= self._asked_at + (PERIOD if self._asked is None else PATIENCE):
            self._asked_at = now
            self._forget()
            names = list(self._kind.asked)
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
        answers = zip(self._kind.asked, values, strict=False)
        self.design = self._kind.model_of(
            {name: value for name, value in answers if value is not None}
        )
