"""Run the tests of the node again and again beside busy loops, and print what each run took."""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ros_programs import END_WITH_PARENT

_BUSY_LOOP = ('sh', '-c', 'while :; do :; done')


@contextmanager
def busy_loops(count: int, seconds: float) -> Iterator[None]:
    """Keep cores busy; each loop ends with this program, or after so many seconds."""
    command = (*END_WITH_PARENT, 'timeout', f'{seconds:g}', *_BUSY_LOOP)
    loops = [subprocess.Popen(command) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.terminate()
        for loop in loops:
            loop.wait()


def outcome(output: str) -> str:
    """Pytest's last line without its frame: `222 passed, 2 skipped in 148.30s`."""
    lines = [line for line in output.splitlines() if re.search(r'\b\d+ \w+.* in [\d.]+s', line)]
    return lines[-1].strip('= ') if lines else 'no result'


def main() -> int:
    """Return 0 if every run passed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=10)
    parser.add_argument('--loops', type=int, default=4, help='busy loops beside each run')
    parser.add_argument('--marked', default='node', help="which tests: pytest's -m")
    parser.add_argument('--limit', type=float, default=3000.0, help='seconds for one run')
    arguments = parser.parse_args()

    failed = []
    for run in range(1, arguments.runs + 1):
        begin = time.monotonic()
        with busy_loops(arguments.loops, arguments.limit):
            pytest = subprocess.run(
                [*END_WITH_PARENT, sys.executable, '-m', 'pytest', '-q', '-m', arguments.marked],
                stdout=subprocess.PIPE,
                text=True,
                timeout=arguments.limit,
            )
        took = time.monotonic() - begin
        print(f'run {run:2}: {took:4.0f} s: {outcome(pytest.stdout)}', flush=True)
        if pytest.returncode:
            failed.append(run)
            print(pytest.stdout, flush=True)
    print(f'{arguments.runs - len(failed)} of {arguments.runs} runs passed')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main())
