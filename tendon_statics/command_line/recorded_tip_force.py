"""What a recording tells of a force at the tip, as options ask for it, and in words."""

from __future__ import annotations

import argparse
import dataclasses

import numpy as np

from ..files.unit_file import Unit
from ..recordings.recording import Recording
from ..recordings.replay.tip_forces import TipForces, tip_forces
from .options import bend_angle_stddev_from, tension_stddev_from
from .progress import with_progress
from .recorded_load import recorded_load
from .tables import Facts
from .tip_force_options import line_from


def recorded_tip_forces(
    options: argparse.Namespace, unit: Unit, recording: Recording, most: int | None = None
) -> TipForces:
    """Return what samples tell of the force along the line that the options name.

    Raises
    ------
    UsageError
        If it is not said where the force acts.
    RecordingError, LoadError
        As `tip_forces` does.
    """
    line = line_from(options, unit)
    bare = dataclasses.replace(recording, tip_force_x=None, tip_force_z=None)
    if recording.tip_force_x is not None or recording.tip_force_z is not None:
        # Where that acts is asked by who takes it for known.
        options = argparse.Namespace(**{**vars(options), 'tip_distance': None})
    return tip_forces(
        recording,
        dataclasses.replace(unit.settings, tension_stddev=tension_stddev_from(options, unit)),
        **line._asdict(),
        load=recorded_load(options, unit, bare),
        bend_angle_stddev=bend_angle_stddev_from(options, unit),
        design_covariance=unit.uncertainty,
        level=options.level,
        most=most,
        progress=with_progress,
    )


def tip_force_facts(found: TipForces) -> Facts:
    """Say how often the tip may be free, how wide the intervals are, and whether they hold."""
    known = found.known
    if not known.any():
        return [('tip force', 'no sample tells anything of it')]
    width = (found.high - found.low)[known]
    wide = f'median width {np.median(width):.3g} N' if np.isfinite(np.median(width)) else 'rays'
    free = float(np.mean(found.probability_free[known] > 0.5))
    facts = [
        (
            'tip force',
            f'{int(known.sum())} intervals at {100.0 * found.level:g} %, {wide}; '
            f'{int((found.at_limit & known).sum())} at the limit of friction; '
            f'a free tip is the more probable in {100.0 * free:.3g} %',
        )
    ]
    holds = found.holds_measured
    if holds is not None and len(holds):
        facts.append(
            (
                'measured',
                f'force inside in {int(holds.sum())} of {len(holds)} samples '
                f'({100.0 * float(np.mean(holds)):.4g} %)',
            )
        )
    return facts
