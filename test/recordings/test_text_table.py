"""Tables as spreadsheets, LabVIEW, MATLAB, PlotJuggler and `rostopic echo` write them."""

import math
import re

import numpy as np
import pytest
from programs import assert_refused, run

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.table_options import TableOptions

PAIRS = [(1.0, 1.5), (1.0, 1.6)]


@pytest.fixture
def file(tmp_path):
    def write(text, name='run.csv', encoding='utf-8'):
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return path

    return write


LABVIEW = (
    'LabVIEW Measurement\t\nSeparator\t{name}\nDecimal_Separator\t{decimal}\n'
    'X_Columns\t{columns}\n'
    '***End_of_Header***\t\n\t\nChannels\t2\nSamples\t2\t2\nX_Dimension\tTime\tTime\n'
    '***End_of_Header***\t\nX_Value\ttension_l\ttension_s\tComment\n'
)


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('time,tension_l,tension_s\n0,1,1.5\n1,1,1.6\n', ()),
        ('time;tension_l;tension_s\n0;1;1.5\n1;1;1.6\n', ('separated by semicolon',)),
        (
            'time;tension_l;tension_s\n0,0;1,0;1,5\n1,0;1,0;1,6\n',
            ('separated by semicolon', 'decimals are written with a comma'),
        ),
        ('time\ttension_l\ttension_s\n0\t1\t1.5\n1\t1\t1.6\n', ('separated by tab',)),
        ('sep=;\ntime;tension_l;tension_s\n0;1;1.5\n1;1;1.6\n', ('separated by semicolon',)),
        ('time;tension_l;tension_s\n0;1;1.5;\n1;1;1.6;\n', ('separated by semicolon',)),
        ('time|tension_l|tension_s\n0|1|1.5\n1|1|1.6\n', ('separated by bar',)),
        ('time | tension_l | tension_s\n0 | 1 | 1.5\n1 | 1 | 1.6\n', ('separated by bar',)),
        ('time tension_l  tension_s\n0 1 1.5\n1   1 1.6\n', ('separated by space',)),
        ('time,tension_l,tension_s\n"0,0","1,0","1,5"\n"1,0",1,"1,6"\n', ('with a comma',)),
        ('% a run\n# of MATLAB\ntime,tension_l,tension_s\n0,1,1.5\n% pause\n1,1,1.6\n', ()),
        ('# a run\n# time tension_l tension_s\n0 1 1.5\n1 1 1.6\n', ('separated by space',)),
        ('%time,tension_l,tension_s\n0,1,1.5\n1,1,1.6\n', ('the column %time, in s',)),
        ('time,tension_l,tension_s\ns,N,N\n0,1,1.5\n1,1,1.6\n', ('units: those of line 2',)),
        (
            'time,tension_l,tension_s\nseconds,Millinewton,Newton\n0,1000,1.5\n1,1000,1.6\n',
            (
                'units: those of line 2',
                'tension_l: in mN, converted to N',
                'time [seconds], in s',
            ),
        ),
        (
            'time,tension_l,tension_s,note\n[ms],[mN],[mN],\n0,1000,1500,a\n1000,1000,1600,b\n',
            (
                'units: those of line 2',
                'tension_l and tension_s: in mN, converted to N',
                'not used: note',
            ),
        ),
        (
            LABVIEW.format(name='Tab', decimal=',', columns='One')
            + '0,000000\t1,0\t1,5\n1,000000\t1,0\t1,6\tpause\n',
            ('a measurement file of LabVIEW',),
        ),
        (
            LABVIEW.replace('\t', ',').format(name='Comma', decimal='.', columns='One')
            + '0.0,1,1.5\n1.0,1.0,1.6\n',
            ('a measurement file of LabVIEW',),
        ),
    ],
)
def test_what_is_recognised_for_sure_is_read_and_said(file, text, said):
    recording = load_recording(file(text)).whole()
    assert recording.tensions() == PAIRS
    assert recording.time.tolist() == [0.0, 1.0]
    assert len(recording.notes) == len(said)
    for note, part in zip(recording.notes, said, strict=True):
        assert part in note


