"""Recordings in ROS 2 bags: topics, times, and what of a damaged file is kept."""

import functools
import math
import shutil
import sqlite3

import bags
import numpy as np
import pytest
from bags import ORIGIN, write_bag
from programs import assert_refused, run

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.topics import BagTopics


def session(count=10):
    """Tensions every 10 ms; an angle every 20 ms, recorded 1 ms later."""
    for index in range(count):
        time = 0.01 * index
        yield '/tensions', time, bags.array(1.0, 1.5 + time)
        if index % 2 == 0:
            yield '/measured_bend_angle', time + 0.001, bags.number(0.001 * index)


@pytest.mark.parametrize('plugin', ['MCAP', 'SQLITE3'])
@pytest.mark.parametrize('of', ['file', 'folder'])
def test_tensions_and_the_nearest_angle(tmp_path, plugin, of):
    file = write_bag(tmp_path / 'bag', session(), plugin)
    recording = load_recording(file if of == 'file' else file.parent)
    assert recording.time == pytest.approx(0.01 * np.arange(10))
    assert recording.time_origin == ORIGIN
    assert (recording.tension_l == 1.0).all()
    assert recording.tension_s == pytest.approx(1.5 + recording.time)
    nearest = [0, 0, 2, 2, 4, 4, 6, 6, 8, 8]
    assert recording.bend_angle == pytest.approx(0.001 * np.array(nearest))
    assert recording.damage == ()
    assert recording.name == (file if of == 'file' else file.parent).name


def test_an_angle_farther_away_than_the_tolerance_is_none(tmp_path):
    file = write_bag(tmp_path / 'bag', session())
    recording = load_recording(file, BagTopics(max_skew=0.002))
    assert np.isnan(recording.bend_angle).tolist() == [False, True] * 5


def test_pressure_and_state_have_topics_of_their_own(tmp_path):
    messages = [*session(2), ('/p', 0.0, bags.number(400.0)), ('/state', 0.01, bags.text('held'))]
    file = write_bag(tmp_path / 'bag', messages)
    recording = load_recording(file, BagTopics(pressure='p', state='/state', max_skew=0.005))
    assert recording.pressure[0] == 400.0
    assert math.isnan(recording.pressure[1])
    assert recording.state == ['', 'held']


def test_a_joint_state_is_read_by_names_and_stamp(tmp_path):
    messages = [
        ('/drives', 5.0, bags.joint_state(['x', 's', 'l'], effort=[9.0, 2.0, 1.0], time=0.2)),
        ('/drives', 6.0, bags.joint_state(['l', 's'], effort=[1.1, 2.1], time=0.1)),
        ('/drives', 7.0, bags.joint_state(['l'], effort=[1.2], time=0.3)),
        ('/camera', 9.0, bags.joint_state(['tip', 'base'], position=[0.3, 0.4], time=0.1)),
    ]
    file = write_bag(tmp_path / 'bag', messages)
    topics = BagTopics(
        tensions=('drives',), cable_names=('l', 's'), bend_angle='camera', joint_name='tip'
    )
    recording = load_recording(file, topics)
    assert recording.time == pytest.approx([0.0, 0.1, 0.2])
    assert recording.time_origin == ORIGIN + 100_000_000
    assert recording.tensions()[:2] == [(1.1, 2.1), (1.0, 2.0)]
    assert np.isnan(recording.tension_s).tolist() == [False, False, True]
    assert recording.bend_angle[0] == 0.3
    with pytest.raises(RecordingError, match='tip, base; name one'):
        load_recording(file, BagTopics(('drives',), ('l', 's'), bend_angle='camera'))


@pytest.mark.parametrize(('component', 'tension'), [('x', 3.0), ('z', 4.0), ('norm', 5.0)])
def test_a_pair_of_wrenches_is_joined_by_stamp(tmp_path, component, tension):
    messages = []
    for index in range(5):
        time = 0.1 * index
        messages.append(('/cell_l', time, bags.wrench(3.0, 0.0, 4.0, time)))
        if index != 3:
            late = time + 0.005
            messages.append(('/cell_s', time, bags.wrench(6.0, 0.0, 8.0, late)))
    file = write_bag(tmp_path / 'bag', messages)
    recording = load_recording(
        file, BagTopics(tensions=('cell_l', 'cell_s'), force_component=component)
    )
    assert recording.tension_l == pytest.approx([tension] * 5)
    assert recording.tension_s[[0, 1, 2, 4]] == pytest.approx([2.0 * tension] * 4)
    assert math.isnan(recording.tension_s[3])


