"""Tensions in a bag: by whatever types, names and topics drivers publish them."""

import math
from collections import Counter

import bags
import numpy as np
import pytest
from bags import STORE, write_bag
from designs import PRELIMINARY
from programs import assert_refused, run
from rosbags.typesys import get_types_from_msg

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording
from tendon_statics.recordings.reading.topics import BagTopics
from tendon_statics.recordings.replay.estimates import replay

DYNAMIC = 'control_msgs/msg/DynamicJointState'
STORE.register(
    {
        **get_types_from_msg(
            'string[] interface_names\nfloat64[] values\n', 'control_msgs/msg/InterfaceValue'
        ),
        **get_types_from_msg(
            'std_msgs/Header header\nstring[] joint_names\nInterfaceValue[] interface_values\n',
            DYNAMIC,
        ),
    }
)
CABLES = ['cable_l', 'cable_s']


def dynamic(names, interfaces, time=None):
    value = STORE.types['control_msgs/msg/InterfaceValue']
    return STORE.types[DYNAMIC](
        bags.header(time),
        names,
        [value(list(held), np.array(list(held.values()), dtype=float)) for held in interfaces],
    )


def single(kind, value):
    if kind == 'geometry_msgs/msg/Wrench':
        return bags.wrench(0.0, 0.0, value, 0.0).wrench
    return STORE.types[kind](data=value)


def write(tmp_path, *messages):
    return write_bag(tmp_path / 'bag', messages)


def test_one_cable_a_message_is_joined_with_the_other(tmp_path):
    messages = []
    for index in range(50):
        time = 0.01 * index
        for cable, effort, delay in (('cable_l', 1.0, 0.0), ('cable_s', 2.0 + index, 0.001)):
            message = bags.joint_state([cable], effort=[effort], time=time)
            messages.append(('/tensions', time + delay, message))
    recording = load_recording(write(tmp_path, *messages))
    assert recording.tensions() == [(1.0, 2.0 + index) for index in range(50)]
    assert recording.time == pytest.approx(0.01 * np.arange(50))
    assert set(recording.faults) == {''}
    recording = load_recording(write_bag(tmp_path / 'lost', messages[:7] + messages[8:]))
    assert len(recording) == 50
    assert recording.faults.count('unpaired') == 1
    assert recording.tensions()[4:6] == [(1.0, 6.0), (1.0, 7.0)]


def test_messages_about_other_joints_are_passed_over_whatever_is_wrong_with_them(tmp_path):
    messages = []
    for index in range(20):
        time = 0.01 * index
        messages += [
            ('/tensions', time, bags.joint_state(CABLES, effort=[1.0, 2.0], time=time)),
            ('/tensions', time, bags.joint_state(['wheel', 'grip'], time=time)),
            ('/tensions', time, bags.joint_state(['wheel'], effort=[9.0, 9.0], time=-5.0)),
        ]
    recording = load_recording(write(tmp_path, *messages))
    assert recording.tensions() == [(1.0, 2.0)] * 20
    assert recording.notes == ()


def test_fewer_efforts_than_names_are_of_wrong_length(tmp_path):
    file = write(
        tmp_path,
        ('/tensions', 0.0, bags.joint_state([*CABLES, 'wheel'], effort=[1.0, 2.0], time=0.0)),
        ('/tensions', 0.1, bags.joint_state(CABLES, effort=[1.0, 1.5], time=0.1)),
    )
    recording = load_recording(file)
    assert recording.faults == ['wrong length', '']
    assert np.isnan(recording.tension_l).tolist() == [True, False]
    assert 'invalid       wrong length 1\n' in run('replay', file).stdout


@pytest.mark.parametrize(
    ('names', 'efforts'),
    [(['cable_l', 'cable_l', 'cable_s'], [1.0, 3.0, 2.0]), (CABLES, [1.0, 2.0, 3.0])],
)
def test_whose_an_effort_is_is_not_guessed(tmp_path, names, efforts):
    file = write(
        tmp_path,
        ('/tensions', 0.0, bags.joint_state(names, effort=efforts, time=0.0)),
        ('/tensions', 0.1, bags.joint_state(CABLES, effort=[1.0, 1.5], time=0.1)),
    )
    assert load_recording(file).faults == ['wrong length', '']