def test_a_labview_file_without_times_has_none(file):
    text = LABVIEW.format(name='Tab', decimal='.', columns='No') + '\t1.0\t1.5\n\t1.0\t1.6\n'
    recording = load_recording(file(text, 'run.lvm')).whole()
    assert recording.tensions() == PAIRS
    assert recording.time is None


CHANNELS = (
    'LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\t{columns}\n'
    '***End_of_Header***\t\n\t\nChannels\t2\nSamples\t2\t2\nY_Unit_Label\t{units}\n'
    'X_Dimension\tTime\tTime\nDelta_X\t{steps}\n***End_of_Header***\t\n'
)
OF_ONE = 'X_Value\ttension_l\ttension_s\tComment\n\t1000.0\t1.5\n\t1000.0\t1.6\tpause\n'


def test_the_preamble_of_labview_tells_steps_of_time_and_units(file):
    text = CHANNELS.format(columns='No', units='mN\tNewtons', steps='0.010000\t0.01') + OF_ONE
    recording = load_recording(file(text, 'run.lvm')).whole()
    assert recording.tensions() == PAIRS
    assert recording.time.tolist() == [0.0, 0.01]
    assert recording.in_newtons
    assert recording.notes[1:] == (
        'tension_l: in mN, by Y_Unit_Label',
        'tension_s: in N, by Y_Unit_Label',
        'tension_l: in mN, converted to N',
        'time: 0.01 s from row to row, by Delta_X',
    )
    rate = load_recording(file(text, 'run.lvm'), table=TableOptions(rate=50.0))
    assert rate.time.tolist() == [0.0, 0.02]


def test_a_row_of_labview_that_is_damaged_takes_its_time_too(file):
    text = CHANNELS.format(columns='No', units='N', steps='0.5') + OF_ONE + '\tx\t1\n\t1\t1\n'
    recording = load_recording(file(text, 'run.lvm'))
    assert len(recording.damage) == 1
    assert recording.time.tolist() == [0.0, 0.5, 1.5]


@pytest.mark.parametrize('units', ['mN\t\tNewton', 'mN\tNewton'])
def test_where_each_channel_of_labview_has_times_units_stand_above_theirs(file, units):
    text = CHANNELS.format(columns='Multi', units=units, steps='0.01\t\t0.01')
    text += 'X_Value\ttension_l\tX_Value\ttension_s\tComment\n'
    text += '0.0\t1000.0\t0.0\t1.5\n0.01\t1000.0\t0.01\t1.6\n'
    recording = load_recording(file(text, 'run.lvm')).whole()
    assert recording.tensions() == PAIRS
    assert recording.time.tolist() == [0.0, 0.01]


@pytest.mark.parametrize('steps', ['0.01\t\t0.02', '0.01\t0.02'])
def test_channels_of_labview_that_were_measured_at_other_times_are_no_pairs(file, steps):
    text = CHANNELS.format(columns='Multi', units='N\tN', steps=steps)
    text += 'X_Value\ttension_l\tX_Value\ttension_s\tComment\n0.0\t1.0\t0.0\t1.5\n'
    with pytest.raises(RecordingError, match=r'their Delta_X is 0.01 and 0.02.*one X column'):
        load_recording(file(text, 'run.lvm'))


def test_what_the_preamble_of_labview_does_not_tell_names_the_options(file):
    steps = '0.01\t0.02'
    text = CHANNELS.format(columns='No', units='Volts\tN', steps=steps) + OF_ONE
    recording = load_recording(file(text, 'run.lvm')).whole()
    assert recording.tensions() == [(1000.0, 1.5), (1000.0, 1.6)]
    assert (recording.time, recording.in_newtons) == (None, False)
    _, volts, _, times = recording.notes
    assert 'Y_Unit_Label is Volts' in volts
    assert '--units tension_l=UNIT' in volts
    assert '--rate HZ' in times
    parts = CHANNELS.format(columns='No', units='N', steps='0.01') + OF_ONE + OF_ONE
    assert '2 parts' in load_recording(file(parts, 'run.lvm')).notes[-1]


