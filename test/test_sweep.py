"""``tendon-statics sweep``: a map that agrees with `solve`."""

import csv
import math

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import assert_refused, run
from pyarrow import parquet

from tendon_statics import solve

GRID = ('--tension-l-range', '0', '2', '--tension-s-range', '1', '3', '--points', '21')


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp('maps')
    for ending in ('npz', 'csv', 'parquet'):
        done = run('sweep', *GRID, '--output', folder / f'map.{ending}')
        assert (done.returncode, done.stderr) == (0, '')
        assert '| slack ' in done.stdout
    return folder


def test_the_map_is_as_solve_answers(folder):
    arrays = np.load(folder / 'map.npz')
    assert arrays['tension_l'].shape == arrays['tension_s'].shape == (21,)
    assert arrays['bend_angle'].shape == (21, 21)
    for i, tension_l in enumerate(arrays['tension_l']):
        for j, tension_s in enumerate(arrays['tension_s']):
            answer = solve(PRELIMINARY, tension_l, tension_s)
            assert arrays['regime'][i, j] == answer.regime.value
            if answer.bend_angle is None:
                assert math.isnan(arrays['bend_angle'][i, j])
            else:
                assert arrays['bend_angle'][i, j] == pytest.approx(answer.bend_angle, abs=1e-9)
                assert arrays['pressure'][i, j] == pytest.approx(answer.pressure, rel=1e-9)
                gradient = answer.bend_angle_gradient
                assert arrays['bend_angle_by_tension_s'][i, j] == pytest.approx(gradient.tension_s)
                assert arrays['bend_angle_by_tension_l'][i, j] == pytest.approx(gradient.tension_l)


def test_a_table_has_a_row_for_each_pair(folder):
    rows = list(csv.DictReader((folder / 'map.csv').read_text().splitlines()))
    table = parquet.read_table(folder / 'map.parquet')
    arrays = np.load(folder / 'map.npz')
    assert len(rows) == table.num_rows == 441
    assert [row['regime'] for row in rows] == arrays['regime'].ravel().tolist()
    assert [float(row['tension_l']) for row in rows[:21]] == [0.0] * 21
    angles = [float(row['bend_angle'] or 'nan') for row in rows]
    assert angles == pytest.approx(arrays['bend_angle'].ravel().tolist(), nan_ok=True)
    assert table['bend_angle'].to_pylist() == pytest.approx(angles, nan_ok=True)


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        ([], '--output'),
        (['--output', 'map.xls'], '.npz, .csv, .parquet'),
        (['--output', '/no/such/folder/map.npz'], 'cannot be written'),
        (['--output', 'map.npz', '--points', '1'], '--points is 1'),
        (['--output', 'map.npz', '--tension-l-range', '2', '1'], '--tension-l-range is 2 to 1 N'),
    ],
)
def test_an_error_is_one_line(arguments, named):
    assert_refused(run('sweep', *arguments), named)
