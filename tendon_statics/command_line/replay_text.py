"""A replay in words."""

from __future__ import annotations

import math

import numpy as np

from ..recordings.recording import Recording
from ..recordings.replay import Replay


def recording_lines(recording: Recording) -> list[str]:
    """How long the recording is and how fast."""
    lines = [f'recording     {recording.name}: {len(recording)} samples']
    if recording.time is not None and len(recording) > 1:
        steps = np.diff(recording.time)
        steps = steps[np.isfinite(steps)]
        if len(steps) and np.median(steps) > 0.0:
            lines.append(
                f'rate          {1.0 / np.median(steps):.4g} Hz over '
                f'{np.nansum(steps):.4g} s; longest gap {steps.max():.3g} s'
            )
    return lines


def replay_lines(replay: Replay) -> list[str]:
    """What the model says of the recording, a line each."""
    count = len(replay.recording)
    names, counts = np.unique(replay.regime, return_counts=True)
    order = np.argsort(-counts, kind='stable')
    regimes = (f'{names[i]} {counts[i]} ({100.0 * counts[i] / count:.4g} %)' for i in order)
    angles = int(np.isfinite(replay.bend_angle).sum())
    lines = [
        *recording_lines(replay.recording),
        f'estimation    {replay.estimation}',
        f'regimes       {", ".join(regimes)}',
        f'bend angle    determined in {angles} samples',
    ]
    unsure = int((np.isfinite(replay.bend_angle) & ~replay.angle_assured).sum())
    if unsure:
        lines.append(
            f'not assured   {unsure} of these angles: a cable had been slack, so the unit may '
            'have moved'
        )
    error = replay.error
    if error is not None:
        error = error[np.isfinite(error)]
        lines.append(
            'error         no sample has both an assured and a measured angle'
            if not len(error)
            else f'error         root mean square {_degrees(np.sqrt(np.mean(error**2)))}, '
            f'median {_degrees(np.median(abs(error)))}, largest {_degrees(abs(error).max())} '
            f'against the measured angle, in {len(error)} samples'
        )
    return lines


def _degrees(angle: float) -> str:
    return f'{math.degrees(angle):.3g} deg'
