"""From a file to a `Recording`, by its ending."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ...physics.arm import Arm
from ..arm_recording import ArmRecording
from ..errors import RecordingError, one_line
from ..progress import Progress, unseen
from ..recording import Recording
from ..session import Own
from .bag_folder import BAG_ENDINGS, is_bag_file
from .table import Table
from .table_options import TableOptions
from .topics import BagTopics
from .units import of_arm

TEXT_ENDINGS = ('.csv', '.tsv', '.lvm')
ENDINGS = (*TEXT_ENDINGS, '.parquet', '.mat', *BAG_ENDINGS)

_REMEDIES = {
    '.txt': '; a table of text can be read when it is renamed to .csv',
    '.dat': '; a table of text can be read when it is renamed to .csv',
    **dict.fromkeys(('.gz', '.bz2', '.xz', '.zip'), '; unpack it first'),
    **dict.fromkeys(('.xlsx', '.xls', '.ods'), '; save a spreadsheet as CSV'),
}
"""Endings that people try → what to do"""


def load_recording(
    path: str | Path,
    topics: BagTopics | None = None,
    table: TableOptions | None = None,
    *,
    progress: Progress = unseen,
) -> Recording:
    """Read a recorded session.

    A table, CSV, Parquet or MATLAB, has columns ``tension_l``, ``tension_s`` and, where there are
    such, ``time``, ``bend_angle``, ``pressure`` and ``state``; a unit stands in brackets,
    ``tension_l [mN]``, and without one the column is in SI. A ROS 2 bag is an ``.mcap`` or
    ``.db3`` file, or the folder of one, compressed or not; a ``.bag`` is one of ROS 1.

    Parameters
    ----------
    path : str or Path
        Its ending says what it is.
    topics : BagTopics, optional
        Of a bag; ignored for a table.
    table : TableOptions, optional
        Of a table; ignored for a bag.
    progress : callable
        A `Progress`, to show how far the reading is.

    Returns
    -------
    Recording
        What could be read; what could not is named in its `damage`, what was recognised that is
        not said in the file in its `notes`.

    Raises
    ------
    RecordingError
        If there is no such file, it cannot be read at all, it holds no sample, or a column, unit
        or topic is not there or not known; the text names the file. Also if a library is missing
        that the format needs.
    """
    path = Path(path)
    with _named(path):
        if path.is_dir() or is_bag_file(path):
            from .bag import load_bag

            return load_bag(path, topics or BagTopics(), progress)
        return _timed(_table(path, table, progress).of_unit(), table)


def load_arm_recording(
    path: str | Path,
    arm: Arm,
    topics: BagTopics | None = None,
    table: TableOptions | None = None,
    *,
    progress: Progress = unseen,
) -> ArmRecording:
    """Read a recorded session of an arm, as `load_recording` reads that of a unit.

    A table has a column for the tension of each cable, at the base, titled with its name, and,
    where there are such, ``time``, the load, and measured angles ``bend_angle_1`` and so on, from
    the base on. What else is in it is left alone. A bag has all cables by name in a
    ``JointState``, or in parts that belong together, or an array in the arm's order.

    Parameters
    ----------
    arm : Arm
    topics : BagTopics, optional
        Of a bag; its cables are the arm's, and the joints `arm_joint_1` and so on, unless it names
        them.
    table : TableOptions, optional
        Of a table. Where columns or units are named, it has to be made with the arm's quantities:
        ``TableOptions(quantities=of_arm(arm), ...)``.

    Raises
    ------
    RecordingError
        As `load_recording` does.
    """
    path = Path(path)
    options = dataclasses.replace(table or TableOptions(), quantities=of_arm(arm))
    with _named(path):
        if path.is_dir() or is_bag_file(path):
            from .arm_bag import load_arm_bag

            topics = topics or BagTopics()
            joints = tuple(f'arm_joint_{number}' for number in range(1, len(arm.units) + 1))
            topics = dataclasses.replace(
                topics, cable_names=arm.cable_names, arm_joints=topics.arm_joints or joints
            )
            return load_arm_bag(path, topics, progress)
        found = _table(path, options, progress)
        return _timed(found.of_arm(arm.cable_names, len(arm.units)), options)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Name the file in whatever is wrong with it.

    Raises
    ------
    RecordingError
        In place of any error of the system, too.
    """
    try:
        yield
    except RecordingError as error:
        raise RecordingError(f'{path}: {one_line(error)}') from None
    except OSError as error:
        raise RecordingError(f'{path}: it cannot be read: {error.strerror or error}') from None


def _timed(recording: Own, options: TableOptions | None) -> Own:
    """Give the rows of a table without times those that its rate makes.

    Raises
    ------
    RecordingError
        If there are both times and a rate.
    """
    if options is None or options.rate is None:
        return recording
    if recording.time is not None:
        raise RecordingError('it has times; a rate (--rate) is for tables without')
    return dataclasses.replace(
        recording,
        time=np.arange(len(recording)) / options.rate,
        unknown_times='',
        notes=(*recording.notes, f'time: {options.rate:g} rows per second, as was said'),
    )


def is_recording_file(path: Path) -> bool:
    """Whether a file is a recording, or one of a bag, by its ending."""
    return path.suffix in ENDINGS or is_bag_file(path)


def _table(path: Path, options: TableOptions | None, progress: Progress) -> Table:
    if path.suffix == '.parquet':
        from .parquet_file import load_parquet

        return load_parquet(path, options, progress)
    if path.suffix == '.mat':
        from .mat_file import load_mat

        return load_mat(path, options, progress)
    if path.suffix in TEXT_ENDINGS:
        from .csv_file import load_csv

        return load_csv(path, options, progress)
    raise RecordingError(
        f'a recording ends in {", ".join(ENDINGS)}, or is the folder of a bag'
        + _REMEDIES.get(path.suffix.lower(), '')
    )
