"""Recordings in CSV files: columns, units, and what of a damaged file is kept."""

import math

import numpy as np
import pytest

from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / 'run.csv'
        path.write_text(text, encoding='utf-8')
        return path

    return write


def test_columns_are_found_by_name_and_comments_are_left_alone(file):
    recording = load_recording(
        file(
            '# a run\ntime, tension_s ,note,tension_l\n\n0.0,2.0,a,1.0\n# pause\n0.1,nan,,-1e-3\n'
        )
    )
    assert recording.time.tolist() == [0.0, 0.1]
    assert recording.tension_l.tolist() == [1.0, -0.001]
    assert recording.tension_s[0] == 2.0
    assert math.isnan(recording.tension_s[1])
    assert recording.bend_angle is recording.pressure is recording.state is None
    assert recording.damage == ()


def test_units_in_brackets_are_turned_into_si(file):
    recording = load_recording(
        file(
            'time [ms],tension_l [mN],tension_s[kgf],bend_angle [deg],pressure [ kPa ],state\n'
            '500,1000,1,180,0.4,held\n750,,1,,,\n'
        )
    )
    assert recording.time.tolist() == [0.5, 0.75]
    assert recording.tension_l[0] == 1.0
    assert recording.tension_s[0] == 9.80665
    assert recording.bend_angle[0] == pytest.approx(math.pi, rel=1e-15)
    assert recording.pressure[0] == 400.0
    assert recording.state == ['held', '']
    assert np.isnan([recording.tension_l[1], recording.bend_angle[1], recording.pressure[1]]).all()


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        ('', 'no column tension_l'),
        ('tension_l,t\n1,2\n', 'no column tension_s.*there are: tension_l, t'),
        ('T_l,T_s\n1,2\n', 'T_l, T_s .--columns tension_l=TITLE,tension_s=TITLE names them'),
        ('1.0,2.0\n1.0,1.5\n', 'numbers in place of titles; put titles above it'),
        ('1,0;2,0\n1,0;1,5\n', 'numbers in place of titles; put titles above it'),
        ('tension_l,tension_s\n', 'no row'),
        ('tension_l,tension_s\n1,x\n', "no row.*line 2, '1,x'"),
        ('tension_l [lbf],tension_s\n1,2\n', "tension_l is 'lbf'.* N, mN"),
        ('tension_l,tension_s,bend_angle_deg\n1,2,3\n', r'in brackets, bend_angle \[deg\]'),
        ('tension_l,tension_s,tension_l [mN]\n1,2,3\n', 'two columns of tension_l'),
    ],
)
def test_a_file_without_a_recording_is_named_with_the_reason(file, text, named):
    path = file(text)
    with pytest.raises(RecordingError, match=f'^{path}: .*{named}'):
        load_recording(path)


@pytest.mark.parametrize(
    'line',
    [
        b'1,x',
        b'1',
        b'1,2,3',
        b'"1,2',
        b'1,\xff2',
        b'1,2\0',
        b'\0' * 3,
        b'1,1_5',
        b'"' + b'1' * 200_000,
    ],
)
def test_a_damaged_line_is_named_and_the_rest_is_kept(tmp_path, line):
    path = tmp_path / 'run.csv'
    path.write_bytes(b'tension_l,tension_s\n1,2\n' + line + b'\n3,4\n')
    recording = load_recording(path)
    assert recording.tensions() == [(1.0, 2.0), (3.0, 4.0)]
    (damage,) = recording.damage
    assert damage.startswith('line 3, ')
    assert len(damage) < 300
    with pytest.raises(RecordingError, match=r'run\.csv: line 3'):
        recording.whole()


def test_what_is_no_utf_8_in_a_comment_and_separators_of_unicode_in_a_field_do_no_harm(tmp_path):
    path = tmp_path / 'run.csv'
    content = '# für\n'.encode('latin-1') + 'note,tension_l,tension_s\r\na\u2028b,1,2\r'.encode()
    path.write_bytes(content)
    assert load_recording(path).whole().tensions() == [(1.0, 2.0)]


def test_a_last_line_that_was_cut_is_not_believed(file):
    text = 'tension_l,tension_s\n1.5,2.5123\n1.5,2.0512'
    assert load_recording(file(text)).whole().tension_s.tolist() == [2.5123, 2.0512]
    for cut in range(1, 5):
        recording = load_recording(file(text[:-cut]))
        assert recording.tensions() == [(1.5, 2.5123)]
        assert 'line 3' in recording.damage_summary
        assert 'has no end, so it has been cut' in recording.damage_summary
    assert load_recording(file('tension_l,tension_s\n1,2')).whole().tensions() == [(1.0, 2.0)]


def test_of_much_damage_a_part_is_named_and_the_rest_is_counted(file):
    recording = load_recording(file('tension_l,tension_s\n1,2\n' + 'x\n' * 10))
    assert recording.damage_summary.count('line') == 3
    assert recording.damage_summary.endswith('and 7 more such places')


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(RecordingError, match='cannot be read: No such file'):
        load_recording(tmp_path / 'missing.csv')
    binary = tmp_path / 'binary.csv'
    binary.write_bytes(b'\xff\xfe')
    with pytest.raises(RecordingError, match='not a text file'):
        load_recording(binary)
    with pytest.raises(RecordingError, match=r'run\.txt: .*\.parquet.*renamed to \.csv'):
        load_recording(tmp_path / 'run.txt')
    with pytest.raises(RecordingError, match=r'run\.xlsx: .*save a spreadsheet as CSV'):
        load_recording(tmp_path / 'run.xlsx')


def test_the_demo_holds_the_published_case():
    assert (1.0, 2.0) in load_recording(installed_config('demo_tensions.csv')).whole().tensions()


@pytest.mark.parametrize(
    'text',
    [
        *('', 'nan', 'NA', 'N/A', 'n.a.', 'null', '#N/A', '#NV', '#DIV/0!', '#WERT!', '--'),
        *('NaN(ind)', '-nan', '1.#QNAN', '-1.#IND', '1.#INF'),
    ],
)
def test_what_programs_write_for_a_missing_number_is_no_damage(tmp_path, text):
    path = tmp_path / 'run.csv'
    path.write_text(f'tension_l,tension_s\n1,1.5\n1,{text}\n1,1.6\n')
    recording = load_recording(path).whole()
    np.testing.assert_array_equal(recording.tension_s, [1.5, np.nan, 1.6])
