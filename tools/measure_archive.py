"""Measure `tendon-statics archive`: two workers against one, and memory over many recordings.

The recordings are made here: slow ramps of both tensions with noise, five minutes at 100 Hz. Each
run is the program from start to end, with its cluster. The machine should be quiet.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
import psutil

PROGRAM = [sys.executable, '-m', 'tendon_statics.command_line.main', 'archive']

RATE = 100.0
"""Hz"""


class Run(NamedTuple):
    """What a run took."""

    seconds: float
    program: float
    """Largest resident memory of the program itself, MiB"""
    worker: float
    """That of the worker that had most"""


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--recordings', type=int, default=40)
    parser.add_argument('--samples', type=int, default=30_000, help='of each')
    parser.add_argument('--rounds', type=int, default=2, help='the shorter time counts')
    parser.add_argument('--many', type=int, nargs='*', default=[20, 80, 320])
    parser.add_argument('--small', type=int, default=3_000, help='samples of each of many')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='measure-archive-') as folder:
        _speed(Path(folder), options)
        _memory(Path(folder), options)
    return 0


def _speed(folder: Path, options: argparse.Namespace) -> None:
    data = folder / 'speed'
    _write(data, options.recordings, options.samples)
    times: dict[int, float] = {}
    for _ in range(options.rounds):
        for workers in (1, 2):
            seconds = _run(data, workers).seconds
            times[workers] = min(seconds, times.get(workers, seconds))
    print(f'{options.recordings} recordings of {options.samples} samples')
    print(f'one worker    {times[1]:.1f} s')
    print(f'two workers   {times[2]:.1f} s, {times[2] / times[1]:.2f} of it (to reach: 0.6)')


def _memory(folder: Path, options: argparse.Namespace) -> None:
    print(f'\nlargest memory with two workers, {options.small} samples each, in MiB')
    print('| recordings | program | a worker |\n|-----------:|--------:|---------:|')
    for count in options.many:
        data = folder / f'many-{count}'
        _write(data, count, options.small)
        run = _run(data, 2)
        print(f'| {count:>10} | {run.program:7.0f} | {run.worker:8.0f} |')


def _write(folder: Path, recordings: int, samples: int) -> None:
    """Write sessions as CSV."""
    folder.mkdir()
    time_of = np.arange(samples) / RATE
    for number in range(recordings):
        rng = np.random.default_rng(number)
        ramps = (
            np.interp(time_of, np.linspace(0.0, time_of[-1], 40), rng.uniform(0.5, 2.5, 40)),
            np.interp(time_of, np.linspace(0.0, time_of[-1], 40), rng.uniform(0.5, 2.5, 40)),
        )
        noise = rng.normal(0.0, 0.01, (2, samples))
        table = np.column_stack([time_of, *(ramps + noise)])
        np.savetxt(
            *(folder / f'session_{number:04}.csv', table, '%.5f', ','),
            header='time,tension_l,tension_s',
            comments='',
        )


def _run(data: Path, workers: int) -> Run:
    """Make a data set and remove it."""
    with tempfile.TemporaryDirectory(dir=data.parent) as output:
        begin = time.perf_counter()
        with subprocess.Popen(
            [*PROGRAM, str(data), '--output', f'{output}/dataset', '--workers', str(workers)],
            stdout=subprocess.DEVNULL,
        ) as process:
            program = worker = 0.0
            while process.poll() is None:
                own, others = _resident(process.pid)
                program, worker = max(program, own), max([worker, *others])
                time.sleep(0.1)
        if process.returncode != 0:
            raise SystemExit(f'the program ended with {process.returncode}')
        return Run(time.perf_counter() - begin, program, worker)


def _resident(number: int) -> tuple[float, list[float]]:
    """Memory of a process and of each that it has started, in MiB."""
    try:
        process = psutil.Process(number)
        family = [process, *process.children(recursive=True)]
        own, *others = [of.memory_info().rss / 2**20 for of in family]
    except psutil.NoSuchProcess:
        return 0.0, []
    return own, others


if __name__ == '__main__':
    sys.exit(main())
