"""Files that a disk or a recorder did not finish: only what was recorded comes out of them."""

import functools
import io
import sqlite3

import bags
import numpy as np
import pytest
from bags import ORIGIN, STORE, write_bag

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading import sqlite_file
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.topics import BagTopics

PAGE = 4096
"""Bytes of a page, as SQLite makes them"""

ARRAY = 'std_msgs/msg/Float64MultiArray'


@pytest.fixture(params=['sqlite3', 'pysqlite3'])
def sqlite(request, monkeypatch):
    """The SQLite of this Python, and a newer one."""
    library = pytest.importorskip(request.param)
    monkeypatch.setattr(sqlite_file, 'sqlite3', library)
    return library


def arrays(count=500):
    for index in range(count):
        yield '/tensions', 0.01 * index, bags.array(1.0, 1.5 + 0.01 * index)


def of_two_topics(count=300):
    for index in range(count):
        yield '/tension_l', 0.01 * index, bags.number(1.0)
        yield '/tension_s', 0.01 * index, bags.number(1.5 + 0.01 * index)


def of_many_joints(count=40):
    """A message takes more than a page, and tensions are at its end."""
    names = [f'joint_{number}' for number in range(200)] + ['cable_l', 'cable_s']
    for index in range(count):
        efforts = [*range(200), 1.0, 1.5 + 0.01 * index]
        message = bags.joint_state(names, effort=efforts, time=0.01 * index)
        yield '/tensions', 0.01 * index, message


@pytest.mark.usefixtures('sqlite')
@pytest.mark.parametrize('zeros', [False, True], ids=['is missing', 'is zeros'])
@pytest.mark.parametrize('messages', [arrays, of_two_topics, of_many_joints])
def test_what_is_missing_of_a_database_does_not_come_out_as_zeros(tmp_path, messages, zeros):
    """Cut at any byte, or filled with zeros from there on, as a disk that lost power does."""
    file = write_bag(tmp_path / 'bag', messages(), 'SQLITE3')
    recorded = set(load_recording(file).whole().tensions())
    content = file.read_bytes()
    end = len(content.rstrip(b'\0'))
    if messages is of_many_joints:  # the last of which may well end in a page with zeros
        end -= PAGE
    read = 0
    for size in range(end - 6 * PAGE, end, 587):
        filled = bytes(len(content) - size) if zeros else b''
        file.write_bytes(content[:size] + filled)
        recording = load_recording(file)
        there = {pair for pair in recording.tensions() if not np.isnan(pair).any()}
        assert there <= recorded, size
        assert recording.damage, size
        read = max(read, len(there))
    assert read > 0.5 * len(recorded)


