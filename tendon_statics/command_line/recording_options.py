"""What the verbs that read a recording have in common."""

from __future__ import annotations

import argparse
import dataclasses
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from ..files.cable_parameters import TENSION_SOURCES
from ..files.unit_file import Unit
from ..recordings.hints import hints
from ..recordings.progress import Progress
from ..recordings.reading.clock import CLOCKS
from ..recordings.reading.load import ENDINGS, load_recording
from ..recordings.reading.table_options import SEPARATORS, TableOptions
from ..recordings.reading.topics import (
    DEFAULT_PAIR,
    DEFAULT_TENSIONS,
    FORCE_COMPONENTS,
    BagTopics,
)
from ..recordings.reading.units import OF_UNIT, Quantities
from ..recordings.recording import Recording
from ..recordings.scaling import of_unit
from ..recordings.session import Session
from .options import unit_from
from .progress import with_progress

DEFAULTS = BagTopics()

TIP_WRENCH = '/tip_wrench'
"""Where the estimator listens"""


def add_recording_options(parser: argparse.ArgumentParser) -> None:
    """Add ``DATA`` and what says how it is read."""
    parser.add_argument(
        'data',
        type=Path,
        metavar='DATA',
        help=f'recording, ending in {", ".join(ENDINGS)}, or the folder of a bag',
    )
    add_reading_options(parser)


def add_reading_options(parser: argparse.ArgumentParser) -> None:
    """Add what says where in a bag or table the numbers are."""
    _add_bag_options(parser.add_argument_group('of a bag'))
    add_table_options(parser, 'tension_l=Fz1,tension_s=Fz2', 'tension=mN,bend_angle=deg')


def _add_bag_options(bag: argparse._ArgumentGroup) -> None:
    bag.add_argument(
        '--tensions-topic',
        type=names_of,
        metavar='TOPIC[,TOPIC]',
        help='Float64MultiArray, Float32MultiArray, JointState, DynamicJointState or Estimate; or '
        'two of WrenchStamped, Wrench, Float64 or Float32, cable l first; default: '
        f'{DEFAULT_TENSIONS}, or {",".join(DEFAULT_PAIR)} if only these are there',
    )
    bag.add_argument(
        '--tension-source',
        choices=TENSION_SOURCES,
        help="type of the tensions, as the estimator's parameter; default: that of the design "
        'file, or whichever there is',
    )
    bag.add_argument(
        '--cable-names',
        type=names_of,
        metavar='L,S',
        help='names in a JointState; default: those of the design file, or '
        f'{",".join(DEFAULTS.cable_names)}',
    )
    bag.add_argument(
        '--force-component',
        choices=FORCE_COMPONENTS,
        help=f'of a wrench; default: that of the design file, or {DEFAULTS.force_component}',
    )
    bag.add_argument(
        '--bend-angle-topic',
        metavar='TOPIC',
        help='Float64, Float32, JointState or DynamicJointState; default: /measured_bend_angle, '
        'if it is there',
    )
    bag.add_argument(
        '--joint-name', metavar='NAME', help='in a JointState of the angle; default: its only one'
    )
    bag.add_argument(
        '--pressure-topic',
        metavar='TOPIC',
        help='Float64 or Float32; default: /measured_pressure, if it is there',
    )
    bag.add_argument('--state-topic', metavar='TOPIC', help='String: slipping or held')
    add_common_bag_options(bag, 'design file')


def add_common_bag_options(bag: argparse._ArgumentGroup, file: str) -> None:
    """Add what is alike of a unit and of an arm, whose parameters are in a file called so."""
    bag.add_argument(
        '--interface',
        metavar='NAME',
        default=DEFAULTS.interface,
        help='of the cables in a DynamicJointState; default: %(default)s',
    )
    bag.add_argument(
        '--base-topic',
        metavar='TOPIC',
        help='of the base: Imu, PoseStamped or QuaternionStamped; or its tilt in rad, Float64 or '
        f"Float32; default: what the {file}'s gravity_source says, or /measured_base_tilt, if "
        'it is there',
    )
    bag.add_argument(
        '--tip-wrench-topic',
        metavar='TOPIC',
        help='of the force at the tip, in the joint frame: WrenchStamped or Wrench; default: '
        f'/tip_wrench if the {file} says tip_wrench, else none',
    )
    bag.add_argument(
        '--max-skew',
        type=float,
        metavar='S',
        help='by which messages that belong together may be apart; default: '
        f'{DEFAULTS.max_skew}, and of the two tensions of a pair that of the design file, or '
        f'{DEFAULTS.pair_skew}',
    )
    bag.add_argument(
        '--clock',
        choices=CLOCKS,
        default=DEFAULTS.clock,
        help='times of messages: their stamps, those of recording (log), or whichever of these '
        'all of them have; default: %(default)s',
    )


