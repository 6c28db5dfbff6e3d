"""`tendon-statics archive`: all recordings, once, whatever happens to one or to a worker."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
from contextlib import contextmanager, suppress
from multiprocessing import forkserver
from pathlib import Path

import bags
import dask
import numpy as np
import pyarrow.dataset
import pytest
from bags import write_bag
from forks import FORKS  # noqa: F401  which says what the server of forks loads
from make_docs import ROOT
from programs import TIME_LIMIT
from pyarrow import parquet
from ros_programs import wait_for

from tendon_statics import load_recording
from tendon_statics.archive import cluster as cluster_module
from tendon_statics.archive.cluster import Results
from tendon_statics.archive.dataset import PAGE, SUMMARY, Dataset
from tendon_statics.archive.errors import ArchiveError
from tendon_statics.archive.finding import Found, find_recordings
from tendon_statics.archive.row import STATUSES
from tendon_statics.archive.summary_table import summary_columns
from tendon_statics.archive.work import Work
from tendon_statics.command_line.main import VERBS, main
from tendon_statics.files.installed_files import installed_config
from tendon_statics.files.output_file import OutputError

SESSION = installed_config('recorded_session.mcap')
DESIGN = installed_config('preliminary_design.yaml')
COUNT = 40
DAMAGED = {
    'day0/torn.csv': 'damaged',
    'day1/cut.mcap': 'damaged',
    'day2/noise.parquet': 'unreadable',
}


def write_csv(path, seed, rows=300):
    """A session of a unit whose tensions vary."""
    rng = np.random.default_rng(seed)
    time = 0.01 * np.arange(rows)
    tensions = rng.uniform(0.8, 2.2, 2) + 0.2 * np.sin(np.outer(time, rng.uniform(1, 5, 2)))
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = (
        f'{t:.3f},{left:.5f},{right:.5f}\n'
        for t, (left, right) in zip(time, tensions, strict=True)
    )
    path.write_text('time,tension_l,tension_s\n' + ''.join(lines), encoding='utf-8')


@pytest.fixture(scope='module')
def archive(tmp_path_factory):
    """Folder with 40 recordings of all kinds, three of which are damaged."""
    folder = tmp_path_factory.mktemp('lab') / 'archive'
    for number in range(COUNT - 7):
        write_csv(folder / f'day{number % 4}/run {number}.csv', number)
    shutil.copy(SESSION, folder / 'day3/session.mcap')
    messages = [('/tensions', 0.01 * n, bags.array(1.0 + 0.01 * n, 2.0)) for n in range(50)]
    write_bag(folder / 'day3/bag', messages)
    columns = {'tension_l': [1.0, 1.0], 'tension_s': [1.5, 2.0]}
    parquet.write_table(pyarrow.table(columns), folder / 'day3/table.parquet')
    (folder / 'day3/killed').mkdir()
    for part in (0, 1):  # as a killed recorder leaves them
        file = write_bag(folder / f'made{part}', messages)
        file.rename(folder / f'day3/killed/killed_{part}.mcap')
        shutil.rmtree(folder / f'made{part}')
    write_csv(folder / 'day0/torn.csv', 100)
    with (folder / 'day0/torn.csv').open('a') as file:
        file.write('4.0,1.0,\x00\n4.1,1,2\n')
    whole = SESSION.read_bytes()
    (folder / 'day1/cut.mcap').write_bytes(whole[: len(whole) // 2])
    (folder / 'day2/noise.parquet').write_bytes(b'PAR1' + bytes(range(256)))
    (folder / 'notes.txt').write_text('no recording')
    (folder / 'day0/.hidden.csv').write_text('no recording')
    return folder


@pytest.fixture(scope='module', autouse=True)
def forks():
    """What the tests fork from; begun by an archive, it would not have what others need."""
    forkserver.ensure_running()


@pytest.fixture(scope='module')
def cluster():
    """Two workers in processes of their own, forked where all is imported already."""
    from distributed import LocalCluster  # Here, as each worker of the tests loads this file.

    with (
        dask.config.set({'distributed.worker.multiprocessing-method': 'forkserver'}),
        LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            dashboard_address='127.0.0.1:0',
            scheduler_kwargs={'dashboard': False},  # Its pages take long to load.
            silence_logs='CRITICAL',
        ) as cluster,
    ):
        yield cluster


def run(cluster, capsys, *arguments, code=0):
    """Run the verb on the cluster, to this exit code; return output and errors."""
    given = ['archive', *map(str, arguments), '--scheduler', cluster.scheduler_address]
    ended = main(given)
    captured = capsys.readouterr()
    assert ended == code, captured.err
    return captured.out, captured.err


@pytest.fixture(scope='module')
def dataset(cluster, archive, tmp_path_factory):
    """The data set of the archive, made without any trouble."""
    folder = tmp_path_factory.mktemp('plain') / 'dataset'
    given = ['archive', archive, '--output', folder, '--scheduler', cluster.scheduler_address]
    assert main([*map(str, given)]) == 1
    return folder


def contents(folder):
    """Everything in a data set but the page: the summary, and each file of samples."""
    parts = {
        path.parent.name: parquet.read_table(path, partitioning=None)
        for path in folder.glob('samples/*/*')
    }
    return parts, parquet.read_table(folder / SUMMARY)


def assert_same(folder, other):
    """Assert that two data sets hold the same, in samples, metadata and summary."""
    (parts, summary), (other_parts, other_summary) = contents(folder), contents(other)
    assert parts.keys() == other_parts.keys()
    for name, table in parts.items():
        assert table.equals(other_parts[name], check_metadata=True), name
    assert summary.equals(other_summary)


def rows(folder):
    """Rows of the summary by recording."""
    return {row['recording']: row for row in parquet.read_table(folder / SUMMARY).to_pylist()}


def test_every_recording_is_there_once_and_damaged_ones_cost_themselves_only(archive, dataset):
    found = rows(dataset)
    assert len(found) == COUNT
    assert 'archive/day3/bag' in found
    assert 'archive/day3/killed' in found
    wrong = {name: row['status'] for name, row in found.items() if row['status'] != 'whole'}
    assert wrong == {f'archive/{name}': status for name, status in DAMAGED.items()}
    for name in wrong:
        assert found[name]['error'] or found[name]['damage']
    samples = pyarrow.dataset.dataset(dataset / 'samples', partitioning='hive').to_table()
    counted = samples.group_by('recording').aggregate([('regime', 'count')]).to_pylist()
    assert {row['recording']: row['regime_count'] for row in counted} == {
        name: row['samples'] for name, row in found.items() if row['status'] != 'unreadable'
    }
    row = found['archive/day3/session.mcap']
    recording = load_recording(SESSION)
    assert row['samples'] == len(recording)
    assert row['clock'] == recording.clock == 'log'
    assert row['time_origin'] == recording.time_origin
    assert row['path'] == str(archive / 'day3/session.mcap')
    counted = subprocess.run(
        ['sha256sum', row['path']], capture_output=True, text=True, check=True
    )
    assert row['sha256'] == counted.stdout.split()[0]


def test_samples_are_those_of_a_replay(archive, dataset, tmp_path):
    output = tmp_path / 'replay.parquet'
    assert main(['replay', str(archive / 'day0/run 0.csv'), '--output', str(output)]) == 0
    alone = parquet.read_table(output)
    part = parquet.read_table(Dataset(dataset).part('archive/day0/run 0.csv'), partitioning=None)
    for name in alone.column_names:
        expected = [None if value != value else value for value in alone[name].to_pylist()]
        assert part[name].to_pylist() == expected, name


def test_the_page_names_every_recording_and_why_one_is_not_whole(dataset):
    page = (dataset / PAGE).read_text(encoding='utf-8')
    found = rows(dataset)
    for name, row in found.items():
        assert name in page
        assert (row['error'] or '').split('"')[0][:30] in page
    assert 'http' not in page


@contextmanager
def stopped_worker(cluster):
    """Stop a worker, so that what it is given is not done; give the number of its process."""
    with cluster.get_client() as client:
        client.wait_for_workers(2)
        worker = next(iter(client.run(os.getpid).values()))
    os.kill(worker, signal.SIGSTOP)
    try:
        yield worker
    finally:
        with suppress(ProcessLookupError):
            os.kill(worker, signal.SIGCONT)


def wait_for_parts(output):
    """Wait until some recordings are done."""
    wait_for('some of the work', lambda: len([*output.glob('samples/*/part.parquet')]) >= 3)


def test_a_killed_worker_loses_nothing(cluster, archive, dataset, tmp_path, capsys):
    output = tmp_path / 'dataset'

    def kill():
        wait_for_parts(output)
        os.kill(worker, signal.SIGKILL)

    with stopped_worker(cluster) as worker:
        killer = threading.Thread(target=kill)
        killer.start()
        out, _ = run(cluster, capsys, archive, '--output', output, code=1)
        killer.join()
    assert f'{COUNT}; 0 were there already' in out
    assert_same(output, dataset)


def test_a_killed_run_leaves_nothing_half_and_the_next_goes_on(
    cluster, archive, dataset, tmp_path, capsys
):
    output = tmp_path / 'dataset'
    program = 'import sys; from tendon_statics.command_line.main import main; main(sys.argv[1:])'
    given = ['archive', archive, '--output', output, '--scheduler', cluster.scheduler_address]
    with (
        stopped_worker(cluster),
        subprocess.Popen(
            [sys.executable, '-c', program, *map(str, given)], stderr=subprocess.DEVNULL
        ) as process,
    ):
        wait_for_parts(output)
        process.kill()
        process.wait(TIME_LIMIT)
    (output / 'samples/recording=archive%2Fday0%2Frun 0.csv').mkdir(exist_ok=True)
    half = output / 'samples/recording=archive%2Fday0%2Frun 0.csv/.part-12.parquet'
    half.write_bytes(b'PAR1')
    there = len([*output.glob('samples/*/part.parquet')])
    for path in output.glob('samples/*/part.parquet'):
        parquet.read_table(path, partitioning=None)
    out, _ = run(cluster, capsys, archive, '--output', output, code=1)
    kept = int(out.split(' were there already')[0].split('; ')[-1])
    assert there <= kept < COUNT
    assert not half.exists()
    # The worker that was stopped may still be at what the killed run gave it.
    wait_for('nothing half', lambda: not [*output.glob('samples/*/.*')])
    assert_same(output, dataset)


@contextmanager
def dashboard_of_another():
    """Hold the port at which every other cluster of dask on this machine has its pages."""
    with socket.socket() as taken:
        with suppress(OSError):  # Another has it indeed.
            taken.bind(('127.0.0.1', 8787))
            taken.listen()
        yield


def test_an_interrupted_run_on_this_machine_ends_in_silence_and_the_next_goes_on(tmp_path, capsys):
    folder, output = tmp_path / 'runs', tmp_path / 'dataset'
    folder.mkdir()
    shutil.copy(SESSION, folder / '000.mcap')
    for number in range(1, 300):
        os.link(folder / '000.mcap', folder / f'{number:03}.mcap')
    given = ['archive', str(folder), '--output', str(output), '--workers', '1']
    program = 'import sys; from tendon_statics.command_line.main import main; sys.exit(main())'
    with (
        dashboard_of_another(),
        subprocess.Popen(
            [sys.executable, '-c', program, *given], stderr=subprocess.PIPE, start_new_session=True
        ) as process,
    ):
        wait_for_parts(output)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, errors = process.communicate(timeout=TIME_LIMIT)
    assert process.returncode == 128 + signal.SIGINT, errors
    assert errors == b''
    for path in sorted(folder.iterdir())[4:]:
        path.unlink()
    code = main(given)
    captured = capsys.readouterr()
    assert code == 0, captured.err
    there = int(captured.out.split('; ')[1].split()[0])
    assert there >= 3
    assert len([name for name in rows(output) if (folder.parent / name).exists()]) == 4


def test_only_what_has_changed_is_done_again(cluster, archive, tmp_path, capsys):
    folder, output = tmp_path / 'day0', tmp_path / 'dataset'
    shutil.copytree(archive / 'day0', folder)

    def worked_on(*options):
        out, _ = run(cluster, capsys, folder, '--output', output, *options, code=1)
        return int(out.split('worked on')[1].split(';')[0])

    whole = len([*folder.glob('[!.]*.csv')])
    assert worked_on() == whole
    assert worked_on() == 0
    times = {path: path.stat().st_mtime_ns for path in output.glob('samples/*/*')}
    write_csv(folder / 'run 0.csv', 1000)
    shutil.copy(folder / 'run 4.csv', folder / 'new.csv')
    os.utime(folder / 'run 8.csv')
    assert worked_on() == 2
    after = {path: path.stat().st_mtime_ns for path in output.glob('samples/*/*')}
    assert len(after) == whole + 1
    assert sum(times.get(path) == at for path, at in after.items()) == whole - 1
    design = tmp_path / 'unit.yaml'
    text = DESIGN.read_text(encoding='utf-8')
    design.write_text(f'# another file that says the same\n{text}', encoding='utf-8')
    assert worked_on('--design', design) == 0
    assert worked_on('--fit', 'mass') == 0  # without --calibrate it does nothing
    assert worked_on('--estimation', 'tracking') == whole + 1
    design.write_text(text.replace('1.05', '1.06'), encoding='utf-8')
    assert worked_on('--design', design, '--estimation', 'tracking') == whole + 1


def test_what_is_not_below_the_folders_any_more_stays_and_is_said(cluster, tmp_path, capsys):
    first, second, output = tmp_path / 'a/runs', tmp_path / 'b/runs', tmp_path / 'dataset'
    write_csv(first / 'one.csv', 1, rows=5)
    write_csv(second / 'one.csv', 2, rows=5)
    run(cluster, capsys, first, '--output', output)
    run(cluster, capsys, second / 'one.csv', '--output', output)
    assert rows(output).keys() == {'runs/one.csv'}  # the same name: it is that one, changed
    out, _ = run(cluster, capsys, first, second, '--output', output)
    assert rows(output).keys() == {'a/runs/one.csv', 'b/runs/one.csv', 'runs/one.csv'}
    assert '1 of earlier runs' in out
    assert out.endswith(f'wrote {output}\n')


def test_with_calibrate_there_are_fitted_values_with_their_errors(cluster, tmp_path, capsys):
    folder, output = tmp_path / 'runs', tmp_path / 'dataset'
    folder.mkdir()
    shutil.copy(SESSION, folder)
    write_csv(folder / 'no_angle.csv', 3, rows=5)
    out, _ = run(
        cluster, capsys, folder, '--output', output, '--calibrate', '--motion-step-deg', 3
    )
    assert '1 of 2' in out
    fitted = rows(output)['runs/recorded_session.mcap']
    assert 0.0 < fitted['fitted_mass_stderr'] < fitted['fitted_mass']
    without = rows(output)['runs/no_angle.csv']
    assert without['fitted_mass'] is None
    assert 'no measured bend angle' in without['calibration_error']


def test_a_recording_that_kills_every_worker_costs_itself_only(cluster, monkeypatch):
    monkeypatch.setattr(cluster.scheduler, 'allowed_failures', 0)
    with cluster.get_client() as client:
        client.wait_for_workers(2)
        killer = Results(client, _die_of_three, [1, 2, 3, 4, 5, 6], lambda thing: -thing)
        assert len(killer) == 6  # for a progress bar
        assert sorted(killer) == [-3, 1, 2, 4, 5, 6]


def _die_of_three(number):
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def test_what_lies_elsewhere_is_left_out(tmp_path):
    for name in ('a.csv', 'raw/a.csv', 'raw/b.csv', '.git/c.csv', 'old/samples/x/part.parquet'):
        write_csv(tmp_path / name, 1, rows=2)
    (tmp_path / 'old/.samples.lock').touch()
    (tmp_path / 'circle').symlink_to(tmp_path)
    os.mkfifo(tmp_path / 'pipe.csv')
    (tmp_path / 'linked').symlink_to(tmp_path / 'raw')
    base = tmp_path.name

    def names(*folders, **more):
        return [found.name for found in find_recordings([*folders], **more)]

    assert names(tmp_path) == [f'{base}/a.csv', f'{base}/raw/a.csv', f'{base}/raw/b.csv']
    assert names(tmp_path, exclude=['b.*']) == [f'{base}/a.csv', f'{base}/raw/a.csv']
    assert names(tmp_path, exclude=['raw/*']) == [f'{base}/a.csv']
    assert names(tmp_path / 'a.csv') == [f'{base}/a.csv']
    assert names(tmp_path, tmp_path / 'raw') == names(tmp_path)
    long = tmp_path / ('ü' * 60) / ('ü' * 60)
    write_csv(long / 'a.csv', 1, rows=2)
    (name,) = names(long)
    Dataset(tmp_path).part(name).parent.mkdir(parents=True)


def test_a_link_to_nothing_is_listed_and_costs_itself_only(cluster, tmp_path, capsys):
    """As to a disk that is not mounted: a recording, or a folder of them, is not there."""
    folder, output = tmp_path / 'runs', tmp_path / 'dataset'
    write_csv(folder / 'whole.csv', 1, rows=5)
    bag = folder / 'killed'
    file = write_bag(tmp_path / 'bag', [('/tensions', 0.0, bags.array(1.0, 2.0))])
    bag.mkdir()
    shutil.copy(file, bag / 'killed_0.mcap')
    links = {
        'run.mcap': 'nowhere.mcap',
        'day1': '/nowhere/day1',
        'loop.csv': 'loop.csv',
        'killed/killed_1.mcap': 'nowhere.mcap',
        'notes.txt': 'nowhere.txt',
    }
    for name, target in links.items():
        (folder / name).symlink_to(target)
    _, errors = run(cluster, capsys, folder, '--output', output, code=1)
    statuses = {name: row['status'] for name, row in rows(output).items()}
    assert statuses == {
        'runs/whole.csv': 'whole',
        'runs/killed': 'damaged',
        **dict.fromkeys(('runs/run.mcap', 'runs/day1', 'runs/loop.csv'), 'unreadable'),
    }
    assert 'killed_1.mcap is a link to nothing' in errors
    assert 'run.mcap: it cannot be read: No such file' in errors


def test_a_folder_that_cannot_be_entered_or_looked_into_is_given_too(tmp_path, monkeypatch):
    for name in ('open/a.csv', 'closed/b.csv', 'blind/c.csv'):
        write_csv(tmp_path / name, 1, rows=2)
    entries, looked = Path.iterdir, Path.stat

    def iterdir(path):
        if path.name == 'closed':
            raise PermissionError(13, 'Permission denied')
        return entries(path)

    def stat(path, **more):
        if path.parent.name == 'blind':
            raise PermissionError(13, 'Permission denied')
        return looked(path, **more)

    monkeypatch.setattr(Path, 'iterdir', iterdir)
    monkeypatch.setattr(Path, 'stat', stat)
    base = tmp_path.name
    assert [found.name for found in find_recordings([tmp_path])] == [
        *(f'{base}/blind', f'{base}/closed', f'{base}/open/a.csv')
    ]


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['nowhere', '--output', 'out'], 'nowhere: there is no such folder'),
        (['empty', '--output', 'out'], 'no recording below empty'),
        (['runs', '--output', 'runs'], 'it has other things in it'),
        (['runs', '--output', 'out', '--workers', '0'], "'0', allowed is a whole number from 1"),
        (['runs', '--output', 'out', '--workers', '2', '--scheduler', 'x'], 'not allowed with'),
        (['runs', '--output', 'out', '--calibrate', '--fit', 'weight'], 'weight'),
        (['runs', '--output', 'out', '--initial-bend-angle', '3'], '3.0'),
        (['runs', '--output', 'out', '--clock', 'sun'], 'sun'),
        (['runs', '--output', 'out', '--scheduler', 'tcp://127.0.0.1:9'], 'cannot be reached'),
    ],
)
def test_an_error_is_one_line(tmp_path, monkeypatch, capsys, arguments, named):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cluster_module, 'CONNECT', 0.5)
    write_csv(tmp_path / 'runs/a.csv', 1, rows=2)
    (tmp_path / 'empty').mkdir()
    assert main(['archive', *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith('tendon-statics: ')
    assert error.count('\n') == 1, error
    assert named in error


def test_a_missing_library_is_named_with_what_installs_it(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, 'distributed', None)
    write_csv(tmp_path / 'runs/a.csv', 1, rows=2)
    assert main(['archive', str(tmp_path / 'runs'), '--output', str(tmp_path / 'out')]) == 2
    error = capsys.readouterr().err
    assert error.count('\n') == 1
    assert 'pip install distributed' in error
    assert '[archive' in error
    assert not (tmp_path / 'out').exists()


def test_two_at_once_do_not_write_to_one_data_set(tmp_path):
    first, second = Dataset(tmp_path / 'out'), Dataset(tmp_path / 'out')
    with first.held(), pytest.raises(OutputError, match='another archive'), second.held():
        pass
    with second.held():
        pass


def test_of_two_begun_at_once_on_a_new_folder_the_second_is_told_of_the_first(
    tmp_path, monkeypatch
):
    first, second = Dataset(tmp_path / 'out'), Dataset(tmp_path / 'out')
    told = []

    def mkdir(path, *of, mkdir=Path.mkdir, **options):
        mkdir(path, *of, **options)
        if path.name == 'samples':
            with pytest.raises(OutputError) as error, second.held():
                pass
            told.append(str(error.value))

    monkeypatch.setattr(Path, 'mkdir', mkdir)
    with first.held():
        pass
    assert len(told) == 1
    assert 'another archive is being written there' in told[0]


def test_what_was_half_may_be_gone_before_it_is_removed(tmp_path, monkeypatch):
    output = Dataset(tmp_path / 'out')
    with output.held():
        half = output.part('a').with_name('.part-12.parquet')
        half.parent.mkdir()
        half.touch()

    def unlink(path, unlink=Path.unlink, **options):
        path.replace(path.with_name('part.parquet'))  # as a worker that has written it
        unlink(path, **options)

    monkeypatch.setattr(Path, 'unlink', unlink)
    with output.held():
        assert output.part('a').exists()


def test_the_folder_of_what_was_half_may_be_gone_before_it_is_looked_into(tmp_path, monkeypatch):
    output = Dataset(tmp_path / 'out')
    with output.held():
        folder = output.part('a').parent
        folder.mkdir()

    def scandir(path, scandir=os.scandir):
        if Path(path) == folder:
            folder.rmdir()  # as a worker to which the recording is damaged
        return scandir(path)

    monkeypatch.setattr(os, 'scandir', scandir)
    with output.held():
        assert not folder.exists()


def test_a_worker_with_another_version_ends_it(tmp_path):
    work = Work(tmp_path, 'options', print, version='0.0.1')
    with pytest.raises(ArchiveError, match=r'and this is 0\.0\.1'):
        work(Found('a', tmp_path))


def test_a_study_that_fails_costs_one_recording(tmp_path):
    def study(path):
        raise MemoryError(f'{path.name} is too long')

    write_csv(tmp_path / 'runs/a.csv', 1, rows=2)
    work = Work(tmp_path / 'out', 'options', study)
    (found,) = find_recordings([tmp_path / 'runs'])
    row, is_new = work(found)
    assert (row.status, is_new) == ('failed', True)
    assert row.error == 'MemoryError: a.csv is too long'


def test_the_page_on_archives_names_every_column_and_status():
    text = (ROOT / 'docs/archive.md').read_text(encoding='utf-8')
    for name in (*summary_columns(), *STATUSES):
        assert f'`{name}`' in text


def test_other_verbs_load_nothing_of_it():
    others = (verb.replace('-', '_') for verb in VERBS if verb != 'archive')
    modules = ', '.join(f'tendon_statics.command_line.{name}' for name in others)
    code = (
        f'import sys, {modules}\n'
        "there = {name.split('.')[0] for name in sys.modules}\n"
        "assert not there & {'dask', 'distributed', 'tornado'}, there\n"
        "assert not any(name.startswith('tendon_statics.archive') for name in sys.modules)\n"
        'import tendon_statics.command_line.archive\n'
        "assert 'distributed' not in sys.modules\n"
    )
    subprocess.run([sys.executable, '-c', code], check=True, timeout=TIME_LIMIT)
