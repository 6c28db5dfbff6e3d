"""What the verbs that calibrate have in common."""

from __future__ import annotations

import argparse
import dataclasses
import math
from importlib.util import find_spec
from typing import Any, NamedTuple

from ..files.unit_file import Unit
from ..physics import CONTACT_LAWS, Calibration, CalibrationError, DesignError, calibrate
from ..physics.calibration import DEFAULT_FIT, SLIPPING, LawComparison, compare_laws
from ..physics.calibration.parameters import checked_fit
from ..physics.calibration.sessions import follow_each_other
from ..recordings.errors import RecordingError
from ..recordings.hints import hints
from ..recordings.motion import mark_motion
from ..recordings.recording import Recording
from ..recordings.samples import usable
from .options import (
    UsageError,
    add_bend_angle_stddev_option,
    add_tension_stddev_option,
    bend_angle_stddev_from,
    tension_stddev_from,
)
from .recorded_load import recorded_load
from .tables import Facts

NEEDS_SCIPY = 'a calibration needs SciPy: install python3-scipy or pip install scipy'

ASSUMED = 'all slipping, as is taken of a list without states and times'

ALL_LAWS = 'all'
"""Of ``--contact-law``: compare them"""


def add_calibration_options(parser: argparse.ArgumentParser) -> None:
    """Add what is fitted, how samples are known to slip, and how noisy they are."""
    parser.add_argument(
        '--fit',
        default=','.join(DEFAULT_FIT),
        metavar='NAME,...',
        help='design parameters to fit, and of the load cells gain_l, gain_s, bias_l (N), bias_s; '
        'default: %(default)s',
    )
    parser.add_argument(
        '--contact-law',
        choices=(*CONTACT_LAWS, ALL_LAWS),
        metavar='LAW',
        help=f'fit {", ".join(CONTACT_LAWS)}, or {ALL_LAWS}: compare them on these data; default: '
        "the design's",
    )
    states = parser.add_mutually_exclusive_group()
    states.add_argument(
        '--motion-step-deg',
        type=float,
        metavar='DEG',
        help='take the states from the angle: it moves where it changes by more than this between '
        'two samples, the sample before is slipping, those at rest are held; default: the '
        "recording's states",
    )
    states.add_argument(
        '--all-slipping',
        action='store_true',
        help='every sample is about to slip, as is taken of a recording without states and times',
    )
    add_tension_stddev_option(parser, default=None)
    add_bend_angle_stddev_option(parser)
    parser.add_argument(
        '--pressure-stddev',
        type=float,
        metavar='PA',
        help='standard deviation of the pressure; default: 2 %% of its median',
    )


def states_from(options: argparse.Namespace, recording: Recording) -> Recording:
    """Give the recording the states that the options ask for.

    Raises
    ------
    RecordingError
        If an option is needed that names the angle, or says what is slipping.
    """
    if recording.bend_angle is None:
        raise RecordingError(
            f'there is no measured bend angle in {recording.name}: neither a column bend_angle '
            'nor, in a bag, the topic /measured_bend_angle or another named by --bend-angle-topic'
        )
    if options.motion_step_deg is not None:
        return mark_motion(recording, math.radians(options.motion_step_deg))
    if options.all_slipping:
        return dataclasses.replace(recording, state=[SLIPPING] * len(recording))
    if recording.state is None:
        why = follow_each_other(recording)
        if why:
            raise RecordingError(
                f'the samples of {recording.name} follow each other in time, as {why}, but have '
                'no state that says which of them are slipping: take it from the motions of the '
                'angle (--motion-step-deg), or say that all are (--all-slipping)'
            )
    return recording


def states_text(options: argparse.Namespace, recording: Recording) -> str:
    """Say where the states come from."""
    if options.motion_step_deg is not None:
        return f'motions of the angle by more than {options.motion_step_deg:g} deg'
    if options.all_slipping:
        return 'all slipping, as was said'
    return 'those of the recording' if recording.state is not None else ASSUMED


def assumed_facts(options: argparse.Namespace, recording: Recording) -> Facts:
    """Say that samples are taken to slip without anybody's saying so, where they are."""
    text = states_text(options, recording)
    return [('states', text)] if text == ASSUMED else []


def check_calibration_options(options: argparse.Namespace) -> None:
    """Check what can be checked before there are data.

    Raises
    ------
    CalibrationError
        If a parameter is not known.
    UsageError
        If SciPy is missing.
    """
    checked_fit(_fit(options))
    if find_spec('scipy') is None:
        raise UsageError(NEEDS_SCIPY)


def _fit(options: argparse.Namespace) -> list[str]:
    return [name.strip() for name in options.fit.split(',') if name.strip()]


class Fitted(NamedTuple):
    """What was fitted, and how the contact laws compare if that was asked."""

    calibration: Calibration
    """With the law that was asked for, or the best of all"""
    comparison: LawComparison | None = None


def calibration_from(options: argparse.Namespace, unit: Unit, recording: Recording) -> Fitted:
    """Fit what the options name to the samples that the estimator would take.

    Raises
    ------
    CalibrationError, RecordingError
        If nothing can be fitted; the text has the hints that the recording gives.
    UsageError
        If SciPy is missing.
    """
    load = recorded_load(options, unit, recording)
    try:
        asked: dict[str, Any] = {
            'design': unit.design,
            'data': states_from(options, usable(recording, unit.settings)),
            'fit': _fit(options),
            'tension_stddev': tension_stddev_from(options, unit),
            'bend_angle_stddev': bend_angle_stddev_from(options, unit),
            'pressure_stddev': options.pressure_stddev,
            'load': load,
        }
        if options.contact_law != ALL_LAWS:
            return Fitted(calibrate(**asked, contact_law=options.contact_law))
        comparison = compare_laws(**asked)
        assert comparison.best.calibration is not None
        return Fitted(comparison.best.calibration, comparison)
    except ImportError:
        raise UsageError(NEEDS_SCIPY) from None
    except (CalibrationError, DesignError, RecordingError) as error:
        doubts = hints(recording, unit.design, unit.settings.plausibility)
        if recording.damage:
            doubts.append(f'not all of it could be read: {recording.damage_summary}')
        raise type(error)('; '.join([str(error), *doubts])) from None
