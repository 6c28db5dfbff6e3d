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
    arrays = dict(np.load(folder / 'map.npz', allow_pickle=False))
    assert len(rows) == table.num_rows == 441
    assert list(rows[0]) == table.column_names == list(arrays)
    arrays['tension_l'] = np.repeat(arrays['tension_l'], 21)
    arrays['tension_s'] = np.tile(arrays['tension_s'], 21)
    for name, values in arrays.items():
        in_parquet = table[name].to_numpy()
        np.testing.assert_array_equal(in_parquet, values.ravel())
        in_csv = [row[name] for row in rows]
        if values.dtype.kind == 'f':
            assert [float(text or 'nan') for text in in_csv] == pytest.approx(
                in_parquet, rel=0.0, abs=0.0, nan_ok=True
            )
        else:
            assert in_csv == [str(value) for value in in_parquet]


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        ([], '--output'),
        (['--output', 'map.xls'], '.npz, .csv, .parquet'),
        (['--output', '/no/such/folder/map.npz'], 'cannot be written'),
        (['--output', '/dev/map.csv/map.csv'], 'cannot be written'),
        (['--output', 'map.npz', '--points', '1'], '--points is 1'),
        (['--output', 'map.npz', '--points', '5001'], 'allowed is 2 to 5000'),
        *(
            (
                ['--output', 'map.npz', '--tension-l-range', low, high],
                f'--tension-l-range is {low} to {high} N, which must rise from 0 on',
            )
            for low, high in (('2', '1'), ('1', '1'), ('-1', '1'), ('nan', '1'), ('0', 'inf'))
        ),
    ],
)
def test_an_error_is_one_line(arguments, named):
    assert_refused(run('sweep', *arguments), named)
