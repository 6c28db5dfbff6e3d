"""``tendon-statics archive``: many recordings through the model, into one data set."""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Sequence
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

from ..archive import PURPOSE
from ..archive.cluster import Results, begin_workers, connected
from ..archive.dataset import Dataset
from ..archive.finding import find_recordings
from ..archive.row import DAMAGED, STATUSES, Row
from ..archive.work import Outcome, Work
from ..physics.admissible import check_bend_angle
from ..recordings.libraries import needed
from ..recordings.reading.units import OF_UNIT
from .archive_page import write_archive_page
from .archive_study import Study, what_counts
from .calibration_options import add_calibration_options, check_calibration_options
from .options import (
    add_design_option,
    add_format_option,
    add_load_options,
    design_name,
    print_json,
    say_written,
    unit_from,
)
from .progress import with_progress
from .recording_bag_options import topics_from
from .recording_options import add_reading_options, table_from
from .replay_options import add_estimation_options, initial_bend_angle_from
from .tables import Facts, fact_lines


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    parser.add_argument(
        'folders',
        type=Path,
        nargs='+',
        metavar='DIR',
        help='folders, all recordings below which are taken; or recordings',
    )
    parser.add_argument(
        '--output',
        type=Path,
        required=True,
        metavar='DATASET',
        help='folder for the data set; what is there of an earlier run is not done again',
    )
    parser.add_argument(
        '--exclude',
        action='append',
        default=[],
        metavar='PATTERN',
        help="leave out recordings of that name or path below DIR, say '*_raw.csv'; may be "
        'repeated',
    )
    parser.add_argument(
        '--calibrate', action='store_true', help='fit a design to each recording, too'
    )
    where = parser.add_argument_group('where the work is done').add_mutually_exclusive_group()
    where.add_argument(
        '--workers',
        type=_count,
        metavar='N',
        help='processes on this machine; default: one a core',
    )
    where.add_argument(
        '--scheduler',
        metavar='ADDRESS',
        help='of a dask cluster that sees the same folders, say tcp://host:8786',
    )
    add_reading_options(parser)
    add_design_option(parser)
    add_estimation_options(parser)
    add_load_options(parser)
    add_calibration_options(parser)
    add_format_option(parser)


def run(options: argparse.Namespace) -> int:
    """Find the recordings, have them worked on, write summary and page, say what came of it."""
    if options.scheduler is None:
        begin_workers(Study.__module__)
    needed('distributed', 'pyarrow', purpose=PURPOSE)
    unit = unit_from(options)
    check_bend_angle(unit.design, initial_bend_angle_from(options, unit))
    topics_from(options, unit)
    table_from(options, OF_UNIT)
    if options.calibrate:
        check_calibration_options(options)
    counts = what_counts(options, unit)
    text = json.dumps([version('tendon_statics'), counts], sort_keys=True, default=str)
    found = find_recordings(options.folders, options.exclude)
    dataset = Dataset(options.output)
    work = Work(dataset.folder, sha256(text.encode()).hexdigest()[:16], Study(unit, options))
    with dataset.held():
        with connected(options.workers, options.scheduler) as client:
            if options.scheduler is not None and not client.nthreads():
                print(f'tendon-statics: {options.scheduler} has no workers yet', file=sys.stderr)
            results = Results(client, work, found, work.lost)
            outcomes = [*with_progress(results, 'recordings')]
        rows = sorted((outcome.row for outcome in outcomes), key=lambda row: row.recording)
        names = {row.recording for row in rows}
        others = [row for row in dataset.rows() if row.recording not in names]
        dataset.write_summary([*rows, *others])
        facts = _facts(options, outcomes, others)
        write_archive_page(dataset.folder, rows, others, facts)
    if options.format == 'json':
        print_json(_as_dict(dataset, outcomes, others))
    else:
        print(fact_lines(facts))
    say_written(options.output, options)
    return _report(rows)


def _facts(
    options: argparse.Namespace, outcomes: Sequence[Outcome], others: Sequence[Row]
) -> Facts:
    rows = [outcome.row for outcome in outcomes]
    counted = Counter(row.status for row in rows)
    statuses = {status: counted[status] for status in STATUSES if counted[status]}
    new = sum(outcome.is_new for outcome in outcomes)
    facts = [
        ('data set', str(options.output)),
        ('design', design_name(options)),
        ('recordings', f'{len(rows)}: ' + ', '.join(f'{s} {n}' for s, n in statuses.items())),
        ('worked on', f'{new}; {len(rows) - new} were there already'),
        ('samples', str(sum(row.samples or 0 for row in rows if row.is_replayed))),
    ]
    if options.calibrate:
        fitted = sum(bool(row.fitted) for row in rows)
        facts.append(('calibrated', f'{fitted} of {len(rows)}'))
    if others:
        facts.append(
            (
                'kept',
                f'{len(others)} of earlier runs, which are not among these recordings, as '
                f'{others[0].recording}',
            )
        )
    return facts


def _as_dict(
    dataset: Dataset, outcomes: Sequence[Outcome], others: Sequence[Row]
) -> dict[str, object]:
    rows = [outcome.row for outcome in outcomes]
    return {
        'dataset': str(dataset.folder),
        'recordings': len(rows),
        'statuses': Counter(row.status for row in rows),
        'worked_on': sum(outcome.is_new for outcome in outcomes),
        'kept_of_earlier_runs': len(others),
        'problems': {row.path: row.problem for row in rows if row.problem},
    }


def _report(rows: Sequence[Row]) -> int:
    """Name on stderr what could not be read or done; return the exit code."""
    troubled = [row for row in rows if row.problem]
    for row in troubled:
        what = 'not all of it could be read: ' if row.status == DAMAGED else ''
        print(f'tendon-statics: {row.path}: {what}{row.problem}', file=sys.stderr)
    return 1 if troubled else 0


def _count(text: str) -> int:
    count = int(text) if text.isdecimal() else 0
    if count < 1:
        raise argparse.ArgumentTypeError(f'it is {text!r}, allowed is a whole number from 1 on')
    return count
