"""From a file to a `Recording`, by its ending."""

from __future__ import annotations

from pathlib import Path

from ..errors import RecordingError, one_line
from ..progress import Progress, unseen
from ..recording import Recording
from .topics import BagTopics

ENDINGS = ('.csv', '.parquet', '.mcap', '.db3')


def load_recording(
    path: str | Path, topics: BagTopics | None = None, *, progress: Progress = unseen
) -> Recording:
    """Read a recorded session.

    A table, CSV or Parquet, has columns ``tension_l``, ``tension_s`` and, where there are such,
    ``time``, ``bend_angle``, ``pressure`` and ``state``; a unit stands in brackets,
    ``tension_l [mN]``, and without one the column is in SI. A ROS 2 bag is an ``.mcap`` or
    ``.db3`` file, or the folder of one.

    Parameters
    ----------
    path : str or Path
        Its ending says what it is.
    topics : BagTopics, optional
        Of a bag; of a table they are not looked at.
    progress : callable
        A `Progress`, to show how far the reading is.

    Returns
    -------
    Recording
        What could be read; what could not is named in its `damage`.

    Raises
    ------
    RecordingError
        If there is no such file, it cannot be read at all, it holds no sample, or a column, unit
        or topic is not there or not known; the text names the file. Also if a library is missing
        that the format needs.
    """
    path = Path(path)
    try:
        return _loaded(path, topics or BagTopics(), progress)
    except RecordingError as error:
        raise RecordingError(f'{path}: {one_line(error)}') from None
    except OSError as error:
        raise RecordingError(f'{path}: it cannot be read: {error.strerror or error}') from None


def _loaded(path: Path, topics: BagTopics, progress: Progress) -> Recording:
    if path.is_dir() or path.suffix in ('.mcap', '.db3'):
        from .bag import load_bag

        return load_bag(path, topics, progress)
    if path.suffix == '.parquet':
        from .parquet_file import load_parquet

        return load_parquet(path, progress)
    if path.suffix == '.csv':
        from .csv_file import load_csv

        return load_csv(path, progress)
    raise RecordingError(f'a recording ends in {", ".join(ENDINGS)}, or is the folder of a bag')