@pytest.mark.parametrize('encoding', ['utf-16', 'utf-8-sig'])
def test_a_byte_order_mark_says_the_encoding(file, encoding):
    recording = load_recording(file('tension_l;tension_s\n1,0;1,5\n1,0;1,6\n', encoding=encoding))
    assert recording.whole().tensions() == PAIRS
    assert ('encoding: UTF-16' in recording.notes) == (encoding == 'utf-16')


@pytest.mark.parametrize(
    ('encoding', 'named'),
    [('latin-1', 'byte 0xb0; if it is Latin-1, --encoding latin-1'), ('utf-16-le', 'utf-16-le')],
)
def test_an_encoding_that_is_not_sure_is_named_with_the_option_that_reads_it(
    file, encoding, named
):
    text = 'tension_l,tension_s,bend_angle [°]\n1,1.5,180\n1,1.6,90\n'
    path = file(text, encoding=encoding)
    assert_refused(run('replay', path), named)
    recording = load_recording(path, table=TableOptions(encoding=encoding)).whole()
    assert recording.tensions() == PAIRS
    assert recording.bend_angle == pytest.approx([math.pi, math.pi / 2])


@pytest.mark.parametrize(
    ('text', 'options', 'named'),
    [
        (
            'tension_l;tension_s\n1,5;2,5\n1.000,5;2,5\n1.5;2,5\n',
            {'decimal': ','},
            '--decimal , or --decimal . says',
        ),
        ('Fz1,Fz2\n1,1.5\n', {'columns': {'tension_l': 'Fz1', 'tension_s': 'Fz2'}}, '--columns'),
        ('a\nb\ntension_l,tension_s\n1,1.5\n', {'skip_rows': 2}, 'line 3 has them: --skip-rows 2'),
    ],
)
def test_what_is_not_sure_is_refused_with_the_option_that_reads_it(file, text, options, named):
    path = file(text)
    with pytest.raises(RecordingError, match=named):
        load_recording(path)
    assert load_recording(path, table=TableOptions(**options)).tensions() in (
        [(1.5, 2.5)],
        [(1.0, 1.5)],
    )


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        (
            'Rig export\nOperator: A B\n;;\n\ntime;tension_l;tension_s\n0,0;1,0;1,5\n',
            'line 1, the first, has no titles of tensions; line 5 has them: --skip-rows 4',
        ),
        (
            'Rig export\n;;\n\nTime (s);Force left (N);Force right\n0,0;1,0;1,5\n',
            'line 4 looks like the titles, Time (s), Force left (N), Force right: --skip-rows 3 '
            '--columns tension_l=TITLE,tension_s=TITLE',
        ),
        ('Time (s);Force left (N);Force right (N)\n0,0;1,0;1,5\n', 'Time (s), Force left (N), F'),
    ],
)
def test_titles_are_found_below_a_preamble_and_not_split_at_their_blanks(file, text, named):
    path = file(text)
    with pytest.raises(RecordingError, match=re.escape(named)):
        load_recording(path)
    columns = {'tension_l': 'Force left (N)', 'tension_s': 'Force right'} if 'F' in named else {}
    skip = int(named.partition('--skip-rows ')[2].split()[0]) if '--skip-rows' in named else 0
    table = TableOptions(skip_rows=skip, columns=columns)
    assert load_recording(path, table=table).tensions() == [(1.0, 1.5)]


def test_of_rows_that_are_skipped_with_the_titles_it_is_said_where_those_stand(file):
    path = file('a\ntension_l,tension_s\n1,1.5\n')
    with pytest.raises(RecordingError, match='line 2 has them: --skip-rows 1'):
        load_recording(path, table=TableOptions(skip_rows=2))