def test_a_dynamic_joint_state_whose_parts_do_not_fit_is_of_wrong_length(tmp_path):
    held = [{'effort': 1.0}, {'effort': 2.0}]
    short = dynamic(CABLES, held[:1], 0.0)
    odd = dynamic(CABLES, held, 0.1)
    odd.interface_values[0].values = np.array([1.0, 2.0])
    file = write(
        tmp_path,
        ('/tensions', 0.0, short),
        ('/tensions', 0.1, odd),
        ('/tensions', 0.2, dynamic(CABLES, held, 0.2)),
    )
    assert load_recording(file).faults == ['wrong length', 'wrong length', '']


@pytest.mark.parametrize('encoding', ['ros1', 'json'])
def test_an_mcap_file_with_messages_of_ros_1_is_read_and_other_encodings_are_named(
    tmp_path, encoding
):
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    kind = 'std_msgs/msg/Float64MultiArray'
    layout = store.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
    data = store.serialize_ros1(store.types[kind](layout=layout, data=np.array([1.0, 2.0])), kind)
    file = tmp_path / 'run.mcap'
    with file.open('wb') as stream:
        writer = Writer(stream)
        writer.start(profile='ros1')
        definition, _ = store.generate_msgdef(kind, ros_version=1)
        schema = writer.register_schema(
            'std_msgs/Float64MultiArray', 'ros1msg', definition.encode()
        )
        channel = writer.register_channel('/tensions', encoding, schema)
        writer.add_message(channel, 5, bytes(data), 5)
        writer.finish()
    if encoding == 'ros1':
        assert load_recording(file).whole().tensions() == [(1.0, 2.0)]
        return
    with pytest.raises(RecordingError, match='1 messages on /tensions cannot be read'):
        load_recording(file)


def test_a_type_that_the_units_file_does_not_mean_is_refused_with_the_way_out(tmp_path):
    file = write(tmp_path, ('/tensions', 0.0, bags.joint_state(CABLES, effort=[1.0, 2.0])))
    with pytest.raises(
        RecordingError, match=r'as the tension source is array \(--tension-source\)'
    ):
        load_recording(file, BagTopics(tension_source='array'))


@pytest.mark.parametrize('slash', ['', '/'])
def test_a_topic_is_found_with_and_without_its_slash(tmp_path, slash):
    from mcap.writer import Writer

    file = tmp_path / 'run.mcap'
    kind = 'std_msgs/msg/Float64MultiArray'
    with file.open('wb') as stream:
        writer = Writer(stream)
        writer.start()
        definition, _ = STORE.generate_msgdef(kind, ros_version=2)
        schema = writer.register_schema(kind, 'ros2msg', definition.encode())
        channel = writer.register_channel(f'{slash}tensions', 'cdr', schema)
        writer.add_message(channel, 5, bytes(STORE.serialize_cdr(bags.array(1.0, 2.0), kind)), 5)
        writer.finish()
    for topics in (BagTopics(), BagTopics(('tensions',)), BagTopics(('/tensions',))):
        assert load_recording(file, topics).whole().tensions() == [(1.0, 2.0)]


