"""Every sample of an arm's recording through the model, as the arm's node would have said it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...estimation.arm_estimate import ArmEstimate
from ...estimation.arm_follower import ArmFollower
from ...estimation.arm_settings import ArmSettings
from ...estimation.estimate import Remark
from ...estimation.regimes import INVALID
from ...physics import Load, Regime
from ...physics.arm.joints import check_bend_angles
from ..arm_recording import ArmRecording
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..recording import Recording
from ..samples import Samples
from ..session import Floats
from .arm_result import ArmReplay
from .result import VALID, Replay

REGIMES = tuple(regime for regime in Regime if regime is not Regime.EQUILIBRIUM)
"""Those that a joint that is followed can be in"""

OF_JOINT = (
    *('tension_l', 'tension_s', 'bend_angle', 'bend_angle_stddev', 'pressure', 'slip_margin'),
    *('low', 'high', *(regime.value for regime in REGIMES)),
)
"""What numbers there are of each joint in each sample"""

OF_TIP = ('value', 'stddev', 'low', 'high')
"""What numbers there are of each of the tip's coordinates"""


def replay_arm(
    settings: ArmSettings,
    recording: ArmRecording,
    estimation: str = 'tracking',
    *,
    load: Load | None = None,
    progress: Progress = unseen,
) -> ArmReplay:
    """Follow an arm through a recording, as its node does with the same settings.

    Measured angles are used for nothing but comparison.

    Parameters
    ----------
    estimation : str
        ``tracking``: with the memory of an `ArmTracker`; others as `ARM_METHODS` has them.
    load : Load
        What acts beside the cables; what was recorded of it comes first.
    progress : callable
        A `Progress`, to show how far it is.

    Raises
    ------
    BendAngleError
        If the joints cannot begin at the angles of the settings.
    RecordingError
        If time goes back in the recording, or it is to be filtered and has no times.
    """
    load = load or settings.load
    check_bend_angles(settings.arm, settings.start)
    recording.in_order()
    is_filtered = estimation == 'filtering'
    if is_filtered and recording.time is None:
        raise RecordingError(
            f'{recording.name}: filtering needs the time of each sample, which is not recorded'
        )
    samples, loads = Samples(recording, settings), recording.loads(load)
    follower = ArmFollower(settings, estimation)
    count = len(settings.arm.units)
    regimes = np.full((len(recording), count), INVALID, dtype='<U24')
    assured = np.zeros((len(recording), count), dtype=bool)
    joints = np.full((len(recording), count, len(OF_JOINT)), math.nan)
    tips = np.full((len(recording), 3, len(OF_TIP)), math.nan)
    risks = np.zeros(count, dtype=int)
    for place in progress(range(len(recording)), 'solving'):
        estimate = samples.followed(follower, loads, place)
        if estimate is None:
            continue
        regimes[place] = [regime.value for regime in estimate.regimes]
        assured[place] = estimate.angles_assured
        joints[place] = [*_of_joints(estimate)]
        tips[place] = [*_of_tip(estimate)]
        risks += estimate.joints_with(Remark.NOISE)
    validity = np.array([fault or VALID for fault in samples.faults], dtype=np.str_)

    def of_joint(index: int) -> Replay:
        numbers = dict(zip(OF_JOINT, joints[:, index].T, strict=True))
        unit = _as_unit(recording, numbers, recording.bend_angles.get(index + 1))
        return Replay(
            unit,
            load,
            estimation,
            regime=regimes[:, index],
            bend_angle=numbers['bend_angle'],
            bend_angle_stddev=numbers['bend_angle_stddev'],
            pressure=numbers['pressure'],
            pressure_stddev=np.full(len(recording), math.nan),
            slip_margin=numbers['slip_margin'],
            angle_assured=assured[:, index],
            validity=validity,
            confidence=settings.confidence,
            measured_stddev=settings.measured_bend_angle_stddev,
            interval=(numbers['low'], numbers['high']) if is_filtered else None,
            regime_probabilities={regime: numbers[regime.value] for regime in REGIMES}
            if is_filtered
            else None,
            noise_risks=int(risks[index]),
        )

    values, deviations, lows, highs = (
        (tips[:, 0, place], tips[:, 1, place], tips[:, 2, place]) for place in range(len(OF_TIP))
    )
    return ArmReplay(
        recording,
        settings.arm,
        load,
        estimation,
        tuple(map(of_joint, range(count))),
        validity,
        tip=values,
        tip_stddev=deviations,
        tip_interval=tuple(zip(lows, highs, strict=True)) if is_filtered else None,
    )


def _of_joints(estimate: ArmEstimate) -> Iterator[Sequence[float | None]]:
    """What `OF_JOINT` names, joint by joint; None becomes NaN in an array."""
    count = len(estimate.regimes)
    intervals = estimate.intervals or ((None, None),) * count
    probabilities = estimate.regime_probabilities or ({},) * count
    for joint in range(count):
        yield [
            *estimate.state.joint_tensions[joint],
            None if estimate.bend_angles is None else estimate.bend_angles[joint],
            estimate.bend_angle_stddevs[joint],
            estimate.pressures[joint],
            estimate.slip_margins[joint],
            *(intervals[joint] or (None, None)),
            *(probabilities[joint].get(regime) for regime in REGIMES),
        ]


def _of_tip(estimate: ArmEstimate) -> Iterator[Sequence[float | None]]:
    """What `OF_TIP` names, for x, z and tilt."""
    covariance, tip = estimate.tip_covariance, estimate.tip
    low, high = estimate.tip_interval or (None, None)
    for place in range(3):
        yield [
            None if tip is None else tip[place],
            None if covariance is None else math.sqrt(max(covariance[place, place], 0.0)),
            None if low is None else low[place],
            None if high is None else high[place],
        ]


def _as_unit(
    recording: ArmRecording, numbers: dict[str, Floats], measured: Floats | None
) -> Recording:
    """A joint's part of a recording, as if it were that of a single unit."""
    return Recording(
        numbers['tension_l'],
        numbers['tension_s'],
        measured,
        time=recording.time,
        time_origin=recording.time_origin,
        name=recording.name,
    )
