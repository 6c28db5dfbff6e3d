"""Which files make a bag: its manifest, split and compressed files, strangers, missing ones."""

import functools
import shutil

import bags
import lz4.frame
import numpy as np
import pytest
import yaml
import zstandard
from bags import write_bag
from programs import run

from tendon_statics.recordings.errors import RecordingError
from tendon_statics.recordings.reading.load import load_recording


def tensions(first, count):
    for index in range(first, first + count):
        yield '/tensions', 0.01 * index, bags.array(1.0, float(index))


@pytest.fixture(scope='module')
def written_split(tmp_path_factory):
    """Gives a bag of twelve files of the kind asked for, written once."""

    @functools.cache
    def written(ending):
        parts = tmp_path_factory.mktemp('parts')
        folder = parts / 'split'
        folder.mkdir()
        names = []
        for number in range(12):
            plugin = {'mcap': 'MCAP', 'db3': 'SQLITE3'}[ending]
            file = write_bag(parts / f'part_{number}', tensions(8 * number, 8), plugin)
            names.append(f'run_{number}.{ending}')
            shutil.move(file, folder / names[-1])
        write_manifest(folder, names, 96)
        return folder

    return written


@pytest.fixture(params=['mcap', 'db3'])
def split(tmp_path, written_split, request):
    """A bag of twelve files with eight messages each, listed in the order of recording."""
    return shutil.copytree(written_split(request.param), tmp_path / 'split')


def write_manifest(folder, names, count, **more):
    information = {'version': 9, 'relative_file_paths': names, 'message_count': count, **more}
    content = yaml.safe_dump({'rosbag2_bagfile_information': information})
    (folder / 'metadata.yaml').write_text(content)


def test_files_are_read_in_the_order_of_the_manifest(split):
    assert load_recording(split).whole().tension_s.tolist() == list(range(96))


def test_without_a_manifest_files_are_read_by_their_numbers_and_that_is_said(split):
    (split / 'metadata.yaml').unlink()
    recording = load_recording(split)
    assert recording.tension_s.tolist() == list(range(96))
    assert recording.damage == ()
    assert 'there is no metadata.yaml' in recording.notes[0]


def test_a_file_that_is_missing_is_named_and_the_others_are_read(split):
    (missing,) = split.glob('run_5.*')
    missing.unlink()
    recording = load_recording(split)
    assert recording.tension_s.tolist() == [*range(40), *range(48, 96)]
    assert recording.damage == (
        f'{missing.name} is missing, which metadata.yaml lists',
        'metadata.yaml counts 96 messages, and 88 can be read',
    )
    done = run('replay', split)
    assert done.returncode == 1
    assert f'{missing.name} is missing' in done.stderr


def test_a_file_that_the_manifest_does_not_list_is_left_out_and_named(split, tmp_path):
    stray = write_bag(tmp_path / 'stray', tensions(900, 3))
    shutil.copy(stray, split / 'a_stray.mcap')
    recording = load_recording(split)
    assert recording.tension_s.tolist() == list(range(96))
    assert recording.damage == ()
    assert recording.notes == ('left out, as metadata.yaml does not list it: a_stray.mcap',)
    assert run('replay', split).returncode == 0


def test_counts_by_topic_are_compared(tmp_path):
    file = write_bag(tmp_path / 'bag', tensions(0, 8))
    manifest = file.parent / 'metadata.yaml'
    assert load_recording(file.parent).damage == ()
    manifest.write_text(manifest.read_text().replace('message_count: 8', 'message_count: 9'))
    recording = load_recording(file.parent)
    assert recording.damage == ('metadata.yaml counts 9 messages on /tensions, and 8 can be read',)


@pytest.mark.parametrize(
    'content', ['rosbag2_bagfile_information: 3\n', 'a: [\n', '', '- 1\n', 'a: 1\na: 2\n']
)
def test_a_manifest_that_cannot_be_read_is_damage(split, content):
    (split / 'metadata.yaml').write_text(content)
    recording = load_recording(split)
    assert recording.tension_s.tolist() == list(range(96))
    (damage,) = recording.damage
    assert damage.startswith('metadata.yaml: ')


def test_a_manifest_without_files_loses_none(split):
    write_manifest(split, [], 0)
    recording = load_recording(split)
    assert recording.tension_s.tolist() == list(range(96))
    assert 'metadata.yaml lists no files' in recording.damage_summary


def test_if_all_files_of_a_manifest_are_missing_it_is_said_how_to_read_others(split):
    write_manifest(split, ['other_0.mcap', 'other_1.mcap'], 96)
    with pytest.raises(RecordingError, match=r'other_0\.mcap is missing.* run_0\.'):
        load_recording(split)


