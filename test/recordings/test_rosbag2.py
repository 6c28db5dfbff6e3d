"""Bags through ROS's own library, where it is: as much as the pure ones read, and without them."""

import re
import sys

import bags
import numpy as np
import pytest
import stand_in_rosbag2
from bags import write_bag

from tendon_statics import BagTopics, RecordingError, load_recording
from tendon_statics.files.installed_files import installed_config

ARRAY = 'std_msgs/msg/Float64MultiArray'
SESSION = installed_config('recorded_session.mcap')
PURE = ('mcap', 'mcap.stream_reader', 'mcap.records', 'rosbags', 'rosbags.typesys')


@pytest.fixture
def rosbag2(monkeypatch):
    """Make `rosbag2_py` be there; the stand-in says what of the real one is used."""
    monkeypatch.setitem(sys.modules, 'rosbag2_py', stand_in_rosbag2)
    for library in PURE:
        monkeypatch.setitem(sys.modules, library, None)
    return monkeypatch


@pytest.fixture
def both(rosbag2):
    """Make the pure libraries be there too."""
    for library in PURE:
        rosbag2.delitem(sys.modules, library)
    return rosbag2


def read(path):
    recording = load_recording(path).whole()
    return {
        name: repr(np.asarray(getattr(recording, name)).tolist())  # since NaN is not NaN
        for name in ('tension_l', 'tension_s', 'bend_angle', 'pressure', 'state', 'time')
    }


KINDS = {
    'an array': lambda k: [('/tensions', bags.array(1.0, 2.0 + k))],
    'joint states': lambda k: [
        ('/tensions', bags.joint_state(['cable_l', 'cable_s'], [1.0, 2.0 + k], time=0.1 * k))
    ],
    'load cells': lambda k: [
        ('/tension_l', bags.wrench(0.0, 0.0, 1.0, 0.1 * k)),
        ('/tension_s', bags.wrench(0.0, 0.0, 2.0 + k, 0.1 * k)),
    ],
    'estimates': lambda k: [('/tensions', bags.estimate(1.0, 2.0 + k, 0.1 * k))],
}


@pytest.fixture(params=['session', *KINDS])
def bag(request, tmp_path):
    """A bag, and what the pure libraries read of it."""
    if request.param == 'session':
        return SESSION, read(SESSION)
    messages = [
        (topic, 0.1 * k, message) for k in range(5) for topic, message in KINDS[request.param](k)
    ]
    path = write_bag(tmp_path / 'bag', messages)
    return path, read(path)


@pytest.mark.usefixtures('rosbag2')
def test_it_gives_what_the_pure_libraries_give_and_needs_none_of_them(bag):
    path, expected = bag
    assert expected['tension_l'].count(',') >= 4
    assert read(path) == expected


@pytest.mark.parametrize(
    ('damaged', 'why'),
    [
        (lambda content: content[:-3000], 'its end is missing'),
        (lambda content: content[:-3000] + bytes(3000), 'its end is missing'),
        (lambda content: b'X' + content[1:], 'rosbag2 refuses it'),
    ],
    ids=['cut', 'zeros', 'its beginning'],
)
def test_a_damaged_file_is_read_by_the_pure_libraries_as_far_as_it_goes(
    tmp_path, rosbag2, damaged, why
):
    """Of a file that was cut rosbag2 may read the beginning, and say nothing."""
    path = tmp_path / 'torn.mcap'
    path.write_bytes(damaged(SESSION.read_bytes()))
    with pytest.raises(RecordingError, match=rf'{why}.*pip install mcap rosbags'):
        load_recording(path)
    for library in PURE:
        rosbag2.delitem(sys.modules, library)
    recording = load_recording(path)
    assert bool(recording.damage) == (why == 'its end is missing')
    assert len(recording) > 10