def test_rows_of_separators_alone_at_the_ends_are_none(file):
    recording = load_recording(file(';\ntension_l;tension_s\n1,0;1,5\n;\n1,0;1,6\n;\n;\n'))
    assert [at_s for _, at_s in recording.whole().tensions()][::2] == [1.5, 1.6]
    assert math.isnan(recording.tension_s[1])


def test_of_a_row_in_latin_1_the_cause_is_named(file):
    path = file('tension_l,tension_s,note\n1,1.5,20 C\n1,1.6,25 °C\n', encoding='latin-1')
    recording = load_recording(path)
    assert 'line 3' in recording.damage_summary
    assert 'byte 0xb0; if it is Latin-1, --encoding latin-1 reads it' in recording.damage_summary
    latin = load_recording(path, table=TableOptions(encoding='latin-1'))
    assert latin.whole().tensions() == PAIRS


def test_of_a_number_with_a_comma_among_points_the_option_is_named(file):
    rows = ''.join(f'1.0;1.{i}\n' for i in range(10, 120))
    recording = load_recording(file(f'tension_l;tension_s\n{rows}1,0;1,5\n'))
    assert "'1,0' is no number (--decimal , if commas" in recording.damage_summary


@pytest.mark.parametrize('word', ['NaN', 'NA', 'N/A', '#N/A', 'null', 'None', '-1.#IND'])
def test_what_programs_write_for_no_number_is_none(file, word):
    recording = load_recording(file(f'tension_l,tension_s\n1,1.5\n1,{word}\n')).whole()
    assert math.isnan(recording.tension_s[1])


def test_a_long_rest_of_whole_numbers_does_not_hide_how_decimals_are_written(file):
    rest = '0;0;0\n' * 500
    recording = load_recording(file(f'time;tension_l;tension_s\n{rest}0,5;1,0;1,5\n')).whole()
    assert recording.tensions()[-1] == (1.0, 1.5)


def test_commas_between_columns_and_in_numbers_are_not_guessed_at(file):
    with pytest.raises(RecordingError, match='commas separate both'):
        load_recording(file('tension_l,tension_s\n1,0,1,5\n1,0,1,6\n'))


def test_a_point_between_thousands_is_no_decimal_point(file):
    recording = load_recording(
        file('tension_l;tension_s\n1,5;2,5\n1.000,5;2,5\n'), table=TableOptions(decimal=',')
    )
    assert recording.tensions() == [(1.5, 2.5)]
    assert 'line 3' in recording.damage_summary


def test_the_command_line_has_all_the_options(file):
    path = file('x\nForce A;Force B [mN];phi\n1000,0;1500,0;10\n1000,0;1600,0;20\n')
    done = run(
        *('replay', path, '--skip-rows', 1, '--separator', 'semicolon', '--decimal', ','),
        *('--columns', 'tension_l=Force A,tension_s=Force B,bend_angle=phi'),
        *('--units', 'tension_l=mN,bend_angle=deg', '--encoding', 'utf-8'),
        *('--output', path.with_name('out.csv')),
    )
    assert done.returncode == 0, done.stderr
    again = load_recording(path.with_name('out.csv'))
    assert again.tensions() == PAIRS
    assert again.bend_angle == pytest.approx(np.radians([10.0, 20.0]))


@pytest.mark.parametrize(
    ('given', 'named'),
    [
        ({'separator': 'ab'}, "separator is 'ab'; one character"),
        ({'separator': '"'}, 'one character'),
        ({'decimal': ';'}, 'allowed are . and ,'),
        ({'decimal': ',', 'separator': ','}, 'cannot separate both'),
        ({'skip_rows': -1}, '-1 lines'),
        ({'columns': {'force': 'a'}}, "'force' is no quantity; there are time, tension_l"),
        ({'units': {'tension_l': 'lbf'}}, "tension_l is 'lbf', which is not known; there are N"),
        ({'units': {'state': 's'}}, "'state' is no quantity"),
        ({'encoding': 'klingon'}, "no encoding 'klingon'"),
    ],
)
def test_options_that_no_table_can_meet_are_refused_before_one_is_read(given, named):
    with pytest.raises(RecordingError, match=named):
        TableOptions(**given)


