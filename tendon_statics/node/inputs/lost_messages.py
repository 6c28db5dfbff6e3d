"""Messages that were sent and never came, by the gaps in the numbers of their publisher."""

from __future__ import annotations

from collections.abc import Collection, Hashable


class LostMessages:
    """Counts what one topic lost on the way, and claims no loss that may be none.

    Each publisher numbers its messages one by one, but a message does not say whose it is, and a
    new publisher may be heard before it is known. So a gap in the numbers is a suspicion, which
    is settled by reports on who publishes. It counts as a loss at the second report after it, if
    no other publisher was known meanwhile, and if the numbers never fell, as they do where two
    publishers take turns. A gap that leads beyond where they fell before may be the way back, from
    the last message of a publisher that has left, which was still waiting to be taken.
    """

    def __init__(self) -> None:
        self.are_counted = True
        """False once a middleware has left out a message's number"""
        self.forget()

    def forget(self) -> None:
        """Begin anew, as with messages that were let pass."""
        self._newest: int | None = None
        self._left_at: list[int] = []  # numbers above the newest, descending: from where they fell
        self._suspected = 0  # since the last report
        self._suspected_before = 0  # between the two last reports
        self._publishers: frozenset[Hashable] = frozenset()  # at the last report
        self._publishers_before: frozenset[Hashable] = frozenset()  # at the last but one

    def note(self, number: int | None) -> None:
        """Note that a message came, which its publisher gave this number, if it is known."""
        if number is None:
            self.are_counted = False
            return
        before, self._newest = self._newest, number
        goes_on = False  # where it was left
        while self._left_at and self._left_at[-1] <= number:
            self._left_at.pop()
            goes_on = True
        if before is None or number == before + 1:
            return
        if number <= before:
            self._left_at.append(before)
            self._suspected = self._suspected_before = 0
        elif not goes_on:
            self._suspected += number - before - 1

    def settle(self, publishers: Collection[Hashable]) -> int:
        """Return how many more were lost, told by what the publishers of the topic are known."""
        known = frozenset(publishers)
        if self._newest is not None and (self._publishers - known or len(known) > 1):
            # The next number may be another publisher's.
            self._left_at.append(self._newest)
            self._newest = None
        if len(known | self._publishers) > 1:
            self._suspected = self._suspected_before = 0
        elif len(known | self._publishers_before) > 1:
            self._suspected_before = 0  # at the report in between none was known
        self._publishers, self._publishers_before = known, self._publishers
        lost = self._suspected_before
        self._suspected, self._suspected_before = 0, self._suspected
        return lost
