"""What the numbers of a report mean, in sentences for those who were not there."""

from __future__ import annotations

import math

from ..estimation.arm_settings import ArmSettings
from ..files.estimator_parameters import ESTIMATIONS
from ..recordings.recording import Recording
from ..recordings.replay.arm_result import ArmReplay
from ..recordings.replay.result import Replay

ESTIMATION_DEFAULT = (
    'filtering where the noise of the load cells is known and samples have times, tracking where '
    'they have times, else equilibrium'
)
"""What a report does unless it is told"""

DISTANCES = (
    'A distance is how far a slipping sample, or its pressure, lies from what the fitted design '
    'gives, in units of what the stated noise makes of it. If model and noise are right, the root '
    'mean square is about 1, and one in 370 is beyond 3. Much more says that the noise is larger, '
    'some states are wrong, or the model does not fit; much less, that the noise is stated too '
    'large.'
)

FREEDOM = (
    'Freedom is how many equations can contradict the fit: each slipping sample is one, its '
    'pressure another, and each fitted parameter takes one away. With hardly any, a wrong model '
    'fits as well.'
)

_OF_OTHER_DATA = 'The design was fitted to this same recording, so this is no test on other data. '


def default_estimation(recording: Recording, tension_stddev: float | None) -> tuple[str, str]:
    """Return how a recording is estimated if nobody says so, and why.

    Parameters
    ----------
    tension_stddev : float, optional
        Standard deviation of each tension in N, as options or design file have it; None if neither
        does.
    """
    equilibrium, tracking, filtering = ESTIMATIONS
    if recording.time is None:
        return equilibrium, 'samples have no times'
    if recording.disorder:
        return equilibrium, 'times go back'
    if tension_stddev is None:
        return (
            tracking,
            'samples have times; filtering also needs the noise of load cells (--tension-stddev)',
        )
    return filtering, 'samples have times and the noise of the load cells is known'


def error_meaning(
    replayed: Replay, initial_bend_angle: float, tension_stddev: float, *, is_fitted: bool
) -> str:
    """Say what the error against a measured angle tells, and what not.

    Parameters
    ----------
    initial_bend_angle : float
        Where a unit that is followed was taken to be at first, in rad.
    tension_stddev : float
        Standard deviation of each tension in N.
    is_fitted : bool
        Whether the design was fitted to this recording.
    """
    same = _OF_OTHER_DATA if is_fitted else ''
    if replayed.estimation == 'equilibrium':
        return (
            'The error is that of each sample by itself: of the angle at which its tensions would '
            'just make the unit slip. The unit is there only while it slips. Where friction holds '
            f'it, the error says how far it was from that, not how good the model is. {same}'
        ).rstrip()
    followed = (
        'The error is that of the samples whose angle is assured, of a unit that is followed from '
        f'{math.degrees(initial_bend_angle):.4g} deg (--initial-bend-angle). Measured angles are '
        'used for nothing but this comparison. '
    )
    if replayed.estimation == 'tracking':
        return (
            f'{followed}Each sample is believed: noise that seems to slip the unit is in the '
            'error until the unit slips past that place or meets its stop, and so is a wrong '
            f'start. {same}'
        ).rstrip()
    return (
        f'{followed}Its tensions are taken to have noise of {tension_stddev:g} N. The interval is '
        'what that leaves open: measured angles outside of it say that the model, its parameters '
        f'or the start are wrong. {same}'
    ).rstrip()


def arm_meaning(replayed: ArmReplay, settings: ArmSettings) -> str:
    """Say what the numbers of each joint of an arm tell, and what not."""
    start = ', '.join(f'{math.degrees(angle):.4g}' for angle in settings.start)
    told = (
        f'The arm is followed from {start} deg (--bend-angles-deg), sample by sample; a joint is '
        'at rest within its friction, and all that are beyond theirs slip together. After a slack '
        'cable, a gap or a sample that is not valid a joint may have moved unseen; its angle is '
        'not assured until it meets a stop. '
    )
    if any(joint.error is not None for joint in replayed.joints):
        told += (
            'Measured angles are used for nothing but comparison: the error is that of the '
            'samples that are assured. '
        )
    if replayed.estimation == 'filtering':
        return (
            f'{told}Its tensions are taken to have noise of {settings.tension_stddev:g} N. The '
            'intervals are what that leaves open.'
        )
    return (
        f'{told}Each sample is believed: noise that seems to slip a joint is in the angles of all '
        'that follow.'
    )
