"""The tensions in a bag: one sample for each pair that its messages give."""

from __future__ import annotations

import dataclasses
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
    ESTIMATE,
    JOINT_STATE,
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
    """A pair of tensions, or why there is none."""

    order: int
    """Place among the messages of the bag of that which completed it"""
    time: int
    """ns"""
    tension_l: float
    tension_s: float
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
        return any(message.kind == ESTIMATE for of in self.messages.values() for message in of[:1])


def find_tensions(bag: Messages, names: Sequence[str], topics: BagTopics) -> TensionMessages:
    """Take the messages that are about the cables from one topic, or two.

    Raises
    ------
    RecordingError
        If there are none, or they are of another type.
    """
    kinds: tuple[str, ...] = TWO_TOPICS if len(names) == 2 else ONE_TOPIC
    if topics.tension_source is not None:
        kinds = tuple(
            kind for kind in kinds if kind in (*SOURCES[topics.tension_source], ESTIMATE)
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
    """Leave out the messages that are about neither cable.

    Raises
    ------
    RecordingError
        If no value of one of the cables is left.
    """
    read = cables_in(topics)
    values = [read(message) for message in messages]
    pairs = [value.values for value in values if value.values]
    if not all(any(pair[cable] is not None for pair in pairs) for cable in (0, 1)):
        raise RecordingError(_nothing(name, messages, values, topics))
    ours = [m for m, value in zip(messages, values, strict=True) if not value.is_foreign]
    ours = without_copies(bag, name, ours)
    return TensionMessages({name: ours}, {name: [read(message) for message in ours]})


def _nothing(
    name: str, messages: Sequence[Message], values: Sequence[NamedValues], topics: BagTopics
) -> str:
    """Say what there is instead of tensions."""
    kind = messages[0].kind
    if kind not in (JOINT_STATE, DYNAMIC):
        lengths = sorted({len(message.content.data) for message in messages})
        return (
            f'the messages on {name} hold {" or ".join(map(str, lengths))} numbers; '
            'two are needed, T_l and T_s'
        )
    field = topics.interface if kind == DYNAMIC else 'effort'
    there: dict[str, None] = {}
    for message in messages:
        content = message.content
        if kind == DYNAMIC:
            there.update(dict.fromkeys(content.joint_names))
        elif len(content.effort) == len(content.name):
            there.update(dict.fromkeys(content.name))
    fault = next((value.fault[1] for value in values if value.fault), '')
    return (
        f'no message on {name} has the {field} of {" and ".join(topics.cable_names)}'
        f'{f" ({fault})" * bool(fault)}; there is that of: {", ".join(sorted(there)) or "none"}'
    )


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
        tension_l, tension_s = whole.values
        samples.append(Sample(max(whole.sources), whole.time, tension_l, tension_s))

    def drop(fault: Fault, of: Part) -> None:
        # Of what cannot be trusted, not even the value counts.
        known = of.values if fault[0] is Reason.UNPAIRED else {}
        pair = known.get(0, NAN), known.get(1, NAN)
        samples.append(Sample(of.source, of.time, *pair, fault[0].value))

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
    return sorted(samples, key=lambda of: of.time if comes_late else of.order)
