"""What is soaked: an estimator, the driver that feeds it, and what the books of both must say."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

from rclpy.parameter import Parameter
from ros_programs import Program

Setting = tuple[str, Parameter.Type, Any]

Line = tuple[str, int, int]
"""What is counted, what it should be by the books of the driver, and what it is"""


@dataclass(frozen=True)
class Subject:
    """An estimator with a kind of messages of tensions."""

    title: str
    program: str
    """Of the estimator, and the name of its node"""

    arguments: tuple[str, ...]
    """Parameters of the estimator, as ``name:=value``"""

    topics: tuple[str, ...]
    """Of the tensions"""

    outputs: Mapping[str, type]
    """Topics that are counted → type"""

    estimates: str
    """The one of these that has an estimate for each sound reading"""

    regimes: str
    """The one of these that has a word for each reading"""

    regime: Callable[[Any], str]
    """The word in a message of these"""

    rate: float
    """Readings per second"""

    drive: Callable[..., AbstractContextManager[Program]]
    """Runs a driver, given how many readings at which rate, and whether with faults; with 0
    readings until it is ended"""

    settings: tuple[tuple[Setting, bool], ...]
    """Parameters that are set all the time, and whether they are to be taken"""

    books: Callable[[Mapping[str, int], Counter[str], Counter[str]], list[Line]]
    """From what the driver sent, what the estimator counted and what came of it"""

    messages_for_one: Mapping[str, int]
    """What counts once though it was several messages → how many"""
