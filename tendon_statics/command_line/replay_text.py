"""A replay in words."""

from __future__ import annotations

import dataclasses
import math

from ..estimation.estimate import Remark
from ..files.unit_file import Unit
from ..physics import JointDesign
from ..recordings.hints import hints
from ..recordings.recording import Recording
from ..recordings.replay.result import Replay
from ..recordings.replay.summary import ReplaySummary, summary_of
from ..recordings.session import Session
from .load_text import setting_facts
from .tables import Facts


def replay_facts(replay: Replay, unit: Unit, design: JointDesign) -> Facts:
    """What the model says of a recording of a unit, with a design of it."""
    summary = summary_of(replay)
    invalid = invalid_text(summary)
    return [
        *recording_facts(replay.recording, summary),
        *reading_facts(replay.recording, unit, design),
        *(('warning', doubt) for doubt in unit.settings.doubts),
        *setting_facts(design, replay.load),
        ('estimation', replay.estimation),
        ('regimes', regimes_text(summary)),
        *noise_facts(summary),
        *([('invalid', invalid)] if invalid else []),
        *_angle_facts(summary),
        *_band_facts(summary, replay.confidence),
    ]


def reading_facts(recording: Recording, unit: Unit, design: JointDesign) -> Facts:
    """How a recording was read, and what looks wrong with it."""
    settings = dataclasses.replace(unit.settings, design=design)
    return [
        *(('read', note) for note in recording.notes),
        *(('warning', hint) for hint in hints(recording, settings)),
    ]


def recording_facts(recording: Session, summary: ReplaySummary) -> Facts:
    """What a recording is: its name, samples, times and rate."""
    facts = [('recording', f'{recording.name}: {summary.samples} samples')]
    if summary.untimed:
        facts.append(('without time', f'{summary.untimed} samples'))
    if recording.disorder:
        return [*facts, ('order', recording.disorder)]
    if summary.pace is not None:
        pace = summary.pace
        facts.append(
            (
                'rate',
                f'{pace.rate:.4g} Hz over {pace.duration:.4g} s; '
                f'longest gap {pace.longest_gap:.3g} s',
            )
        )
    return facts


def regimes_text(summary: ReplaySummary) -> str:
    """Every regime with its samples and their share, the most frequent first."""
    return ', '.join(
        f'{name} {count} ({100.0 * count / summary.samples:.4g} %)'
        for name, count in summary.regimes.items()
    )


def invalid_text(summary: ReplaySummary) -> str:
    """Why samples are invalid, in the node's words; empty if none is."""
    return ', '.join(f'{reason} {count}' for reason, count in summary.invalid.items())


def noise_facts(summary: ReplaySummary) -> Facts:
    """Whether believing each sample is safe."""
    if not summary.noise_risks:
        return []
    return [('warning', f'{Remark.NOISE.value} ({summary.noise_risks} of {summary.samples})')]


def _band_facts(summary: ReplaySummary, confidence: float) -> Facts:
    """How wide the intervals are, and how often the measured angle lies within."""
    band = summary.band
    if band is None:
        return []
    title = f'{100.0 * confidence:.4g} % interval'
    facts = [(title, f'{_degrees(band.width)} wide in the mean')]
    if band.within is not None:
        facts.append(
            (
                'within it',
                f'{100.0 * band.within:.4g} % of the measured angles, with the interval widened '
                'to either side by two standard deviations of the sensor, '
                f'{_degrees(band.sensor_spread)}',
            )
        )
    return facts


def _angle_facts(summary: ReplaySummary) -> Facts:
    facts = [('bend angle', f'determined in {summary.determined} samples')]
    if summary.unsure:
        facts.append(
            (
                'not assured',
                f'{summary.unsure} of these angles: after a slack cable, a gap or the like the '
                'unit may have moved',
            )
        )
    error = summary.error
    if error is None:
        return facts
    if error.root_mean_square is None or error.median is None or error.largest is None:
        return [*facts, ('error', 'no sample has both an assured and a measured angle')]
    facts.append(
        (
            'error',
            f'root mean square {_degrees(error.root_mean_square)}, '
            f'median {_degrees(error.median)}, largest {_degrees(error.largest)} '
            f'against the measured angle, in {error.samples} samples',
        )
    )
    return facts


def _degrees(angle: float) -> str:
    return f'{math.degrees(angle):.3g} deg'