@pytest.mark.usefixtures('rosbag2')
def test_what_rosbag2_passes_over_in_silence_is_said(tmp_path):
    content = bytearray(SESSION.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path = tmp_path / 'flipped.mcap'
    path.write_bytes(content)
    recording = load_recording(path)
    assert re.search(r'\d+ messages are missing that its summary counts', recording.damage[0])


def write_mcap(path, messages, encoding='cdr', kind=ARRAY, store=bags.STORE, type_hash=''):
    """Write messages as (log time, content), by a library that leaves all to the caller."""
    from mcap.writer import Writer

    definition, _ = store.generate_msgdef(kind, ros_version=2)
    with path.open('wb') as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema(kind, 'ros2msg', definition.encode())
        metadata = {'topic_type_hash': type_hash}  # where rosbag2 writes it
        channel = writer.register_channel('/tensions', encoding, schema, metadata)
        for time, content in messages:
            writer.add_message(channel, time, content, time)
        writer.finish()
    return path


def cdr(*tensions):
    return bytes(bags.STORE.serialize_cdr(bags.array(*tensions), ARRAY))


def test_messages_come_in_the_order_of_the_file_as_from_the_pure_libraries(tmp_path, monkeypatch):
    path = write_mcap(
        tmp_path / 'merged.mcap', [(3, cdr(1.0, 2.0)), (2, cdr(2.0, 2.0)), (1, cdr(3.0, 2.0))]
    )
    expected = read(path)
    monkeypatch.setitem(sys.modules, 'rosbag2_py', stand_in_rosbag2)
    assert read(path) == expected


@pytest.mark.usefixtures('both')
def test_messages_in_another_encoding_are_left_to_the_pure_libraries(tmp_path):
    content = bags.STORE.serialize_ros1(bags.array(1.0, 2.0), ARRAY)
    path = write_mcap(tmp_path / 'of_ros1.mcap', [(1, bytes(content))], 'ros1')
    assert load_recording(path).tensions() == [(1.0, 2.0)]


@pytest.mark.usefixtures('both')
def test_a_topic_of_two_types_is_left_to_the_pure_libraries(tmp_path):
    from rosbags.rosbag2 import StoragePlugin, Writer

    state = bags.joint_state(['cable_l', 'cable_s'], [3.0, 4.0], time=0.1)
    with Writer(tmp_path / 'bag', version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        for message in (bags.array(1.0, 2.0), state):
            kind = message.__msgtype__
            connection = writer.add_connection('/tensions', kind, typestore=bags.STORE)
            writer.write(connection, bags.ORIGIN, bags.STORE.serialize_cdr(message, kind))
    topics = BagTopics(tension_source='joint_state')
    assert load_recording(tmp_path / 'bag', topics).tensions() == [(3.0, 4.0)]


@pytest.fixture(params=['mcap', 'db3'])
def later_version(request, tmp_path):
    """A bag with an ``Estimate`` of other fields; ROS would take them for the tensions."""
    from rosbags.rosbag2 import Writer
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    fields = ('std_msgs/Header header', 'float64 more', 'float64 tension_l', 'float64 tension_s')
    store.register(get_types_from_msg('\n'.join(fields), bags.ESTIMATE))
    message = store.types[bags.ESTIMATE](bags.header(0.1), more=9.0, tension_l=1.0, tension_s=2.0)
    content = bytes(store.serialize_cdr(message, bags.ESTIMATE))
    if request.param == 'mcap':
        type_hash = store.hash_rihs01(bags.ESTIMATE)
        messages = [(bags.ORIGIN, content)]
        return write_mcap(tmp_path / 'a.mcap', messages, 'cdr', bags.ESTIMATE, store, type_hash)
    with Writer(tmp_path / 'bag', version=9) as writer:
        connection = writer.add_connection('/tensions', bags.ESTIMATE, typestore=store)
        writer.write(connection, bags.ORIGIN, content)
    return tmp_path / 'bag'


def test_a_type_of_another_version_is_left_to_the_definition_in_the_bag(both, later_version):
    assert load_recording(later_version).tensions() == [(1.0, 2.0)]
    for library in PURE:
        both.setitem(sys.modules, library, None)
    with pytest.raises(RecordingError, match='pip install rosbags'):
        load_recording(later_version)


def test_a_rosbag2_that_was_made_for_another_python_is_no_hindrance(tmp_path, monkeypatch):
    expected = read(SESSION)
    (tmp_path / 'rosbag2_py.py').write_text("raise ImportError('made for another Python')\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, 'rosbag2_py', raising=False)
    assert read(SESSION) == expected