def test_the_estimators_own_estimates_hold_tensions(tmp_path):
    """Their type is not one of ROS's own; the bag holds its definition."""
    file = write_bag(tmp_path / 'bag', [('/estimate', 3.0, bags.estimate(1.0, 2.0, time=0.5))])
    recording = load_recording(file, BagTopics(tensions=('estimate',)))
    assert recording.tensions() == [(1.0, 2.0)]
    assert recording.time_origin == ORIGIN + 500_000_000
    assert recording.bend_angle is None


def test_a_message_of_another_length_is_kept_as_nan(tmp_path):
    messages = [('/tensions', 0.0, bags.array(1.0, 2.0)), ('/tensions', 0.1, bags.array(1.0))]
    recording = load_recording(write_bag(tmp_path / 'bag', messages))
    assert len(recording) == 2
    assert math.isnan(recording.tension_l[1])
    assert recording.damage == ()


@pytest.mark.parametrize(
    ('topics', 'named'),
    [
        (BagTopics(tensions=('t',)), r'no topic /t; there are: /measured_bend_angle \(std_msgs'),
        (BagTopics(bend_angle='b'), 'no topic /b'),
        (BagTopics(tensions=('measured_bend_angle',)), 'is a std_msgs/msg/Float64; .* is needed'),
        (BagTopics(tensions=('tensions', 'measured_bend_angle')), 'WrenchStamped is needed'),
    ],
)
def test_a_topic_that_is_not_there_is_named_with_those_that_are(tmp_path, topics, named):
    file = write_bag(tmp_path / 'bag', session())
    with pytest.raises(RecordingError, match=f'^{file}: .*{named}'):
        load_recording(file, topics)


@pytest.mark.parametrize(
    ('given', 'named'),
    [
        ({'tensions': ()}, '0 names of a topic of tensions are given, not 1 or 2'),
        ({'tensions': ('a', 'b', 'c')}, '3 names of a topic of tensions'),
        ({'tensions': ('a', '/a')}, 'topic of tensions is given twice: a'),
        ({'tensions': ('a', '')}, 'topic of tensions is empty'),
        ({'cable_names': ('a',)}, '1 names of a cable are given, not 2'),
        ({'cable_names': ('a', 'b', 'c')}, '3 names of a cable'),
        ({'cable_names': ('a', 'a')}, 'a cable is given twice: a'),
        ({'bend_angle': ''}, 'name of a topic is empty'),
        ({'force_component': 'w'}, "is 'w'; there are x, y, z, norm"),
        ({'max_skew': math.nan}, 'largest skew is nan s'),
        ({'max_skew': -0.01}, 'largest skew is -0.01 s'),
        ({'max_skew': math.inf}, 'largest skew is inf s'),
    ],
)
def test_what_no_bag_can_hold_is_refused_before_one_is_read(given, named):
    with pytest.raises(RecordingError, match=named):
        BagTopics(**given)


def test_options_that_no_bag_can_meet_are_refused_in_one_line():
    assert_refused(run('replay', 'missing.mcap', '--tensions-topic', ''), '0 names')
    assert_refused(run('replay', 'missing.mcap', '--max-skew', 'nan'), 'skew is nan')


def test_a_skew_may_be_as_large_as_one_likes(tmp_path):
    file = write_bag(tmp_path / 'bag', session())
    assert np.isfinite(load_recording(file, BagTopics(max_skew=1e308)).bend_angle).all()


NAMELESS = bags.joint_state([], position=[0.3], effort=[1.0, 2.0])


@pytest.mark.parametrize(
    ('message', 'named'),
    [
        (bags.array(1.0, 2.0, 3.0), '/t hold 3 numbers; two are needed'),
        (bags.joint_state(['a', 'cable_s'], effort=[1.0, 2.0]), 'that of: a, cable_s$'),
        (bags.joint_state(['cable_l', 'cable_s'], position=[1.0, 2.0]), 'that of: none$'),
        (NAMELESS, 'the effort of cable_l and cable_s; there is that of: none$'),
    ],
)
def test_tensions_that_are_in_no_message_are_refused_with_what_there_is(tmp_path, message, named):
    file = write_bag(tmp_path / 'bag', [('/t', 0.0, message), ('/t', 0.1, message)])
    with pytest.raises(RecordingError, match=named):
        load_recording(file, BagTopics(('t',)))


