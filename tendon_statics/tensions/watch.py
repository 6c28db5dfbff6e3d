"""Whether the tensions of cables can be believed, and whether one is slack.

One reading by itself does not tell: what a load cell said before it counts.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

from .cable_scale import RELEASE, CableScale
from .reason import ReadingError, Reason


class Plausibility(NamedTuple):
    """What is believed of a load cell, beside its largest tension; nothing is checked at 0."""

    max_rate: float = 0.0
    """N/s; no tension changes faster"""
    saturation_count: int = 0
    """Readings in a row that sit at the largest one so far, of a cell at the end of its range"""
    frozen_count: int = 0
    """Readings in a row that are the same to the last digit, of a cell or converter that hangs"""

    @property
    def is_checked(self) -> bool:
        """Whether there is anything to check."""
        return any(self)


class SlackSwitch:
    """Whether a cable is slack: from its threshold downwards, until it is well above it again."""

    def __init__(self) -> None:
        self.is_slack = False

    def take(self, tension: float, threshold: float) -> bool:
        """Take a tension and the threshold in N; return whether the cable is slack."""
        self.is_slack = tension <= (RELEASE * threshold if self.is_slack else threshold)
        return self.is_slack


@dataclasses.dataclass
class CellWatch:
    """Objects to readings of one load cell that a sound cell would not give.

    Parameters
    ----------
    name : str
        What its tension is called.
    """

    name: str
    newest: float = math.nan
    """N; the newest that was believed"""
    time: float = math.nan
    """s; of it"""
    before: float = math.nan
    """N; the newest of all"""
    same: int = 0
    """How many in a row were the same as the newest of all"""
    largest: float = -math.inf
    """N; of all that did not come too fast"""

    def take(self, tension: float, time: float, believed: Plausibility, threshold: float) -> None:
        """Take a tension in N at a time in s, up to `threshold` of a slack cable.

        Raises
        ------
        ReadingError
            If it is not plausible.
        """
        self.same = self.same + 1 if tension == self.before else 1
        self.before = tension
        if 0.0 < believed.max_rate * (time - self.time) < abs(tension - self.newest):
            raise ReadingError(
                Reason.TOO_FAST,
                f'{self.name} went from {self.newest:.6g} N to {tension:.6g} N in '
                f'{time - self.time:.6g} s, believed are {believed.max_rate:g} N/s',
            )
        self.largest = max(self.largest, tension)
        if tension > threshold:  # A slack cable may well read the same all the time.
            if tension == self.largest and 0 < believed.saturation_count <= self.same:
                raise ReadingError(
                    Reason.SATURATED,
                    f'{self.name} has been at its largest, {tension:.6g} N, for {self.same} '
                    'readings: its load cell is at the end of its range',
                )
            if 0 < believed.frozen_count <= self.same:
                raise ReadingError(
                    Reason.FROZEN,
                    f'{self.name} has been {tension!r} N to the last digit for {self.same} '
                    'readings: its load cell or converter hangs',
                )
        self.newest, self.time = tension, time


class TensionWatch:
    """Watches the load cells of all cables, by default of the two of a unit.

    Parameters
    ----------
    names : sequence of str
        What the tensions are called.
    """

    def __init__(self, names: Sequence[str] = ('tension_l', 'tension_s')) -> None:
        self._cells = [CellWatch(name) for name in names]
        self._switches = [SlackSwitch() for _ in names]

    def take(
        self,
        tensions: Sequence[float],
        time: float,
        scales: Sequence[CableScale],
        believed: Plausibility,
    ) -> tuple[float, ...]:
        """Return all tensions in N, 0 of a slack cable.

        Parameters
        ----------
        tensions : sequence of float
            In N, within the scales' limits.
        time : float
            When they were measured, in s; NaN if that is not known.

        Raises
        ------
        ReadingError
            If one is not plausible.
        """
        if believed.is_checked:
            faults = []
            for cell, tension, scale in zip(self._cells, tensions, scales, strict=True):
                try:
                    cell.take(tension, time, believed, scale.slack_threshold)
                except ReadingError as error:
                    faults.append(error)
            if faults:
                raise faults[0]
        return tuple(
            [
                0.0 if switch.take(tension, scale.slack_threshold) else tension
                for switch, tension, scale in zip(self._switches, tensions, scales, strict=True)
            ]
        )
