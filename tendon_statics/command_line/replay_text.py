"""A replay in words."""

from __future__ import annotations

import math

import numpy as np

from ..recordings.recording import Recording
from ..recordings.replay.estimates import Replay
from .tables import Facts


def replay_facts(replay: Replay) -> Facts:
    """What the model says of a recording."""
    return [
        *_recording_facts(replay.recording),
        ('estimation', replay.estimation),
        ('regimes', _regimes(replay)),
        *_angle_facts(replay),
    ]


def _recording_facts(recording: Recording) -> Facts:
    facts = [('recording', f'{recording.name}: {len(recording)} samples')]
    if recording.time is None:
        return facts
    times = recording.time[np.isfinite(recording.time)]
    untimed = len(recording) - len(times)
    if untimed:
        facts.append(('without time', f'{untimed} samples'))
    if recording.disorder:
        return [*facts, ('order', recording.disorder)]
    steps = np.diff(times)
    if len(steps) and np.median(steps) > 0.0:
        facts.append(
            (
                'rate',
                f'{1.0 / np.median(steps):.4g} Hz over {steps.sum():.4g} s; '
                f'longest gap {steps.max():.3g} s',
            )
        )
    return facts


def _regimes(replay: Replay) -> str:
    names, counts = np.unique(replay.regime, return_counts=True)
    return ', '.join(
        f'{names[index]} {counts[index]} ({100.0 * counts[index] / len(replay.recording):.4g} %)'
        for index in np.argsort(-counts, kind='stable')
    )


def _angle_facts(replay: Replay) -> Facts:
    known = np.isfinite(replay.bend_angle)
    facts = [('bend angle', f'determined in {int(known.sum())} samples')]
    unsure = int((known & ~replay.angle_assured).sum())
    if unsure:
        facts.append(
            (
                'not assured',
                f'{unsure} of these angles: a cable had been slack, so the unit may have moved',
            )
        )
    measured = replay.recording.bend_angle
    if replay.error is None or measured is None:
        return facts
    error = abs(replay.error[np.isfinite(replay.error)])
    if not len(error):
        return [*facts, ('error', 'no sample has both an assured and a measured angle')]
    facts.append(
        (
            'error',
            f'root mean square {_degrees(np.sqrt(np.mean(error**2)))}, '
            f'median {_degrees(np.median(error))}, largest {_degrees(error.max())} '
            f'against the measured angle, in {len(error)} samples',
        )
    )
    middle = float(np.nanmedian(abs(measured)))
    if middle > 0.5 * math.pi:
        facts.append(
            (
                'warning',
                f'half of the measured angles are above {middle:.3g} rad, and no unit bends so '
                'far; if they are degrees, the column has to be named bend_angle [deg]',
            )
        )
    return facts


def _degrees(angle: float) -> str:
    return f'{math.degrees(angle):.3g} deg'
