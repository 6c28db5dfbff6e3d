"""A replay in words."""

from __future__ import annotations

import math

import numpy as np

from ..estimation.estimate import Remark
from ..physics import JointDesign
from ..recordings.hints import hints
from ..recordings.recording import Recording
from ..recordings.replay.result import VALID, Replay
from .load_text import setting_facts
from .tables import Facts


def replay_facts(replay: Replay, design: JointDesign) -> Facts:
    """What the model says of a recording."""
    return [
        *_recording_facts(replay.recording),
        *reading_facts(replay.recording, design),
        *setting_facts(design, replay.load),
        ('estimation', replay.estimation),
        ('regimes', _regimes(replay)),
        *_noise_facts(replay),
        *_invalid_facts(replay),
        *_angle_facts(replay),
        *_band_facts(replay),
    ]


def reading_facts(recording: Recording, design: JointDesign) -> Facts:
    """How a recording was read, and what looks wrong with it."""
    return [
        *(('read', note) for note in recording.notes),
        *(('warning', hint) for hint in hints(recording, design)),
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


def _noise_facts(replay: Replay) -> Facts:
    """Whether believing each sample is safe."""
    if not replay.noise_risks:
        return []
    return [('warning', f'{Remark.NOISE.value} ({replay.noise_risks} of {len(replay.recording)})')]


def _band_facts(replay: Replay) -> Facts:
    """How wide the intervals are, and how often the measured angle lies within."""
    if replay.interval is None:
        return []
    low, high = replay.interval
    known = np.isfinite(low)
    if not known.any():
        return []
    title = f'{100.0 * replay.confidence:.4g} % interval'
    facts = [(title, f'{_degrees(float(np.mean((high - low)[known])))} wide in the mean')]
    measured = replay.recording.bend_angle
    if measured is not None and (both := known & np.isfinite(measured)).any():
        spread = 2.0 * replay.measured_stddev
        within = np.mean(((low - spread <= measured) & (measured <= high + spread))[both])
        facts.append(
            (
                'within it',
                f'{100.0 * within:.4g} % of the measured angles, give or take two deviations of '
                f'the sensor, {_degrees(spread)}',
            )
        )
    return facts


def _invalid_facts(replay: Replay) -> Facts:
    """Why samples are invalid, in the node's words."""
    reasons, counts = np.unique(replay.validity[replay.validity != VALID], return_counts=True)
    if not len(reasons):
        return []
    listed = ', '.join(
        f'{reasons[index]} {counts[index]}' for index in np.argsort(-counts, kind='stable')
    )
    return [('invalid', listed)]


def _angle_facts(replay: Replay) -> Facts:
    known = np.isfinite(replay.bend_angle)
    facts = [('bend angle', f'determined in {int(known.sum())} samples')]
    unsure = int((known & ~replay.angle_assured).sum())
    if unsure:
        facts.append(
            (
                'not assured',
                f'{unsure} of these angles: after a slack cable, a gap or the like the unit may '
                'have moved',
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
    return facts


def _degrees(angle: float) -> str:
    return f'{math.degrees(angle):.3g} deg'
