"""Processes that are forked where all that a program imports is loaded already."""

from __future__ import annotations

import gc
import multiprocessing
import os
from collections.abc import Mapping
from pathlib import Path

FORKS = multiprocessing.get_context('forkserver')
# Once for all that are forked: programs over ROS, and workers on an archive. What is missing here
# is only slower.
FORKS.set_forkserver_preload(
    [
        '__main__',
        *('tendon_statics.command_line.archive', 'tendon_statics.command_line.archive_study'),
        *('tendon_statics.node.estimator', 'tendon_statics.node.arm_estimator'),
        *('tendon_statics.driver.pulley_driver', 'tendon_statics.view.view'),
        *(
            f'tendon_statics.recordings.reading.{name}'
            for name in ('bag_tensions', 'clock_like', 'csv_file')
        ),
        *('rclpy.executors', 'rclpy.experimental'),
        *('numpy', 'scipy.optimize', 'scipy.special'),
        *('mcap.reader', 'mcap.writer', 'rosbags.serde.primitives'),
        'rosbags.typesys.stores.ros2_jazzy',
        *('importlib_metadata', 'email.policy'),
        *('pyarrow.parquet', 'tqdm', 'yaml', 'zstandard', 'distributed'),
    ]
)


def become(streams: tuple[Path, Path], folder: Path, environment: Mapping[str, str]) -> None:
    """Take over what a program has of who starts it: its two streams, folder and environment.

    What was loaded before the fork is kept as it is.
    """
    # Left alone, else the first collection of garbage makes a copy of every page of it.
    gc.freeze()
    for number, stream in enumerate(streams, start=1):
        os.dup2(os.open(stream, os.O_WRONLY | os.O_CREAT | os.O_APPEND), number)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