def add_table_options(parser: argparse.ArgumentParser, columns: str, units: str) -> None:
    """Add what says where in a table the numbers are, with examples of columns and units."""
    table = parser.add_argument_group('of a table')
    table.add_argument(
        '--separator',
        metavar='CHARACTER',
        help=f'between columns, or one of {", ".join(SEPARATORS)}; default: that which fits',
    )
    table.add_argument(
        '--decimal', metavar='CHARACTER', help='. or , in numbers; default: that which fits'
    )
    table.add_argument(
        '--columns',
        type=_pairs,
        default={},
        metavar='NAME=TITLE,...',
        help=f'titles of columns, say {columns}',
    )
    table.add_argument(
        '--units',
        type=_pairs,
        default={},
        metavar='NAME=UNIT,...',
        help=f'units of columns, say {units}; default: those in brackets in the titles, or SI',
    )
    table.add_argument(
        '--skip-rows',
        type=int,
        default=0,
        metavar='N',
        help='lines before the titles; default: %(default)s',
    )
    table.add_argument(
        '--rate', type=float, metavar='HZ', help='rows per second of a table without times'
    )
    table.add_argument(
        '--encoding', metavar='NAME', help='of a text file, say latin-1; default: utf-8'
    )


def unit_and_recording(options: argparse.Namespace) -> tuple[Unit, Recording]:
    """Read the design file and the recording that the options name.

    The tensions are in N and have faults as the estimator would find them with that file, and the
    noise that the options say.
    """
    unit = unit_from(options)
    stddev = getattr(options, 'tension_stddev', None)
    if stddev is not None:
        settings = dataclasses.replace(unit.settings, tension_stddev=stddev)
        unit = dataclasses.replace(unit, settings=settings)
    return unit, recording_from(options, unit, options.data)


def recording_from(
    options: argparse.Namespace, unit: Unit, path: Path, progress: Progress = with_progress
) -> Recording:
    """Read a recording of a unit as the options say, with tensions in N."""
    topics, table = topics_from(options, unit), table_from(options, OF_UNIT)
    return of_unit(load_recording(path, topics, table, progress=progress), unit)


def topics_from(options: argparse.Namespace, unit: Unit) -> BagTopics:
    """Return where in a bag the numbers are, by the options or the unit's file."""
    skew = options.max_skew
    return BagTopics(
        tensions=options.tensions_topic,
        tension_source=options.tension_source or unit.get('tension_source'),
        cable_names=options.cable_names or tuple(unit.get('cable_names') or DEFAULTS.cable_names),
        interface=options.interface,
        force_component=options.force_component
        or unit.get('wrench_component')
        or DEFAULTS.force_component,
        bend_angle=options.bend_angle_topic,
        joint_name=options.joint_name,
        pressure=options.pressure_topic,
        base=options.base_topic,
        gravity_source=unit.get('gravity_source') or DEFAULTS.gravity_source,
        imu_mounting=tuple(unit.get('imu_mounting') or DEFAULTS.imu_mounting),
        tip_wrench=options.tip_wrench_topic
        or (TIP_WRENCH if unit.get('tip_wrench') is True else None),
        state=options.state_topic,
        max_skew=DEFAULTS.max_skew if skew is None else skew,
        tension_skew=unit.get('max_skew') if skew is None else skew,
        clock=options.clock,
    )


def table_from(options: argparse.Namespace, quantities: Quantities) -> TableOptions:
    """Return what a table of some quantities looks like, by the options."""
    return TableOptions(
        separator=options.separator,
        decimal=options.decimal,
        columns=options.columns,
        units=options.units,
        skip_rows=options.skip_rows,
        encoding=options.encoding,
        rate=options.rate,
        quantities=quantities,
    )


def report_damage(recording: Session) -> int:
    """Name on stderr what could not be read; return the exit code: 1 if there was such, else 0."""
    if not recording.damage:
        return 0
    print(
        f'tendon-statics: {recording.name}: not all of it could be read: '
        f'{recording.damage_summary}',
        file=sys.stderr,
    )
    return 1


def report_notes(unit: Unit, recording: Recording) -> None:
    """Name on stderr how it was read and what looks wrong, for verbs whose output is a table."""
    say_notes(recording, hints(recording, unit.settings))


def say_notes(recording: Session, hints: Sequence[str]) -> None:
    """Name on stderr how it was read, and the hints."""
    for text in (*recording.notes, *hints):
        print(f'tendon-statics: {recording.name}: {text}', file=sys.stderr)


def names_of(text: str) -> tuple[str, ...]:
    """Return the names in a list with commas."""
    return tuple(filter(None, (name.strip() for name in text.split(','))))


def _pairs(text: str) -> dict[str, str]:
    """Read ``name=value,name=value``; a value may have commas."""
    pairs: dict[str, str] = {}
    for part in re.split(r',(?=\s*\w+\s*=)', text):
        name, equals, value = part.partition('=')
        name = name.strip()
        if not (name and equals and value.strip()):
            raise argparse.ArgumentTypeError(f'{part!r} is not NAME=VALUE')
        if name in pairs:
            raise argparse.ArgumentTypeError(f'{name} is given twice')
        value = value.strip()
        pairs[name] = value[1:-1] if re.fullmatch('".+"', value) else value
    return pairs
