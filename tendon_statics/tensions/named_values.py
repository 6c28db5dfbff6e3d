"""The values of the cables among those that a message gives by name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from .reason import Fault, Reason


class NamedValues(NamedTuple):
    """What a message with names says of the cables."""

    values: tuple[float | None, ...] = ()
    """In the order of the cables, None of each that the message does not have; empty if it has
    none of them"""
    fault: Fault | None = None
    """Why a message that is about the cables has no values"""

    @property
    def is_foreign(self) -> bool:
        """Whether the message is about no cable, and so meant for others."""
        return self.fault is None and not self.values


def cable_values(
    names: Sequence[str], values: Sequence[Any], cables: Sequence[str], field: str = 'effort'
) -> NamedValues:
    """Find the values of all cables, or of those that the message is about.

    A message with other names only is foreign, whatever else is wrong with it. One that names a
    cable has to name it once and to have as many values as names: else it is not known whose they
    are.

    Parameters
    ----------
    cables : sequence of str
        Names of the cables, in their order.
    field : str
        What the values are called in the message.
    """
    if not any(cable in names for cable in cables):
        return NamedValues()
    if len(values) != len(names):
        text = f'{len(names)} names came with {len(values)} {field}s, so it is not known whose'
        return NamedValues(fault=(Reason.WRONG_LENGTH, text))
    for cable in cables:
        if list(names).count(cable) > 1:
            return NamedValues(fault=(Reason.WRONG_LENGTH, f'{cable} stands twice in the names'))
    held = dict(zip(names, values, strict=True))
    return NamedValues(tuple(held.get(cable) for cable in cables))
