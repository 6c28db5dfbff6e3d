"""`output_file`: an output appears whole or not at all."""

import os
import shlex
import signal
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from programs import PROGRAM, TIME_LIMIT, assert_refused
from ros_programs import wait_for

from tendon_statics.files.installed_files import installed_config
from tendon_statics.files.output_file import OutputError, output_file


def write(path, fail=False):
    with output_file(path) as temporary:
        temporary.write_text('half')
        if fail:
            raise RuntimeError('halfway')


def test_it_appears_only_when_all_is_written(tmp_path):
    path = tmp_path / 'out.csv'
    with output_file(path) as temporary:
        temporary.write_text('new')
        assert not path.exists()
        assert temporary.suffix == path.suffix
    assert path.read_text() == 'new'
    assert list(tmp_path.iterdir()) == [path]
    umask = os.umask(0)
    os.umask(umask)
    assert stat.S_IMODE(path.stat().st_mode) == 0o666 & ~umask


def test_what_fails_leaves_the_old_file_as_it_was(tmp_path):
    path = tmp_path / 'out.csv'
    path.write_text('old')
    path.chmod(0o600)
    with pytest.raises(RuntimeError, match='halfway'):
        write(path, fail=True)
    assert path.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [path]
    with output_file(path) as temporary:
        temporary.write_text('new')
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


def test_what_another_removes_meanwhile_may_be_written(tmp_path, monkeypatch):
    path = tmp_path / 'out.csv'
    path.write_text('old')

    def stat_and_remove(of, stat=Path.stat, **options):
        found = stat(of, **options)
        if of == path:
            path.unlink()
        return found

    monkeypatch.setattr(Path, 'stat', stat_and_remove)
    write(path)
    monkeypatch.undo()
    assert path.read_text() == 'half'


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / 'link.csv').symlink_to(tmp_path / 'out.csv')
    with output_file(tmp_path / 'link.csv') as temporary:
        temporary.write_text('new')
    assert (tmp_path / 'link.csv').is_symlink()
    assert (tmp_path / 'out.csv').read_text() == 'new'


@pytest.mark.parametrize(
    ('arguments', 'name'),
    [
        (('sweep', '--points', '40'), 'map.npz'),
        (('sweep', '--points', '40'), 'map.csv'),
        (('sweep', '--points', '40'), 'map.parquet'),
        (('replay', installed_config('recorded_session.mcap')), 'replay.mcap'),
        (('plot', 'unit'), 'unit.png'),
    ],
    ids=lambda value: value if isinstance(value, str) else '',
)
def test_a_disk_that_gets_full_leaves_the_old_file_and_is_said_in_one_line(
    arguments, name, tmp_path
):
    """By a limit on the size of files, which the system refuses to exceed in the same way."""
    path = tmp_path / name
    path.write_text('old')
    command = shlex.join(map(str, (*PROGRAM, *arguments, '--output', path)))
    done = subprocess.run(
        ['bash', '-c', f'ulimit -f 4; exec {command}'],
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
        check=False,
    )
    assert_refused(done, 'File too large')
    assert str(path) in done.stderr
    assert path.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize('path', ['/no/such/folder/out.csv', '/dev/null', '/tmp'])
def test_what_cannot_be_written_is_named(path):
    with pytest.raises(OutputError, match=f'^{path}: it cannot be written'):
        write(Path(path))


def test_an_interruption_at_any_moment_leaves_nothing_half_written(tmp_path):
    """At the first line that runs while a file is written, at the second, and so on to the end."""
    path = tmp_path / 'out.csv'
    moment = 0
    while interrupted_at(moment, lambda: write(path)):
        assert [file.name for file in tmp_path.iterdir()] in ([], ['out.csv'])
        path.unlink(missing_ok=True)
        moment += 1
    assert moment > 10
    assert path.read_text() == 'half'


def interrupted_at(moment, work):
    """Whether an interruption, as a signal makes, came at one of the lines of `output_file`."""
    left = [moment]

    def count(frame, event, _argument):
        if frame.f_globals['__name__'] != output_file.__module__:
            return None
        if event == 'line':
            left[0] -= 1
            if left[0] == -1:
                raise KeyboardInterrupt
        return count

    before = sys.gettrace()
    sys.settrace(count)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_nothing_half_written_and_no_traceback(tmp_path, number):
    command = [*PROGRAM, 'sweep', '--points', '800', '--output', str(tmp_path / 'map.csv')]
    with subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        text=True,
        # A shell's background jobs, and what they start, are deaf to SIGINT.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        wait_for('the file to be begun', lambda: list(tmp_path.iterdir()))
        process.send_signal(number)
        _, errors = process.communicate(timeout=TIME_LIMIT)
    assert process.returncode == 128 + number, errors
    assert errors == ''
    assert list(tmp_path.iterdir()) == []