@pytest.mark.usefixtures('sqlite')
@pytest.mark.parametrize('messages', [arrays, of_many_joints])
def test_a_page_in_the_middle_that_was_not_written_is_no_data(tmp_path, messages):
    file = write_bag(tmp_path / 'bag', messages(), 'SQLITE3')
    recorded = set(load_recording(file).tensions())
    content = file.read_bytes()
    places = range(0, len(content), PAGE)
    of_rows = [
        place for place in places if b'\0\1\0\0\0' in content[place + PAGE - 100 : place + PAGE]
    ]
    for place in of_rows[1:-1] or [len(content) // PAGE // 2 * PAGE]:
        file.write_bytes(content[:place] + bytes(PAGE) + content[place + PAGE :])
        recording = load_recording(file)
        assert set(recording.tensions()) <= recorded
        assert recording.damage


@pytest.mark.usefixtures('sqlite')
def test_zeros_that_were_recorded_are_data(tmp_path):
    """Of cables without tension, in messages which end in zeros as pages do."""
    messages = [('/tensions', 0.01 * index, bags.array(0.0, 0.0)) for index in range(300)]
    messages += [('/cell_l', 9.0, bags.wrench(0.0, 0.0, 0.0, 9.0))]
    recording = load_recording(write_bag(tmp_path / 'bag', messages, 'SQLITE3')).whole()
    assert recording.tensions() == [(0.0, 0.0)] * 300


@functools.cache
def mcap(*, chunked=True, compression='NONE', sums=True, count=500, beside=0):
    """Return a file of one chunk, or of none; so many numbers of another topic go with a pair."""
    from mcap.writer import CompressionType, Writer

    rng = np.random.default_rng(7)
    stream = io.BytesIO()
    writer = Writer(
        stream,
        chunk_size=1 << 24,
        compression=CompressionType[compression],
        use_chunking=chunked,
        enable_crcs=sums,
    )
    writer.start(profile='ros2')
    definition, _ = STORE.generate_msgdef(ARRAY, ros_version=2)
    schema = writer.register_schema(ARRAY, 'ros2msg', definition.encode())
    tensions, other = (
        writer.register_channel(topic, 'cdr', schema) for topic in ('/tensions', '/other')
    )
    for index in range(count):
        messages = [(tensions, bags.array(1.0 + rng.random(), 0.25 * index))]  # most end in zeros
        if beside:
            messages.append((other, bags.array(*rng.random(beside))))
        for channel, message in messages:
            data = bytes(STORE.serialize_cdr(message, ARRAY))
            writer.add_message(channel, ORIGIN + index, data, ORIGIN + index)
    writer.finish()
    return stream.getvalue()


COMPRESSED = {'count': 1000, 'beside': 125}
"""A megabyte, in blocks of 64 or 128 kB"""
KINDS = {
    'one chunk': {},
    'one chunk without sums': {'sums': False},
    'one chunk by zstd': {'compression': 'ZSTD', **COMPRESSED},
    'one chunk by lz4': {'compression': 'LZ4', **COMPRESSED},
    'no chunks': {'chunked': False},
}


@pytest.mark.parametrize('zeros', [False, True], ids=['is missing', 'is zeros'])
@pytest.mark.parametrize('kind', KINDS)
def test_of_a_file_of_one_chunk_that_was_cut_the_beginning_is_read(tmp_path, kind, zeros):
    file = tmp_path / 'run.mcap'
    content = mcap(**KINDS[kind])
    file.write_bytes(content)
    recorded = load_recording(file).whole().tensions()
    before = 0
    for share in np.arange(0.45, 0.999, 0.073):
        size = int(share * len(content))
        filled = bytes(len(content) - size) if zeros else b''
        file.write_bytes(content[:size] + filled)
        recording = load_recording(file)
        assert recording.tensions() == recorded[: len(recording)]
        assert len(recording) >= before
        assert recording.damage
        before = len(recording)
        if 'compression' not in KINDS[kind]:  # which can be undone block by block only
            assert len(recording) > 0.95 * share * len(recorded)
    assert before > 0.9 * len(recorded)


def test_how_much_of_a_cut_chunk_is_read_is_said(tmp_path):
    file = tmp_path / 'run.mcap'
    content = mcap()
    file.write_bytes(content[: len(content) // 2])
    recording = load_recording(file)
    (damage,) = recording.damage
    assert f'cut short or damaged: the first {len(recording)} messages of it' in damage
    assert len(recording) > 200


def test_a_hole_in_a_chunk_without_a_sum_is_named_and_is_no_data(tmp_path):
    file = tmp_path / 'run.mcap'
    content = mcap(sums=False)
    file.write_bytes(content)
    recorded = load_recording(file).tensions()
    for size in range(5000, 5100, 7):
        file.write_bytes(content[:size] + bytes(512) + content[size + 512 :])
        recording = load_recording(file)
        assert recording.tensions() == recorded[: len(recording)]
        assert recording.damage


def test_of_a_chunk_that_was_cut_before_its_first_message_nothing_is_made_up(tmp_path):
    file = tmp_path / 'run.mcap'
    content = mcap()
    for size in (60, 70, 80, 200):
        file.write_bytes(content[:size])
        with pytest.raises(RecordingError, match=r'no topic /tensions|there is no message'):
            load_recording(file)


def test_a_text_that_was_cut_is_no_text(tmp_path):
    messages = [('/tensions', 0.0, bags.array(1.0, 2.0)), ('/state', 0.0, bags.text('slipping'))]
    file = write_bag(tmp_path / 'bag', messages, 'SQLITE3')
    with sqlite3.connect(file) as database:
        database.execute(
            'UPDATE messages SET data = substr(data, 1, length(data) - 4) WHERE id = 2'
        )
    database.close()
    recording = load_recording(file, BagTopics(state='/state'))
    assert recording.state == ['']
    assert recording.damage == ('1 messages on /state cannot be read',)
