"""Which clock the messages of a bag are timed by: their stamps, or the recorder's clock."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError

CLOCKS = ('auto', 'stamp', 'log')
"""auto: stamps, where those of all messages are sound and agree with the clock of the others"""

LATE = 500_000_000
"""ns: a message that takes longer than that to the recorder goes by another clock"""

FAR = 10_000_000_000
"""ns by which the delays of two topics with stamps may differ, as an image takes its time"""

MOST_REPEATED = 0.6
"""Share of messages with the stamp of that before"""

LATE_IN_A_ROW = 3
"""Messages that may come late together; of more, the clock was set back"""

Times = NDArray[np.int64]


class Stamped(NamedTuple):
    """When the messages of a topic were measured and recorded, in the order of the bag."""

    stamps: Times
    """ns, not above 0 where a message has none; as those of types without a header"""
    log_times: Times
    """ns"""
    streams: Mapping[str, Sequence[int]] = {}
    """Where messages are about some cables each: what each stream is about → its places. Each has
    an order of its own, as in the node; messages of none have none"""

    @classmethod
    def of(
        cls,
        messages: Iterable[tuple[int, int]],
        streams: Mapping[str, Sequence[int]] | None = None,
    ) -> Stamped:
        """Make it of a stamp and a time of recording for each message."""
        pairs = np.array([*messages], dtype=np.int64).reshape(-1, 2)
        return cls(pairs[:, 0], pairs[:, 1], streams or {})

    def by_stream(self, topic: str) -> Iterator[tuple[str, Stamped]]:
        """Give each stream of the topic, with its name."""
        if len(self.streams) < 2:
            yield topic, self
            return
        for name, at in self.streams.items():
            yield f'{topic} of {name}', Stamped(self.stamps[[*at]], self.log_times[[*at]])

    @property
    def has_stamps(self) -> bool:
        """Whether any message has a stamp: a driver that does not stamp leaves them all 0."""
        return bool((self.stamps != 0).any())

    @property
    def delay(self) -> int:
        """By how many ns the recorder's clock is ahead of the stamps, as a median."""
        known = self.stamps > 0
        return int(np.median((self.log_times - self.stamps)[known])) if known.any() else 0

    def objections(self, topic: str) -> list[str]:
        """Say what keeps the stamps from being a clock."""
        count, found = len(self.stamps), []
        without = int((self.stamps == 0).sum())
        negative = int((self.stamps < 0).sum())
        if without:
            found.append(f'{without} of {count} messages on {topic} have no stamp')
        if negative:
            found.append(f'{negative} of {count} stamps on {topic} are before 1970')
        for name, stream in self.by_stream(topic):
            if stream._repeated > MOST_REPEATED * len(stream.stamps) and not without:
                found.append(stream._repeated_text(name))
            if not stream._come_late:
                found += stream.steps_back(name)
        return found

    def repeated(self, topic: str) -> list[str]:
        """Say which of sound stamps are no later than the one before, so that the first counts."""
        return [
            f'{stream._repeated_text(name)}, which counts (--clock log takes all)'
            for name, stream in self.by_stream(topic)
            if stream._repeated
        ]

    def come_late(self, topic: str) -> list[str]:
        """Say where the stamps of sound streams go back, since messages came late."""
        return [
            place for name, stream in self.by_stream(topic) for place in stream.steps_back(name)
        ]

    def jumps(self, topic: str) -> list[str]:
        """Say where sound stamps jump ahead and the times of recording do not."""
        ahead = np.diff(self.stamps) - np.diff(self.log_times)
        jumps = np.flatnonzero(ahead > LATE)
        if not len(jumps):
            return []
        more = f', and at {len(jumps) - 1} more' if len(jumps) > 1 else ''
        return [
            f'the stamps on {topic} jump ahead by {_seconds(ahead[jumps[0]])} s at message '
            f'{jumps[0] + 2} of {len(self.stamps)}{more}, and the times of recording do not '
            '(--clock log takes those)'
        ]

    def steps_back(self, topic: str) -> list[str]:
        """Say where the stamps go back."""
        known = np.flatnonzero(self.stamps > 0)
        back = known[1:][np.diff(self.stamps[known]) < 0]
        if not len(back):
            return []
        before = self.stamps[known[np.searchsorted(known, back[0]) - 1]]
        more = f', and at {len(back) - 1} more' if len(back) > 1 else ''
        return [
            f'the stamps on {topic} go back from {_seconds(before)} s to '
            f'{_seconds(self.stamps[back[0]])} s at message {back[0] + 1} of {len(self.stamps)}'
            f'{more}'
        ]

    @property
    def _repeated(self) -> int:
        """How many stamps are that of the message before."""
        return int((np.diff(self.stamps) == 0).sum())

    def _repeated_text(self, name: str) -> str:
        return (
            f'{self._repeated} of {len(self.stamps)} stamps on {name} are that of the message '
            'before'
        )

    @property
    def _come_late(self) -> bool:
        """Whether where stamps go back, single messages come late, and the clock is sound."""
        behind = np.maximum.accumulate(self.stamps) - self.stamps
        late = np.concatenate([[0], (behind > 0).astype(np.int8), [0]])
        starts, ends = np.flatnonzero(np.diff(late) == 1), np.flatnonzero(np.diff(late) == -1)
        longest = int((ends - starts).max()) if len(starts) else 0
        return longest <= LATE_IN_A_ROW and bool((behind <= LATE).all())