@pytest.mark.parametrize(
    ('message', 'joint', 'named'),
    [
        (bags.joint_state(['a'], position=[1.0]), 'tip', 'position of tip; there is that of: a$'),
        (bags.joint_state(['a'], effort=[1.0]), None, 'position of a; there is that of: none$'),
        (NAMELESS, None, 'position of a joint; there is that of: none$'),
    ],
)
def test_an_angle_that_is_in_no_message_is_refused_with_what_there_is(
    tmp_path, message, joint, named
):
    file = write_bag(tmp_path / 'bag', [*session(2), ('/camera', 0.0, message)])
    with pytest.raises(RecordingError, match=named):
        load_recording(file, BagTopics(bend_angle='camera', joint_name=joint))


def test_a_pair_of_which_one_topic_is_empty_is_refused(tmp_path):
    messages = [('/l', 0.0, bags.wrench(0.0, 0.0, 1.0, 0.0)), ('/s', 0.0, bags.text(''))]
    file = write_bag(tmp_path / 'bag', messages, 'SQLITE3')
    with sqlite3.connect(file) as connection:
        kind = "SELECT type FROM topics WHERE name = '/l'"
        connection.execute(f"UPDATE topics SET type = ({kind}) WHERE name = '/s'")
        connection.execute('DELETE FROM messages WHERE id = 2')
    connection.close()
    with pytest.raises(RecordingError, match=r'there is no message on /s$'):
        load_recording(file, BagTopics(('l', 's')))


@pytest.fixture(scope='module')
def long_bag(tmp_path_factory):
    """Gives a file of the kind asked for, written once, and what is in it."""

    @functools.cache
    def written(plugin):
        file = write_bag(tmp_path_factory.mktemp('long') / 'bag', session(15000), plugin)
        return file, load_recording(file)

    return written


@pytest.mark.parametrize(
    ('plugin', 'share'),
    [('MCAP', 0.75), ('MCAP', 0.99), ('MCAP', 0.9999), ('SQLITE3', 0.97)],
)
def test_of_a_truncated_file_the_beginning_is_read(tmp_path, long_bag, plugin, share):
    file, whole = long_bag(plugin)
    content = file.read_bytes()
    beginning = tmp_path / file.name
    beginning.write_bytes(content[: int(share * len(content))])
    recording = load_recording(beginning)
    assert 0.3 * len(whole) < len(recording) <= len(whole)
    assert set(recording.tensions()) <= set(whole.tensions())
    assert 'truncated or damaged' in recording.damage_summary


@pytest.fixture
def chunks(tmp_path):
    """An MCAP file of 500 messages, and the index of its chunks."""
    from mcap.reader import make_reader
    from mcap.writer import Writer

    file = tmp_path / 'run.mcap'
    with file.open('wb') as stream:
        writer = Writer(stream, chunk_size=2000)
        writer.start(profile='ros2')
        kind = 'std_msgs/msg/Float64MultiArray'
        definition, _ = bags.STORE.generate_msgdef(kind, ros_version=2)
        schema = writer.register_schema(kind, 'ros2msg', definition.encode())
        channel = writer.register_channel('/tensions', 'cdr', schema)
        for index in range(500):
            data = bytes(bags.STORE.serialize_cdr(bags.array(1.0, float(index)), kind))
            writer.add_message(channel, ORIGIN + index, data, ORIGIN + index)
        writer.finish()
    with file.open('rb') as stream:
        return file, make_reader(stream).get_summary().chunk_indexes


def flip(file, *places):
    content = bytearray(file.read_bytes())
    for place in places:
        content[place] ^= 0xFF
    file.write_bytes(content)


@pytest.mark.parametrize('chunk', [0, 1, -1])
@pytest.mark.parametrize('byte', [0, 4, 100], ids=['kind', 'length', 'content'])
def test_a_damaged_chunk_is_named_and_all_others_are_read(chunks, chunk, byte):
    file, index = chunks
    start = index[chunk].chunk_start_offset
    flip(file, start + byte)
    recording = load_recording(file)
    lost = set(range(500)) - set(recording.tension_s)
    assert 0 < len(lost) < 40
    assert len(recording) + len(lost) == 500
    (damage,) = recording.damage
    assert damage.startswith(f'a part at byte {start} cannot be read (')


