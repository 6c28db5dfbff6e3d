"""The values of the two cables among those that a message gives by name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from .reason import Fault, Reason


class NamedValues(NamedTuple):
    """What a message with names says of the two cables; all None if it is not about them."""

    value_l: float | None = None
    """None if the message does not have it"""
    value_s: float | None = None
    fault: Fault | None = None
    """Why a message that is about the cables has no values"""

    @property
    def is_foreign(self) -> bool:
        """Whether the message is about neither cable, and so meant for others."""
        return self == (None, None, None)


def cable_values(
    names: Sequence[str], values: Sequence[Any], cables: Sequence[str], field: str = 'effort'
) -> NamedValues:
    """Find the values of both cables, or of the one that the message is about.

    A message with other names only is foreign, whatever else is wrong with it. One that names a
    cable has to name it once and to have as many values as names: else it is not known whose they
    are.

    Parameters
    ----------
    cables : sequence of str
        Names of cables l and s.
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
    value_l, value_s = (held.get(cable) for cable in cables)
    return NamedValues(value_l, value_s)
