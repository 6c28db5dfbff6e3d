"""Run a page: its blocks of commands, Python and files, in order, as a reader would.

In a folder of its own a block of ``yaml`` whose first line is ``# NAME`` is written to
that file, one of ``bash`` is run, each line of one of ``bash background`` until the page ends, and
one of ``python`` after those before it. What ran last printed what the next block of ``text``
shows. Blocks of any other language, ``console`` say, are to be read.
"""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, redirect_stdout
from pathlib import Path

from ament_index_python.packages import get_package_prefix
from ros_domain import own_domain
from ros_programs import Program

_BLOCK = re.compile(r'^```([^\n]*)\n(.*?)^```$', re.MULTILINE | re.DOTALL)

TIME_LIMIT = 300.0
"""Seconds for one block; more than ten times what any takes"""


def run_page(page: str) -> str:
    """Return the text of a page with what its blocks printed.

    Raises
    ------
    RuntimeError
        If a command ends with another exit code than 0.
    """
    printed = ''
    namespace: dict[str, object] = {'__name__': '__main__'}
    with ExitStack() as stack:
        stack.enter_context(own_domain())
        stack.enter_context(_place())

        def run(block: re.Match[str]) -> str:
            nonlocal printed
            kind, text = block.groups()
            if kind == 'text':
                shown, printed = printed, ''
                return f'```text\n{shown.rstrip()}\n```' if shown else block.group()
            if kind == 'bash background':
                for line in text.replace('\\\n', '').splitlines():
                    command = ['bash', '-c', f'exec {line}']
                    stack.enter_context(Program.running_command(command))
            elif kind == 'bash':
                printed = _shell(text)
            elif kind == 'python':
                output = io.StringIO()
                with redirect_stdout(output):
                    exec(compile(text, 'the page', 'exec'), namespace)
                printed = output.getvalue()
            elif kind == 'yaml' and (name := re.match(r'# ([\w.]+)\n', text)):
                Path(name[1]).write_text(text, encoding='utf-8')
            return block.group()

        return _BLOCK.sub(run, page)


def _shell(text: str) -> str:
    done = subprocess.run(
        ['bash', '-euo', 'pipefail', '-c', text],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=TIME_LIMIT,
    )
    if done.returncode:
        raise RuntimeError(f'{text}ended with {done.returncode}:\n{done.stdout}')
    return done.stdout


@contextmanager
def _place() -> Iterator[None]:
    """Go to an empty folder, with the programs on the path, and come back."""
    programs = Path(get_package_prefix('tendon_statics'), 'lib', 'tendon_statics')
    before, path = Path.cwd(), os.environ['PATH']
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ['PATH'] = os.pathsep.join(
            [str(programs), str(Path(sys.executable).parent), path]
        )
        try:
            yield
        finally:
            os.chdir(before)
            os.environ['PATH'] = path


if __name__ == '__main__':
    for page in map(Path, sys.argv[1:]):
        page.write_text(run_page(page.read_text(encoding='utf-8')), encoding='utf-8')