@pytest.mark.parametrize(
    ('options', 'named'),
    [
        ({'columns': {'tension_l': 'F3', 'tension_s': 'F2'}}, "no column 'F3' to be tension_l"),
        ({'columns': {'tension_l': 'F1', 'tension_s': 'F2'}}, "2 columns 'F1'"),
        ({'columns': {'tension_l': 'F2', 'tension_s': 'F4'}, 'units': {'tension': 'N'}}, 'says N'),
        ({'columns': {'tension_l': 'F2', 'tension_s': 'F2'}}, 'both tension_l and tension_s'),
    ],
)
def test_an_option_that_does_not_fit_the_table_is_refused(file, options, named):
    path = file('F1,F1,F2 [mN],F4 [mN]\n1,2,3,4\n')
    with pytest.raises(RecordingError, match=named):
        load_recording(path, table=TableOptions(**options))


@pytest.mark.parametrize('text', ['a', 'tension_l=', '=a', 'tension_l=a,tension_l=b'])
def test_pairs_of_an_option_that_are_none_are_refused(text):
    assert run('replay', 'x.csv', '--columns', text).returncode == 2


@pytest.mark.parametrize(
    'title',
    [
        *('Kraft links / mN', 'Fz1/mN', 'Fz1 in mN', 'Fz1, mN', 'Fz1 (mN)', 'Fz1 [mN]'),
        *('Fz1 (Millinewton)', 'F 1 / millinewtons', 'tension_l_mN', 'Fz1 mN', 'Fz1-millinewton'),
    ],
)
def test_the_unit_of_a_title_that_is_named_counts_however_it_stands_there(file, title):
    path = file(f'time;{title};tension_s\n0;1000;1.5\n1;1000;1.6\n')
    for name in (title, re.split(r'[,/(\[-]| in |[ _](?=mN)', title)[0].strip()):
        recording = load_recording(path, table=TableOptions(columns={'tension_l': name})).whole()
        assert recording.tensions() == PAIRS


@pytest.mark.parametrize(
    'title',
    ['F (kg)', 'F [lbf]', 'F / g', 'F in oz', 'F (kg force)', 'tension_l_g', 'F lbf'],
)
def test_a_unit_that_is_not_read_is_not_taken_for_newtons_until_an_option_says_so(file, title):
    path = file(f'time;{title};tension_s\n0;1;1.5\n1;1;1.6\n')
    columns = {'tension_l': title}
    if title != 'F (kg force)':  # no unit by any name
        with pytest.raises(RecordingError, match=r'not known.*--units tension_l=UNIT'):
            load_recording(path, table=TableOptions(columns=columns))
    said = TableOptions(columns=columns, units={'tension_l': 'N'})
    assert load_recording(path, table=said).whole().tensions() == PAIRS


def test_a_normal_force_is_not_taken_to_be_in_newtons_by_its_name(file):
    options = TableOptions(columns={'tension_l': 'F_N', 'tension_s': 'F_s'})
    assert not load_recording(file('F_N,F_s\n1,1.5\n'), table=options).in_newtons


@pytest.mark.parametrize(
    'text', ['tension_l [lbf];tension_s [V]\n', 'tension_l;tension_s\nlbf;lbf\n']
)
def test_the_option_that_an_error_names_reads_the_table(file, text):
    path = file(f'{text}1;1.5\n1;1.6\n')
    with pytest.raises(RecordingError, match=r'not known.*--units tension_l=UNIT'):
        load_recording(path)
    said = TableOptions(units={'tension': 'N'})
    assert load_recording(path, table=said).whole().tensions() == PAIRS


