"""Bags through ROS's own library, where it is: as much as the pure ones read, and without them."""

import sys

import bags
import numpy as np
import pytest
import stand_in_rosbag2
from bags import write_bag

from tendon_statics import RecordingError, load_recording
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.reading import rosbag2_file

SESSION = installed_config('recorded_session.mcap')
PURE = ('mcap', 'mcap.stream_reader', 'mcap.records', 'rosbags', 'rosbags.typesys')


@pytest.fixture
def rosbag2(monkeypatch):
    """Make `rosbag2_py` be there; the stand-in says what of the real one is used."""
    monkeypatch.setitem(sys.modules, 'rosbag2_py', stand_in_rosbag2)
    monkeypatch.setattr(rosbag2_file, 'is_installed', lambda library: library == 'rosbag2_py')
    for library in PURE:
        monkeypatch.setitem(sys.modules, library, None)
    return monkeypatch


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
    rosbag2.setattr(rosbag2_file, 'is_installed', lambda _: True)
    for library in PURE:
        rosbag2.delitem(sys.modules, library)
    recording = load_recording(path)
    assert bool(recording.damage) == (why == 'its end is missing')
    assert len(recording) > 10


def test_a_type_of_another_version_is_left_to_the_definitions_in_the_bag(tmp_path, rosbag2):
    path = write_bag(
        tmp_path / 'bag',
        [('/tensions', 0.1 * k, bags.estimate(1.0, 2.0, 0.1 * k)) for k in (0, 1)],
    )
    rosbag2.setitem(stand_in_rosbag2.SequentialReader.hashes, bags.ESTIMATE, 'RIHS01_other')
    with pytest.raises(RecordingError, match='Estimate in another version than is installed'):
        load_recording(path)
