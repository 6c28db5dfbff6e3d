"""Whether the tensions of a unit can be believed, and whether a cable is slack.

One reading by itself does not tell: what a load cell said before it counts.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

from .cable_scale import RELEASE, CableScale
from .rate import RateCheck
from .reason import ReadingError, Reason
from .saturation import SaturationCheck


class Plausibility(NamedTuple):
    """What is believed of a load cell, beside its largest tension; nothing is checked at 0."""

    max_rate: float = 0.0
    """N/s; no tension changes faster"""
    saturation_count: int = 0
    """Readings in a row that sit at the largest or smallest so far, of a cell at the end of its
    range"""
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
    rate: RateCheck = dataclasses.field(default_factory=RateCheck)
    saturation: SaturationCheck = dataclasses.field(default_factory=SaturationCheck)
    before: float = math.nan
    """N; the newest of all"""
    same: int = 0
    """How many in a row were the same as the newest of all"""

    def take(self, tension: float, time: float, believed: Plausibility, scale: CableScale) -> None:
        """Take a tension in N at a time in s, of a cable that is measured by a scale.

        Raises
        ------
        ReadingError
            If it is not plausible.
        """
        self.same = self.same + 1 if tension == self.before else 1
        self.before = tension
        if believed.max_rate > 0.0:
            self._check_rate(tension, time, believed.max_rate, scale.max_tension)
        end = self.saturation.take(tension)
        if not tension > scale.slack_threshold:
            return  # A slack cable may well read the same all the time.
        count = self.saturation.count
        if end and 0 < believed.saturation_count <= count:
            raise ReadingError(
                Reason.SATURATED,
                f'{self.name} has been at its {end}, {tension:.6g} N, for {count} '
                'readings: its load cell is at the end of its range',
            )
        if 0 < believed.frozen_count <= self.same:
            raise ReadingError(
                Reason.FROZEN,
                f'{self.name} has been {tension!r} N to the last digit for {self.same} '
                'readings: its load cell or converter hangs',
            )

    def _check_rate(self, tension: float, time: float, max_rate: float, most: float) -> None:
        rate = self.rate
        known = rate.newest, rate.time
        since, at = known if rate.is_confirmed else rate.before
        if not rate.allows(tension, time, max_rate, most):
            raise ReadingError(
                Reason.TOO_FAST,
                f'{self.name} went from {since:.6g} N to {tension:.6g} N in {time - at:.6g} s, '
                f'believed are {max_rate:g} N/s'
                + (
                    ''
                    if abs(tension - since) > max_rate * (time - at)
                    else ', and it comes back from one that was too fast'
                ),
            )

    def rescale(self, before: CableScale, now: CableScale) -> None:
        """Go on with readings that another scale makes newtons of."""
        if before[:2] == now[:2]:
            return

        def scale(tension: float) -> float:
            return now.gain * (tension - before.bias) / before.gain + now.bias

        self.rate.rescale(scale)
        self.saturation.rescale(scale)
        self.before = scale(self.before)


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
        self.is_confirmed = True
        """False of tensions that are the first that rates are held against, and may be a spike"""

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
        self.is_confirmed = True
        if believed.is_checked:
            faults = []
            for cell, tension, scale in zip(self._cells, tensions, scales, strict=True):
                try:
                    cell.take(tension, time, believed, scale)
                except ReadingError as error:
                    faults.append(error)
            if faults:
                raise faults[0]
            if believed.max_rate > 0.0 and not math.isnan(time):
                self.is_confirmed = all(cell.rate.is_confirmed for cell in self._cells)
        return tuple(
            [
                0.0 if switch.take(tension, scale.slack_threshold) else tension
                for switch, tension, scale in zip(self._switches, tensions, scales, strict=True)
            ]
        )

    def rescale(self, before: Sequence[CableScale], now: Sequence[CableScale]) -> None:
        """Go on with readings that other scales make newtons of."""
        for cell, old, new in zip(self._cells, before, now, strict=True):
            cell.rescale(old, new)
