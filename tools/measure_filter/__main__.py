"""Measure the filter beside the tracker: `make measure-filter`."""

from __future__ import annotations

import argparse
import math
import secrets
import sys
from typing import NamedTuple

import numpy as np

from tendon_statics import StickSlipFilter, StickSlipTracker, TensionError
from tendon_statics.command_line.tables import markdown_table

from .sessions import Session, sessions

TOLERANT = ', design tolerance'
"""What is said of sessions whose unit is not quite its design"""

FAR = math.radians(1.0)
"""Error in rad from which on an angle counts as off"""


class Score(NamedTuple):
    """What one session showed, as shares of its samples."""

    covered: float
    off: float
    tracker_off: float
    width: float
    """Mean width of the 95 % intervals in deg"""
    committed_off: float
    pressure_covered: float
    """Within two of its deviations, of those samples that have a pressure"""


def score(session: Session) -> Score:
    """Run filter and tracker over a session."""
    found = StickSlipFilter(
        session.design,
        tension_stddev=session.noise,
        design_covariance=session.uncertainty,
    )
    tracker = StickSlipTracker(session.design)
    covered, off, tracker_off, width, committed_off, committed = 0, 0, 0, 0.0, 0, 0
    pressed, pressed_well = 0, 0
    angles = dict(zip(session.time.tolist(), session.bend_angle.tolist(), strict=True))
    for time, truth, pressure, tension_l, tension_s in session.samples:
        try:
            state = found.update(tension_l, tension_s, time)
            tracker.update(tension_l, tension_s)
        except TensionError:
            continue
        low, high = state.interval(0.95)
        covered += low - 1e-9 <= truth <= high + 1e-9
        off += abs(state.bend_angle - truth) > FAR
        tracker_off += abs(tracker.bend_angle - truth) > FAR
        width += high - low
        if state.pressure is not None and math.isfinite(pressure):
            pressed += 1
            pressed_well += abs(state.pressure - pressure) <= 2.0 * state.pressure_stddev
        if found.committed is not None:
            committed += 1
            error = found.committed.bend_angle - angles[found.committed.time]
            committed_off += abs(error) > FAR
    count = len(session.time)
    return Score(
        covered / count,
        off / count,
        tracker_off / count,
        math.degrees(width / count),
        committed_off / max(committed, 1),
        pressed_well / pressed if pressed else math.nan,
    )


def main() -> int:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description='Measure StickSlipFilter on random sessions.')
    parser.add_argument('--sessions', type=int, default=64, metavar='N')
    parser.add_argument('--seconds', type=float, default=20.0, metavar='S', help='of a session')
    parser.add_argument('--seed', type=int, default=secrets.randbelow(2**31), metavar='N')
    options = parser.parse_args()
    scores: dict[str, list[Score]] = {}
    for number, session in enumerate(sessions(options.sessions, options.seconds, options.seed)):
        kind = f'{session.program}, {session.unit}'
        if session.uncertainty is not None:
            kind += TOLERANT
        scores.setdefault(kind, []).append(score(session))
        print(f'\r{number + 1} of {options.sessions} sessions', end='', file=sys.stderr)
    print(file=sys.stderr)
    rows = [(kind, *_row(of_kind)) for kind, of_kind in scores.items()]
    for name, tolerant in (('all', False), (f'all{TOLERANT}', True)):
        kinds = [kind for kind in scores if kind.endswith(TOLERANT) is tolerant]
        if kinds:
            rows.append((name, *_row([one for kind in kinds for one in scores[kind]])))
    titles = ('kind', 'covered [%]:', 'least [%]:', 'width [deg]:', 'off [%]:')
    more = ('off, committed [%]:', 'off, tracker [%]:', 'pressure covered [%]:')
    print(markdown_table((*titles, *more), rows))
    print(f'\n{options.sessions} sessions of {options.seconds:g} s, seed {options.seed}')
    return 0


def _row(scores: list[Score]) -> tuple[str, ...]:
    mean = Score(*np.nanmean(scores, axis=0))
    least = min(one.covered for one in scores)
    return (
        f'{100.0 * mean.covered:.1f}',
        f'{100.0 * least:.1f}',
        f'{mean.width:.2f}',
        f'{100.0 * mean.off:.2f}',
        f'{100.0 * mean.committed_off:.2f}',
        f'{100.0 * mean.tracker_off:.1f}',
        f'{100.0 * mean.pressure_covered:.1f}',
    )


if __name__ == '__main__':
    sys.exit(main())
