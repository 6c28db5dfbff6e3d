"""Processes that are forked where all that a program imports is loaded already."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Mapping
from pathlib import Path

from tendon_statics.command_line.main import VERBS

FORKS = multiprocessing.get_context('forkserver')
# Once for all that are forked. What is missing here is only slower.
FORKS.set_forkserver_preload(
    [
        *(
            '__main__',
            *(f'tendon_statics.command_line.{verb.replace("-", "_")}' for verb in VERBS),
        ),
        *(
            'tendon_statics.command_line.arm_plot',
            'tendon_statics.recordings.reading.bag_tensions',
        ),
        *('tendon_statics.node.estimator', 'tendon_statics.node.arm_estimator'),
        *('tendon_statics.driver.pulley_driver', 'tendon_statics.view.view'),
        *('rclpy.executors', 'rclpy.experimental'),
        *(
            'matplotlib.figure',
            'matplotlib.backends.backend_svg',
            'matplotlib.backends.backend_agg',
        ),
        *('numpy', 'scipy.optimize', 'scipy.special', 'mcap.reader', 'rosbags.typesys'),
        *('pyarrow.parquet', 'tqdm', 'yaml', 'zstandard', 'distributed'),
    ]
)


def become(streams: tuple[Path, Path], folder: Path, environment: Mapping[str, str]) -> None:
    """Take over what a program has of who starts it: its two streams, folder and environment."""
    for number, stream in enumerate(streams, start=1):
        os.dup2(os.open(stream, os.O_WRONLY | os.O_CREAT | os.O_APPEND), number)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
