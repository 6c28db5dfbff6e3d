"""What acts on a recorded unit beside its cables, as it was recorded or as options say."""

from __future__ import annotations

import argparse

from ..files.unit_file import Unit
from ..physics import Load
from ..recordings.recording import Recording
from .options import UsageError, load_from


def recorded_load(options: argparse.Namespace, unit: Unit, recording: Recording) -> Load:
    """Return what acts beside the cables as far as it was not recorded.

    Raises
    ------
    UsageError
        If something was recorded and is said too, or it is not said where a recorded tip force
        acts.
    LoadError
        As `load_from` does.
    """
    if recording.base_tilt is not None and (
        options.base_tilt_deg is not None or options.gravity_direction is not None
    ):
        raise UsageError(
            f'{recording.name} has the tilt of the base in it; --base-tilt-deg and '
            '--gravity-direction are for recordings that do not'
        )
    if recording.tip_force_x is None and recording.tip_force_z is None:
        return load_from(options, unit)
    if options.tip_force is not None:
        raise UsageError(
            f'{recording.name} has the force at the tip in it; --tip-force is for recordings that '
            'do not'
        )
    distance = options.tip_distance
    distance = unit.get('tip_distance') if distance is None else distance
    if distance is None:
        raise UsageError(
            f"{recording.name} has a force at the tip in it: say where it acts along the unit's "
            'axis by --tip-distance, in m, or by tip_distance in the design file'
        )
    said = {**vars(options), 'tip_force': (0.0, 0.0), 'tip_distance': float(distance)}
    return load_from(argparse.Namespace(**said), unit)
