"""The tensions in a bag: one sample for each pair that its messages give."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ...tensions.joining import Joining, Whole
from ...tensions.named_values import NamedValues
from ...tensions.pairing import Part
from ...tensions.reason import Fault, Reason
from ..errors import RecordingError
from .bag_storage import Message, Messages, without_copies
from .bag_values import (
    DYNAMIC,
    IN_NEWTONS,
    JOINT_STATE,
    OF_ARM,
    ONE_TOPIC,
    SOURCES,
    TWO_TOPICS,
    cables_in,
    messages_on,
    one_cable,
)
from .clock import Clocked
from .topics import BagTopics

NAN = math.nan


class Sample(NamedTuple):
    """The tensions of all cables, or why there are none."""

    order: int
    """Place among the messages of the bag of that which completed it"""
    time: int
    """ns"""
    tensions: Sequence[float]
    """In the order of the cables, NaN of one that is not known"""
    fault: str = ''
    """A `Reason`; empty if there is none"""


@dataclasses.dataclass(frozen=True)
class TensionMessages:
    """The messages with tensions, by topic, and what each says."""

    messages: Mapping[str, Sequence[Message]]
    values: Mapping[str, Sequence[NamedValues]]

    @property
    def in_newtons(self) -> bool:
        """Whether they are tensions for certain, and no readings of load cells."""
        return any(of[0].kind in IN_NEWTONS for of in self.messages.values() if of)

    def streams(
        self, topic: str, orders: Sequence[int], cables: Sequence[str]
    ) -> dict[str, list[int]]:
        """Return the places of the messages about each cable among all that are read of a topic.

        The node holds the stamps of each cable against each other, too. Empty where all messages
        are about the same cables, or about none.
        """
        places = {order: place for place, order in enumerate(orders)}
        found: dict[str, list[int]] = {cable: [] for cable in cables}
        pairs = zip(self.messages.get(topic, ()), self.values.get(topic, ()), strict=True)
        for message, value in pairs:
            for cable, of in zip(cables, value.values or (), strict=bool(value.values)):
                if of is not None:
                    found[cable].append(places[message.order])
        alike: dict[tuple[int, ...], list[str]] = {}
        for cable, at in found.items():
            alike.setdefault(tuple(at), []).append(cable)
        alike.pop((), None)
        return {_listed(names): [*at] for at, names in alike.items()} if len(alike) > 1 else {}


def find_tensions(bag: Messages, names: Sequence[str], topics: BagTopics) -> TensionMessages:
    """Take the messages that are about the cables from one topic, or two.

    Raises
    ------
    RecordingError
        If there are none, or they are of another type.
    """
    kinds: tuple[str, ...] = TWO_TOPICS if len(names) == 2 else ONE_TOPIC
    if topics.arm_joints:
        kinds = OF_ARM
    if topics.tension_source is not None:
        kinds = tuple(
            kind for kind in kinds if kind in (*SOURCES[topics.tension_source], *IN_NEWTONS)
        )
        if not kinds:
            raise RecordingError(
                f'the tension source is {topics.tension_source}, which does not come on '
                f'{len(names)} topic{"s" * (len(names) > 1)}: {", ".join(names)}'
            )
    hint = '; --tension-source array|joint_state says which are meant' if len(names) == 1 else ''
    wanted = ''
    if topics.tension_source is not None:
        wanted = f', as the tension source is {topics.tension_source} (--tension-source)'
    found = {name: messages_on(bag, name, kinds, hint, wanted) for name in names}
    for name, messages in found.items():
        if not messages:
            why = f'; {bag.damage[0]}' if bag.damage else ''
            raise RecordingError(f'there is no message on {name}{why}')
    if len(names) == 2:
        found = {name: without_copies(bag, name, messages) for name, messages in found.items()}
        value = one_cable(topics)
        name_l, name_s = names
        return TensionMessages(
            found,
            {
                name_l: [NamedValues((value(message), None)) for message in found[name_l]],
                name_s: [NamedValues((None, value(message))) for message in found[name_s]],
            },
        )
    return _of_one_topic(bag, names[0], found[names[0]], topics)


def _of_one_topic(
    bag: Messages, name: str, messages: Sequence[Message], topics: BagTopics
) -> TensionMessages:
    """Leave out the messages that are about no cable.

    Raises
    ------
    RecordingError
        If no value of one of the cables is left.
    """
    read = cables_in(topics)
    values = [read(message) for message in messages]
    told = [value.values for value in values if value.values]
    cables = range(len(topics.cable_names))
    if not all(any(of[cable] is not None for of in told) for cable in cables):
        raise RecordingError(_nothing(name, messages, values, topics))
    by_order = {m.order: value for m, value in zip(messages, values, strict=True)}
    ours = [message for message in messages if not by_order[message.order].is_foreign]
    ours = without_copies(bag, name, ours)
    return TensionMessages({name: ours}, {name: [by_order[message.order] for message in ours]})


def _nothing(
    name: str, messages: Sequence[Message], values: Sequence[NamedValues], topics: BagTopics
) -> str:
    """Say what there is instead of tensions."""
    kind = messages[0].kind
    if kind not in (JOINT_STATE, DYNAMIC):
        lengths = sorted({len(message.content.data) for message in messages})
        return f'the messages on {name} hold {" or ".join(map(str, lengths))} numbers; ' + (
            f'{len(topics.needed)} are needed, {", ".join(topics.needed)}'
            if topics.arm_joints
            else 'two are needed, T_l and T_s'
        )
    field = topics.interface if kind == DYNAMIC else 'effort'
    there: dict[str, None] = {}
    fields: dict[str, None] = {}
    for message in messages:
        content = message.content
        if kind == DYNAMIC:
            for joint, of in zip(content.joint_names, content.interface_values, strict=False):
                fields.update(dict.fromkeys(of.interface_names))
                there.update(dict.fromkeys([joint] * (field in of.interface_names)))
        elif len(content.effort) == len(content.name):
            there.update(dict.fromkeys(content.name))
    others = '' if field in fields or not fields else f'; {field} is not among {", ".join(fields)}'
    others += ' (--interface NAME)' * bool(others)
    fault = next((value.fault[1] for value in values if value.fault), '')
    return (
        f'no message on {name} has the {field} of {_listed(topics.cable_names)}'
        f'{f" ({fault})" * bool(fault)}; there is that of: {", ".join(sorted(there)) or "none"}'
        f'{others}'
    )


def _listed(names: Sequence[str]) -> str:
    return ' and '.join(filter(None, [', '.join(names[:-1]), names[-1]]))


def tension_samples(
    found: TensionMessages,
    times: Mapping[int, int],
    clocked: Clocked,
    topics: BagTopics,
) -> list[Sample]:
    """Join what belongs together, as the node does; keep what is dropped, with NaN and the reason.

    Parameters
    ----------
    times : mapping
        `Message.order` → time in ns.
    clocked : Clocked
        What these times are.
    """
    samples: list[Sample] = []

    def deliver(whole: Whole) -> None:
        samples.append(Sample(max(whole.sources), whole.time, whole.values))

    def drop(fault: Fault, of: Part) -> None:
        # Of what cannot be trusted, not even the value counts.
        known = of.values if fault[0] is Reason.UNPAIRED else {}
        tensions = [known.get(cable, NAN) for cable in range(len(topics.cable_names))]
        samples.append(Sample(of.source, of.time, tensions, fault[0].value))

    joining = Joining(deliver, drop, topics.cable_names, lambda: topics.pair_skew)
    arrivals = [
        (times[message.order], message.order, topic, values)
        for topic, messages in found.messages.items()
        for message, values in zip(messages, found.values[topic], strict=True)
    ]
    comes_late = bool(clocked.late & found.messages.keys())
    for time, order, topic, values in sorted(arrivals, key=lambda of: of[0 if comes_late else 1]):
        joining.take(values, time if topic in clocked.rising else 0, time, order)
    joining.forget()
    # What is dropped has its own time: of two cables whose stamps each rise it need not follow.
    rise = comes_late or all(
        topic in clocked.rising or _rise([times[message.order] for message in messages])
        for topic, messages in found.messages.items()
    )
    return sorted(samples, key=lambda of: (of.time, of.order) if rise else (of.order, 0))


def _rise(times: Sequence[int]) -> bool:
    return all(before <= after for before, after in itertools.pairwise(times))