class Clocked(NamedTuple):
    """The times of messages by the clocks that were chosen."""

    times: dict[str, Times]
    """Topic → time of each message in ns"""
    rising: set[str]
    """Topics that go by stamps which rise, but for messages that come late and repeated stamps"""
    late: set[str]
    """Topics single messages of which came later than they were sent, so out of their order"""
    notes: list[str]
    """What is to be known of these times, a sentence each"""
    named: str
    """``stamp`` or ``log``, topic by topic where they differ"""


def common_clock(topics: Mapping[str, Stamped], clock: str, max_skew: int) -> Clocked:
    """Choose one clock for each topic, so that all of them can be put together.

    Parameters
    ----------
    topics : mapping
        Those that belong together, by name.
    clock : str
        One of `CLOCKS`. With ``stamp`` a topic none of whose messages has a stamp, or can have
        one, goes by the times of recording.
    max_skew : int
        ns that messages which belong together may be apart.

    Raises
    ------
    RecordingError
        If stamps are asked for and some messages of a topic have none.
    """
    notes: list[str] = []
    by_stamp: list[str] = []
    rising: set[str] = set()
    late: set[str] = set()
    for topic, times in topics.items():
        if clock == 'log' or not times.has_stamps:
            continue
        objections = times.objections(topic)
        if clock == 'stamp' and (times.stamps <= 0).any():
            raise RecordingError(f'{objections[0]}; --clock log takes the times of recording')
        if clock == 'auto' and objections:
            notes.append(
                f'{"; ".join(objections)}: its times are those of recording (--clock stamp|log)'
            )
            continue
        by_stamp.append(topic)
        notes += objections or [
            *times.repeated(topic),
            *(jump for name, stream in times.by_stream(topic) for jump in stream.jumps(name)),
        ]
        if not objections:
            rising.add(topic)
        places = [] if objections else times.come_late(topic)
        if places:
            late.add(topic)
            notes.append(f'{"; ".join(places)}, where messages came late: they are put in order')
    offsets = [*_offsets(topics, by_stamp, max_skew)]
    if clock == 'auto' and _are_apart(topics, by_stamp):
        notes += offsets
        notes.append('so all topics go by the times of recording (--clock stamp|log)')
        by_stamp, rising, late = [], set(), set()
    elif offsets:
        notes.append(f'{"; ".join(offsets)} (--clock stamp|log)')
    chosen = {
        topic: times.stamps if topic in by_stamp else times.log_times
        for topic, times in topics.items()
    }
    return Clocked(chosen, rising, late, notes, _named(topics, by_stamp))


def _named(topics: Iterable[str], by_stamp: Sequence[str]) -> str:
    clocks = {topic: 'stamp' if topic in by_stamp else 'log' for topic in topics}
    if len(set(clocks.values())) == 1:
        return next(iter(clocks.values()))
    return ', '.join(f'{topic}: {clock}' for topic, clock in sorted(clocks.items()))


def _delays(topics: Mapping[str, Stamped], by_stamp: Sequence[str]) -> dict[str, int]:
    """By how much the recorder's clock is ahead of that of each topic; 0 of its own."""
    return {
        topic: times.delay if topic in by_stamp else 0
        for topic, times in topics.items()
        if len(times.stamps)
    }


def _are_apart(topics: Mapping[str, Stamped], by_stamp: Sequence[str]) -> bool:
    """Whether the times of some topics are by clocks that have nothing to do with each other."""
    delays = _delays(topics, by_stamp)
    without = len(by_stamp) < len(delays)
    return any(without and abs(delay) > LATE for delay in delays.values()) or (
        _spread(topics, by_stamp) > FAR
    )


def _spread(topics: Mapping[str, Stamped], by_stamp: Sequence[str]) -> int:
    delays = _delays(topics, by_stamp).values()
    return max(delays) - min(delays) if delays else 0


def _offsets(
    topics: Mapping[str, Stamped], by_stamp: Sequence[str], max_skew: int
) -> Iterable[str]:
    """Name clocks that are apart, by topic, and those far from the recorder's."""
    delays = _delays(topics, by_stamp)
    if len(delays) > 1 and _spread(topics, by_stamp) > max_skew:
        for topic, delay in delays.items():
            if delay:
                yield f'the stamps on {topic} are {_apart(delay)} the times of recording'
        others = [topic for topic in delays if topic not in by_stamp]
        if others:
            yield f'{" and ".join(others)} {"has" if len(others) == 1 else "have"} no stamps'
    elif delays and abs(max(delays.values(), key=abs)) > LATE:
        topic, delay = max(delays.items(), key=lambda entry: abs(entry[1]))
        yield f'the stamps on {topic} are {_apart(delay)} the times of recording'


def _apart(delay: int) -> str:
    return f'{_seconds(abs(delay))} s {"behind" if delay > 0 else "ahead of"}'


def _seconds(time: int) -> str:
    return f'{1e-9 * int(time):.13g}'
