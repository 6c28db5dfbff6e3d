"""``tendon-statics track``: a replay with memory, as a table."""

import csv
import random
import sys
from dataclasses import asdict

import pytest
from designs import PRELIMINARY
from programs import assert_refused, run
from pyarrow import parquet

from tendon_statics.command_line.main import main

DEMO = 'config/demo_tensions.csv'
NOISE = ('--tension-stddev', '0.01')


def table(text):
    return list(csv.DictReader(text.splitlines()))


@pytest.fixture(scope='module')
def session(tmp_path_factory):
    """A ramp with noise, that slips the unit."""
    draw = random.Random(4)
    path = tmp_path_factory.mktemp('session') / 'ramp.csv'
    rows = (
        (0.01 * row, draw.gauss(1.0, 0.01), draw.gauss(1.5 + 0.01 * row, 0.01), 0.1)
        for row in range(100)
    )
    lines = [','.join(map(str, row)) for row in rows]
    path.write_text('\n'.join(['time,tension_l,tension_s,bend_angle', *lines]))
    return path


@pytest.fixture
def unit(tmp_path):
    """A parameter file of the preliminary unit with some lines more."""

    def write(*lines):
        path = tmp_path / 'unit.yaml'
        design = [f'  {name}: {value}' for name, value in asdict(PRELIMINARY).items()]
        body = ''.join(f'    {line}\n' for line in (*lines, 'design:', *design))
        path.write_text(f'/**:\n  ros__parameters:\n{body}')
        return path

    return write


@pytest.mark.parametrize('estimation', [(), ('--estimation', 'filtering', *NOISE)])
def test_it_says_what_a_replay_says(tmp_path, session, estimation):
    output = tmp_path / 'replayed.csv'
    as_replay = estimation or ('--estimation', 'tracking')
    assert run('replay', session, *as_replay, '--output', output).returncode == 0
    rows, replayed = table(run('track', session, *estimation).stdout), table(output.read_text())
    assert len(rows) == len(replayed) > 0
    same = {name: name for name in rows[0] if not name.startswith('bend_angle')}
    same['bend_angle'] = 'estimated_bend_angle'
    if estimation:
        same |= {f'bend_angle_{end}': f'estimated_bend_angle_{end}' for end in ('low', 'high')}
    assert set(same) == set(rows[0])
    for name, there in same.items():
        assert [row[name] for row in rows] == [row[there] for row in replayed]


def test_it_filters_where_the_file_of_the_unit_does(session, unit):
    noisy = unit('estimation: filtering', 'tension_stddev: 0.01')
    done = run('track', session, '--design', noisy)
    assert done.stdout == run('track', session, '--estimation', 'filtering', *NOISE).stdout
    assert 'bend_angle_low' in done.stdout
    tracked = run('track', session, '--design', noisy, '--estimation', 'tracking')
    assert tracked.stdout == run('track', session).stdout
    assert_refused(
        run('track', session, '--design', unit('estimation: filtering')), '--tension-stddev'
    )


def test_it_tracks_also_a_unit_that_is_not_followed_otherwise(unit):
    of_pairs = unit('estimation: equilibrium')
    assert run('track', DEMO, '--design', of_pairs).stdout == run('track', DEMO).stdout
    refused = run('track', DEMO, '--estimation', 'equilibrium')
    assert_refused(refused, 'tracking')
    assert 'filtering' in refused.stderr


@pytest.mark.parametrize('ending', ['csv', 'parquet'])
def test_it_writes_the_table_and_then_prints_the_summary_of_a_replay(tmp_path, ending):
    output = tmp_path / f'out.{ending}'
    done = run('track', DEMO, '--output', output)
    summary = run('replay', DEMO, '--estimation', 'tracking').stdout
    assert done.stdout == f'{summary}wrote {output}\n'
    printed = run('track', DEMO).stdout
    if ending == 'csv':
        assert output.read_text() == printed
    else:
        assert parquet.read_table(output).column_names == list(table(printed)[0])


def test_it_writes_no_bag_and_nothing_over_the_recording(tmp_path):
    done = run('track', DEMO, '--output', tmp_path / 'out.mcap')
    assert_refused(done, 'ending in .csv, .parquet')
    data = tmp_path / 'run.csv'
    data.write_text('tension_l,tension_s\n1,2\n')
    assert_refused(run('track', data, '--output', data), 'it is the recording itself')
    assert data.read_text() == 'tension_l,tension_s\n1,2\n'


def test_a_script_is_warned_of_noise_beside_the_table():
    done = run('track', DEMO)
    slack, noise = done.stderr.splitlines()
    assert slack == (
        'tendon-statics: demo_tensions.csv: a cable counts as slack up to 0.03 N, 3 times the '
        'tension_stddev of 0.01 N; tensions up to 1000 N are believed, as no max_tension is given'
    )
    assert noise.startswith('tendon-statics: demo_tensions.csv: noise of tension_stddev')
    assert 'estimation: filtering' in noise


def test_a_person_gets_the_summary_below_the_table(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, 'isatty', lambda: True)
    assert main(['track', DEMO]) == 0
    printed = capsys.readouterr()
    assert len(table(printed.out)) == 16
    assert printed.err.strip() == run('replay', DEMO, '--estimation', 'tracking').stdout.strip()


def test_it_takes_a_tip_force_that_is_looked_for(session):
    (row, *_) = table(run('track', session, '--direction', 1, 0, '--distance', 0.02).stdout)
    assert {'tip_force_low', 'tip_force_high'} <= set(row)
