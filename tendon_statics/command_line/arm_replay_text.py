"""A replay of an arm in words."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..estimation.estimate import Remark
from ..physics import UPRIGHT
from ..recordings.replay.arm_result import ArmReplay
from ..recordings.replay.result import Replay
from ..recordings.replay.summary import summary_of
from ..recordings.session import Floats
from .arm_recording import FollowedArm
from .load_text import load_text
from .recorded_tip_force import tip_force_facts
from .replay_text import invalid_text, recording_facts
from .tables import Facts

_TITLES = (
    *('joint:', 'held [%]:', 'slipping [%]:', 'at stop [%]:'),
    *('least [deg]:', 'greatest [deg]:', 'not assured:', 'interval [deg]:'),
    *('measured:', 'rms error [deg]:', 'within [%]:'),
)
"""Of a table with a row a joint"""

_NOTHING = '-'

REGIMES = ('held', 'slipping', 'driven_to_stop')


def arm_facts(replay: ArmReplay, hints: Sequence[str]) -> Facts:
    """What the model says of a recording of an arm as a whole."""
    first = summary_of(replay.joints[0])
    invalid, load = invalid_text(first), load_text(replay.load, 'the end of the last unit')
    slack = first.regimes.get('slack', 0)
    risky = [str(n) for n, of in enumerate(replay.joints, start=1) if of.noise_risks]
    noise = f'{Remark.NOISE.value} (joint {", ".join(risky)})'
    return [
        *recording_facts(replay.recording, first),
        *(('read', note) for note in replay.recording.notes),
        *(('warning', hint) for hint in hints),
        *([('load', load)] if replay.load != UPRIGHT else []),
        ('estimation', replay.estimation),
        *([('warning', noise)] if risky else []),
        *([('invalid', invalid)] if invalid else []),
        *([('slack', f'{slack} samples, in which no joint is followed')] if slack else []),
        *_tip_facts(replay),
    ]


def _tip_facts(replay: ArmReplay) -> Facts:
    x, z, tilt = replay.tip
    if not np.isfinite(x).any():
        return [('tip', 'determined in no sample')]
    facts = [
        (
            'tip',
            f'x {_span(x, 1e3)} mm, z {_span(z, 1e3)} mm, tilt {_span(tilt, _DEGREES)} deg',
        )
    ]
    deviations = replay.tip_stddev[0]
    last = deviations[np.isfinite(deviations)]
    if len(last):
        facts.append(('tip deviation', f'in x at most {1e3 * float(last.max()):.3g} mm'))
    return facts


def arm_tip_force_facts(followed: FollowedArm) -> Facts:
    """Say what the recording tells of a force at the tip, if it was asked for."""
    if followed.tips is None:
        return []
    recording = followed.replay.recording
    missing = [
        name
        for joint, name in enumerate(followed.settings.joint_names, start=1)
        if joint not in recording.bend_angles
    ]
    facts = [*tip_force_facts(followed.tips)]
    if missing:
        facts.append(
            (
                'not measured',
                f'the angle of {", ".join(missing)}: the estimated one takes the force at the tip '
                'for known',
            )
        )
    return facts


def joint_table(replay: ArmReplay) -> tuple[list[str], list[list[str]]]:
    """Titles and rows of a table of what there is of each joint."""
    rows = [_joint_row(number, joint) for number, joint in enumerate(replay.joints, start=1)]
    there = [place for place in range(len(_TITLES)) if any(r[place] != _NOTHING for r in rows)]
    return [_TITLES[place] for place in there], [[row[place] for place in there] for row in rows]


def _joint_row(number: int, joint: Replay) -> list[str]:
    summary = summary_of(joint)
    shares = [100.0 * summary.regimes.get(name, 0) / summary.samples for name in REGIMES]
    angles = joint.bend_angle[np.isfinite(joint.bend_angle)]
    error, band = summary.error, summary.band
    return [
        str(number),
        *(f'{share:.4g}' for share in shares),
        *(
            [f'{_DEGREES * of:.2f}' for of in (angles.min(), angles.max())]
            if len(angles)
            else '--'
        ),
        str(summary.unsure),
        _NOTHING if band is None else f'{_DEGREES * band.width:.3g}',
        _NOTHING if error is None else str(error.samples),
        _NOTHING
        if error is None or error.root_mean_square is None
        else f'{_DEGREES * error.root_mean_square:.3g}',
        _NOTHING if band is None or band.within is None else f'{100.0 * band.within:.4g}',
    ]


_DEGREES = math.degrees(1.0)


def _span(values: Floats, factor: float) -> str:
    return f'{factor * np.nanmin(values):.4g} to {factor * np.nanmax(values):.4g}'
