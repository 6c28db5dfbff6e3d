"""How reading, solving and writing tell how far they are, to whoever wants to show it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, TypeVar

T = TypeVar('T')


class Progress(Protocol):
    """Passes the items of a long loop on, one by one, and so sees how far it is."""

    def __call__(self, items: Iterable[T], doing: str, total: int | None = None, /) -> Iterable[T]:
        """Pass items on.

        Parameters
        ----------
        doing : str
            ``reading``, ``solving`` or ``writing``.
        total : int, optional
            How many items there are, where that is known and they do not tell themselves.
        """


def unseen(items: Iterable[T], _doing: str, _total: int | None = None) -> Iterable[T]:
    """Pass items on and show nothing."""
    return items
