"""The numbers in messages, by the types of these."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ...tensions.named_values import NamedValues, cable_values
from ...tensions.reason import Reason
from ..errors import RecordingError
from .bag_storage import Message, Messages
from .topics import BagTopics

ARRAY = 'std_msgs/msg/Float64MultiArray'
ARRAY_32 = 'std_msgs/msg/Float32MultiArray'
NUMBER = 'std_msgs/msg/Float64'
NUMBER_32 = 'std_msgs/msg/Float32'
JOINT_STATE = 'sensor_msgs/msg/JointState'
DYNAMIC = 'control_msgs/msg/DynamicJointState'
WRENCH = 'geometry_msgs/msg/WrenchStamped'
BARE_WRENCH = 'geometry_msgs/msg/Wrench'
ESTIMATE = 'tendon_statics_interfaces/msg/Estimate'
ARM_ESTIMATE = 'tendon_statics_interfaces/msg/ArmEstimate'

SOURCES: Mapping[str, tuple[str, ...]] = {
    'array': (ARRAY, ARRAY_32),
    'joint_state': (JOINT_STATE, DYNAMIC),
    'wrench_pair': (WRENCH, BARE_WRENCH),
}
"""Value of the estimator's ``tension_source`` → the types that are meant by it"""

ONE_TOPIC = (ARRAY, ARRAY_32, JOINT_STATE, DYNAMIC, ESTIMATE)
"""Types of a topic with the tensions of both cables"""

TWO_TOPICS = (NUMBER, NUMBER_32, BARE_WRENCH, WRENCH)
"""Types of two topics with one tension each"""

OF_ARM = (ARRAY, ARRAY_32, JOINT_STATE, DYNAMIC, ARM_ESTIMATE)
"""Types of a topic with the tensions of an arm's cables"""

IN_NEWTONS = (ESTIMATE, ARM_ESTIMATE)
"""Types that hold tensions for certain, and no readings of load cells"""

Value = Callable[[Message], Any]


def messages_on(
    bag: Messages, topic: str, kinds: tuple[str, ...], hint: str = '', wanted: str = ''
) -> list[Message]:
    """Return the messages on a topic, all of one type that is among `kinds`.

    The two texts are added to errors: what to do about several types, and why those are needed.

    Raises
    ------
    RecordingError
        If the topic has another type, or messages of several of those types.
    """
    there: dict[str, int] = {}
    for message in bag.messages[topic]:
        there[message.kind] = there.get(message.kind, 0) + 1
    there = there or {bag.types[topic]: 0}
    readable = [kind for kind in there if kind in kinds]
    if not readable:
        raise RecordingError(
            f'the topic {topic} is a {" and a ".join(there)}; {" or ".join(kinds)} is needed'
            f'{wanted}'
        )
    if len(readable) > 1:
        listed = ', '.join(f'{kind} ({there[kind]} messages)' for kind in readable)
        raise RecordingError(f'the topic {topic} has several types: {listed}{hint}')
    for kind, count in there.items():
        if kind not in readable:
            bag.notes.append(f'{count} messages on {topic} are left out: they are a {kind}')
    return [message for message in bag.messages[topic] if message.kind == readable[0]]


def cables_in(topics: BagTopics) -> Callable[[Message], NamedValues]:
    """Return what reads the tensions of both cables, or of one, from a message."""

    def array(content: Any) -> NamedValues:
        data = content.data
        if len(data) != len(topics.cable_names):
            needed = ', '.join(topics.needed)
            text = f'{len(data)} values came, [{needed}] is needed'
            return NamedValues(fault=(Reason.WRONG_LENGTH, text))
        return NamedValues(tuple(data.tolist()))

    def joint_state(content: Any) -> NamedValues:
        return cable_values(content.name, content.effort, topics.cable_names)

    def dynamic(content: Any) -> NamedValues:
        return _of_interface(content, topics.cable_names, topics.interface)

    def estimate(content: Any) -> NamedValues:
        return NamedValues((content.tension_l, content.tension_s))

    def arm_estimate(content: Any) -> NamedValues:
        return cable_values(content.cable_names, content.tensions, topics.cable_names, 'tension')

    by_kind: dict[str, Callable[[Any], NamedValues]] = {
        **dict.fromkeys((ARRAY, ARRAY_32), array),
        JOINT_STATE: joint_state,
        DYNAMIC: dynamic,
        ESTIMATE: estimate,
        ARM_ESTIMATE: arm_estimate,
    }
    return lambda message: by_kind[message.kind](message.content)


def _of_interface(content: Any, cables: Sequence[str], interface: str) -> NamedValues:
    """Values of one interface in a ``DynamicJointState``.

    A joint without it is treated like one that is not named.
    """
    of_joints = cable_values(content.joint_names, content.interface_values, cables, 'interface')
    if of_joints.fault is not None:
        return of_joints
    found: list[float | None] = []
    joints: tuple[Any, ...] = of_joints.values
    for of_joint in joints:
        inner = NamedValues()
        if of_joint is not None:
            names, values = of_joint.interface_names, of_joint.values
            inner = cable_values(names, values, (interface,), interface)
        if inner.fault is not None:
            return inner
        found.append(next(iter(inner.values), None))
    return NamedValues(tuple(found) if any(value is not None for value in found) else ())


def one_cable(topics: BagTopics) -> Callable[[Message], float]:
    """Return what reads the tension of one cable from a message about it alone."""

    def value(message: Message) -> float:
        content = message.content
        if message.kind in (NUMBER, NUMBER_32):
            return float(content.data)
        force = content.wrench.force if message.kind == WRENCH else content.force
        if topics.force_component == 'norm':
            return math.hypot(force.x, force.y, force.z)
        return float(getattr(force, topics.force_component))

    return value


def position_of(joint: str) -> Callable[[Message], float | None]:
    """Return what reads the position of a joint, None where a message is not about it.

    It is NaN in a message with another number of positions than of names.
    """

    def value(message: Message) -> float | None:
        content = message.content
        if message.kind in (NUMBER, NUMBER_32):
            return float(content.data)
        if message.kind == DYNAMIC:
            found = _of_interface(content, (joint,), 'position')
        else:
            found = cable_values(content.name, content.position, (joint,), 'position')
        return math.nan if found.fault else next(iter(found.values), None)

    return value


def joints_on(messages: list[Message]) -> list[str]:
    """Names of the joints in messages, each once."""
    names: dict[str, None] = {}
    for message in messages:
        content = message.content
        of = content.joint_names if message.kind == DYNAMIC else content.name
        names.update(dict.fromkeys(of))
    return list(names)
