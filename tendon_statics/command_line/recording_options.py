"""What the verbs that read a recording have in common."""

from __future__ import annotations

import argparse
import dataclasses
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from ..files.unit_file import Unit
from ..recordings.hints import hints
from ..recordings.progress import Progress
from ..recordings.reading.load import ENDINGS, load_recording
from ..recordings.reading.table_options import SEPARATORS, TableOptions
from ..recordings.reading.units import OF_UNIT, Quantities
from ..recordings.recording import Recording
from ..recordings.scaling import of_unit
from ..recordings.session import Session
from .options import unit_from
from .progress import with_progress
from .recording_bag_options import add_bag_options, topics_from


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
    add_bag_options(parser.add_argument_group('of a bag'))
    add_table_options(parser, 'tension_l=Fz1,tension_s=Fz2', 'tension=mN,bend_angle=deg')


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