@pytest.mark.parametrize('place', ['magic', 'header', 'index', 'footer', 'last magic'])
def test_damage_outside_the_chunks_costs_no_message(chunks, place):
    file, index = chunks
    end = index[3].chunk_start_offset + index[3].chunk_length
    flip(
        file, {'magic': 0, 'header': 10, 'index': end + 1, 'footer': -30, 'last magic': -1}[place]
    )
    assert load_recording(file).tension_s.tolist() == list(range(500))


def test_a_damaged_summary_is_named_and_not_believed(chunks):
    file, _ = chunks
    content = file.read_bytes()
    flip(file, content.rindex(b'/tensions'))
    recording = load_recording(file)
    assert len(recording) == 500
    assert recording.damage == ('its end, the summary, is truncated or damaged',)


def test_without_summary_and_first_chunk_nothing_says_what_the_topics_are(chunks):
    file, index = chunks
    flip(file, index[0].chunk_start_offset + 100, -30)
    with pytest.raises(RecordingError, match='no topic /tensions; there are: none; a part at'):
        load_recording(file)


def test_messages_that_are_not_where_the_summary_counts_them_are_missed(tmp_path):
    file = tmp_path / 'run.mcap'
    from mcap.writer import Writer

    with file.open('wb') as stream:
        writer = Writer(stream, use_chunking=False)
        writer.start()
        kind = 'std_msgs/msg/Float64MultiArray'
        schema = writer.register_schema(kind, 'ros2msg', b'')
        channel = writer.register_channel('/tensions', 'cdr', schema)
        data = bytes(bags.STORE.serialize_cdr(bags.array(1.0, 2.0), kind))
        for time in (7, 8, 2**63):
            message = stream.tell()
            writer.add_message(channel, time, data, time)
        writer.finish()
    recording = load_recording(file)
    assert len(recording) == 2
    assert recording.damage == ('1 messages on /tensions cannot be read',)
    flip(file, 0, message)
    assert load_recording(file).damage == ('1 messages are missing that its summary counts',)


@pytest.fixture
def database(tmp_path):
    return write_bag(tmp_path / 'bag', session(), 'SQLITE3')


@pytest.mark.parametrize(
    ('change', 'damage'),
    [
        ("timestamp = 'x'", '1 messages on /tensions cannot be read'),
        ('timestamp = 1e300', '1 messages on /tensions cannot be read'),
        ('timestamp = -9223372036854775808', '1 messages on /tensions cannot be read'),
        ("data = x'00'", '1 messages on /tensions cannot be read'),
        ("data = 'x'", '1 messages on /tensions cannot be read'),
        ('data = 7', '1 messages on /tensions cannot be read'),
        ('data = zeroblob(length(data))', '1 messages on /tensions cannot be read'),
        ("data = x'ffff' || substr(data, 3)", '1 messages on /tensions cannot be read'),
        ('data = substr(data, 1, length(data) - 8)', '1 messages on /tensions cannot be read'),
        ("topic_id = 'x'", '1 messages are of topics that it does not define'),
        ('topic_id = 99', '1 messages are of topics that it does not define'),
    ],
)
def test_a_row_that_is_no_message_is_counted_and_the_others_are_read(database, change, damage):
    with sqlite3.connect(database) as connection:
        connection.execute(f'UPDATE messages SET {change} WHERE id = 1')
    connection.close()
    recording = load_recording(database)
    assert recording.tension_s == pytest.approx(1.51 + 0.01 * np.arange(9))
    assert recording.damage == (damage,)


@pytest.mark.parametrize('name', ["x'ff'", 'NULL', '7'])
def test_a_topic_without_a_name_leaves_the_others(database, name):
    with sqlite3.connect(database) as connection:
        connection.execute('PRAGMA writable_schema = ON')
        connection.execute("UPDATE sqlite_master SET sql = replace(sql, 'NOT NULL', '')")
    connection.close()
    with sqlite3.connect(database) as connection:
        angle = "name = '/measured_bend_angle'"
        connection.execute(f'UPDATE topics SET name = {name}, type = {name} WHERE {angle}')
    connection.close()
    recording = load_recording(database)
    assert len(recording) == 10
    assert recording.bend_angle is None


def test_rows_that_are_missing_from_a_table_are_missed(database):
    """Damage within a page can hide rows, but they still stand in the index of times."""
    with sqlite3.connect(database) as connection:
        connection.execute('PRAGMA writable_schema = ON')
        connection.execute("DELETE FROM sqlite_master WHERE type = 'index'")
    connection.close()
    with sqlite3.connect(database) as connection:
        connection.execute('DELETE FROM messages WHERE id = 4')
    connection.close()
    assert 'messages may be missing' in load_recording(database).damage_summary


