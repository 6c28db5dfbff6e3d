"""What every sample of an arm's recording tells of a force at its tip, beside one measured."""

from __future__ import annotations

import dataclasses
import math

from ...estimation.arm_follower import ArmFollower
from ...estimation.arm_settings import ArmSettings
from ...estimation.arm_tip_force_watch import ArmTipForceWatch
from ...physics import Load
from ...physics.load import push_along
from ..arm_recording import ArmRecording
from ..errors import RecordingError
from ..progress import Progress, unseen
from ..samples import Samples
from .tip_forces import UNKNOWN, TipForces, chosen_places, measured_along, row_of


def arm_tip_forces(
    settings: ArmSettings,
    recording: ArmRecording,
    estimation: str = 'tracking',
    *,
    load: Load | None = None,
    most: int | None = None,
    progress: Progress = unseen,
) -> TipForces:
    """Ask of every sample what pushes at the tip, as the node does with the same settings.

    The arm is followed from its measured angles, as by the node. A recorded tip force is not taken
    for known; it is what the answer is held against. Nothing is told while a joint that has an
    encoder has not been measured lately.

    Parameters
    ----------
    settings : ArmSettings
        Along which line, how sure all is, and at which level.
    estimation : str
        As of `replay_arm`.
    load : Load
        What acts beside the cables and was not recorded.
    most : int, optional
        Samples that are asked, evenly chosen; by default all.

    Raises
    ------
    RecordingError
        If there is no measured angle, or time goes back.
    LoadError
        If the direction is no unit vector in the plane of bending.
    """
    if not recording.bend_angles:
        raise RecordingError(
            'there is no measured bend angle in the data, without which nothing can be told of '
            'a force at the tip: estimated angles take it for known'
        )
    recording.in_order()
    x, z, _, _ = push_along(settings.tip_direction, settings.arm.units[-1].length)
    bare = dataclasses.replace(recording, tip_force_x=None, tip_force_z=None)
    samples, loads = Samples(bare, settings), bare.loads(load or settings.load)
    follower = ArmFollower(settings, estimation)
    watch = ArmTipForceWatch(len(settings.arm.units))
    places = chosen_places(recording, most)
    asked, recorded, rows = set(places.tolist()), recording.bend_angles.keys(), []
    for place in progress(range(len(recording)), 'solving'):
        now, _ = samples.times[place]
        if recording.time is None:  # nothing tells whether an angle moves, or is old
            watch.forget()
            now = 0.0
        angles = {joint: float(of[place]) for joint, of in recording.bend_angles.items()}
        angles = {joint: angle for joint, angle in angles.items() if math.isfinite(angle)}
        watch.note_angles(angles, now, settings)
        follower.measure(angles, now)
        estimate = samples.followed(follower, loads, place)
        if place in asked:
            told = None
            if estimate is not None and watch.measured(now, settings).keys() >= recorded:
                told = watch.ask(estimate, settings, now)
            rows.append(UNKNOWN if told is None else row_of(told.found))
    along = measured_along(recording, x, z)
    return TipForces.of(
        places, rows, None if along is None else along[places], settings.tip_force_level
    )