def test_a_manifest_leads_to_no_file_outside_of_its_folder(tmp_path):
    outside = write_bag(tmp_path / 'outside', tensions(0, 3))
    inside = write_bag(tmp_path / 'bag', tensions(10, 3)).parent
    write_manifest(inside, ['bag.mcap', str(outside), f'../outside/{outside.name}'], 3)
    recording = load_recording(inside)
    assert recording.tension_s.tolist() == [10.0, 11.0, 12.0]
    assert f'{outside.name} is missing' in recording.damage_summary


def test_the_folders_own_name_before_that_of_a_file_is_no_other_file(split):
    names = [f'split/{path.name}' for path in split.glob('run_?.*')]
    write_manifest(split, sorted(names), 80)
    assert load_recording(split).whole().tension_s.tolist() == list(range(80))


COMPRESSORS = {
    '.zstd': zstandard.ZstdCompressor(write_checksum=True).compress,
    '.zst': zstandard.ZstdCompressor().compress,
    '.lz4': lz4.frame.compress,
}


@pytest.mark.parametrize('ending', COMPRESSORS)
@pytest.mark.parametrize('plugin', ['MCAP', 'SQLITE3'])
def test_compressed_files_are_read_in_a_folder_and_by_themselves(tmp_path, plugin, ending):
    file = write_bag(tmp_path / 'bag', tensions(0, 50), plugin)
    packed = file.with_name(file.name + ending)
    packed.write_bytes(COMPRESSORS[ending](file.read_bytes()))
    file.unlink()
    manifest = packed.parent / 'metadata.yaml'
    for name in (packed.name, file.name):  # as it was recorded, and as it was before packing
        write_manifest(packed.parent, [name], 50)
        assert load_recording(packed.parent).whole().tension_s.tolist() == list(range(50))
    assert load_recording(packed).whole().tension_s.tolist() == list(range(50))
    manifest.unlink()
    assert load_recording(packed.parent).whole().tension_s.tolist() == list(range(50))
    assert sorted(path.name for path in packed.parent.iterdir()) == [packed.name]


@pytest.fixture(scope='module')
def long_bag(tmp_path_factory):
    """A file of many blocks of any compression."""
    return write_bag(tmp_path_factory.mktemp('long') / 'bag', tensions(0, 30_000))


@pytest.mark.parametrize('ending', COMPRESSORS)
def test_of_a_compressed_file_that_was_cut_the_beginning_is_read(tmp_path, long_bag, ending):
    content = COMPRESSORS[ending](long_bag.read_bytes())
    packed = tmp_path / f'run.mcap{ending}'
    packed.write_bytes(content[: int(0.6 * len(content))])
    recording = load_recording(packed)
    assert 500 < len(recording) < 30_000
    assert recording.tension_s.tolist() == list(range(len(recording)))
    assert 'truncated' in recording.damage_summary
    packed.write_bytes(b'no such')
    with pytest.raises(RecordingError, match=f'^{packed}: '):
        load_recording(packed)


@pytest.mark.parametrize(
    'compress',
    [zstandard.ZstdCompressor().compress, lz4.frame.compress],
    ids=['zstd', 'lz4'],
)
def test_messages_that_are_compressed_one_by_one_are_read(tmp_path, compress):
    import sqlite3

    file = write_bag(tmp_path / 'bag', tensions(0, 20), 'SQLITE3')
    with sqlite3.connect(file) as connection:
        rows = connection.execute('SELECT id, data FROM messages').fetchall()
        for key, data in rows:
            connection.execute('UPDATE messages SET data = ? WHERE id = ?', [compress(data), key])
    connection.close()
    assert load_recording(file.parent).whole().tension_s.tolist() == list(range(20))


def test_a_bag_of_ros_1_is_read_and_a_damaged_one_named(tmp_path):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    stamp = store.types['builtin_interfaces/msg/Time']
    kind = 'sensor_msgs/msg/JointState'
    path = tmp_path / 'run.bag'
    with Writer(path) as writer:
        connection = writer.add_connection('/tensions', kind, typestore=store)
        for index in range(40):
            time = bags.ORIGIN + index * 10_000_000
            header = store.types['std_msgs/msg/Header'](
                seq=index, stamp=stamp(sec=time // 10**9, nanosec=time % 10**9), frame_id=''
            )
            message = store.types[kind](
                header, ['cable_l', 'cable_s'], *[np.array([])] * 2, np.array([1.0, 2.0 + index])
            )
            writer.write(connection, time, store.serialize_ros1(message, kind))
    recording = load_recording(path).whole()
    assert recording.tension_s.tolist() == (2.0 + np.arange(40)).tolist()
    assert recording.time == pytest.approx(0.01 * np.arange(40))
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(RecordingError, match='rosbag reindex'):
        load_recording(path)
