"""What was simulated, as it is kept in docs/validation.json."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

FILE = Path(__file__).resolve().parents[2] / 'docs' / 'validation.json'


@dataclass(frozen=True)
class Onset:
    """K / (r T) of one construction, without weight."""

    construction: str
    friction: float
    rigid_body: float
    bristles: float
    foundation: float | None


@dataclass(frozen=True)
class Trial:
    """The same by rigid-body simulation with a setting changed."""

    setting: str
    construction: str
    friction: float
    rigid_body: float


@dataclass(frozen=True)
class Results:
    """All of it."""

    simulator: str
    onsets: tuple[Onset, ...]
    rest_angles_deg: tuple[float, ...]
    trials: tuple[Trial, ...]

    def write(self) -> None:
        """Keep them."""
        FILE.write_text(json.dumps(asdict(self), indent=1) + '\n', encoding='utf-8')


def read() -> Results:
    """Return what was kept."""
    kept = json.loads(FILE.read_text(encoding='utf-8'))
    return Results(
        kept['simulator'],
        tuple(Onset(**onset) for onset in kept['onsets']),
        tuple(kept['rest_angles_deg']),
        tuple(Trial(**trial) for trial in kept['trials']),
    )
