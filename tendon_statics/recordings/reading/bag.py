"""Recordings in ROS bags: from messages on topics to samples."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from ..session import OF_LOAD
from .bag_beside import Beside, default_beside, find_beside, named_beside
from .bag_storage import END_OF_TIME, Message, Messages, read_messages
from .bag_tensions import TensionMessages, find_tensions, tension_samples
from .clock import Clocked, Stamped, Times, common_clock
from .topics import DEFAULT_PAIR, DEFAULT_TENSIONS, BagTopics, full_name

LOAD_SKEW = 500_000_000
"""ns by which a message about the load may be apart from the tensions: a base is turned slowly,
and the estimator waits as long"""
REPLAYED = '/replay/regime'
"""Topic of a bag that `replay` has written, whose tensions are in N"""


def load_bag(path: Path, topics: BagTopics, progress: Progress = unseen) -> Recording:
    """Read a bag, as `load_recording` does: one sample for each pair of tensions.

    The samples stand in the order of time or, where the clock of a topic goes back, of recording.
    Their times are by the clock that is chosen (`common_clock`). Angle, pressure and state are
    those of the message nearest in time, if it is not farther than `BagTopics.max_skew`, and what
    acts on the unit beside the cables likewise, if it is not farther than `LOAD_SKEW`.
    """
    required = [*(topics.tensions or ()), *named_beside(topics)]
    defaults = [DEFAULT_TENSIONS, *DEFAULT_PAIR, *default_beside(topics)]
    wanted = {full_name(name) for name in [*required, *defaults]}
    bag = read_messages(path, wanted, progress)
    names = _tension_topics(bag, topics)
    for name in [*names, *required]:
        if full_name(name) not in bag.types:
            there = ', '.join(f'{topic} ({kind})' for topic, kind in sorted(bag.types.items()))
            why = f'; {bag.damage[0]}' if bag.damage else ''
            raise RecordingError(
                f'there is no topic {full_name(name)}; there are: {there or "none"}{why}'
            )
    tensions = find_tensions(bag, names, topics)
    beside = find_beside(bag, topics)
    skew = round(min(topics.max_skew * 1e9, END_OF_TIME))
    times, clocked = clocked_times(tensions, beside, topics, skew)
    samples = tension_samples(tensions, times, clocked, topics)
    at = np.array([sample.time for sample in samples], dtype=np.int64)
    origin = int(at.min())

    def joined(quantity: str) -> npt.NDArray[Any] | None:
        return joined_to(at, beside, quantity, times, skew)

    state = joined('state')
    load: dict[str, Any] = {quantity: joined(quantity) for quantity in OF_LOAD}
    return Recording(
        tension_l=np.array([sample.tensions[0] for sample in samples]),
        tension_s=np.array([sample.tensions[1] for sample in samples]),
        bend_angle=joined('bend_angle'),
        pressure=joined('pressure'),
        **load,
        state=None if state is None else state.tolist(),
        faults=[sample.fault for sample in samples],
        in_newtons=tensions.in_newtons or REPLAYED in bag.types,
        time=1e-9 * (at - origin).astype(np.float64),
        time_origin=origin,
        name=path.name,
        damage=tuple(bag.damage),
        notes=(*bag.notes, *beside.notes, *clocked.notes),
        clock=clocked.named,
    )


def joined_to(
    at: Times, beside: Beside, quantity: str, times: Mapping[int, int], skew: int
) -> npt.NDArray[Any] | None:
    """Return what was measured nearest to some times, NaN where nothing was; None of no topic.

    Parameters
    ----------
    at : array
        In ns.
    times : mapping
        `Message.order` → time in ns.
    skew : int
        ns by which it may be apart, but for the load.
    """
    series = beside.series.get(quantity)
    if series is None:
        return None
    values = np.array([*series.values, '' if quantity == 'state' else np.nan])
    there = np.array([times[message.order] for message in series.messages], np.int64)
    found: npt.NDArray[Any] = values[
        _nearest(there, at, LOAD_SKEW if quantity in OF_LOAD else skew)
    ]
    return found


def clocked_times(
    tensions: TensionMessages, beside: Beside, topics: BagTopics, skew: int
) -> tuple[dict[int, int], Clocked]:
    """Return the time of every message, by its order, as `common_clock` chooses it, and how.

    One topic may tell more than one thing.
    """
    on: dict[str, dict[int, Message]] = {}
    for messages_by_topic in (tensions.messages, beside.messages):
        for topic, messages in messages_by_topic.items():
            on.setdefault(topic, {}).update((message.order, message) for message in messages)
    ordered = {topic: sorted(messages) for topic, messages in on.items()}
    stamped = {
        topic: Stamped.of(
            ((on[topic][order].stamp, on[topic][order].log_time) for order in orders),
            tensions.streams(topic, orders, topics.cable_names),
        )
        for topic, orders in ordered.items()
    }
    clocked = common_clock(stamped, topics.clock, skew)
    by_order = {
        order: time
        for topic, orders in ordered.items()
        for order, time in zip(orders, clocked.times[topic].tolist(), strict=True)
    }
    return by_order, clocked


def _tension_topics(bag: Messages, topics: BagTopics) -> list[str]:
    """Return the topics of the tensions: those that are named, or where the estimator listens."""
    if topics.tensions is not None:
        return [full_name(name) for name in topics.tensions]
    there = DEFAULT_TENSIONS in bag.types
    if topics.tension_source == 'wrench_pair' or (
        not there and topics.tension_source is None and set(DEFAULT_PAIR) <= bag.types.keys()
    ):
        return [*DEFAULT_PAIR]
    return [DEFAULT_TENSIONS]


def _nearest(there: Times, times: Times, skew: int) -> npt.NDArray[np.intp]:
    """Index of the time nearest to each of `times`, −1 where none is within `skew`; all in ns."""
    if not len(there):
        return np.full(len(times), -1)
    order = np.argsort(there, kind='stable')
    ordered = there[order]
    after = np.searchsorted(ordered, times).clip(0, len(there) - 1)
    before = (after - 1).clip(0)
    nearest = np.where(times - ordered[before] <= ordered[after] - times, before, after)
    return np.where(abs(ordered[nearest] - times) <= skew, order[nearest], -1)