@pytest.fixture
def two_types(tmp_path):
    """Three arrays and two joint states on one topic."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    arrays = [bags.array(1.0, 2.0)] * 3
    states = [bags.joint_state(CABLES, effort=[3.0, 4.0], time=time) for time in (3.0, 4.0)]
    with Writer(tmp_path / 'bag', version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        times = iter(range(5))
        for messages in (arrays, states):
            kind = messages[0].__msgtype__
            connection = writer.add_connection('/tensions', kind, typestore=STORE)
            for message in messages:
                time = bags.ORIGIN + next(times) * 10**9
                writer.write(connection, time, STORE.serialize_cdr(message, kind))
    return tmp_path / 'bag' / 'bag.mcap'


def test_of_two_types_on_a_topic_it_has_to_be_said_which_is_meant(two_types):
    done = run('replay', two_types)
    assert_refused(done, 'Float64MultiArray (3 messages), sensor_msgs/msg/JointState (2 messages)')
    assert '--tension-source array|joint_state says which' in done.stderr
    recording = load_recording(two_types, BagTopics(tension_source='joint_state'))
    assert recording.tensions() == [(3.0, 4.0)] * 2
    assert '3 messages on /tensions are left out' in recording.notes[0]
    recording = load_recording(two_types, BagTopics(tension_source='array'))
    assert recording.tensions() == [(1.0, 2.0)] * 3


@pytest.mark.parametrize('stamped', [True, False])
def test_a_topic_that_was_recorded_twice_is_read_once_and_named(tmp_path, stamped):
    messages = []
    for index in range(20):
        message = (
            bags.joint_state(CABLES, effort=[1.0, 2.0], time=0.01 * index)
            if stamped
            else bags.array(1.0, 2.0)
        )
        messages += [('/tensions', 0.01 * index, message)] * 2
    recording = load_recording(write(tmp_path, *messages))
    assert len(recording) == 20
    assert recording.notes == (
        '/tensions was recorded more than once: 20 copies of messages are left out',
    )


def test_equal_messages_one_after_the_other_are_no_copies(tmp_path):
    messages = [('/tensions', 0.01 * index, bags.array(1.0, 2.0)) for index in range(20)]
    recording = load_recording(write(tmp_path, *messages))
    assert len(recording) == 20
    assert recording.notes == ()


def test_dynamic_joint_states_are_read_by_joint_and_interface(tmp_path):
    held = [{'position': 0.1, 'effort': 1.0}, {'effort': 2.0}, {'position': 0.3}]
    file = write(
        tmp_path,
        ('/tensions', 0.0, dynamic([*CABLES, 'tip'], held, 0.0)),
        ('/tensions', 0.1, dynamic(['tip'], held[2:], 0.1)),
        ('/tensions', 0.105, dynamic(['tip'], held[2:], 0.105)),
        ('/tensions', 0.2, dynamic(CABLES[::-1], held[:2], 0.2)),
    )
    topics = BagTopics(bend_angle='/tensions', joint_name='tip')
    recording = load_recording(file, topics)
    assert recording.tensions() == [(1.0, 2.0), (2.0, 1.0)]
    assert recording.bend_angle[0] == 0.3
    assert math.isnan(recording.bend_angle[1])
    with pytest.raises(RecordingError, match='the force of cable_l and cable_s') as error:
        load_recording(file, BagTopics(interface='force'))
    assert 'force is not among position, effort (--interface NAME)' in str(error.value)


@pytest.mark.parametrize(
    'kind', ['std_msgs/msg/Float64', 'std_msgs/msg/Float32', 'geometry_msgs/msg/Wrench']
)
def test_two_topics_with_a_number_or_a_bare_wrench_each_are_joined(tmp_path, kind):
    messages = []
    for index in range(20):
        time = 0.01 * index
        messages.append(('/tension_l', time, single(kind, 1.0)))
        messages.append(('/tension_s', time + 0.002, single(kind, 2.0 + index)))
    file = write(tmp_path, *messages)
    for topics in (BagTopics(), BagTopics(('tension_l', 'tension_s'))):
        recording = load_recording(file, topics)
        assert recording.tensions() == [(1.0, 2.0 + index) for index in range(20)]


def test_an_array_of_single_precision_is_read(tmp_path):
    layout = STORE.types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
    message = STORE.types['std_msgs/msg/Float32MultiArray'](
        layout=layout, data=np.array([1.5, 2.5], dtype=np.float32)
    )
    recording = load_recording(write(tmp_path, ('/tensions', 0.0, message)))
    assert recording.tensions() == [(1.5, 2.5)]


@pytest.mark.parametrize('lost', [None, 5])
def test_what_is_dropped_of_two_cables_does_not_put_time_back(tmp_path, lost):
    """Cells that are not triggered together, one of which comes later and repeats a message."""
    messages = []
    for index in range(20):
        time = 0.02 * index
        for topic, stamp, delay, value in (
            ('/tension_l', time + 0.004, 0.005, 1.0 + 0.01 * index),
            ('/tension_s', time, 0.006, 1.5),
            ('/tension_s', time, 0.007, 1.5001),
        ):
            if index != lost or topic == '/tension_s':
                messages.append((topic, time + delay, bags.wrench(0.0, 0.0, value, stamp)))
    recording = load_recording(write(tmp_path, *messages))
    assert recording.disorder == ''
    sound = [not fault for fault in recording.known_faults]
    assert recording.time[sound] == pytest.approx(
        [0.02 * index + 0.004 for index in range(20) if index != lost]
    )
    assert Counter(filter(None, recording.known_faults)) == Counter(
        {'repeated stamp': 20, **({} if lost is None else {'unpaired': 1})}
    )
    found = replay(PRELIMINARY, recording, 'tracking')
    assert found.angle_assured[sound].all()
