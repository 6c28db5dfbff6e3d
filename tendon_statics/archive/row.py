"""What is told of one recording in the summary of an archive."""

from __future__ import annotations

import dataclasses
from typing import Any

from ..recordings.session import summary_of_damage

WHOLE, DAMAGED = 'whole', 'damaged'
REFUSED, UNREADABLE, FAILED = 'refused', 'unreadable', 'failed'

STATUSES = {
    WHOLE: 'all of it was read',
    DAMAGED: 'part of it could not be read; the rest is there',
    REFUSED: 'it was read, but the model cannot take it so',
    UNREADABLE: 'nothing of it could be read',
    FAILED: 'working on it failed',
}
"""Status of a recording → what it means; only of the first two there are samples"""


@dataclasses.dataclass(frozen=True)
class Row:
    """A recording and what came of it; SI units, None where there is nothing to tell."""

    recording: str
    """Its name in the data set"""
    path: str
    sha256: str
    options: str
    """What stands for the options, the design and the version that it was worked out with"""
    format: str
    """What it is: the ending of a file, or ``bag folder``"""
    status: str = WHOLE
    """One of `STATUSES`"""
    error: str = ''
    """Why nothing came of it"""
    damage: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    """How it was read"""
    warnings: tuple[str, ...] = ()
    """What looks as if it were in another unit, and what is to be known of a calibration"""
    clock: str = ''
    """Of a bag, `Recording.clock`"""
    time_origin: int | None = None
    """ns of the Unix epoch at which its time is 0"""
    samples: int | None = None
    rate: float | None = None
    """Hz"""
    duration: float | None = None
    """s"""
    longest_gap: float | None = None
    """s"""
    estimation: str = ''
    regimes: dict[str, int] = dataclasses.field(default_factory=dict)
    """Samples by regime"""
    invalid_reasons: str = ''
    determined: int | None = None
    """Samples with an angle"""
    not_assured: int | None = None
    """Those of them with one that is not assured"""
    error_samples: int | None = None
    """Samples with an assured and a measured angle, from which the next three are"""
    error_root_mean_square: float | None = None
    """rad"""
    error_median: float | None = None
    error_largest: float | None = None
    calibration_error: str = ''
    """Why nothing could be fitted"""
    calibration_objections: tuple[str, ...] = ()
    """Fitted values that cannot be believed"""
    calibration_residual: float | None = None
    """Root mean square of the distances in units of the noise"""
    contact_law: str = ''
    """That was fitted"""
    fitted: dict[str, tuple[float | None, float | None]] = dataclasses.field(default_factory=dict)
    """Parameter → value and standard error, None for what the data do not determine"""

    @property
    def is_replayed(self) -> bool:
        """Whether there are samples of it."""
        return self.status in (WHOLE, DAMAGED)

    @property
    def problem(self) -> str:
        """What could not be done, in one line; empty if all could."""
        return self.error or summary_of_damage(self.damage)

    def as_dict(self) -> dict[str, Any]:
        """Return what `of_dict` takes."""
        return dataclasses.asdict(self)

    @classmethod
    def of_dict(cls, values: dict[str, Any]) -> Row:
        """Make it of the dictionary that JSON makes of `as_dict`.

        Raises
        ------
        TypeError
            If it is of another version.
        """
        lists = {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
        fitted = {name: tuple(pair) for name, pair in values['fitted'].items()}
        return cls(**{**values, **lists, 'fitted': fitted})
