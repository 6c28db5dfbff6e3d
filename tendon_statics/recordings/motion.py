"""Which samples are known to be slipping, from the measured angle itself."""

from __future__ import annotations

import dataclasses

import numpy as np

from .errors import RecordingError
from .recording import Recording

LONGEST_GAP = 0.2
"""s between two angles; a camera of 5 Hz has as much, but for a hundredth"""


def mark_motion(recording: Recording, step: float) -> Recording:
    """Return a recording with a state for each sample, from the steps of its angle.

    A change of more than `step` between two angles is motion. The sample before a motion is
    ``slipping``: the unit is still where it was held, with the last tensions before it moved. So
    it is on the boundary of slip but for one step of the tensions, whatever the motion after it
    looks like. Samples in motion have the state ``moving``, all others are ``held``. Samples
    without an angle are passed over. Two angles that are more than `LONGEST_GAP` apart tell no
    motion: nothing is known of how the unit came to move. Without times, neighbouring samples do.

    Parameters
    ----------
    step : float
        rad; well above the noise of the angle, well below a slip.

    Raises
    ------
    RecordingError
        If there is no angle, time goes back or is there but not known, no two angles are near
        enough in time, or the step is not above 0.
    """
    if recording.bend_angle is None:
        raise RecordingError('there is no measured bend angle in the data')
    if not step > 0.0:
        raise RecordingError(f'the step of a motion is {step!r} rad, which must be above 0')
    if recording.unknown_times:
        raise RecordingError(
            f'{recording.name}: motions are not told from gaps where times are not known: '
            f'{recording.unknown_times}'
        )
    recording.in_order()
    known = np.flatnonzero(~np.isnan(recording.bend_angle))
    if recording.time is None:
        near = np.diff(known) == 1
    else:
        gaps = np.diff(recording.time[known])
        near = gaps <= 1.01 * LONGEST_GAP
        if len(gaps) and not near.any():
            raise RecordingError(
                f'{recording.name}: measured angles are {np.nanmin(gaps):.4g} s apart, or more; '
                f'motions are told from angles within {LONGEST_GAP:g} s'
            )
    moves = np.zeros(len(known) + 1, dtype=bool)
    moves[1:-1] = near & (abs(np.diff(recording.bend_angle[known])) > step)
    before, after = moves[:-1], moves[1:]
    state = np.full(len(recording), 'held', dtype='<U8')
    state[known] = np.select([before, after], ['moving', 'slipping'], 'held')
    return dataclasses.replace(recording, state=state.tolist())