def test_a_unit_that_is_written_out_in_the_title_is_not_another_by_an_option(file):
    path = file('F [Newton],tension_s\n1,1.5\n')
    options = TableOptions(columns={'tension_l': 'F'}, units={'tension_l': 'mN'})
    with pytest.raises(RecordingError, match='stands in its title, and --units says mN'):
        load_recording(path, table=options)


@pytest.mark.parametrize(
    'rows',
    [
        '0;1,000;1,500\n1;1,000;1,600\n',
        '0;1,000;1,500;0.5\n1;100;200;0.5\n',
        '0;"12,000";"1,500"\n1;0;0\n',
    ],
)
def test_commas_that_may_stand_between_thousands_are_not_guessed_at(file, rows):
    path = file(f'time;tension_l;tension_s{";x" * (".5" in rows)}\n{rows}')
    with pytest.raises(
        RecordingError, match=r"'1\d?,000' is a few or some thousands: --decimal ,"
    ):
        load_recording(path)
    assert load_recording(path, table=TableOptions(decimal=',')).tension_s[0] == 1.5
    sure = file('time;tension_l;tension_s\n0;1,000;1,500\n0;0,900;1,500\n')
    assert load_recording(sure).tension_l.tolist() == [1.0, 0.9]


def test_titles_with_commas_blanks_and_quotes_can_be_named(file):
    path = file('time,"Force, left (N)",F=2\n0,1,1.5\n1,1,1.6\n')
    for left in ('Force, left (N)', '"Force, left (N)"'):
        done = run('replay', path, '--columns', f'tension_l={left},tension_s=F=2')
        assert done.returncode == 0, done.stderr
        assert '2 samples' in done.stdout


def test_titles_that_nothing_known_separates_name_the_option(file):
    path = file('time:tension_l:tension_s\n0:1:1.5\n1:1:1.6\n')
    with pytest.raises(RecordingError, match='--separator CHARACTER'):
        load_recording(path)
    recording = load_recording(path, table=TableOptions(separator=':')).whole()
    assert recording.tensions() == PAIRS


def test_what_has_no_titles_as_ros2_topic_echo_writes_it_is_said(file):
    path = file(
        '1795737600,0,base,cable_l,cable_s,1.0,1.5\n1795737600,5,base,cable_l,cable_s,1,1\n'
    )
    with pytest.raises(RecordingError, match='first line has numbers in place of titles'):
        load_recording(path)


def test_a_row_of_units_of_which_one_is_not_known_asks_for_that(tmp_path):
    """It is no damage, after which volts would be read as newtons."""
    data = tmp_path / 'run.csv'
    data.write_text('time,tension_l,tension_s\ns,V,V\n0,1,1.5\n1,1,1.6\n')
    assert_refused(run('replay', data), "the unit of tension_l is 'V', which is not known")
    done = run('replay', data, '--units', 'tension=mN')
    assert done.returncode == 0, done.stderr
    assert 'units: those of line 2' in done.stdout


def test_many_columns_that_are_not_used_are_counted(file):
    titles = ','.join(f'extra_{number}' for number in range(10))
    rows = ''.join(f'{row},1,{1.5 + 0.1 * row}{",7" * 10}\n' for row in range(2))
    recording = load_recording(file(f'time,tension_l,tension_s,{titles}\n{rows}'))
    named = ', '.join(f'extra_{number}' for number in range(8))
    assert recording.notes == (f'not used: {named} and 2 more',)


def test_a_unit_that_an_option_says_is_told_too(file):
    text = 'time,tension_l,tension_s,bend_angle\n0,1000,1500,10\n1,1000,1600,11\n'
    units = {'tension': 'mN', 'bend_angle': 'deg'}
    recording = load_recording(file(text), table=TableOptions(units=units)).whole()
    assert recording.tensions() == PAIRS
    assert recording.notes == (
        'tension_l and tension_s: in mN, converted to N',
        'bend_angle: in deg, converted to rad',
    )
