"""What the verbs that read a recording have in common."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..recordings.reading.load import ENDINGS, load_recording
from ..recordings.reading.topics import FORCE_COMPONENTS, BagTopics
from ..recordings.recording import Recording
from .progress import with_progress

DEFAULTS = BagTopics()


def add_recording_options(parser: argparse.ArgumentParser) -> None:
    """Add ``DATA`` and what says where in a bag the numbers are."""
    parser.add_argument(
        'data',
        type=Path,
        metavar='DATA',
        help=f'recording, ending in {", ".join(ENDINGS)}, or the folder of a bag',
    )
    bag = parser.add_argument_group('of a bag')
    bag.add_argument(
        '--tensions-topic',
        type=_names,
        default=DEFAULTS.tensions,
        metavar='TOPIC[,TOPIC]',
        help='Float64MultiArray, JointState or Estimate; or two of WrenchStamped, cable l first; '
        f'default: {DEFAULTS.tensions[0]}',
    )
    bag.add_argument(
        '--cable-names',
        type=_names,
        default=DEFAULTS.cable_names,
        metavar='L,S',
        help=f'names in a JointState; default: {",".join(DEFAULTS.cable_names)}',
    )
    bag.add_argument(
        '--force-component',
        choices=FORCE_COMPONENTS,
        default=DEFAULTS.force_component,
        help='of a WrenchStamped; default: %(default)s',
    )
    bag.add_argument(
        '--bend-angle-topic',
        metavar='TOPIC',
        help='Float64 or JointState; default: /measured_bend_angle, if it is there',
    )
    bag.add_argument(
        '--joint-name', metavar='NAME', help='in a JointState of the angle; default: its only one'
    )
    bag.add_argument(
        '--pressure-topic',
        metavar='TOPIC',
        help='Float64; default: /measured_pressure, if it is there',
    )
    bag.add_argument('--state-topic', metavar='TOPIC', help='String: slipping or held')
    bag.add_argument(
        '--max-skew',
        type=float,
        default=DEFAULTS.max_skew,
        metavar='S',
        help='by which messages that belong together may be apart; default: %(default)s',
    )


def recording_from(options: argparse.Namespace) -> Recording:
    """Read the recording that the options name."""
    topics = BagTopics(
        tensions=options.tensions_topic,
        cable_names=options.cable_names,
        force_component=options.force_component,
        bend_angle=options.bend_angle_topic,
        joint_name=options.joint_name,
        pressure=options.pressure_topic,
        state=options.state_topic,
        max_skew=options.max_skew,
    )
    return load_recording(options.data, topics, progress=with_progress)


def report_damage(recording: Recording) -> int:
    """Name on stderr what could not be read; return the exit code: 1 if there was such, else 0."""
    if not recording.damage:
        return 0
    print(
        f'tendon-statics: {recording.name}: not all of it could be read: '
        f'{recording.damage_summary}',
        file=sys.stderr,
    )
    return 1


def _names(text: str) -> tuple[str, ...]:
    return tuple(filter(None, (name.strip() for name in text.split(','))))
