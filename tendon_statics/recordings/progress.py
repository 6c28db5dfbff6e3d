"""How reading, solving and writing tell how far they are, to whoever wants to show it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, TypeVar

T = TypeVar('T')


class Progress(Protocol):
    """Passes the items of a long loop on, one by one, and so sees how far it is."""

    def __call__(self, items: Iterable[T], doing: str, /) -> Iterable[T]:
        """Pass items on.

        Parameters
        ----------
        doing : str
            ``reading``, ``solving`` or ``writing``.
        """


def unseen(items: Iterable[T], _doing: str) -> Iterable[T]:
    """Pass items on and show nothing."""
    return items