@pytest.fixture
def unfinished(tmp_path, database):
    """The folder of a bag whose last messages are in SQLite's log only."""
    folder = tmp_path / 'unfinished'
    folder.mkdir()
    connection = sqlite3.connect(database)
    connection.execute('PRAGMA journal_mode = WAL')
    for _ in range(3):
        connection.execute(
            'INSERT INTO messages (topic_id, timestamp, data) '
            'SELECT topic_id, timestamp + 1000000000, data FROM messages WHERE id = 1'
        )
        connection.commit()
    for ending in ('', '-wal'):
        shutil.copyfile(f'{database}{ending}', folder / f'run.db3{ending}')
    connection.close()
    return folder


@pytest.mark.parametrize('mode', [0o755, 0o555])
def test_what_is_in_the_log_of_a_database_is_read_and_left_alone(unfinished, mode):
    before = {file.name: file.read_bytes() for file in unfinished.iterdir()}
    unfinished.chmod(mode)
    recording = load_recording(unfinished / 'run.db3')
    unfinished.chmod(0o755)
    assert len(recording) == 13
    assert recording.damage == ()
    assert {file.name: file.read_bytes() for file in unfinished.iterdir()} == before


@pytest.mark.parametrize(('place', 'kept'), [(-100, 12), (10, 10), (20, 10), (32 + 24, 10)])
def test_damage_in_the_log_of_a_database_is_named(unfinished, place, kept):
    flip(unfinished / 'run.db3-wal', place)
    recording = load_recording(unfinished)
    assert len(recording) == kept
    assert 'pages of its -wal are damaged' in recording.damage_summary


def test_what_a_recorder_did_not_finish_is_undone_and_named(tmp_path, database):
    copy = tmp_path / 'run.db3'
    connection = sqlite3.connect(database)
    connection.execute('PRAGMA cache_size = 1')
    connection.execute('BEGIN')
    for key in range(100, 2000):
        connection.execute(
            'INSERT INTO messages SELECT ?, topic_id, timestamp, data FROM messages WHERE id = 1',
            [key],
        )
    for ending in ('', '-journal'):
        shutil.copyfile(f'{database}{ending}', f'{copy}{ending}')
    connection.close()
    assert copy.stat().st_size > 50_000
    recording = load_recording(copy)
    assert len(recording) == 10
    (damage,) = recording.damage
    assert damage.startswith('what was written last is left out')


def test_in_a_folder_a_file_that_is_no_bag_is_named_and_the_others_are_read(tmp_path):
    file = write_bag(tmp_path / 'bag', session())
    (file.parent / 'other.mcap').write_bytes(b'')
    (file.parent / 'metadata.yaml').unlink()
    recording = load_recording(file.parent)
    assert len(recording) == 10
    assert recording.damage == ('other.mcap: it is not an MCAP file',)


@pytest.mark.parametrize('ending', ['mcap', 'db3'])
def test_what_is_no_bag_is_named(tmp_path, ending):
    (tmp_path / 'folder').mkdir()
    file = tmp_path / f'run.{ending}'
    for content in (b'', b'\x89MCAP0', b'no bag'):
        file.write_bytes(content)
        with pytest.raises(RecordingError, match=f'^{file}: '):
            load_recording(file)
    with pytest.raises(RecordingError, match='missing'):
        load_recording(tmp_path / f'missing.{ending}')
    with pytest.raises(RecordingError, match='so no bag'):
        load_recording(tmp_path / 'folder')


def test_a_library_that_is_missing_is_named_with_what_to_install(tmp_path, monkeypatch):
    import sys

    file = write_bag(tmp_path / 'bag', session())
    monkeypatch.setitem(sys.modules, 'mcap.stream_reader', None)
    with pytest.raises(RecordingError, match='ROS bags need mcap: pip install mcap'):
        load_recording(file)


def test_a_library_that_does_not_fit_is_named_with_its_own_reason(tmp_path, monkeypatch):
    from tendon_statics.recordings import libraries

    def refuse(_module):
        raise ImportError('it needs\nanother version')

    file = write_bag(tmp_path / 'bag', session())
    monkeypatch.setattr(libraries, 'import_module', refuse)
    with pytest.raises(RecordingError, match='cannot be loaded: it needs another version'):
        load_recording(file)
